"""Single volumes as experiments have them, side by side: what measurements of one scene run on."""

import math

from gdml_writer import Gdml, common_materials, place


def hall(gdml):
    """65 large daughters of many kinds around an axis: 13 rings of five."""
    gdml.solid("box", "HallBox_s", x=600, y=1500, z=900)
    gdml.solid("trd", "HallTrd_s", x1=900, x2=500, y1=1100, y2=700, z=1000)
    gdml.solid("tube", "HallTube_s", rmin=150, rmax=480, z=1100, deltaphi=360)
    gdml.solid("cone", "HallCone_s", rmin1=40, rmax1=420, rmin2=60, rmax2=700, z=1200, deltaphi=360)
    gdml.planes("polycone", "HallCore_s",
                [(-600, 50, 500), (-100, 50, 1300), (200, 50, 1300), (600, 50, 800)])
    gdml.volume("HallBox", "Steel", "HallBox_s")
    gdml.volume("HallTrd", "Lead", "HallTrd_s")
    gdml.volume("HallTube", "Steel", "HallTube_s")
    gdml.volume("HallCone", "Steel", "HallCone_s")
    gdml.volume("HallCore", "Polystyrene", "HallCore_s")
    arms = ("HallBox", "HallTrd", "HallTube", "HallTrd")
    daughters = []
    for ring in range(13):
        z = (ring - 6) * 1350
        daughters.append(place(f"core{ring}", "HallCore" if ring % 2 else "HallCone", (0, 0, z)))
        for arm in range(4):
            phi = 90 * arm + 13 * ring
            x, y = 2600 * math.cos(math.radians(phi)), 2600 * math.sin(math.radians(phi))
            daughters.append(place(f"arm{ring}_{arm}", arms[(arm + ring) % 4], (x, y, z),
                                   (0, 0, -phi)))
    gdml.solid("tube", "Hall_s", rmax=4000, z=18600, deltaphi=360)
    gdml.volume("Hall", "Air", "Hall_s", daughters)
    return "Hall"


def drift(gdml):
    """A drift volume: field rings, rods, chambers and clips, 641 daughters of seven solids."""
    gdml.solid("tube", "FieldRing_s", rmin=802, rmax=808, z=10, deltaphi=360)
    gdml.solid("tube", "Rod_s", rmin=7, rmax=9, z=2200, deltaphi=360)
    gdml.solid("tube", "OuterRod_s", rmin=14, rmax=20, z=2200, deltaphi=360)
    gdml.solid("trd", "Chamber_s", x1=290, x2=440, y1=36, y2=36, z=440)
    gdml.solid("trd", "OuterChamber_s", x1=460, x2=840, y1=36, y2=36, z=1080)
    gdml.solid("box", "Clip_s", x=18, y=50, z=12)
    gdml.solid("tube", "Membrane_s", rmin=850, rmax=2450, z=0.3, deltaphi=360)
    for name in ("FieldRing", "Rod", "OuterRod", "Chamber", "OuterChamber", "Clip", "Membrane"):
        gdml.volume(name, "Polystyrene", f"{name}_s")
    daughters = [place("membrane", "Membrane")]
    for i in range(156):
        z = (i - 77.5) * 15 + (1 if i > 77 else -1) * 20
        daughters.append(place(f"ring{i}", "FieldRing", (0, 0, z)))
    for side, sign in (("A", 1), ("C", -1)):
        for s in range(18):
            phi = 20 * s + 10
            c, sn = math.cos(math.radians(phi)), math.sin(math.radians(phi))
            # The chambers stand upright in their frame: z outwards, x along phi.
            for name, radius in (("Chamber", 1100.0), ("OuterChamber", 1900.0)):
                daughters.append(place(f"{name}{side}{s}", name,
                                       (radius * c, radius * sn, sign * 2440), (-90, 270 - phi, 0)))
            for name, radius in (("Rod", 830.0), ("OuterRod", 2520.0)):
                a = math.radians(phi + 10)
                daughters.append(place(f"{name}{side}{s}", name,
                                       (radius * math.cos(a), radius * math.sin(a), sign * 1130)))
    clips = 641 - len(daughters)
    for i in range(clips):
        phi = 360 * i / clips * 4 + 3
        z = -2000 + 4000 * i / clips
        x, y = 2480 * math.cos(math.radians(phi)), 2480 * math.sin(math.radians(phi))
        daughters.append(place(f"clip{i}", "Clip", (x, y, z), (0, 0, -phi)))
    gdml.solid("tube", "Drift_s", rmin=795, rmax=2560, z=4980, deltaphi=360)
    gdml.volume("Drift", "Air", "Drift_s", daughters)
    return "Drift"


def wheel(gdml):
    """A muon wheel: 12 sectors of 12 layers of five rotated boxes, and 69 feet: 789 daughters."""
    for layer in range(12):
        gdml.solid("box", f"Layer{layer}_s", x=180, y=400 + 25 * layer, z=460)
        gdml.volume(f"Layer{layer}", "Steel", f"Layer{layer}_s")
    gdml.solid("box", "Foot_s", x=50, y=160, z=180)
    gdml.volume("Foot", "Steel", "Foot_s")
    daughters = []
    for sector in range(12):
        phi = 30 * sector
        c, s = math.cos(math.radians(phi)), math.sin(math.radians(phi))
        for layer in range(12):
            for cell in range(5):
                radius = 4000 + 210 * layer
                z = (cell - 2) * 490
                daughters.append(place(f"layer{sector}_{layer}_{cell}", f"Layer{layer}",
                                       (radius * c, radius * s, z), (0, 0, -phi)))
    for foot in range(69):
        phi = 360 / 69 * foot
        c, s = math.cos(math.radians(phi)), math.sin(math.radians(phi))
        daughters.append(place(f"foot{foot}", "Foot", (6780 * c, 6780 * s, 0), (0, 0, -phi)))
    gdml.planes("polyhedra", "Wheel_s", [(-1268, 3800, 6900), (1268, 3800, 6900)], startphi=-15,
                numsides=12)
    gdml.volume("Wheel", "Air", "Wheel_s", daughters)
    return "Wheel"


