"""Sofas of round forms: the chesterfield with its rolls, and a loveseat with a camel back."""

import numpy as np

from data_gen.families.pieces.feet import BUN, SYMMETRIC, four_feet, under
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between, soft
from data_gen.families.sofa.parts import (
    APRON,
    ARMS,
    FRAME,
    LEGS,
    MEANINGS,
    TALL,
    WITH_ARMS,
    base,
    behind,
    beside,
    even,
    half_seat,
    on_base,
    pillows,
    seats,
    under_arms,
)
from data_gen.part import cylinder, joined, loft, mirrored, rounded, section
from data_gen.rig import FLOOR, Rig

CHANNELS = 6
"""How many upright pads the back of a chesterfield is made of."""


def chesterfield(p):
    """Arms and a back of one height that end in rolls, on bun feet; the back is quilted in upright channels."""
    half = p.width / 2 - p.roll_diameter
    found = base(p, (-half, half)), *seats(p, (-half, half), 3), _channelled_back(p, half), *_rolled_arms(p, half)
    return *found, *four_feet(half + 0.03, p.depth / 2 - 0.035, p.leg_height, 0.055, profile=BUN)


def _channelled_back(p, half):
    """Upright pads side by side and a roll above them."""
    rear, front, top = -p.depth / 2, p.back_thickness - p.depth / 2, p.seat_height + p.back_height
    wall = (p.seat_height - p.seat_thickness, top - p.roll_diameter / 2)
    pads = [soft("pad", *between(x, wall, (rear, front))) for x in even((-half, half), CHANNELS)]
    roll = between((-half, half), (top - p.roll_diameter, top), (rear, rear + p.roll_diameter))
    return joined("back", *pads, cylinder("roll", *roll, "x", 20))


def _rolled_arms(p, half):
    """An upright plate and a roll above it on either side."""
    top, z = p.seat_height + p.back_height, (-p.depth / 2, p.depth / 2)
    plate = soft("plate", *between((half, half + 0.06), (p.leg_height, top - p.roll_diameter / 2), z), radius=0.01)
    roll = between((half, half + p.roll_diameter), (top - p.roll_diameter, top), z)
    right = joined("arm_right", plate, cylinder("roll", *roll, "z", 20))
    return mirrored(right, "arm_left"), right


def loveseat(p):
    """A camel back, arms that fall to the front, one cushion, two pillows, and tapered legs."""
    half, front, level = half_seat(p), p.back_thickness - p.depth / 2, p.seat_height - p.seat_thickness
    frame = between((-half, half), (p.leg_height, level), (front, p.depth / 2 - APRON))
    return (
        soft("base", *frame, radius=0.01),
        *seats(p, (-half, half), 1),
        _camel_back(p),
        *_falling_arms(p, front),
        *four_feet(p.width / 2 - 0.05, p.depth / 2 - 0.05, p.leg_height, 0.04, p.leg_splay),
        *pillows(p, half - 0.08, front),
    )


def _camel_back(p):
    """A back across the whole width that rises in the middle."""
    low, z, sections = FLOOR + p.leg_height, (p.back_thickness - p.depth) / 2, []
    for share in (-1, -0.95, -0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75, 0.95, 1):
        inset = 0.012 * (abs(share) == 1)
        rise = (0.5 + 0.5 * np.cos(np.pi * share)) * p.hump_height
        top = FLOOR + p.seat_height + p.back_height + rise - inset
        size = (top - low, p.back_thickness - 2 * inset)
        sections.append(section("x", (share * p.width / 2, (low + top) / 2, z), size))
    return loft("back", sections, rounded(0.2, 2))


def _falling_arms(p, rear):
    """Arms in front of the back whose upper sides fall to the front in a curve."""
    low, sections = FLOOR + p.leg_height, []
    for share, inset in ((0, 0), (0.25, 0), (0.5, 0), (0.75, 0), (0.95, 0), (1, 0.012)):
        top = FLOOR + p.seat_height + p.arm_height - share**2 * p.arm_slope - inset
        at = ((p.width - p.arm_width) / 2, (low + top) / 2, rear + share * (p.depth / 2 - rear))
        sections.append(section("z", at, (p.arm_width - 2 * inset, top - low)))
    right = loft("arm_right", sections, rounded(0.2, 2))
    return mirrored(right, "arm_left"), right


FAMILIES = (
    Rig(
        "sofa/chesterfield",
        ranges(MEANINGS, width=(0.8, 1.0), **FRAME, **LEGS, roll_diameter=(0.08, 0.12)),
        chesterfield,
        (*WITH_ARMS, ("seat_1", "seat_3"), *itself("seat_2"), *SYMMETRIC),
        (*beside("base"), *on_base("seat_1", "seat_2", "seat_3"), *under_arms()),
    ),
    Rig(
        "sofa/loveseat",
        ranges(
            MEANINGS,
            width=(0.55, 0.7),
            **TALL,
            **ARMS,
            arm_slope=(0.0, 0.05),
            hump_height=(0.0, 0.09),
            leg_height=(0.04, 0.1),
            leg_splay=(0, 0.03),
        ),
        loveseat,
        (*WITH_ARMS, *itself("seat_1"), ("pillow_left", "pillow_right"), *SYMMETRIC),
        (
            *beside("base"),
            *on_base("seat_1"),
            *behind("base", "seat_1", "arm_left", "arm_right"),
            *under("arm_right", "arm_left", "back", "back"),
        ),
    ),
)
