"""Scissors: they stand on their handles, blades up, and open about a screw; the front blade leans to the left."""

from data_gen.joint import hinge
from data_gen.part import RECTANGLE, Section, cylinder, ellipse, joined, loft, moved, rounded, section
from data_gen.rig import FLOOR, Contact, Parameter, Rig

BLADE_LENGTH = Parameter("blade_length", 0.38, 0.52, "from the screw to the tip of a blade")
BLADE_WIDTH = Parameter("blade_width", 0.05, 0.08, "edge of a blade along x beside the screw")
HANDLE_LENGTH = Parameter("handle_length", 0.34, 0.44, "from the screw down to the lower end of a handle")
OPENING = Parameter("opening", 0.0, 1.1, "angle between the blades", "rad")
RINGS = (
    BLADE_LENGTH,
    BLADE_WIDTH,
    HANDLE_LENGTH,
    Parameter("ring_width", 0.1, 0.16, "edge of the right ring along x"),
    Parameter("ring_height", 0.14, 0.22, "edge of the right ring along y"),
    Parameter("ring_thickness", 0.022, 0.036, "thickness of a ring"),
    OPENING,
)
TAILOR = (
    *RINGS[:-1],
    Parameter("bow_width", 0.13, 0.18, "edge of the left ring along x"),
    Parameter("bow_height", 0.22, 0.27, "edge of the left ring along y"),
    OPENING,
)
SHEARS = (
    BLADE_LENGTH,
    BLADE_WIDTH,
    HANDLE_LENGTH,
    Parameter("handle_spread", 0.05, 0.1, "how far the lower end of a handle stands from the middle"),
    Parameter("grip_length", 0.14, 0.22, "edge of a grip along y"),
    Parameter("grip_width", 0.045, 0.065, "edge of a grip along x where it is thickest"),
    OPENING,
)
THICK = 0.018
TANG = 0.05
"""How far a blade reaches below the screw."""
BLADE = ((0, -0.5, 0.5), (0.2, -0.62, 0.46), (0.55, -0.52, 0.32), (0.85, -0.3, 0.2), (1, -0.06, 0.12))
"""The front blade: height as a share of its length, left and right edge in units of its width."""
PATH, OUTWARD = ellipse(20), 2 * ellipse(20)


def _blade(p, name, side):
    """A blade in front of (side 1) or behind (side -1) the other, which it mirrors."""
    screw = FLOOR + p.handle_length
    rows = [(screw - TANG, *BLADE[0][1:]), *((screw + up * p.blade_length, left, right) for up, left, right in BLADE)]
    cuts = [
        section(
            "y",
            (side * (left + right) / 2 * p.blade_width, y, side * THICK / 2),
            ((right - left) * p.blade_width, THICK),
        )
        for y, left, right in rows
    ]
    return loft(name, cuts, RECTANGLE)


def _ring(x, width, height, thick):
    """An upright ring on the floor around x, by its outer edges."""
    y = FLOOR + height / 2
    cuts = [
        Section((x + q * (width - thick), y + r * (height - thick), 0), (a * thick, b * thick, 0), (0, 0, 0.032))
        for (q, r), (a, b) in zip(PATH, OUTWARD, strict=True)
    ]
    return loft("ring", cuts, ellipse(8), closed=True)


def _shank(p, side, x, y):
    """From the lower end of a blade to a point."""
    top = section("y", (0, FLOOR + p.handle_length - TANG, side * THICK / 2), (0.9 * p.blade_width, THICK))
    return loft("shank", [top, section("y", (x, y, 0), (0.03, 0.028))], rounded(0.3, 2))


def _ringed(p, name, side, width, height):
    """A handle that ends in a ring; side 1 stands at x > 0."""
    x = side * (0.5 * width + 0.006)
    ring = _ring(x, width, height, p.ring_thickness)
    return joined(name, _shank(p, side, 0.7 * x, FLOOR + height - 0.7 * p.ring_thickness), ring)


def _halves(p, left, right):
    """Both blades, the handles that cross over to the other side, the screw, and the hinges that open them."""
    screw = (0, FLOOR + p.handle_length, 0)
    return (
        _blade(p, "blade_left", 1),
        _blade(p, "blade_right", -1),
        *left,
        *right,
        cylinder("screw", screw, (0.04, 0.04, 0.05), "z"),
        hinge("left_hinge", ["blade_left", *(part.name for part in right)], "screw", (0, 0, 1), screw, p.opening / 2),
        hinge("right_hinge", ["blade_right", *(part.name for part in left)], "screw", (0, 0, -1), screw, p.opening / 2),
    )


def rings(p):
    """Scissors with two equal rings."""
    size = (p.ring_width, p.ring_height)
    return _halves(p, [_ringed(p, "handle_left", -1, *size)], [_ringed(p, "handle_right", 1, *size)])


def tailor(p):
    """A tailor's scissors: a long ring for four fingers at the left, a round one for the thumb."""
    left = _ringed(p, "handle_left", -1, p.bow_width, p.bow_height)
    return _halves(p, [left], [_ringed(p, "handle_right", 1, p.ring_width, p.ring_height)])


def shears(p):
    """Garden shears: straight handles that end in thick grips."""
    return _halves(p, _straight(p, "left", -1), _straight(p, "right", 1))


def _straight(p, name, side):
    """A straight handle, and the grip at its end, which stands on the floor."""
    x, top = side * p.handle_spread, FLOOR + p.grip_length
    low, upper = (FLOOR + share * p.grip_length for share in (0.1, 0.8))
    rows = ((FLOOR, 0.8), (low, 1), (upper, 0.85), (top, 0.6))
    grip = [section("y", (x, y, 0), (wide * p.grip_width, wide * p.grip_width)) for y, wide in rows]
    return moved(_shank(p, side, x, top), f"handle_{name}"), loft(f"grip_{name}", grip, ellipse(12))


JOINED = (Contact("handle_left", "blade_right", "face_y"), Contact("handle_right", "blade_left", "face_y"))
LAID = (Contact("blade_right", "blade_left", "face_z"),)
GRIPS = tuple(Contact(f"grip_{side}", f"handle_{side}", "face_y") for side in ("left", "right"))
SCREW = ("screw", "screw")
FAMILIES = (
    Rig("scissors/rings", RINGS, rings, (SCREW,), JOINED + LAID),
    Rig("scissors/tailor", TAILOR, tailor, (SCREW,), JOINED + LAID),
    Rig("scissors/shears", SHEARS, shears, (("grip_left", "grip_right"), SCREW), JOINED + LAID + GRIPS),
)
