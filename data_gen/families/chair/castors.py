"""Chairs that turn on a column and roll on castors."""

import numpy as np

from data_gen.families.chair.pieces import MEANINGS, cushion, panel, strut
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import turned
from data_gen.part import Section, box, cylinder, ellipse, joined, loft, rounded
from data_gen.rig import FLOOR, Contact, Rig

STAR = np.radians([90, 18, 162, -54, 234])
"""Directions of five feet in the plane of x and z: one in front, then pairs, each the right one first."""
CASTOR = 0.07
"""From the floor to the upper side of a castor."""
BASE = (
    *itself("leg_1", "castor_1", "column"),
    *((f"{kind}_{i}", f"{kind}_{i + 1}") for kind in ("leg", "castor") for i in (2, 4)),
)
ON_STAR = (*(Contact(f"castor_{i}", f"leg_{i}", "face_y") for i in (1, 2, 3, 4, 5)), *stack("column", "seat"))


def star(p):
    """Five feet on castors around a gas column that ends under the seat."""
    legs, castors, out = [], [], p.base_radius - 0.015
    for i, angle in enumerate(STAR, start=1):
        legs.append(_foot(p, f"leg_{i}", np.cos(angle), np.sin(angle)))
        castors.append(_castor(f"castor_{i}", out * np.cos(angle), out * np.sin(angle)))
    low, high, size = FLOOR + CASTOR + 0.005, FLOOR + p.seat_height - p.seat_thickness, p.column_size
    stops = ((low, 1.5), (low + 0.075, 1.5), (low + 0.08, 1), (low + 0.15, 1), (low + 0.155, 0.6), (high, 0.6))
    return *legs, *castors, turned("column", [(y, share * size) for y, share in stops])


def _foot(p, name, x, z):
    """One of the five, from the column outwards and down."""
    found = []
    for out, y, wide, high in ((0.015 + 0 * p.base_radius, 0.045, 0.05, 0.05), (p.base_radius, 0.013, 0.035, 0.026)):
        at = (out * x, FLOOR + CASTOR + y, out * z)
        found.append(Section(at, (-wide * z, 0, wide * x), (0, high, 0)))
    return loft(name, found, rounded(0.3, 2))


def _castor(name, x, z):
    """A wheel and its stem."""
    wheel = cylinder("wheel", (x, FLOOR + 0.026, z), (0.036, 0.052, 0.052), "x", 16)
    return joined(name, wheel, box("stem", (x, FLOOR + CASTOR - 0.012, z), (0.014, 0.024, 0.014)))


def swivel(p):
    """A typist's chair: a star on castors, a cushion, and a small back on a bent bar."""
    seat_y, gap = FLOOR + p.seat_height, 0.1
    foot, high = -p.seat_depth / 2 - 0.01, p.back_height - gap
    extents = (p.seat_width, p.seat_thickness, p.seat_depth)
    seat = cushion("seat", (0, seat_y - p.seat_thickness / 2, 0), extents, corner=0.25)
    widths = (0.8 * p.seat_width, 0.9 * p.seat_width)
    look = {"corner": 0.3, "outline": rounded(0.3, 2)}
    back = panel("back", (0, seat_y + gap, foot), widths, high, p.back_thickness, p.back_lean, **look)
    return seat, back, _spine(p, seat_y, foot, gap + 0.5 * high, 0.5 * p.back_lean), *star(p)


def _spine(p, seat_y, foot, high, lean):
    """A flat bar from under the seat to the rear and up behind the back."""
    low, rear, thick = seat_y - p.seat_thickness - 0.01, foot - p.back_thickness / 2 - 0.006, 0.014
    path = [
        (low, -0.05, 0, 1),
        (low, rear + 0.04, 0, 1),
        (low + 0.012, rear + 0.012, 0.7, 0.7),
        (low + 0.04, rear, 1, 0),
    ]
    found = [Section((0, y, z), (0.05, 0, 0), (0, thick * b, thick * a)) for y, z, a, b in path]
    found.append(Section((0, seat_y + high, rear - lean), (0.05, 0, 0), (0, 0, thick)))
    return loft("spine", found)


def office(p):
    """A manager's chair: a star on castors, a high back that bends backwards, a headrest and T-shaped arms."""
    seat_y = FLOOR + p.seat_height
    foot, high = (p.back_thickness - p.seat_depth) / 2, 0.74 * p.back_height
    seat = cushion("seat", (0, seat_y - p.seat_thickness / 2, 0), (p.seat_width, p.seat_thickness, p.seat_depth))
    width = p.seat_width - 2 * p.arm_width - 0.02
    look = {"corner": 0.1, "outline": rounded(0.25, 2)}
    back = panel("back", (0, seat_y, foot), (width, 0.95 * width), high, p.back_thickness, p.back_lean, **look)
    headrest = _headrest(p, seat_y + high, foot - p.back_lean, 0.7 * width)
    arms = [_arm(p, name, side) for name, side in (("arm_left", -1), ("arm_right", 1))]
    return seat, back, headrest, *arms, *star(p)


def _headrest(p, y, z, width):
    """A cushion on two short rods above the back."""
    rods = [strut("rod", (x, y, z), (x, y + 0.05, z - 0.01), *2 * [(0.012, 0.012)], ellipse(8)) for x in (-0.05, 0.05)]
    pad = cushion(
        "pad", (0, y + 0.015 + 0.08 * p.back_height, z), (width, 0.16 * p.back_height, p.back_thickness), "z", 0.25
    )
    return joined("headrest", pad, *rods)


def _arm(p, name, side):
    """A pad on a post that stands on the edge of the seat."""
    x, pad, foot = side * (p.seat_width - p.arm_width) / 2, 0.03, FLOOR + p.seat_height
    post = box("post", (x, foot + (p.arm_height - pad) / 2, 0), (0.6 * p.arm_width, p.arm_height - pad, 0.07))
    top = cushion("pad", (x, foot + p.arm_height - pad / 2, 0.02), (p.arm_width, pad, 0.6 * p.seat_depth), corner=0.3)
    return joined(name, post, top)


FAMILIES = (
    Rig(
        "chair/swivel",
        ranges(
            MEANINGS,
            seat_width=(0.36, 0.52),
            seat_height=(0.4, 0.52),
            seat_depth=(0.34, 0.5),
            seat_thickness=(0.05, 0.09),
            back_height=(0.28, 0.48),
            back_thickness=(0.025, 0.07),
            back_lean=(0.0, 0.08),
            base_radius=(0.22, 0.34),
            column_size=(0.04, 0.09),
        ),
        swivel,
        (*itself("seat", "back", "spine"), *BASE),
        ON_STAR,
    ),
    Rig(
        "chair/office",
        ranges(
            MEANINGS,
            seat_width=(0.44, 0.62),
            seat_height=(0.36, 0.44),
            seat_depth=(0.4, 0.54),
            seat_thickness=(0.07, 0.12),
            back_height=(0.38, 0.56),
            back_thickness=(0.05, 0.09),
            back_lean=(0.02, 0.1),
            arm_height=(0.16, 0.24),
            arm_width=(0.05, 0.08),
            base_radius=(0.24, 0.36),
            column_size=(0.045, 0.1),
        ),
        office,
        (*itself("seat", "back", "headrest"), *BASE, ("arm_left", "arm_right")),
        (*ON_STAR, *stack("seat", "back", "headrest"), *stack("seat", "arm_left"), *stack("seat", "arm_right")),
    ),
)
