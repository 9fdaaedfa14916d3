"""A muon arm: a target chamber, and a front absorber of cones in cones along the beam."""

from gdml_writer import Gdml, common_materials, place


def outer(z):
    """The absorber fills a cone of about ten degrees ..."""
    return 0.18 * z + 15


def inner(z):
    """... down to the shield around the beam pipe."""
    return 0.02 * z + 20


# From the outside in: name, material, margin to `inner`, then z and margin to `outer` of each
# plane. Two planes make a cone, more a polycone; margins that jump at a z are steps.
NEST = (
    ("Jacket", "Steel", 0, ((900, 0), (2000, 0), (2000, -40), (5000, -40))),
    ("Moderator", "Polyethylene", 6, ((920, 10), (4980, 10))),
    ("Carbon", "Graphite", 10, ((920, 25), (3000, 25), (3000, 40), (4900, 40))),
    ("Concrete", "Concrete", 15, ((1000, 60), (4800, 60))),
    ("Magnesium", "Magnesium", 20, ((1000, 80), (2200, 80), (2200, 100), (4700, 90))),
    ("Shield", "Lead", 25, ((1500, 120), (4500, 120))),
    ("Core", "Tungsten", 30, ((1500, 140), (3400, 140), (4200, 150))),
)
SLABS, SLAB_Z, SLAB = 8, 1800, 250  # cones that touch along z, within the core


def nested(gdml, name, planes):
    """A cone or polycone through (z, rmin, rmax). Returns its centre: a cone's origin is there."""
    if len(planes) > 2:
        gdml.planes("polycone", name, planes)
        return 0
    (z1, rmin1, rmax1), (z2, rmin2, rmax2) = planes
    gdml.solid("cone", name, rmin1=rmin1, rmax1=rmax1, rmin2=rmin2, rmax2=rmax2, z=z2 - z1,
               deltaphi=360)
    return (z1 + z2) / 2


def margins_at(level, z):
    """Margins of a level at z on both sides of a step; None outside it."""
    planes = level[3]
    return [m1 + (m2 - m1) * (z - z1) / (z2 - z1)
            for (z1, m1), (z2, m2) in zip(planes, planes[1:]) if z1 <= z <= z2 and z1 != z2]


def check_nest():
    """Each level lies within the one before."""
    for mother, daughter in zip(NEST, NEST[1:]):
        assert mother[2] < daughter[2]
        for z in sorted({z for level in (mother, daughter) for z, _ in level[3]}):
            if margins_at(daughter, z):
                assert margins_at(mother, z), f"{daughter[0]} is longer than {mother[0]}"
                assert max(margins_at(mother, z)) < min(margins_at(daughter, z)), daughter[0]


def absorber(gdml):
    check_nest()
    centres = []
    for name, _, shield, planes in NEST:
        centres.append(nested(gdml, f"{name}_s", [(z, inner(z) + shield, outer(z) - margin)
                                                  for z, margin in planes]))
    # Slabs in the core, each with a ring of gas in which a chamber is.
    slabs = []
    for i in range(SLABS):
        z1, z2 = SLAB_Z + i * SLAB, SLAB_Z + (i + 1) * SLAB
        planes = [(z, inner(z) + 35, outer(z) - 170) for z in (z1, z2)]
        assert planes[0][2] > planes[1][1] + 10
        centre = nested(gdml, f"Slab{i}_s", planes)
        rmin, rmax = planes[1][1] + 2, planes[0][2] - 2
        gdml.solid("tube", f"Gas{i}_s", rmin=rmin, rmax=rmax, z=SLAB / 5, deltaphi=360)
        gdml.solid("tube", f"Chamber{i}_s", rmin=rmin + 2, rmax=rmax, z=0.5, startphi=15,
                   deltaphi=60)
        gdml.volume(f"Chamber{i}", "Silicon", f"Chamber{i}_s")
        gdml.volume(f"Gas{i}", "Air", f"Gas{i}_s",
                    [place(f"chamber{i}_{q}", f"Chamber{i}", None, (0, 0, -90 * q), copy=q)
                     for q in range(4)])
        gdml.volume(f"Slab{i}", "Tungsten" if i % 2 else "Lead", f"Slab{i}_s",
                    [place("gas", f"Gas{i}")])
        slabs.append(place(f"slab{i}", f"Slab{i}", (0, 0, centre), copy=i))
    within = slabs
    for k in reversed(range(len(NEST))):
        name, material = NEST[k][:2]
        gdml.volume(name, material, f"{name}_s", within)
        mother = centres[k - 1] if k else 0
        within = [place(name.lower(), name, (0, 0, centres[k] - mother))]
    return within


