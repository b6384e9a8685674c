"""What chairs and beds are made of: cushions, leaning panels, legs, bent tubes; and what chairs are measured by."""

import numpy as np

from data_gen.part import AXES, RECTANGLE, Section, ellipse, joined, loft, rounded, section
from data_gen.rig import FLOOR

MEANINGS = {
    "seat_width": "edge of the seat along x",
    "seat_height": "from the floor to the upper side of the seat",
    "seat_depth": "edge of the seat along z",
    "seat_thickness": "edge of the seat along y",
    "back_height": "from the upper side of the seat to the upper end of the back",
    "back_thickness": "edge of the back along z",
    "back_lean": "how far the upper end of the back lies behind its lower end",
    "back_curve": "how far the middle of the back lies behind its left and right ends",
    "leg_size": "edge of a leg along x and z, at its upper end if it tapers",
    "leg_splay": "how far a foot stands outside the upper end of its leg, along x and along z",
    "leg_height": "from the floor to the upper end of the legs",
    "tube_size": "thickness of the tubes",
    "arm_height": "from the upper side of the seat to the upper side of the arms",
    "arm_width": "edge of an arm along x",
    "base_radius": "from the middle of the foot to its outer end",
    "column_size": "edge of the column along x and z",
    "wing_depth": "edge of a wing along z at its lower end",
    "rocker_length": "edge of a rocker along z",
    "rocker_rise": "from the floor to the lower side of a rocker at its ends",
}
LEGS = (("leg_1", "leg_2"), ("leg_3", "leg_4"))
PUFF = ((-0.5, 0.4), (-0.4, 0.12), (-0.22, 0.0), (0.22, 0.0), (0.4, 0.12), (0.5, 0.4))
"""How a cushion narrows towards its faces: place along its thickness and inset of its edges, as shares of that."""


def cushion(name, centre, extents, axis="y", corner=0.12, outline=None):
    """A soft piece that fills a box; its two faces across `axis` are rounded off at their edges.

    Its outline has round corners over a share of its edges, if none is given.
    """
    along = AXES.index(axis)
    sections = []
    for place, inset in PUFF:
        at = tuple(c + (place * extents[along] if i == along else 0) for i, c in enumerate(centre))
        edges = [edge - 2 * inset * extents[along] for i, edge in enumerate(extents) if i != along]
        sections.append(section(axis, at, edges))
    return loft(name, sections, rounded(corner, 4) if outline is None else outline)


def panel(name, foot, widths, height, thickness, lean=0, corner=0.0, bend=1.0, outline=None):
    """A plate from the middle of its lower edge up, from the first width to the second, that leans back to -z.

    `corner` rounds the upper corners, as a share of the height; with `bend` above 1 the plate starts upright.
    """
    arc = np.linspace(0, np.pi / 2, 5 if corner else 1)
    stops = [(share, 0.0) for share in np.linspace(0, 1 - corner, 4)[:-1]]
    stops += [(1 - corner * (1 - np.sin(t)), corner * (1 - np.cos(t))) for t in arc]
    sections = []
    for share, inset in stops:
        at = (foot[0], foot[1] + share * height, foot[2] - share**bend * lean)
        width = widths[0] + (widths[1] - widths[0]) * share - 2 * inset * height
        sections.append(section("y", at, (width, thickness)))
    return loft(name, sections, rounded(0.12, 2) if outline is None else outline)


def strut(name, low, high, low_size, high_size, outline=RECTANGLE, axis="y"):
    """A straight bar between two points, cut off across `axis`, with its two edges at either end."""
    return loft(name, [section(axis, low, low_size), section(axis, high, high_size)], outline)


def sided(kind, side):
    """The name of the left part of a kind for side -1, of the right one for side 1."""
    return f"{kind}_left" if side < 0 else f"{kind}_right"


def along(low, high, share):
    """The point a constant share of the way between two."""
    return tuple(a + share * (b - a) for a, b in zip(low, high, strict=True))


def corners(x, z):
    """Places (x, z) of four legs: 1 and 2 in front (z > 0), 1 and 3 at x > 0."""
    return ((x, z), (-x, z), (x, -z), (-x, -z))


