"""Checks that what the generator places does not overlap: rectangles around the beam line."""

import math


def rectangle(radius, phi, turn, thickness, width):
    """Corners of a rectangle, thick along its own x, whose centre is at (radius, phi) and whose
    x axis points to phi + turn; degrees."""
    centre = math.radians(phi)
    axis = math.radians(phi + turn)
    cx, cy = radius * math.cos(centre), radius * math.sin(centre)
    ux, uy = math.cos(axis), math.sin(axis)
    return [(cx + a * thickness / 2 * ux - b * width / 2 * uy,
             cy + a * thickness / 2 * uy + b * width / 2 * ux)
            for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]


def gap(first, second):
    """A lower bound of the distance of two convex polygons, negative if they overlap: the largest
    separation along a normal of an edge."""
    best = -math.inf
    for polygon, other in ((first, second), (second, first)):
        for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
            length = math.hypot(bx - ax, by - ay)
            nx, ny = (by - ay) / length, (ax - bx) / length
            along = [x * nx + y * ny for x, y in polygon]
            across = [x * nx + y * ny for x, y in other]
            best = max(best, min(across) - max(along), min(along) - max(across))
    return best


def radial_range(polygon):
    """Nearest and farthest distance of a polygon's edges from the origin."""
    near = math.inf
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        dx, dy = bx - ax, by - ay
        t = min(1, max(0, -(ax * dx + ay * dy) / (dx * dx + dy * dy)))
        near = min(near, math.hypot(ax + t * dx, ay + t * dy))
    return near, max(math.hypot(x, y) for x, y in polygon)


def ring(radius, count, turn, thickness, width):
    """The range in radius of a ring of `count` turned rectangles. Raises if neighbours overlap."""
    first = rectangle(radius, 0, turn, thickness, width)
    second = rectangle(radius, 360 / count, turn, thickness, width)
    distance = gap(first, second)
    if distance <= 0:
        raise ValueError(f"ring at {radius} mm: neighbours overlap by {-distance:.3g} mm")
    return radial_range(first)
