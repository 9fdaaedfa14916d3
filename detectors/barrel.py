"""A collider detector: tracker, crystal and sampling calorimeters around a beam pipe along z."""

import math

import clearance
from gdml_writer import Gdml, common_materials, place

# Silicon layers: name, radius, staves, turn of a stave in degrees, modules along z.
LAYERS = (("Pixel1", 44, 16, 14, 8), ("Pixel2", 80, 28, 14, 8), ("Strip1", 250, 28, 10, 10),
          ("Strip2", 400, 44, 10, 10), ("Strip3", 600, 64, 10, 12), ("Strip4", 850, 92, 10, 12))
STAVE = {"Pixel": (3, 20, 800), "Strip": (6, 62, 1600)}  # thickness, width, length of a stave
DISKS = (1000, 1250, 1550, 1900)  # z of the silicon disks

SECTORS = 36  # of the crystal calorimeter
ROWS = 40
COLUMNS = 5
CRYSTAL_IN, CRYSTAL_OUT = 1250.0, 1500.0  # radii of a sector's faces
ROW_PITCH = 96.0
SECTOR_GAP = 0.5  # half of the space between sectors

HCAL_SIDES = 12
HCAL_IN, HCAL_OUT = 1800.0, 2700.0  # distances of the sides from the beam
HCAL_PLATES = 12


def stave(gdml, name, kind, modules):
    """A stave of `modules` modules: x is its thickness, z its length."""
    thickness, width, length = STAVE[kind]
    pitch = length / modules
    gdml.solid("box", f"{name}Stave_s", x=thickness, y=width, z=length)
    gdml.solid("box", f"{name}Module_s", x=f"{kind.lower()}_sensor + 0.7", y=width, z=pitch - 1)
    gdml.solid("box", f"{name}Sensor_s", x=f"{kind.lower()}_sensor", y=width - 1, z=pitch - 2)
    gdml.solid("box", f"{name}Chip_s", x=0.4, y=width / 4, z=(pitch - 2) / 5)
    gdml.solid("box", f"{name}Support_s", x=0.8, y=width, z=length)
    gdml.solid("tube", f"{name}Cooling_s", rmax=0.3, z=length, deltaphi=360)
    gdml.volume(f"{name}Sensor", "Silicon", f"{name}Sensor_s")
    gdml.volume(f"{name}Chip", "Silicon", f"{name}Chip_s")
    gdml.volume(f"{name}Cooling", "Water", f"{name}Cooling_s")
    # From the inside: the sensor, then its chips in touch with it.
    chips = [place(f"chip{j * 4 + i}", f"{name}Chip",
                   (f"0.15 + {kind.lower()}_sensor/2", (j - 1) * width / 3.5,
                    (i - 1.5) * pitch / 4))
             for j in range(3) for i in range(4)]
    gdml.volume(f"{name}Module", "Nitrogen", f"{name}Module_s",
                [place("sensor", f"{name}Sensor", ("-0.05", 0, 0))] + chips)
    gdml.volume(f"{name}Support", "CarbonFibre", f"{name}Support_s",
                [place("cooling", f"{name}Cooling")])
    parts = [place("support", f"{name}Support", (thickness / 2 - 0.4, 0, 0))]
    parts += [place(f"module{i}", f"{name}Module",
                    (-thickness / 4, 0, (i - (modules - 1) / 2) * pitch), copy=i)
              for i in range(modules)]
    gdml.volume(f"{name}Stave", "Nitrogen", f"{name}Stave_s", parts)


def layer(gdml, name, radius, count, turn, modules):
    """An assembly of turned staves. The pixels' rotations have names, the strips' are inline."""
    kind = name[:5]
    thickness, width, _ = STAVE[kind]
    stave(gdml, name, kind, modules)
    staves = []
    for i in range(count):
        phi = 360 * i / count
        x = radius * math.cos(math.radians(phi))
        y = radius * math.sin(math.radians(phi))
        if kind == "Pixel":
            rotation = f"{name}_turn{i}"
            gdml.rotation(rotation, z=f"-(360*{i}/{count} + {turn})")
        else:
            rotation = (0, 0, f"-({i}*two_pi/{count} + {turn}*one_degree)")
        staves.append(place(f"{name}_stave{i}", f"{name}Stave", (x, y, 0), rotation, copy=i,
                            unit="rad"))
    gdml.assembly(f"{name}Layer", staves)
    return clearance.ring(radius, count, turn, thickness, width)


