"""Legs and frames that furniture stands on, and the slats it is made of."""

import numpy as np

from data_gen.families.pieces.turned import turned
from data_gen.part import AXES, RECTANGLE, Section, box, ellipse, joined, loft, section
from data_gen.rig import FLOOR, Contact, Parameter

LEG_WIDTH = Parameter("leg_width", 0.03, 0.12, "edge of a leg along x")
LEG_DEPTH = Parameter("leg_depth", 0.03, 0.12, "edge of a leg along z")
SYMMETRIC = (("leg_1", "leg_2"), ("leg_3", "leg_4"))
CORNERS = ((1, 1), (-1, 1), (1, -1), (-1, -1))
"""On which side in x and in z legs 1 to 4 stand."""
SIDES = (("left", -1), ("right", 1))


def four_legs(p, width, depth, height):
    """Legs from the floor to `height`, flush with a rectangle; 1 and 2 stand in front (z > 0), 1 and 3 at x > 0."""
    x, z = (width - p.leg_width) / 2, (depth - p.leg_depth) / 2
    feet = [(side * x, end * z) for side, end in CORNERS]
    size = (p.leg_width, height, p.leg_depth)
    return tuple(box(f"leg_{i}", (x, FLOOR + height / 2, z), size) for i, (x, z) in enumerate(feet, start=1))


def slanted_legs(feet, heads, height, low, high, outline=RECTANGLE, first=1):
    """Four legs between the floor and `height`: (x, z) of foot and head of the first, sizes (x, z) below and above."""
    return tuple(
        loft(
            f"leg_{i}",
            [
                section("y", (side * feet[0], FLOOR, end * feet[1]), low),
                section("y", (side * heads[0], FLOOR + height, end * heads[1]), high),
            ],
            outline,
        )
        for i, (side, end) in enumerate(CORNERS, start=first)
    )


def three_legs(foot, head, height, tip, width):
    """Round legs, two in front, one behind, from `foot` off the middle to `head`, from the width `tip` to `width`."""
    legs = []
    for i, turn in enumerate(np.pi / 6 * np.array([1, 5, 9]), start=1):
        x, z = np.cos(turn), np.sin(turn)
        low = section("y", (x * foot, FLOOR, z * foot), (tip, tip))
        high = section("y", (x * head, FLOOR + height, z * head), (width, width))
        legs.append(loft(f"leg_{i}", [low, high], ellipse(12)))
    return tuple(legs)


def crossed_legs(x, z, height, size):
    """Legs that cross when seen from the side: each leans to the other z, and those that stand behind stand inside."""
    legs = []
    for i, (side, end) in enumerate(CORNERS, start=1):
        at = side * (x if end > 0 else x - size[0])
        ends = (at, FLOOR, end * z), (at, FLOOR + height, -end * z)
        legs.append(loft(f"leg_{i}", [section("y", one, size) for one in ends]))
    return tuple(legs)


def between_crosses(part):
    """The contacts of crossed legs with each other, and with a part between the two crosses."""
    pairs = (("leg_3", "leg_1"), ("leg_2", "leg_4"), ("leg_4", part), (part, "leg_3"))
    return tuple(Contact(low, high, "face_x") for low, high in pairs)


def carry(part, *legs):
    """The contacts of a part that stands on legs, on the four if none are named."""
    return tuple(Contact(leg, part, "face_y") for leg in legs or ("leg_1", "leg_2", "leg_3", "leg_4"))


def loop(name, axis, centre, size, bar, bend, outline=RECTANGLE):
    """A closed frame that fills a rectangle across an axis, its corners bent by the outer radius `bend`.

    `bar` is the thickness of the frame along the axis and in its plane.
    """
    sections = []
    for sign, turn in _round_corners():
        way = np.cos(turn), np.sin(turn)
        offset = [s * (edge / 2 - bend) + w * (bend - bar[1] / 2) for s, edge, w in zip(sign, size, way, strict=True)]
        middle = tuple(c + d for c, d in zip(centre, _across(axis, 0, offset), strict=True))
        sections.append(Section(middle, _across(axis, bar[0], (0, 0)), _across(axis, 0, [w * bar[1] for w in way])))
    return loft(name, sections, outline, closed=True)


def ring(name, y, width, thickness):
    """A lying ring of round wire: its outer width, its thickness, the y of its middle."""
    turns = 2 * np.pi * np.arange(8) / 8
    profile = [(y + np.sin(t) / 2 * thickness, width - (1 - np.cos(t)) * thickness) for t in turns]
    return turned(name, profile, sides=32, closed=True)


def slats(name, count, gap, centre, extents, axis="z"):
    """Slats side by side along an axis, `gap` apart, that fill a box."""
    at = AXES.index(axis)
    pitch = (extents[at] + gap) / count
    size = tuple(pitch - gap if i == at else edge for i, edge in enumerate(extents))
    offsets = [(i - (count - 1) / 2) * pitch for i in range(count)]
    places = [tuple(c + (offset if i == at else 0) for i, c in enumerate(centre)) for offset in offsets]
    return joined(name, *(box(name, place, size) for place in places))


def _round_corners():
    """The corner, as two signs, and the direction, in radians, of each bend of a loop."""
    corners = ((1, 1), (-1, 1), (-1, -1), (1, -1))
    return [(sign, np.pi / 2 * (i + step / 3)) for i, sign in enumerate(corners) for step in range(4)]


def _across(axis, along, across):
    """A vector: its length along an axis, and its lengths along the other two."""
    found = list(across)
    found.insert(AXES.index(axis), along)
    return tuple(found)
