"""Benches: seats for two or three. Here those of planks; others have a back, or a cushion."""

from data_gen.families.bench import backs, soft
from data_gen.families.pieces.legs import SIDES, SYMMETRIC, between_crosses, carry, crossed_legs, slats
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.seats import MEANINGS
from data_gen.part import box, loft, section
from data_gen.rig import FLOOR, Contact, Rig

PLANK = ranges(
    MEANINGS,
    seat_width=(0.6, 1.0),
    seat_height=(0.24, 0.32),
    seat_depth=(0.16, 0.28),
    seat_thickness=(0.02, 0.05),
    overhang=(0.06, 0.15),
    leg_width=(0.03, 0.06),
    stretcher_height=(0.08, 0.14),
)
CROSS_LEGS = ranges(
    MEANINGS,
    seat_width=(0.7, 1.0),
    seat_height=(0.26, 0.34),
    seat_depth=(0.22, 0.34),
    seat_thickness=(0.018, 0.05),
    overhang=(0.06, 0.14),
    leg_width=(0.022, 0.055),
    leg_depth=(0.035, 0.08),
)


def plank(p):
    """A thick plank on two boards, with a stretcher between them."""
    height, x = p.seat_height - p.seat_thickness, p.seat_width / 2 - p.overhang - p.leg_width / 2
    low, high = (p.leg_width, p.seat_depth - 0.02), (p.leg_width, p.seat_depth - 0.08)
    legs = []
    for name, side in SIDES:
        levels = [section("y", (side * x, FLOOR + share * height, 0), size) for share, size in ((0, low), (1, high))]
        legs.append(loft(f"leg_{name}", levels))
    bar = (2 * x - p.leg_width, 0.045, 0.025)
    size = (p.seat_width, p.seat_thickness, p.seat_depth)
    seat = box("seat", (0, FLOOR + p.seat_height - p.seat_thickness / 2, 0), size)
    return seat, *legs, box("stretcher", (0, FLOOR + p.stretcher_height, 0), bar)


def cross_legs(p):
    """Three planks on two pairs of crossed legs, and a stretcher where they cross."""
    height, x = p.seat_height - p.seat_thickness, p.seat_width / 2 - p.overhang - p.leg_width / 2
    legs = crossed_legs(x, (p.seat_depth - p.leg_depth) / 2 - 0.01, height, (p.leg_width, p.leg_depth))
    size = (p.seat_width, p.seat_thickness, p.seat_depth)
    seat = slats("seat", 3, 0.012, (0, FLOOR + p.seat_height - p.seat_thickness / 2, 0), size)
    return seat, *legs, box("stretcher", (0, FLOOR + height / 2, 0), (2 * x - 3 * p.leg_width, 0.04, 0.025))


MIDDLE = (("seat", "seat"), ("stretcher", "stretcher"))
FAMILIES = (
    Rig(
        "bench/plank",
        PLANK,
        plank,
        (*MIDDLE, ("leg_left", "leg_right")),
        (
            *carry("seat", "leg_left", "leg_right"),
            Contact("leg_left", "stretcher", "face_x"),
            Contact("stretcher", "leg_right", "face_x"),
        ),
    ),
    Rig(
        "bench/cross_legs", CROSS_LEGS, cross_legs, (*MIDDLE, *SYMMETRIC), carry("seat") + between_crosses("stretcher")
    ),
    *soft.FAMILIES,
    *backs.FAMILIES,
)
