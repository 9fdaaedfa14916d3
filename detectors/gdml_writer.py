"""Writes the subset of GDML that the sample detectors need, with a fixed layout and order."""


MOTHER = "@mother@"  # stands for the mother's name: some readers want unique names of positions
SCHEMA = "http://service-spi.web.cern.ch/service-spi/app/releases/GDML/schema/gdml.xsd"


def number(x):
    """The shortest decimal text of a number; strings (expressions) are left as they are."""
    if isinstance(x, str):
        return x
    text = repr(round(float(x), 12) + 0.0)
    return text[:-2] if text.endswith(".0") else text


def attributes(**values):
    return "".join(f' {key}="{number(value)}"' for key, value in values.items())


class Gdml:
    """One file. Lengths are mm and angles degrees, unless an expression says otherwise.

    Positions and rotations of placements are the name of a <position> or <rotation>, a triple of
    numbers and expressions, or None. GDML's rotation is mother-to-daughter: a daughter that is
    turned by +phi about z has z = -phi.
    """

    def __init__(self, comment):
        self.comment = comment
        self.sections = {"define": [], "materials": [], "solids": [], "structure": []}

    def _add(self, section, text):
        self.sections[section].append(text)

    # define
    def constant(self, name, value):
        self._add("define", f"<constant{attributes(name=name, value=value)}/>")

    def variable(self, name, value):
        self._add("define", f"<variable{attributes(name=name, value=value)}/>")

    def quantity(self, name, kind, value, unit):
        self._add("define",
                  f"<quantity{attributes(name=name, type=kind, value=value, unit=unit)}/>")

    def position(self, name, x=0, y=0, z=0, unit="mm"):
        self._add("define", f"<position{attributes(name=name, x=x, y=y, z=z, unit=unit)}/>")

    def rotation(self, name, x=0, y=0, z=0, unit="deg"):
        self._add("define", f"<rotation{attributes(name=name, x=x, y=y, z=z, unit=unit)}/>")

    # materials
    def material(self, name, z, atom, density):
        self._add("materials", f"<material{attributes(name=name, Z=z)}>"
                  f"<D{attributes(value=density, unit='g/cm3')}/>"
                  f"<atom{attributes(value=atom)}/></material>")

    def element(self, name, formula, z, atom):
        self._add("materials", f"<element{attributes(name=name, formula=formula, Z=z)}>"
                  f"<atom{attributes(value=atom)}/></element>")

    def mixture(self, name, density, **fractions):
        parts = "".join(f"<fraction{attributes(n=n, ref=ref)}/>" for ref, n in fractions.items())
        self._add("materials", f"<material{attributes(name=name)}>"
                  f"<D{attributes(value=density, unit='g/cm3')}/>{parts}</material>")

    # solids
    def solid(self, kind, name, **values):
        angles = {"startphi", "deltaphi", "starttheta", "deltatheta", "theta", "phi", "alpha1"}
        units = {"lunit": values.pop("lunit", "mm")}
        if angles & values.keys():
            units["aunit"] = "deg"
        self._add("solids", f"<{kind}{attributes(name=name, **values, **units)}/>")

    def planes(self, kind, name, planes, startphi=0, deltaphi=360, **more):
        """A polycone or polyhedra: planes are (z, rmin, rmax)."""
        body = "".join(f"\n      <zplane{attributes(z=z, rmin=rmin, rmax=rmax)}/>"
                       for z, rmin, rmax in planes)
        head = attributes(name=name, startphi=startphi, deltaphi=deltaphi, **more, lunit="mm",
                          aunit="deg")
        self._add("solids", f"<{kind}{head}>{body}\n    </{kind}>")

    def boolean(self, kind, name, first, second, x=0, y=0, z=0):
        self._add("solids", f"<{kind}{attributes(name=name)}><first{attributes(ref=first)}/>"
                  f"<second{attributes(ref=second)}/>"
                  f"<position{attributes(name=name + '_at', x=x, y=y, z=z, unit='mm')}/></{kind}>")

    # structure
    def volume(self, name, material, solid, placements=()):
        body = f"<materialref{attributes(ref=material)}/><solidref{attributes(ref=solid)}/>"
        self._structure("volume", name, body, placements)

    def assembly(self, name, placements):
        self._structure("assembly", name, "", placements)

    def _structure(self, kind, name, body, placements):
        lines = [f"<{kind}{attributes(name=name)}>{body}"]
        lines += ["      " + text.replace(MOTHER, name) for text in placements]
        self._add("structure", "\n".join(lines) + f"\n    </{kind}>")

    def raw(self, section, text):
        """An element that has no method of its own: a loop."""
        self._add(section, text)

    def text(self, world):
        lines = ['<?xml version="1.0" encoding="UTF-8"?>', f"<!-- {self.comment} -->",
                 '<gdml xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
                 f'xsi:noNamespaceSchemaLocation="{SCHEMA}">']
        for section, entries in self.sections.items():
            lines.append(f"  <{section}>")
            lines += [f"    {entry}" for entry in entries]
            lines.append(f"  </{section}>")
        lines += ['  <setup name="Default" version="1.0">', f"    <world{attributes(ref=world)}/>",
                  "  </setup>", "</gdml>", ""]
        return "\n".join(lines)


def place(name, volume, position=None, rotation=None, copy=None, unit="deg"):
    """A <physvol>, for the list of daughters of a volume or an assembly."""
    number_of = "" if copy is None else attributes(copynumber=copy)
    text = f'<physvol{attributes(name=name)}{number_of}><volumeref{attributes(ref=volume)}/>'
    if isinstance(position, str):
        text += f"<positionref{attributes(ref=position)}/>"
    elif position is not None:
        x, y, z = position
        text += f"<position{attributes(name=f'{MOTHER}_{name}_at', x=x, y=y, z=z, unit='mm')}/>"
    if isinstance(rotation, str):
        text += f"<rotationref{attributes(ref=rotation)}/>"
    elif rotation is not None:
        x, y, z = rotation
        text += f"<rotation{attributes(name=f'{MOTHER}_{name}_turn', x=x, y=y, z=z, unit=unit)}/>"
    return text + "</physvol>"


def common_materials(gdml):
    """Elements and materials that all detectors use."""
    for name, formula, z, atom in (
            ("hydrogen", "H", 1, 1.008), ("carbon", "C", 6, 12.011), ("nitrogen", "N", 7, 14.007),
            ("oxygen", "O", 8, 15.999), ("silicon_atom", "Si", 14, 28.086),
            ("tungsten", "W", 74, 183.84), ("lead_atom", "Pb", 82, 207.2),
            ("iron_atom", "Fe", 26, 55.845), ("chromium", "Cr", 24, 51.996),
            ("nickel", "Ni", 28, 58.693), ("copper_atom", "Cu", 29, 63.546),
            ("zinc", "Zn", 30, 65.38)):
        gdml.element(name, formula, z, atom)
    gdml.mixture("Vacuum", 1e-25, hydrogen=1)
    gdml.mixture("Air", 0.001205, nitrogen=0.76, oxygen=0.24)
    gdml.mixture("Steel", 7.9, iron_atom=0.7, chromium=0.19, nickel=0.11)
    gdml.mixture("Polystyrene", 1.05, hydrogen=0.0774, carbon=0.9226)
    gdml.material("Lead", 82, 207.2, 11.35)