def tracker(gdml):
    parts = []
    previous = 30.0  # outside the beam pipe
    for name, radius, count, turn, modules in LAYERS:
        near, far = layer(gdml, name, radius, count, turn, modules)
        assert previous < near, f"{name} reaches into the layer within"
        previous = far
        parts.append(place(name.lower(), f"{name}Layer"))
    assert previous < 1000

    # A disk: 24 petals, alternately on its two sides, so that they may overlap in phi.
    gdml.solid("tube", "Disk_s", rmin=120, rmax=950, z=24, deltaphi=360)
    gdml.solid("tube", "DiskSupport_s", rmin=120, rmax=950, z=4, deltaphi=360)
    gdml.solid("tube", "Petal_s", rmin=150, rmax=900, z="strip_sensor", startphi=-8.5,
               deltaphi=17)
    gdml.volume("DiskSupport", "CarbonFibre", "DiskSupport_s")
    gdml.volume("Petal", "Silicon", "Petal_s")
    petals = [place("support", "DiskSupport")]
    for i in range(24):
        side = 4 if i % 2 else -4
        petals.append(place(f"petal{i}", "Petal", (0, 0, side), (0, 0, f"-15*{i}"), copy=i))
    gdml.volume("Disk", "Nitrogen", "Disk_s", petals)
    for i, z in enumerate(DISKS):
        parts.append(place(f"disk_plus{i}", "Disk", (0, 0, z), copy=i))
        parts.append(place(f"disk_minus{i}", "Disk", (0, 0, -z), "flip", copy=i + len(DISKS)))
    gdml.solid("tube", "Tracker_s", rmin=30, rmax=1000, z=4400, deltaphi=360)
    gdml.volume("Tracker", "Nitrogen", "Tracker_s", parts)


def crystals(gdml):
    """A ring of trapezoidal sectors: local z points outwards, y along the beam. Rows touch, and so
    do the five crystals of a row, whose sides all point to the sector's apex."""
    slope = math.tan(math.pi / SECTORS)
    inner = CRYSTAL_IN * slope - SECTOR_GAP  # half widths
    outer = CRYSTAL_OUT * slope - SECTOR_GAP
    height = CRYSTAL_OUT - CRYSTAL_IN
    gdml.solid("trd", "Sector_s", x1=2 * inner, x2=2 * outer, y1=ROWS * ROW_PITCH,
               y2=ROWS * ROW_PITCH, z=height)
    gdml.solid("trd", "Row_s", x1=2 * inner, x2=2 * outer, y1=ROW_PITCH, y2=ROW_PITCH, z=height)
    row = []
    for column in range(COLUMNS):
        offset = (2 * column + 1 - COLUMNS) / COLUMNS  # of the centre, in half widths
        lean = math.degrees(math.atan(abs(offset) * (outer - inner) / height))
        name = f"Crystal{column}"
        wide = dict(x1=2 * inner / COLUMNS, x2=2 * inner / COLUMNS)
        if offset == 0:
            gdml.solid("trd", f"{name}_s", x1=wide["x1"], x2=2 * outer / COLUMNS, y1=ROW_PITCH,
                       y2=ROW_PITCH, z=height)
        else:
            gdml.solid("trap", f"{name}_s", z=height, theta=lean, phi=0 if offset > 0 else 180,
                       y1=ROW_PITCH, **wide, alpha1=0, y2=ROW_PITCH, x3=2 * outer / COLUMNS,
                       x4=2 * outer / COLUMNS, alpha2=0)
        gdml.volume(name, "LeadTungstate", f"{name}_s")
        row.append(place(f"crystal{column}", name, (offset * (inner + outer) / 2, 0, 0),
                         copy=column))
    gdml.volume("Row", "Air", "Row_s", row)
    gdml.volume("Sector", "Air", "Sector_s",
                [place(f"row{i}", "Row", (0, (i - (ROWS - 1) / 2) * ROW_PITCH, 0), copy=i)
                 for i in range(ROWS)])
    sectors = []
    middle = (CRYSTAL_IN + CRYSTAL_OUT) / 2
    for i in range(SECTORS):
        phi = 2 * math.pi * i / SECTORS
        sectors.append(place(f"sector{i}", "Sector",
                             (middle * math.cos(phi), middle * math.sin(phi), 0),
                             angles_of(sector_matrix(phi)), copy=i))
    gdml.assembly("CrystalBarrel", sectors)
    assert CRYSTAL_IN > 1000 and math.hypot(CRYSTAL_OUT, outer) < 1550


