"""Sofas: boxy ones here, round ones in `curved`, wooden frames in `wood`, what reaches out in `room`."""

from data_gen.families.pieces.feet import SYMMETRIC, four_feet, under
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.sofa import curved, room, wood
from data_gen.families.sofa.parts import (
    ARMS,
    FRAME,
    LEGS,
    MEANINGS,
    MIDDLE,
    PILLOWS,
    TALL,
    WITH_ARMS,
    arms,
    back,
    base,
    behind,
    beside,
    block_feet,
    cushions,
    half_seat,
    on_base,
    pillows,
    seats,
    under_arms,
)
from data_gen.rig import Rig


def two_seater(p):
    """Two deep cushions between boxy arms, and a pillow in each corner."""
    x = (-half_seat(p), half_seat(p))
    found = base(p, x), *seats(p, x, 2), back(p, x), *arms(p), *block_feet(p)
    return *found, *pillows(p, half_seat(p) - 0.08, p.back_thickness - p.depth / 2)


def three_seater(p):
    """Three seat cushions between boxy arms, and three loose cushions before the back."""
    x = (-half_seat(p), half_seat(p))
    return base(p, x), *seats(p, x, 3), back(p, x), *arms(p), *block_feet(p), *cushions(p, x, 3)


def armless(p):
    """One long seat with two loose cushions before its back, on splayed legs, without arms."""
    x = (-p.width / 2, p.width / 2)
    feet = four_feet(p.width / 2 - 0.06, p.depth / 2 - 0.06, p.leg_height, 0.034, p.leg_splay)
    return base(p, x), *seats(p, x, 1), back(p, x), *feet, *cushions(p, x, 2)


FAMILIES = (
    Rig(
        "sofa/two_seater",
        ranges(MEANINGS, width=(0.6, 0.78), **FRAME, **ARMS, **LEGS),
        two_seater,
        (*WITH_ARMS, ("seat_1", "seat_2"), ("pillow_left", "pillow_right"), *SYMMETRIC),
        (*beside("base"), *on_base("seat_1", "seat_2", "back"), *behind("seat_1", "seat_2"), *under_arms()),
    ),
    Rig(
        "sofa/three_seater",
        ranges(MEANINGS, width=(0.84, 1.0), **FRAME, **ARMS, **LEGS, **PILLOWS),
        three_seater,
        (*WITH_ARMS, ("seat_1", "seat_3"), *itself("seat_2"), ("cushion_1", "cushion_3"), *SYMMETRIC),
        (*beside("base"), *on_base("seat_1", "seat_2", "seat_3", "back"), *behind("seat_1", "seat_2"), *under_arms()),
    ),
    Rig(
        "sofa/armless",
        ranges(MEANINGS, width=(0.56, 0.8), **TALL, leg_height=(0.05, 0.09), leg_splay=(0, 0.04), **PILLOWS),
        armless,
        (*MIDDLE, *itself("seat_1"), ("cushion_1", "cushion_2"), *SYMMETRIC),
        (*on_base("seat_1", "back"), *behind("seat_1"), *under("base")),
    ),
    *curved.FAMILIES,
    *room.FAMILIES,
    *wood.FAMILIES,
)