def ends(x, z, height, splay, low=FLOOR):
    """The lower and the upper end of each of four legs whose upper ends stand at x, z and whose feet stand outside."""
    feet = corners(x + splay, z + splay)
    return tuple(((a, low, b), (c, low + height, d)) for (a, b), (c, d) in zip(feet, corners(x, z), strict=True))


def legs(places, size, taper=0.6, outline=RECTANGLE):
    """Four legs between their ends, `taper` times as thick at the floor."""
    small = (taper * size, taper * size)
    return tuple(strut(f"leg_{i}", *pair, small, (size, size), outline) for i, pair in enumerate(places, start=1))


def tube(name, start, heading, moves, size, plane=((0, 0, 1), (0, 1, 0)), outline=None):
    """A tube that runs in a plane: each move goes straight by a length, then turns by an angle on an arc of a radius.

    The plane is spanned by two constant unit vectors; angles are constants from its first to its second. `size` is the
    edge across the plane and the edge in it.
    """
    u, v = (np.array(axis, float) for axis in plane)
    across, at, sections = np.cross(u, v), start, []

    def side(angle):
        return np.cos(angle) * v - np.sin(angle) * u

    def cut(centre, angle):
        sections.append(Section(centre, _scaled(across, size[0]), _scaled(side(angle), size[1])))

    cut(at, heading)
    for length, turn, radius in moves:
        at = _shifted(at, np.cos(heading) * u + np.sin(heading) * v, length)
        steps = int(np.ceil(abs(turn) / 0.4)) if turn else 0
        hub = _shifted(at, side(heading), np.sign(turn) * radius)
        for angle in heading + turn * np.linspace(0, 1, steps + 1):
            at = _shifted(hub, side(angle), -np.sign(turn) * radius)
            cut(at, angle)
        heading += turn
    return loft(name, sections, ellipse(8) if outline is None else outline)


def bowed(name, left, right, size, bow, outline=None):
    """A bar from left to right, cut across x, whose middle lies `bow` behind its ends."""
    shares = np.linspace(0, 1, 7)
    middles = [along(left, right, share) for share in shares]
    found = [(x, y, z - 4 * s * (1 - s) * bow) for (x, y, z), s in zip(middles, shares, strict=True)]
    return loft(name, [section("x", at, size) for at in found], rounded(0.3, 2) if outline is None else outline)


def wrapped(name, foot, radii, heights, thickness, reach=2.0, outline=None):
    """A wall on `foot` around the rear of an ellipse, `reach` radians to either side.

    heights: at its two ends and at the rear, it swings up between them.
    """
    sections = []
    for angle in reach * np.linspace(-1, 1, 29):
        swing = 0.5 + 0.5 * np.cos(np.pi * angle / reach)
        height = heights[0] + (heights[1] - heights[0]) * swing
        out = (np.sin(angle), 0, -np.cos(angle))
        at = (foot[0] + radii[0] * out[0], foot[1] + height / 2, foot[2] + radii[1] * out[2])
        sections.append(Section(at, _scaled(out, thickness), (0, height, 0)))
    return loft(name, sections, rounded(0.3, 2) if outline is None else outline)


def spindles(p, lean, rail=0.07):
    """A back of six round bars that leans from the rear of the seat, and a bowed rail across their upper ends."""
    z, half, foot = 0.04 - p.seat_depth / 2, p.seat_width / 2 - 0.05, FLOOR + p.seat_height
    high, size = foot + p.back_height - rail, (p.back_thickness, p.back_thickness)
    bars = []
    for share in (-1, -0.6, -0.2, 0.2, 0.6, 1):
        top = (share * (half + 0.01), high, z - lean - (1 - share**2) * p.back_curve)
        bars.append(strut("bar", (share * half, foot, z), top, size, size, ellipse(8)))
    left, right = ((side * (half + 0.04), high + rail / 2, z - lean) for side in (-1, 1))
    return joined("back", *bars, bowed("rail", left, right, (rail, p.back_thickness + 0.004), p.back_curve))


def _shifted(point, direction, length):
    return tuple(p + d * length for p, d in zip(point, direction, strict=True))


def _scaled(vector, length):
    return tuple(component * length for component in vector)
