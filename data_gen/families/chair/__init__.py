"""Chairs. `chair/four_legs` is all boxes; the others stand on turned legs, tubes, a column, rockers."""

from data_gen.families.chair import bent, castors, curved, porch, soft, wood
from data_gen.families.chair.pieces import MEANINGS
from data_gen.families.pieces.legs import LEG_DEPTH, LEG_WIDTH, SYMMETRIC, carry, four_legs
from data_gen.families.pieces.ranges import ranges
from data_gen.part import box
from data_gen.rig import FLOOR, Contact, Rig

FOUR_LEGS = ranges(
    MEANINGS,
    seat_width=(0.4, 0.8),
    seat_height=(0.3, 0.5),
    seat_depth=(0.4, 0.8),
    seat_thickness=(0.02, 0.1),
    back_height=(0.25, 0.5),
    back_thickness=(0.02, 0.1),
)


def with_four_legs(p):
    """A seat on four legs, and a back that stands on the rear edge of the seat, as wide as it."""
    seat = box(
        "seat",
        centre=(0, FLOOR + p.seat_height - p.seat_thickness / 2, 0),
        extents=(p.seat_width, p.seat_thickness, p.seat_depth),
    )
    back = box(
        "back",
        centre=(0, FLOOR + p.seat_height + p.back_height / 2, (p.back_thickness - p.seat_depth) / 2),
        extents=(p.seat_width, p.back_height, p.back_thickness),
    )
    return seat, back, *four_legs(p, p.seat_width, p.seat_depth, p.seat_height - p.seat_thickness)


FAMILIES = (
    Rig(
        "chair/four_legs",
        (*FOUR_LEGS, LEG_WIDTH, LEG_DEPTH),
        with_four_legs,
        (("seat", "seat"), ("back", "back"), *SYMMETRIC),
        (*carry("seat"), Contact("seat", "back", "face_y")),
    ),
    *wood.FAMILIES,
    *soft.FAMILIES,
    *bent.FAMILIES,
    *curved.FAMILIES,
    *castors.FAMILIES,
    *porch.FAMILIES,
)
