"""What cabinets are made of: hollow bodies, frames, doors and drawers with their knobs."""

from data_gen.families.pieces.soft import between
from data_gen.joint import hinge, slide
from data_gen.part import RECTANGLE, box, ellipse, joined, loft, section
from data_gen.rig import FLOOR

WALL = 0.012
"""Thickness of the boards of bodies, doors and drawers."""
REVEAL = 0.003
"""Half of the gap between neighbouring fronts."""
KNOB = 0.03
"""How far a knob stands out."""


def shell(name, x, y, z, wall=WALL, up=False):
    """A box between two values each of x, height and z, open in front, or at its upper side if `up`."""
    (cx, cy, cz), size = between(x, y, z)
    inner = [length - 2 * wall for length in size]
    if up:
        low, high = FLOOR + y[0], FLOOR + y[1]
        levels = [(low, size), (high, size), (high, inner), (low + wall, inner)]
        return loft(name, [section("y", (cx, at, cz), (a, b)) for at, (a, _, b) in levels])
    levels = [(z[0], size), (z[1], size), (z[1], inner), (z[0] + wall, inner)]
    return loft(name, [section("z", (cx, cy, at), (a, b)) for at, (a, b, _) in levels])


def frame(name, x, y, z, bar, axis="z"):
    """Four bars around an opening along an axis, mitred at the corners."""
    centre, size = between(x, y, z)
    along = "xyz".index(axis)
    other = [i for i in range(3) if i != along]

    def ring(share, inset):
        at = [c + (share * size[along] if i == along else 0) for i, c in enumerate(centre)]
        return section(axis, tuple(at), [size[i] - 2 * inset for i in other])

    return loft(name, [ring(0.5, 0), ring(-0.5, 0), ring(-0.5, bar), ring(0.5, bar)], RECTANGLE, closed=True)


def knob(x, height, z, size=KNOB):
    """A round knob whose neck stands on the plane z."""
    levels = [(0, 0.5), (0.45, 0.5), (0.6, 1), (0.85, 1), (1, 0.7)]
    sections = [section("z", (x, FLOOR + height, z + at * size), (wide * size, wide * size)) for at, wide in levels]
    return loft("knob", sections, ellipse(12))


def bar_handle(x, height, z, length, across=True):
    """A straight handle on the plane z, `length` long, lying or standing."""
    half, thin = length / 2, 0.005
    long, thick = (x - half, x + half), (height - thin, height + thin)
    if not across:
        long, thick = (x - thin, x + thin), (height - half, height + half)
    return box("handle", *between(long, thick, (z, z + 0.03)))


def shelf(number, x, level, z):
    """A board between the walls of a hollow body, its upper side at a height."""
    inside = (x[0] + WALL, x[1] - WALL), (z[0] + WALL, z[1])
    return box(f"shelf_{number}", *between(inside[0], (level - WALL, level), inside[1]))


def door(name, x, y, z, handle):
    """A board before the plane z, a little smaller than its place so that neighbours show a gap, and its handle."""
    return joined(name, board(x, y, z), handle)


def board(x, y, z):
    """The board of a door or a drawer before the plane z."""
    return box("front", *between(inset(x), inset(y), (z, z + WALL)))


def inset(span):
    """A span without the gap to its neighbours."""
    return span[0] + REVEAL, span[1] - REVEAL


def drawer(name, x, y, z, depth, handles):
    """A front before the plane z with its handles, and behind it a tray `depth` deep, open above."""
    low, high = inset(y)
    tray = shell("tray", (x[0] + 2 * WALL, x[1] - 2 * WALL), (low + WALL, high - WALL), (z - depth, z), 0.006, up=True)
    return joined(name, board(x, y, z), *handles, tray)


def pulled(number, p, x, y, z, on="body"):
    """The slide of a drawer of these spans along z, out by `open_<number>`."""
    pivot = ((x[0] + x[1]) / 2, FLOOR + (y[0] + y[1]) / 2, z)
    return slide(f"slide_{number}", [f"drawer_{number}"], on, (0, 0, 1), pivot, getattr(p, f"open_{number}"))


def swung(name, x, height, z, angle, side, on="body"):
    """The hinge of a door that hangs at x on its left (side -1) or right (1), and opens to the front."""
    return hinge(f"{name}_hinge", [name], on, (0, side, 0), (x - side * REVEAL, FLOOR + height, z), angle)