def sector_matrix(phi):
    """Mother-to-local: its rows are the local axes, which are the azimuth, the beam, the radius."""
    c, s = math.cos(phi), math.sin(phi)
    return ((-s, c, 0), (0, 0, 1), (c, s, 0))


def angles_of(m):
    """Degrees x, y, z with m = Rz(z) * Ry(y) * Rx(x)."""
    y = math.asin(max(-1.0, min(1.0, -m[2][0])))
    if math.hypot(m[0][0], m[1][0]) < 1e-9:  # y = +-90: only a sum of x and z is defined
        x, z = math.atan2(-m[1][2], m[1][1]), 0
    else:
        x, z = math.atan2(m[2][1], m[2][2]), math.atan2(m[1][0], m[0][0])
    return tuple(math.degrees(a) for a in (x, y, z))


def hadronic(gdml):
    """Twelve-sided steel with twelve-sided plates of scintillator, and end caps of rings of tube
    segments that touch in phi."""
    sides = dict(startphi=-15, deltaphi=360, numsides=HCAL_SIDES)
    gdml.planes("polyhedra", "Hcal_s", [(-2100, HCAL_IN, HCAL_OUT), (2100, HCAL_IN, HCAL_OUT)],
                **sides)
    plates = []
    for i in range(HCAL_PLATES):
        at = HCAL_IN + 30 + i * 72
        gdml.planes("polyhedra", f"HcalPlate{i}_s", [(-2050, at, at + 12), (2050, at, at + 12)],
                    **sides)
        gdml.volume(f"HcalPlate{i}", "Polystyrene", f"HcalPlate{i}_s")
        plates.append(place(f"plate{i}", f"HcalPlate{i}", copy=i))
    gdml.volume("Hcal", "Steel", "Hcal_s", plates)

    gdml.planes("polycone", "Endcap_s", [(0, 110, 1600), (400, 120, 1600), (400, 120, 2700),
                                         (1200, 140, 2700)])
    segments = []
    for ring, (rmin, rmax, count) in enumerate(((200, 800, 16), (800, 1500, 32), (1650, 2600, 64))):
        step = f"360/{count}"
        gdml.solid("tube", f"EndcapTile{ring}_s", rmin=rmin, rmax=rmax, z="endcap_tile",
                   startphi=0, deltaphi=step)
        gdml.volume(f"EndcapTile{ring}", "Polystyrene", f"EndcapTile{ring}_s")
        gdml.assembly(f"EndcapRing{ring}",
                      [place(f"ring{ring}_tile{i}", f"EndcapTile{ring}", None,
                             (0, 0, f"-{i}*{step}"), copy=i) for i in range(count)])
        for layer_number in range(10):
            z = 60 + 110 * layer_number
            if ring < 2 or z > 460:
                segments.append(place(f"ring{ring}_layer{layer_number}", f"EndcapRing{ring}",
                                      (0, 0, z)))
    gdml.volume("Endcap", "Brass", "Endcap_s", segments)
    assert HCAL_OUT / math.cos(math.pi / HCAL_SIDES) < 3000


def beam_pipe(gdml):
    gdml.planes("polycone", "BeamPipe_s", [(-5500, 0, 62), (-2300, 0, 26), (2300, 0, 26),
                                           (5500, 0, 62)])
    gdml.solid("tube", "PipeCentral_s", rmin=24, rmax=25, z=4600, deltaphi=360)
    gdml.solid("cone", "PipeForward_s", rmin1=24, rmax1=25, rmin2=60, rmax2=61, z=3200,
               deltaphi=360)
    gdml.volume("PipeCentral", "Beryllium", "PipeCentral_s")
    gdml.volume("PipeForward", "Steel", "PipeForward_s")
    gdml.volume("BeamPipe", "Vacuum", "BeamPipe_s",
                [place("central", "PipeCentral"),
                 place("forward_plus", "PipeForward", (0, 0, 3900), copy=0),
                 place("forward_minus", "PipeForward", (0, 0, -3900), "flip", copy=1)])


def solenoid(gdml):
    gdml.solid("tube", "Cryostat_s", rmin=1560, rmax=1760, z="2*2080", deltaphi=360)
    gdml.solid("tube", "CryostatVacuum_s", rmin=1575, rmax=1745, z="2*2060", deltaphi=360)
    gdml.solid("tube", "Coil_s", rmin="1650 - coil/2", rmax="1650 + coil/2", z="2*1950",
               deltaphi=360)
    gdml.volume("Coil", "Aluminium", "Coil_s")
    gdml.volume("CryostatVacuum", "Vacuum", "CryostatVacuum_s", [place("coil", "Coil")])
    gdml.volume("Cryostat", "Aluminium", "Cryostat_s", [place("vacuum", "CryostatVacuum")])