def lattice(gdml):
    gdml.solid("box", "LatticeCell_s", x=9, y=9, z=9)
    gdml.volume("LatticeCell", "Lead", "LatticeCell_s")
    gdml.solid("box", "Lattice_s", x=100, y=100, z=100)
    gdml.volume("Lattice", "Air", "Lattice_s",
                [place(f"cell{i}_{j}_{k}", "LatticeCell",
                       (10 * i - 45, 10 * j - 45, 10 * k - 45))
                 for k in range(10) for j in range(10) for i in range(10)])
    return "Lattice"


def end_cap(gdml):
    """Tapered crystals that point at a place in front of them, a rotation each."""
    gdml.solid("trd", "Crystal_s", x1=24, x2=26, y1=24, y2=26, z=200)
    gdml.volume("Crystal", "Lead", "Crystal_s")
    focus, radius = 3000.0, 3100.0
    daughters = []
    for j in range(20):
        for i in range(20):
            a, b = (i - 9.5) * 0.0092, (j - 9.5) * 0.0092
            # Mother to daughter: about x, then about y.
            x, y = math.tan(a), math.tan(b)
            norm = math.sqrt(1 + x * x + y * y)
            position = (radius * x / norm, radius * y / norm, radius / norm - focus)
            turn = (math.degrees(math.atan2(y, 1)), -math.degrees(math.asin(x / norm)), 0)
            daughters.append(place(f"crystal{i}_{j}", "Crystal", position, turn))
    gdml.solid("box", "EndCap_s", x=700, y=700, z=420)
    gdml.volume("EndCap", "Air", "EndCap_s", daughters)
    return "EndCap"


def nested(gdml):
    """A leaf tube in tubes, and a leaf cone in cones."""
    for name, rmin, rmax, z in (("CopperTube", 40, 42, 3900), ("PumpTube", 0, 42, 3900),
                                ("Section", 0, 850, 4100), ("BeamLine", 0, 900, 8400)):
        gdml.solid("tube", f"{name}_s", rmin=rmin, rmax=rmax, z=z, deltaphi=360)
    gdml.volume("CopperTube", "Steel", "CopperTube_s")
    gdml.volume("PumpTube", "Vacuum", "PumpTube_s", [place("copper", "CopperTube")])
    gdml.volume("Section", "Air", "Section_s", [place("tube", "PumpTube")])
    gdml.volume("BeamLine", "Air", "BeamLine_s",
                [place("front", "Section", (0, 0, -2100)), place("back", "Section", (0, 0, 2100))])
    shells = (("LeadCone", 40, 62, 60, 90), ("GraphiteCone", 62, 190, 90, 270),
              ("SteelCone", 190, 215, 270, 300))
    for name, a, b, c, d in shells:
        gdml.solid("cone", f"{name}_s", rmin1=a, rmax1=b, rmin2=c, rmax2=d, z=520, deltaphi=360)
        gdml.volume(name, "Lead", f"{name}_s")
    gdml.solid("cone", "Absorber_s", rmin1=40, rmax1=215, rmin2=60, rmax2=300, z=520, deltaphi=360)
    gdml.volume("Absorber", "Air", "Absorber_s", [place(n.lower(), n) for n, *_ in shells])
    return "BeamLine", "Absorber"


def stick(gdml):
    """A quartz fibre in grooves in sticks, thousands of placements."""
    gdml.solid("tube", "Quartz_s", rmax=0.18, z=1000, deltaphi=360)
    gdml.solid("box", "Groove_s", x=0.6, y=0.6, z=1000)
    gdml.solid("box", "Stick_s", x=3.2, y=3.2, z=1000)
    gdml.solid("box", "Slab_s", x=35.2, y=3.2, z=1000)
    gdml.solid("box", "Bundle_s", x=35.2, y=35.2, z=1000)
    gdml.volume("Quartz", "Polystyrene", "Quartz_s")
    gdml.volume("Groove", "Air", "Groove_s", [place("quartz", "Quartz")])
    gdml.volume("Stick", "Lead", "Stick_s",
                [place(f"groove{i}{j}", "Groove", (1.6 * i - 0.8, 1.6 * j - 0.8, 0))
                 for i in range(2) for j in range(2)])
    gdml.volume("Slab", "Lead", "Slab_s",
                [place(f"stick{i}", "Stick", (3.2 * i - 16, 0, 0)) for i in range(11)])
    gdml.volume("Bundle", "Lead", "Bundle_s",
                [place(f"slab{j}", "Slab", (0, 3.2 * j - 16, 0)) for j in range(11)])
    return "Bundle"


def build():
    gdml = Gdml("Single volumes as experiments have them. Generated by generate.py.")
    common_materials(gdml)
    beam_line, absorber = nested(gdml)
    gdml.solid("box", "World_s", x=60, y=30, z=30, lunit="m")
    gdml.volume("World", "Air", "World_s", [
        place("hall", hall(gdml), (-20000, 0, 0)), place("drift", drift(gdml), (-10000, 0, 0)),
        place("wheel", wheel(gdml), (3000, 0, 0)), place("lattice", lattice(gdml), (12000, 0, 0)),
        place("end_cap", end_cap(gdml), (14000, 0, 0)),
        place("beam_line", beam_line, (17000, 0, 0)), place("absorber", absorber, (20000, 0, 0)),
        place("bundle", stick(gdml), (23000, 0, 0))])
    return gdml.text("World")
