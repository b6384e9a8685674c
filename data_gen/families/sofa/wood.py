"""Sofas with frames of wood: open arms, a daybed with spindles, a futon."""

from data_gen.families.pieces.casework import frame
from data_gen.families.pieces.feet import SYMMETRIC, four_feet, under
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between, soft, tilted
from data_gen.families.sofa.parts import (
    FRAME,
    MEANINGS,
    PILLOW,
    PILLOWS,
    TALL,
    WITH_ARMS,
    behind,
    beside,
    cushions,
    even,
    half_seat,
    on_base,
    pillows,
    seats,
)
from data_gen.part import box, cylinder, joined, mirrored
from data_gen.rig import Contact, Rig

RAIL, POST = 0.028, 0.04
"""Height of the rail above spindles, and edge of the posts of a futon along z."""
RECLINE = 0.3
"""How far the back of a futon recedes over its height, as a share of it."""
WOOD = {**TALL, "back_thickness": (0.018, 0.03), "arm_width": (0.025, 0.045)}


def open_arms(p):
    """Loose cushions in a slim wooden frame with open arms, on tapered legs that splay."""
    half, level, rear = half_seat(p), p.seat_height - p.seat_thickness, -p.depth / 2
    arm = (level, p.seat_height + p.arm_height)
    right = frame("arm_right", (half, p.width / 2), arm, (rear, -rear), p.bar_thickness, axis="x")
    board = (level, p.seat_height + p.back_height)
    return (
        box("base", *between((-p.width / 2, p.width / 2), (p.leg_height, level), (rear, -rear))),
        *seats(p, (-half, half), 2),
        box("back", *between((-half, half), board, (rear, rear + p.back_thickness))),
        mirrored(right, "arm_left"),
        right,
        *four_feet(p.width / 2 - 0.05, p.depth / 2 - 0.05, p.leg_height, 0.034, p.leg_splay),
        *cushions(p, (-half, half), 2),
    )


def daybed(p):
    """A mattress in a wooden frame, spindles on three sides, and a round bolster at either end."""
    half, level, rear = half_seat(p), p.seat_height - p.seat_thickness, -p.depth / 2
    top = p.seat_height + p.back_height
    arm = ((half, p.width / 2), (level, top), (rear, -rear))
    right = _fence("arm_right", *arm, p.bar_thickness, 6, "z")
    x, height = (half - p.bolster_diameter, half), (p.seat_height, p.seat_height + p.bolster_diameter)
    bolster = cylinder("bolster_right", *between(x, height, (rear + p.back_thickness, -rear)), "z", 20)
    return (
        box("base", *between((-p.width / 2, p.width / 2), (p.leg_height, level), arm[2])),
        *seats(p, (-half, half), 1),
        _fence("back", (-half, half), (level, top), (rear, rear + p.back_thickness), p.bar_thickness, 14, "x"),
        mirrored(right, "arm_left"),
        right,
        *four_feet(p.width / 2 - 0.03, p.depth / 2 - 0.03, p.leg_height, 0.04),
        mirrored(bolster, "bolster_left"),
        bolster,
    )


def _fence(name, x, y, z, bar, count, spread):
    """A rail on `count` spindles, which are spread along x or z."""
    rail, height = box("rail", *between(x, (y[1] - RAIL, y[1]), z)), (y[0], y[1] - RAIL)
    bars = []
    for low, high in even(x if spread == "x" else z, count):
        at = ((low + high - bar) / 2, (low + high + bar) / 2)
        bars.append(box("spindle", *between(at, height, z) if spread == "x" else between(x, height, at)))
    return joined(name, rail, *bars)


def futon(p):
    """A folded mattress, half of it leaning, between two slatted arms that reach the floor."""
    half, level, rear = half_seat(p), p.seat_height - p.seat_thickness, -p.depth / 2
    right = _slatted_arm(p, (half, p.width / 2), (rear, -rear))
    lying = between((-half, half), (level, p.seat_height), (rear, -rear))
    leaning = between((-half, half), (p.seat_height, p.seat_height + p.back_height), (rear, rear + p.back_thickness))
    beams = [box("beam", *between((-half, half), (level - 0.03, level), z)) for z in _beams(rear)]
    return (
        joined("base", *beams),
        soft("seat_1", *lying, radius=0.024),
        tilted(soft("back", *leaning, radius=0.024), p.seat_height, RECLINE),
        mirrored(right, "arm_left"),
        right,
        *pillows(p, half - 0.09, rear + p.back_thickness - RECLINE * PILLOW),
    )


def _slatted_arm(p, x, z):
    """A rail on two posts that stand on the floor, and slats between it and a lower rail."""
    top, inner = p.seat_height + p.arm_height - RAIL, (z[0] + POST, z[1] - POST)
    low, slim = 0.04, (0.7 * x[0] + 0.3 * x[1], 0.3 * x[0] + 0.7 * x[1])
    bars = [box("rail", *between(x, (top, top + RAIL), z)), box("rail", *between(x, (low, low + RAIL), inner))]
    bars += [box("post", *between(x, (0, top), post)) for post in ((z[0], inner[0]), (inner[1], z[1]))]
    middles = [(a + b) / 2 for a, b in even(inner, 5)]
    spans = [(at - p.bar_thickness / 2, at + p.bar_thickness / 2) for at in middles]
    return joined("arm_right", *bars, *(box("slat", *between(slim, (low + RAIL, top), span)) for span in spans))


def _beams(rear):
    """Where the slats under a mattress are along z, as spans with gaps between them."""
    return [(0.75 * low + 0.25 * high, 0.25 * low + 0.75 * high) for low, high in even((rear, -rear), 5)]


SPINDLES = {"bar_thickness": (0.008, 0.024)}
FAMILIES = (
    Rig(
        "sofa/open_arms",
        ranges(
            MEANINGS,
            width=(0.6, 0.8),
            **WOOD,
            **PILLOWS,
            arm_height=(0.06, 0.1),
            bar_thickness=(0.015, 0.03),
            leg_height=(0.06, 0.1),
            leg_splay=(0.0, 0.045),
        ),
        open_arms,
        (*WITH_ARMS, ("seat_1", "seat_2"), ("cushion_1", "cushion_2"), *SYMMETRIC),
        (*on_base("seat_1", "seat_2", "back", "arm_left", "arm_right"), *behind("seat_1", "seat_2"), *under("base")),
    ),
    Rig(
        "sofa/daybed",
        ranges(
            MEANINGS, width=(0.75, 0.95), **WOOD, **SPINDLES, leg_height=(0.03, 0.08), bolster_diameter=(0.07, 0.11)
        ),
        daybed,
        (*WITH_ARMS, *itself("seat_1"), ("bolster_left", "bolster_right"), *SYMMETRIC),
        (
            *on_base("seat_1", "back", "arm_left", "arm_right"),
            *behind("seat_1"),
            *under("base"),
            *(Contact("seat_1", bolster, "face_y") for bolster in ("bolster_left", "bolster_right")),
        ),
    ),
    Rig(
        "sofa/futon",
        ranges(MEANINGS, width=(0.7, 0.9), **FRAME, **SPINDLES, arm_width=(0.03, 0.06), arm_height=(0.05, 0.1)),
        futon,
        (*WITH_ARMS, *itself("seat_1"), ("pillow_left", "pillow_right")),
        (*beside("base"), *beside("seat_1"), *on_base("seat_1"), Contact("seat_1", "back", "face_y")),
    ),
)
