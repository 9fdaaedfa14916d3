#!/usr/bin/env python3
"""Rewrites a GDML file in the plain subset that simple readers understand.

Expressions, constants, variables and quantities become numbers; lengths become mm and angles deg;
assemblies are dissolved into the volumes that hold them; every placement carries its position and
rotation inline, under a unique name. Volumes, solids and materials keep their names and order.

It follows the conventions of Geant4's GDML reader, written down from its documentation and source
and shared with no other code, so that it can tell when another reader gets them wrong:

    point in mother = position + R(angles)^-1 * point in daughter
    R(x, y, z)      = Rz(z) * Ry(y) * Rx(x), each turning by the right-hand rule

(in a boolean the second solid is turned by R, not by its inverse; its angles are passed on). What
is not understood is an error, never skipped.

usage: flatten.py IN.gdml OUT.gdml
"""

import ast
import math
import operator
import sys
import xml.etree.ElementTree as ElementTree

LENGTH = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "km": 1e6, "um": 1e-3, "nm": 1e-6}
DEGREE = {"deg": 1.0, "degree": 1.0, "rad": 180 / math.pi, "radian": 180 / math.pi,
          "mrad": 0.18 / math.pi}
CONSTANTS = {"pi": math.pi, "twopi": 2 * math.pi, "halfpi": math.pi / 2, "mm": 1.0, "cm": 10.0,
             "m": 1000.0, "rad": 1.0, "deg": math.pi / 180}
FUNCTIONS = {"sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin,
             "acos": math.acos, "atan": math.atan, "atan2": math.atan2, "sqrt": math.sqrt,
             "exp": math.exp, "log": math.log, "abs": abs, "min": min, "max": max, "pow": pow}
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
             ast.Div: operator.truediv, ast.Pow: operator.pow}

# The attributes of each solid: lengths, angles, plain numbers.
SOLIDS = {
    "box": ("x y z", "", ""),
    "tube": ("rmin rmax z", "startphi deltaphi", ""),
    "cone": ("rmin1 rmax1 rmin2 rmax2 z", "startphi deltaphi", ""),
    "sphere": ("rmin rmax", "startphi deltaphi starttheta deltatheta", ""),
    "orb": ("r", "", ""),
    "trd": ("x1 x2 y1 y2 z", "", ""),
    "trap": ("z y1 x1 x2 y2 x3 x4", "theta phi alpha1 alpha2", ""),
    "polycone": ("", "startphi deltaphi", ""),
    "polyhedra": ("", "startphi deltaphi", "numsides"),
}
BOOLEANS = ("union", "subtraction", "intersection")


class Unsupported(Exception):
    """The file holds something that is not understood."""


def text_of(value):
    """The shortest decimal that reads back as the same number, at most 17 digits."""
    return repr(float(value))


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transpose(a):
    return [list(row) for row in zip(*a)]


