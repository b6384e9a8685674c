"""Benches with a back: one for the park and a pew."""

from data_gen.families.pieces.legs import SIDES, SYMMETRIC, slats
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.seats import MEANINGS
from data_gen.part import Section, box, joined, loft, section
from data_gen.rig import FLOOR, Contact, Rig

PARK = ranges(
    MEANINGS,
    seat_width=(0.55, 0.86),
    seat_height=(0.24, 0.34),
    seat_depth=(0.24, 0.34),
    seat_thickness=(0.02, 0.035),
    back_height=(0.24, 0.36),
    back_lean=(0.03, 0.1),
    leg_width=(0.025, 0.06),
    leg_depth=(0.03, 0.065),
)
PEW = ranges(
    MEANINGS,
    seat_width=(0.5, 0.88),
    seat_height=(0.24, 0.34),
    seat_depth=(0.22, 0.3),
    seat_thickness=(0.02, 0.035),
    back_height=(0.24, 0.4),
    back_lean=(0.02, 0.09),
    side_width=(0.02, 0.055),
)
ARM, PLATE = 0.02, 0.02


def park(p):
    """A park bench: slats to sit on and to lean against, and arms, between posts that lean back behind."""
    x, z = (p.seat_width + p.leg_width) / 2, (p.seat_depth - p.leg_depth) / 2
    y = FLOOR + p.seat_height
    seat = slats("seat", 5, 0.01, (0, y - p.seat_thickness / 2, 0), (p.seat_width, p.seat_thickness, p.seat_depth))
    rise = p.seat_height + p.back_height / 2 - ARM
    front = [
        box(f"leg_{i}", (s * x, FLOOR + rise / 2, z), (p.leg_width, rise, p.leg_depth)) for i, s in ((1, 1), (2, -1))
    ]
    rear = [_post(f"leg_{i}", side * x, -z, p) for i, side in ((3, 1), (4, -1))]
    back = joined("back", *(_slat("slat", share, 0.2, -z, p) for share in (0.4, 0.64, 0.88)))
    return seat, back, *front, *rear, *(_arm(f"arm_{name}", side * x, z, p) for name, side in SIDES)


def _post(name, x, z, p):
    """A rear leg and the post of the back in one: it stands a little behind the seat and leans back above it."""
    levels = ((0, 0.03), (p.seat_height, 0), (p.seat_height + p.back_height, p.back_lean))
    return loft(name, [section("y", (x, FLOOR + y, z - behind), (p.leg_width, p.leg_depth)) for y, behind in levels])


def _slat(name, share, height, z, p):
    """A slat of the back around a share of its height, `height` of it high, that leans with it."""
    y, behind = FLOOR + p.seat_height + share * p.back_height, z - share * p.back_lean
    edge, thick = (0, height * p.back_height, -height * p.back_lean), (0, 0, PLATE)
    return loft(name, [Section((side * p.seat_width / 2, y, behind), edge, thick) for side in (-1, 1)])


def _arm(name, x, z, p):
    """An arm from a little before the front leg to the middle of the post, half as high as the back."""
    front, rear = z + p.leg_depth / 2 + 0.015, -z - p.back_lean / 2
    middle = (x, FLOOR + p.seat_height + (p.back_height - ARM) / 2, (front + rear) / 2)
    return box(name, middle, (p.leg_width + 0.015, ARM, front - rear))


def pew(p):
    """A pew: a board to sit on and one to lean against, between two sides from the floor to the top of the back."""
    y, z = FLOOR + p.seat_height, p.seat_depth / 2
    seat = box("seat", (0, y - p.seat_thickness / 2, 0), (p.seat_width, p.seat_thickness, p.seat_depth))
    back = _slat("back", 0.47, 0.94, PLATE / 2 - z, p)
    brace = box("stretcher", (0, FLOOR + 0.6 * p.seat_height, -0.5 * z), (p.seat_width, 0.3 * p.seat_height, PLATE))
    x = (p.seat_width + p.side_width) / 2
    return seat, back, brace, *(_side(f"side_{name}", side * x, z, p) for name, side in SIDES)


def _side(name, x, z, p):
    """A side: as deep as the seat below, with a round shoulder where arms rest, narrow beside the back."""
    sections = []
    for share, front, lean in _pew_front(z, p.back_lean):
        y, rear = FLOOR + p.seat_height + share * p.back_height, -z - 0.012 - lean
        sections.append(section("y", (x, y, (front + rear) / 2), (p.side_width, front - rear)))
    foot = section("y", (x, FLOOR, -0.001), (p.side_width, 2 * z + 0.022))
    return loft(name, [foot, *sections])


def _pew_front(z, lean):
    """The front of a side from the seat upwards: the share of the back's height, z, and how far the rear leans."""
    shoulder = [(0, z + 0.01), (0.3, z - 0.01), (0.45, 0.6 * z), (0.53, 0.1 * z)]
    upright = [(0.6, 0.05 - z - 0.6 * lean), (1, 0.045 - z - lean)]
    return [(share, front, share * lean) for share, front in shoulder + upright]


FAMILIES = (
    Rig(
        "bench/park",
        PARK,
        park,
        (("seat", "seat"), ("back", "back"), *SYMMETRIC, ("arm_left", "arm_right")),
        (
            *(Contact("seat", leg, "face_x") for leg in ("leg_1", "leg_3")),
            *(Contact(leg, "seat", "face_x") for leg in ("leg_2", "leg_4")),
            Contact("back", "leg_3", "face_x"),
            Contact("leg_4", "back", "face_x"),
            Contact("leg_1", "arm_right", "face_y"),
            Contact("leg_2", "arm_left", "face_y"),
        ),
    ),
    Rig(
        "bench/pew",
        PEW,
        pew,
        (("seat", "seat"), ("back", "back"), ("stretcher", "stretcher"), ("side_left", "side_right")),
        (
            *(Contact("side_left", part, "face_x") for part in ("seat", "back", "stretcher")),
            *(Contact(part, "side_right", "face_x") for part in ("seat", "back", "stretcher")),
        ),
    ),
)