def services(gdml):
    """Booleans: bulkheads with openings, patch panels, and the feet."""
    gdml.solid("tube", "BulkheadDisk_s", rmin=300, rmax=1500, z=20, deltaphi=360)
    gdml.solid("box", "BulkheadSlot_s", x=2400, y=160, z=40)
    gdml.boolean("subtraction", "Bulkhead_s", "BulkheadDisk_s", "BulkheadSlot_s")
    gdml.volume("Bulkhead", "CarbonFibre", "Bulkhead_s")

    gdml.solid("tube", "PanelDisk_s", rmin=0, rmax=90, z=8, deltaphi=360)
    gdml.solid("box", "PanelBox_s", x=150, y=150, z=20)
    gdml.boolean("intersection", "Panel_s", "PanelBox_s", "PanelDisk_s")
    gdml.volume("Panel", "Copper", "Panel_s")
    gdml.assembly("Panels", [place("panel_up", "Panel", (0, 700, 0), copy=0),
                             place("panel_left", "Panel", (-700, 400, 0), (0, 0, 30), copy=1),
                             place("panel_right", "Panel", (700, 400, 0), (0, 0, "-30"), copy=2)])
    gdml.assembly("EndServices", [place("bulkhead", "Bulkhead", (0, 0, 2230)),
                                  place("panels", "Panels", (0, 0, 2260))])

    gdml.solid("box", "FootColumn_s", x=300, y=900, z=600)
    gdml.solid("box", "FootBase_s", x=900, y=100, z=900)
    gdml.boolean("union", "Foot_s", "FootColumn_s", "FootBase_s", y=-450)
    gdml.solid("tube", "FootBore_s", rmax=100, z=700, deltaphi=360)
    gdml.boolean("subtraction", "BoredFoot_s", "Foot_s", "FootBore_s", y=100)
    gdml.volume("Foot", "Steel", "BoredFoot_s")


def build():
    gdml = Gdml("A collider detector with a barrel and end caps. Generated by generate.py.")
    gdml.constant("two_pi", "2*pi")
    gdml.constant("one_degree", "two_pi/360")
    gdml.variable("pixel_sensor", 0.3)
    gdml.variable("strip_sensor", "pixel_sensor + 0.1")
    gdml.quantity("coil", "length", 6, "cm")
    gdml.quantity("endcap_tile", "length", 0.01, "m")
    gdml.position("endcap_plus", z=2.3, unit="m")
    gdml.position("endcap_minus", z="-230", unit="cm")
    gdml.rotation("flip", y=180)
    common_materials(gdml)
    gdml.mixture("Nitrogen", 0.00117, nitrogen=1)
    gdml.mixture("Water", 1, hydrogen=0.1119, oxygen=0.8881)
    gdml.mixture("CarbonFibre", 1.6, carbon=0.9, hydrogen=0.02, oxygen=0.08)
    gdml.mixture("LeadTungstate", 8.28, lead_atom=0.455, tungsten=0.404, oxygen=0.141)
    gdml.mixture("Brass", 8.5, copper_atom=0.7, zinc=0.3)
    gdml.material("Silicon", 14, 28.086, 2.33)
    gdml.material("Beryllium", 4, 9.012, 1.848)
    gdml.material("Aluminium", 13, 26.982, 2.699)
    gdml.material("Copper", 29, 63.546, 8.96)

    beam_pipe(gdml)
    tracker(gdml)
    crystals(gdml)
    solenoid(gdml)
    hadronic(gdml)
    services(gdml)
    gdml.solid("box", "World_s", x="2*4", y="2*4.5", z="2*6", lunit="m")
    gdml.volume("World", "Air", "World_s", [
        place("beam_pipe", "BeamPipe"), place("tracker", "Tracker"),
        place("crystals", "CrystalBarrel"), place("solenoid", "Cryostat"), place("hcal", "Hcal"),
        place("endcap_plus_1", "Endcap", "endcap_plus", copy=0),
        place("endcap_minus_1", "Endcap", "endcap_minus", "flip", copy=1),
        place("services_plus", "EndServices"), place("services_minus", "EndServices", None, "flip"),
        place("foot0", "Foot", (-1500, -3700, 0), copy=0),
        place("foot1", "Foot", (1500, -3700, 0), copy=1)])
    return gdml.text("World")