def apply(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def cosine_sine(degrees):
    """Exact at right angles."""
    turns = {0: (1.0, 0.0), 90: (0.0, 1.0), 180: (-1.0, 0.0), 270: (0.0, -1.0)}
    if degrees % 360 in turns:
        return turns[degrees % 360]
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


def matrix_of(angles):
    """R(x, y, z) of the angles in deg."""
    (cx, sx), (cy, sy), (cz, sz) = (cosine_sine(a) for a in angles)
    rx = [[1, 0, 0], [0, cx, -sx], [0, sx, cx]]
    ry = [[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]
    rz = [[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]
    return multiply(rz, multiply(ry, rx))


def angles_of(r):
    """Angles in deg whose R is r."""
    cy = math.hypot(r[0][0], r[1][0])
    y = math.atan2(-r[2][0], cy)
    if cy > 1e-9:
        x, z = math.atan2(r[2][1], r[2][2]), math.atan2(r[1][0], r[0][0])
    else:  # only the sum or the difference of x and z counts
        x, z = math.atan2(-r[1][2], r[1][1]), 0.0
    return [math.degrees(a) for a in (x, y, z)]


class Flattener:
    def __init__(self, root):
        self.root = root
        self.values = dict(CONSTANTS)
        self.positions = {}
        self.rotations = {}
        self.assemblies = {}
        self.placements = 0

    # Expressions

    def number(self, text):
        try:
            return float(text)
        except ValueError:
            pass
        try:
            tree = ast.parse(text.strip().replace("^", "**"), mode="eval")
            return float(self.evaluate(tree.body))
        except (SyntaxError, ArithmeticError, ValueError, TypeError) as error:
            raise Unsupported(f"expression '{text}': {error}") from error

    def evaluate(self, node):
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return float(node.value)
        if isinstance(node, ast.Name) and node.id in self.values:
            return self.values[node.id]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            value = self.evaluate(node.operand)
            return -value if isinstance(node.op, ast.USub) else value
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            if isinstance(node.op, ast.Pow) and isinstance(node.right, ast.BinOp):
                raise Unsupported("powers of powers: GDML groups them from the left")
            return OPERATORS[type(node.op)](self.evaluate(node.left), self.evaluate(node.right))
        if (isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords
                and node.func.id in FUNCTIONS):
            return FUNCTIONS[node.func.id](*[self.evaluate(a) for a in node.args])
        raise Unsupported(f"expression '{ast.unparse(node)}'")

    def vector(self, element, units, unit):
        factor = units[element.get("unit", unit)]
        return [self.number(element.get(axis, "0")) * factor for axis in "xyz"]

    def position(self, element):
        return self.vector(element, LENGTH, "mm")

    def rotation(self, element):
        return self.vector(element, DEGREE, "rad")

    # Sections

    def define(self, section):
        for element in section:
            name = element.get("name")
            if element.tag in ("constant", "variable"):
                self.values[name] = self.number(element.get("value"))
            elif element.tag == "quantity":
                unit = element.get("unit", "")
                factors = {**LENGTH, **{n: math.radians(f) for n, f in DEGREE.items()}, "": 1.0}
                self.values[name] = self.number(element.get("value")) * factors[unit]
            elif element.tag == "position":
                self.positions[name] = self.position(element)
            elif element.tag == "rotation":
                self.rotations[name] = self.rotation(element)
            else:
                raise Unsupported(f"<{element.tag}> in <define>")

    def convert(self, out, element, kinds, lengths, degrees):
        """Copies the attributes as numbers in mm and deg."""
        factors = {name: factor for names, factor in zip(kinds, (lengths, degrees, 1.0))
                   for name in names.split()}
        for name, text in element.attrib.items():
            if name in factors:
                out.set(name, text_of(self.number(text) * factors[name]))
            elif name not in ("name", "lunit", "aunit"):
                raise Unsupported(f"<{element.tag}> with attribute '{name}'")

    def solid(self, element):
        out = ElementTree.Element(element.tag, name=element.get("name"))
        if element.tag in BOOLEANS:
            for child in element:
                if child.tag in ("first", "second"):
                    ElementTree.SubElement(out, child.tag, ref=child.get("ref"))
            if any(child.tag.startswith("first") and child.tag != "first" for child in element):
                raise Unsupported("a frame for the first solid of a boolean")
            self.write_frame(out, *self.frame(element, ("first", "second")), out.get("name"))
            return out
        if element.tag not in SOLIDS:
            raise Unsupported(f"solid <{element.tag}>")
        lengths = LENGTH[element.get("lunit", "mm")]
        degrees = DEGREE[element.get("aunit", "rad")]
        self.convert(out, element, SOLIDS[element.tag], lengths, degrees)
        if element.tag == "polyhedra":
            out.set("numsides", str(int(float(out.get("numsides")))))
        for child in element:
            if child.tag != "zplane":
                raise Unsupported(f"<{child.tag}> in <{element.tag}>")
            plane = ElementTree.SubElement(out, "zplane")
            self.convert(plane, child, ("z rmin rmax", "", ""), lengths, degrees)
        out.set("lunit", "mm")
        out.set("aunit", "deg")
        return out

    # Placements

    def frame(self, element, others):
        """Position in mm and angles in deg of a physvol or a boolean."""
        position, angles = [0.0] * 3, [0.0] * 3
        for child in element:
            if child.tag == "position":
                position = self.position(child)
            elif child.tag == "positionref":
                position = self.positions[child.get("ref")]
            elif child.tag == "rotation":
                angles = self.rotation(child)
            elif child.tag == "rotationref":
                angles = self.rotations[child.get("ref")]
            elif child.tag not in others:
                raise Unsupported(f"<{child.tag}> in <{element.tag}>")
        return position, angles

    def write_frame(self, out, position, angles, name):
        for tag, values, unit in (("position", position, "mm"), ("rotation", angles, "deg")):
            if tag == "rotation" and not any(values):
                continue
            child = ElementTree.SubElement(out, tag, name=f"{name}_{tag}")
            for axis, value in zip("xyz", values):
                child.set(axis, text_of(value))
            child.set("unit", unit)

    def flat_placements(self, physvol):
        """(volume, name, position, angles) of each volume that a physvol stands for."""
        target = physvol.find("volumeref").get("ref")
        name = physvol.get("name", target + "_PV")
        position, angles = self.frame(physvol, ("volumeref",))
        if target not in self.assemblies:
            return [(target, name, position, angles)]
        outer = matrix_of(angles)
        result = []
        for inner_target, inner_name, inner_position, inner_angles in self.assemblies[target]:
            moved = apply(transpose(outer), inner_position)
            turned = angles_of(multiply(matrix_of(inner_angles), outer))
            result.append((inner_target, f"{name}_{inner_name}",
                           [p + m for p, m in zip(position, moved)], turned))
        return result

    def volume(self, element):
        """The flat volume; None for an assembly, which is kept for those that place it."""
        placements = [p for physvol in element.findall("physvol")
                      for p in self.flat_placements(physvol)]
        for child in element:
            if child.tag not in ("physvol", "materialref", "solidref"):
                raise Unsupported(f"<{child.tag}> in <{element.tag}>")
        if element.tag == "assembly":
            self.assemblies[element.get("name")] = placements
            return None
        if element.tag != "volume":
            raise Unsupported(f"<{element.tag}> in <structure>")
        out = ElementTree.Element("volume", name=element.get("name"))
        for tag in ("materialref", "solidref"):
            ElementTree.SubElement(out, tag, ref=element.find(tag).get("ref"))
        for target, name, position, angles in placements:
            self.placements += 1
            physvol = ElementTree.SubElement(out, "physvol", name=f"{name}_{self.placements}")
            ElementTree.SubElement(physvol, "volumeref", ref=target)
            self.write_frame(physvol, position, angles, f"placement_{self.placements}")
        return out

    def run(self):
        out = ElementTree.Element("gdml")
        for section in self.root:
            if section.tag == "define":
                self.define(section)
                ElementTree.SubElement(out, "define")
            elif section.tag in ("solids", "structure"):
                convert = self.solid if section.tag == "solids" else self.volume
                flat = ElementTree.SubElement(out, section.tag)
                flat.extend(e for e in map(convert, section) if e is not None)
            elif section.tag in ("materials", "setup"):
                out.append(section)
            else:
                raise Unsupported(f"<{section.tag}>")
        return out


def main(arguments):
    if len(arguments) != 2:
        print("usage: flatten.py IN.gdml OUT.gdml", file=sys.stderr)
        return 2
    try:
        flat = Flattener(ElementTree.parse(arguments[0]).getroot()).run()
    except (Unsupported, KeyError, OSError, ElementTree.ParseError) as error:
        print(f"flatten.py: {arguments[0]}: {error!r}", file=sys.stderr)
        return 1
    ElementTree.indent(flat)
    ElementTree.ElementTree(flat).write(arguments[1], encoding="UTF-8", xml_declaration=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
