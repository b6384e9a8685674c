"""Benches with a cushion: for the hall, for a window, and a chest to sit on."""

from data_gen.families.pieces.casework import shell
from data_gen.families.pieces.feet import four_feet, under
from data_gen.families.pieces.legs import SIDES, SYMMETRIC, carry, four_legs, slats
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.seats import MEANINGS
from data_gen.families.pieces.soft import soft
from data_gen.joint import hinge
from data_gen.part import box, cylinder, joined
from data_gen.rig import FLOOR, Contact, Parameter, Rig

SHELF = ranges(
    MEANINGS,
    seat_width=(0.55, 0.95),
    seat_height=(0.26, 0.34),
    seat_depth=(0.2, 0.3),
    seat_thickness=(0.014, 0.04),
    cushion_thickness=(0.03, 0.06),
    leg_width=(0.022, 0.06),
    leg_depth=(0.022, 0.06),
    shelf_height=(0.06, 0.12),
)
UPHOLSTERED = ranges(
    MEANINGS,
    seat_width=(0.5, 0.78),
    seat_height=(0.24, 0.32),
    seat_depth=(0.22, 0.32),
    seat_thickness=(0.05, 0.08),
    arm_height=(0.08, 0.15),
    roll_width=(0.07, 0.1),
    leg_height=(0.07, 0.12),
    leg_width=(0.028, 0.06),
)
STORAGE = (
    *ranges(
        MEANINGS,
        seat_width=(0.55, 0.95),
        seat_height=(0.24, 0.32),
        seat_depth=(0.24, 0.36),
        seat_thickness=(0.015, 0.04),
        cushion_thickness=(0.03, 0.06),
        foot_height=(0.02, 0.05),
    ),
    Parameter("lid_angle", 0.0, 1.2, "turn of the seat about its rear edge, 0 where it is closed", "rad"),
)


def with_shelf(p):
    """A bench for the hall: a cushion on a board, four legs, and slats between them for shoes."""
    top = p.seat_height - p.cushion_thickness
    legs = four_legs(p, p.seat_width, p.seat_depth, top - p.seat_thickness)
    size = (p.seat_width - 2 * p.leg_width, 0.015, p.seat_depth)
    shelf = slats("shelf", 5, 0.015, (0, FLOOR + p.shelf_height, 0), size)
    return _board(p, top), _cushion(p), *legs, shelf


def upholstered(p):
    """A window seat: a cushion between two rolled arms, on four short legs."""
    low, high = FLOOR + p.leg_height, FLOOR + p.seat_height - p.seat_thickness
    base = box("base", (0, (low + high) / 2, 0), (p.seat_width, high - low, p.seat_depth))
    size = (p.seat_width, p.seat_thickness, p.seat_depth)
    seat = soft("seat", (0, FLOOR + p.seat_height - p.seat_thickness / 2, 0), size, 0.022)
    arms = [_rolled(f"arm_{name}", side, p) for name, side in SIDES]
    x, z = p.seat_width / 2, p.seat_depth / 2 - 0.03
    return seat, base, *arms, *four_feet(x, z, p.leg_height, p.leg_width, splay=0.02)


def _rolled(name, side, p):
    """An upright board beside the seat, and a roll on it that stands out."""
    low, high, board = FLOOR + p.leg_height, FLOOR + p.seat_height + p.arm_height, 0.04
    x, roll, middle = p.seat_width / 2 + board / 2, p.roll_width, high - p.roll_width / 2
    upright = box(name, (side * x, (low + middle) / 2, 0), (board, middle - low, p.seat_depth))
    out = p.seat_width / 2 + roll / 2
    return joined(name, upright, cylinder(name, (side * out, middle, 0), (roll, roll, p.seat_depth), "z"))


def storage(p):
    """A chest to sit on: its seat, with a cushion, is a lid that turns about its rear edge."""
    rim = p.seat_height - p.cushion_thickness - p.seat_thickness
    x, z = p.seat_width / 2 - 0.015, p.seat_depth / 2
    body = shell("body", (-x, x), (p.foot_height, rim), (-z, z - 0.02), up=True)
    panel = (p.seat_width / 3 - 0.04, rim - p.foot_height - 0.06, 0.008)
    y = FLOOR + (p.foot_height + rim) / 2
    panels = [box("panel", (i * p.seat_width / 3, y, z - 0.016), panel) for i in (-1, 0, 1)]
    foot = box("foot", (0, FLOOR + p.foot_height / 2, -0.01), (2 * x - 0.03, p.foot_height, 2 * z - 0.05))
    lid = hinge("lid_hinge", ["seat", "cushion"], "body", (-1, 0, 0), (0, FLOOR + rim, -z), p.lid_angle)
    return _board(p, rim + p.seat_thickness), _cushion(p), joined("body", body, *panels), foot, lid


def _board(p, height):
    """A seat of one board, its upper side at a height."""
    size = (p.seat_width, p.seat_thickness, p.seat_depth)
    return box("seat", (0, FLOOR + height - p.seat_thickness / 2, 0), size)


def _cushion(p):
    """A cushion on the seat."""
    size = (p.seat_width - 0.01, p.cushion_thickness, p.seat_depth - 0.01)
    return soft("cushion", (0, FLOOR + p.seat_height - p.cushion_thickness / 2, 0), size, 0.014)


CUSHIONED = (("seat", "seat"), ("cushion", "cushion"))
FAMILIES = (
    Rig(
        "bench/shelf",
        SHELF,
        with_shelf,
        (*CUSHIONED, *SYMMETRIC, ("shelf", "shelf")),
        (
            *carry("seat"),
            Contact("seat", "cushion", "face_y"),
            *(Contact("shelf", leg, "face_x") for leg in ("leg_1", "leg_3")),
            *(Contact(leg, "shelf", "face_x") for leg in ("leg_2", "leg_4")),
        ),
    ),
    Rig(
        "bench/upholstered",
        UPHOLSTERED,
        upholstered,
        (("seat", "seat"), ("base", "base"), ("arm_left", "arm_right"), *SYMMETRIC),
        (
            *under("base"),
            Contact("base", "seat", "face_y"),
            *(Contact("arm_left", part, "face_x") for part in ("base", "seat")),
            *(Contact(part, "arm_right", "face_x") for part in ("base", "seat")),
        ),
    ),
    Rig(
        "bench/storage",
        STORAGE,
        storage,
        (*CUSHIONED, ("body", "body"), ("foot", "foot")),
        (
            Contact("foot", "body", "face_y"),
            Contact("body", "seat", "face_y"),
            Contact("seat", "cushion", "face_y"),
        ),
    ),
)