def chamber(gdml):
    """Ball and pipe in one, steel and the vacuum within, with foils and shells of silicon."""
    for name, ball, tube in (("Chamber", 210, 32), ("ChamberVacuum", 205, 30)):
        gdml.solid("orb", f"{name}Ball_s", r=ball)
        gdml.solid("tube", f"{name}Tube_s", rmax=tube, z=600, deltaphi=360)
        gdml.boolean("union", f"{name}_s", f"{name}Ball_s", f"{name}Tube_s")
    gdml.solid("sphere", "Shell_s", rmin=100, rmax=101, deltaphi=360, starttheta=20,
               deltatheta=140)
    gdml.solid("sphere", "Cap_s", rmin=120, rmax=122, startphi=0, deltaphi=180, starttheta=15,
               deltatheta=75)
    gdml.solid("tube", "Foil_s", rmax=15, z=0.5, deltaphi=360)
    for name, material in (("Shell", "Silicon"), ("Cap", "Silicon"), ("Foil", "Tungsten")):
        gdml.volume(name, material, f"{name}_s")
    gdml.volume("ChamberVacuum", "Vacuum", "ChamberVacuum_s",
                [place("shell", "Shell"), place("cap0", "Cap", copy=0),
                 place("cap1", "Cap", None, "half_turn", copy=1)] +
                [place(f"foil{i}", "Foil", (0, 0, 8 * i - 16), copy=i) for i in range(5)])
    gdml.volume("TargetChamber", "Steel", "Chamber_s", [place("vacuum", "ChamberVacuum")])

    gdml.solid("sphere", "Dome_s", rmin=600, rmax=640, deltaphi=360, starttheta=100,
               deltatheta=70)
    gdml.solid("sphere", "RoofShell_s", rmin=700, rmax=720, deltaphi=360, starttheta=0,
               deltatheta=180)
    gdml.solid("box", "RoofBox_s", x=600, y=200, z=600)
    gdml.boolean("intersection", "Roof_s", "RoofShell_s", "RoofBox_s", y=700)
    gdml.volume("Dome", "Steel", "Dome_s")
    gdml.volume("Roof", "Steel", "Roof_s")
    return [place("target_chamber", "TargetChamber"), place("dome", "Dome"),
            place("roof", "Roof"), place("floor", "Roof", None, "half_turn")]


def pipe(gdml):
    """The beam pipe beyond the chamber: steel, and the vacuum in it."""
    outside = [(300, 32), (900, 32), (5000, 114), (7500, 114)]
    for name, wall in (("Pipe", 0), ("PipeVacuum", 2)):
        gdml.planes("polycone", f"{name}_s", [(z, 0, r - wall) for z, r in outside])
        gdml.solid("tube", f"{name}Upstream_s", rmax=32 - wall, z=7000, deltaphi=360)
    assert all(r < inner(z) for z, r in outside if 900 <= z <= 5000)
    parts = []
    for end, z in (("", 0), ("Upstream", -3800)):
        gdml.volume(f"PipeVacuum{end}", "Vacuum", f"PipeVacuum{end}_s")
        gdml.volume(f"Pipe{end}", "Steel", f"Pipe{end}_s",
                    [place("vacuum", f"PipeVacuum{end}")])
        parts.append(place(f"pipe{end.lower()}", f"Pipe{end}", (0, 0, z)))
    return parts


def muon_arm(gdml):
    """A collar, a wall with a bore, and stations of quadrants that touch."""
    gdml.solid("tube", "CollarTube_s", rmin=125, rmax=400, z=200, deltaphi=360)
    gdml.solid("cone", "CollarCone_s", rmin1=125, rmax1=300, rmin2=125, rmax2=200, z=200,
               deltaphi=360)
    gdml.boolean("union", "Collar_s", "CollarTube_s", "CollarCone_s", z=200)
    gdml.volume("Collar", "Lead", "Collar_s")
    gdml.solid("box", "WallBox_s", x=4, y=4, z=1, lunit="m")
    gdml.solid("cone", "WallBore_s", rmax1=125, rmax2=135, z=1200, deltaphi=360)
    gdml.boolean("subtraction", "Wall_s", "WallBox_s", "WallBore_s")
    gdml.volume("Wall", "Steel", "Wall_s")

    gdml.solid("tube", "Quadrant_s", rmin=140, rmax=1800, z=60, startphi=0, deltaphi=90)
    gdml.solid("tube", "QuadrantGas_s", rmin=160, rmax=1780, z=10, startphi=2, deltaphi=86)
    gdml.solid("tube", "Station_s", rmin=140, rmax=1800, z=60, deltaphi=360)
    gdml.volume("QuadrantGas", "Air", "QuadrantGas_s")
    gdml.volume("Quadrant", "Aluminium", "Quadrant_s",
                [place(f"gas{i}", "QuadrantGas", (0, 0, 15 * i - 15), copy=i) for i in range(3)])
    gdml.volume("Station", "Air", "Station_s",
                [place(f"quadrant{q}", "Quadrant", None, (0, 0, -90 * q), copy=q)
                 for q in range(4)])
    return [place("collar", "Collar", (0, 0, 5200)), place("wall", "Wall", "wall")] + [
        place(f"station{i}", "Station", (0, 0, z), copy=i)
        for i, z in enumerate((6600, 6900, 7200))]


def build():
    gdml = Gdml("Cones in cones: a front absorber and muon arm. Generated by generate.py.")
    gdml.position("wall", z=600, unit="cm")
    gdml.rotation("half_turn", z=180)
    common_materials(gdml)
    gdml.mixture("Polyethylene", 0.95, hydrogen=0.1437, carbon=0.8563)
    gdml.mixture("Concrete", 2.35, hydrogen=0.01, oxygen=0.53, silicon_atom=0.46)
    for name, z, atom, density in (("Graphite", 6, 12.011, 1.9), ("Magnesium", 12, 24.305, 1.74),
                                   ("Tungsten", 74, 183.84, 19.3), ("Silicon", 14, 28.086, 2.33),
                                   ("Aluminium", 13, 26.982, 2.699)):
        gdml.material(name, z, atom, density)
    parts = absorber(gdml) + chamber(gdml) + pipe(gdml) + muon_arm(gdml)
    gdml.solid("box", "World_s", x=5, y=5, z=16, lunit="m")
    gdml.volume("World", "Air", "World_s", parts)
    return gdml.text("World")
