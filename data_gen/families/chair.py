"""Chairs."""

from data_gen.families.legs import LEG_DEPTH, LEG_WIDTH, SYMMETRIC, carry, four_legs
from data_gen.part import Box
from data_gen.rig import FLOOR, Contact, Parameter, Rig

CHAIR = (
    Parameter("seat_width", 0.4, 0.8, "edge of the seat along x"),
    Parameter("seat_height", 0.3, 0.5, "from the floor to the upper side of the seat"),
    Parameter("seat_depth", 0.4, 0.8, "edge of the seat along z"),
    Parameter("seat_thickness", 0.02, 0.1, "edge of the seat along y"),
    Parameter("back_height", 0.25, 0.5, "from the upper side of the seat to the upper end of the back"),
    Parameter("back_thickness", 0.02, 0.1, "edge of the back along z"),
    LEG_WIDTH,
    LEG_DEPTH,
)


def with_four_legs(p):
    """A seat on four legs, and a back that stands on the rear edge of the seat, as wide as it."""
    seat = Box(
        "seat",
        centre=(0, FLOOR + p.seat_height - p.seat_thickness / 2, 0),
        extents=(p.seat_width, p.seat_thickness, p.seat_depth),
    )
    back = Box(
        "back",
        centre=(0, FLOOR + p.seat_height + p.back_height / 2, (p.back_thickness - p.seat_depth) / 2),
        extents=(p.seat_width, p.back_height, p.back_thickness),
    )
    return seat, back, *four_legs(p, p.seat_width, p.seat_depth, p.seat_height - p.seat_thickness)


FAMILIES = (
    Rig(
        "chair/four_legs",
        CHAIR,
        with_four_legs,
        (("seat", "seat"), ("back", "back"), *SYMMETRIC),
        (*carry("seat"), Contact("seat", "back", "face_y")),
    ),
)
