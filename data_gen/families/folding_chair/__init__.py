"""Folding chairs: what turns is tied together by one parameter, as the parts of the real ones are."""

import numpy as np

from data_gen.families.chair.pieces import LEGS, MEANINGS, cushion, panel, sided, strut, tube
from data_gen.families.folding_chair import lounger
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.joint import hinge
from data_gen.part import cylinder, ellipse, joined, loft, section
from data_gen.rig import FLOOR, Parameter, Rig

GROUND = FLOOR + 0.045
"""Where they stand: legs that swing through reach lower than they do at rest, and shall stay inside the cube."""
FOLD = "turn of the rear legs towards the front ones, 0 where the chair is open"
LEFT, RIGHT = (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)
"""The axes about which a positive angle lifts, and lowers, what points to the front."""
SLANT, REAR, LEAN = 0.75, 0.55, 0.25
"""How far a front leg leans for each unit of height, a rear leg, and the back."""
CROSS = 0.55
"""Where the legs cross, as a share of the seat's height."""
MEET = float(np.arctan(SLANT) + np.arctan(REAR))
"""The angle between the legs of an open chair: at the end of the fold the rear feet lie beside the front feet."""
LIFT = float((np.pi / 2 + np.arctan(LEAN)) / MEET)
"""By how much the seat turns for each unit that the legs turn, so that it lies against the back at the end."""


def crossed(p):
    """Two pairs of legs that cross; the front ones go on up to the back, against which the seat folds."""
    t, half, foot = p.tube_size, p.seat_width / 2, 0.15 * p.seat_height
    rest = p.seat_height - p.seat_thickness - 0.4 * t
    bars = (
        ("stretcher_1", half, _front, foot),
        ("stretcher_2", half + t, _rear, rest),
        ("stretcher_3", half + t, _rear, foot),
    )
    moved = ("leg_3", "leg_4", "stretcher_2", "stretcher_3")
    return (
        _seat(p),
        _back(p),
        *(_front_leg(p, name, x) for name, x in (("leg_1", half + t / 2), ("leg_2", -half - t / 2))),
        *(_rear_leg(p, name, x, rest) for name, x in (("leg_3", half + 1.5 * t), ("leg_4", -half - 1.5 * t))),
        *(_bar(p, *one) for one in bars),
        hinge("legs", moved, "leg_1", LEFT, (half + t, GROUND + CROSS * p.seat_height, 0), p.fold),
        hinge(
            "seat_hinge",
            ("seat",),
            "leg_1",
            LEFT,
            (half, GROUND + p.seat_height, _front(p, p.seat_height)),
            LIFT * p.fold,
        ),
    )


def _front(p, y):
    """The z of a front leg's middle line at a height above the floor."""
    return SLANT * (CROSS * p.seat_height - y)


def _rear(p, y):
    """The z of a rear leg's middle line."""
    return REAR * (y - CROSS * p.seat_height)


def _front_leg(p, name, x):
    """A tube from the floor to the upper end of the back, bent a little above the seat."""
    size, bend = (p.tube_size, p.tube_size), p.seat_height + 0.03
    z = _front(p, bend)
    stops = ((0, _front(p, 0)), (bend, z), (p.seat_height + p.back_height, z - LEAN * (p.back_height - 0.03)))
    return loft(name, [section("y", (x, GROUND + y, z), size) for y, z in stops], ellipse(8))


def _rear_leg(p, name, x, top):
    low, high = (x, GROUND, _rear(p, 0)), (x, GROUND + top, _rear(p, top))
    return strut(name, low, high, *2 * [(p.tube_size, p.tube_size)], ellipse(8))


def _bar(p, name, half, line, y):
    left, right = ((x, GROUND + y, line(p, y)) for x in (-half, half))
    return strut(name, left, right, *2 * [(0.8 * p.tube_size, 0.8 * p.tube_size)], ellipse(8), "x")


def _seat(p):
    """A seat whose upper side goes through the hinge."""
    z = _front(p, p.seat_height) + p.seat_depth / 2 - 0.05
    at = (0, GROUND + p.seat_height - p.seat_thickness / 2, z)
    return cushion("seat", at, (p.seat_width, p.seat_thickness, p.seat_depth))


def _back(p):
    """A panel between the upper ends of the front legs."""
    low, high = 0.5 * p.back_height, 0.48 * p.back_height
    z = _front(p, p.seat_height + 0.03) - LEAN * (low - 0.03)
    foot = (0, GROUND + p.seat_height + low, z)
    return panel("back", foot, 2 * (p.seat_width,), high, p.back_thickness, LEAN * high)


FRONT_LEG, REAR_LEG = 0.55, 0.42
"""How far the legs below a hub lean for each unit of height, to the front and to the rear."""
CLOSE = float(np.arctan(FRONT_LEG) + np.arctan(REAR_LEG))
"""The angle between these legs."""
DROP = float((np.pi / 2 - np.arctan(FRONT_LEG)) / CLOSE)
"""By how much the seat turns for each unit that the rear legs turn: both end along the front legs."""
HUB = -0.1
"""The z of the hubs."""


def hoops(p):
    """Three frames that turn about one pair of hubs: the back with the front legs, the rear legs, and the seat."""
    t, half, y = p.tube_size, p.seat_width / 2, GROUND + p.seat_height - 0.02
    sides = (("1", 1, half + t / 2, FRONT_LEG), ("2", -1, half + t / 2, FRONT_LEG))
    sides += (("3", 1, half + 1.5 * t, -REAR_LEG), ("4", -1, half + 1.5 * t, -REAR_LEG))
    seat = (0, y + 0.02 - p.seat_thickness / 2, HUB - 0.07 + p.seat_depth / 2)
    hub = (2.6 * t, 0.07, 0.07)
    return (
        cushion("seat", seat, (p.seat_width, p.seat_thickness, p.seat_depth), corner=0.2),
        _hoop(p, half + t / 2, y),
        *(_below(p, f"leg_{i}", side * x, y, lean) for i, side, x, lean in sides),
        _cross(p, "stretcher_1", half, y, FRONT_LEG),
        _cross(p, "stretcher_2", half + t, y, -REAR_LEG),
        *(cylinder(sided("hub", side), (side * (half + t), y, HUB), hub, "x", 20) for side in (-1, 1)),
        hinge("legs", ("leg_3", "leg_4", "stretcher_2"), "hub_right", LEFT, (half + t, y, HUB), p.fold),
        hinge("seat_hinge", ("seat",), "hub_right", RIGHT, (half, y, HUB), DROP * p.fold),
    )


def _hoop(p, x, y):
    """The back: a hoop from hub to hub and a panel in its upper half."""
    t, radius, scale = p.tube_size, 0.08, (1 + LEAN**2) ** 0.5
    up = scale * (p.back_height + 0.02 - t / 2) - radius
    moves = ((up, -np.pi / 2, radius), (2 * (x - radius), -np.pi / 2, radius), (up, 0, 0))
    hoop = tube("hoop", (-x, y, HUB), np.pi / 2, moves, (t, t), ((1, 0, 0), (0, 1 / scale, -LEAN / scale)))
    low, high = 0.45 * p.back_height, 0.5 * p.back_height
    foot, wide = (0, y + low, HUB - LEAN * low), 2 * (p.seat_width,)
    return joined("back", hoop, panel("panel", foot, wide, high, p.back_thickness, LEAN * high, 0.15))


def _below(p, name, x, y, lean):
    """A leg from the hub to the floor."""
    low, high = (x, GROUND, HUB + lean * (y - GROUND)), (x, y, HUB)
    return strut(name, low, high, *2 * [(p.tube_size, p.tube_size)], ellipse(8))


def _cross(p, name, half, y, lean):
    """A bar between two legs, near the floor."""
    up, size = 0.12 * (y - GROUND), 2 * [(0.8 * p.tube_size, 0.8 * p.tube_size)]
    left, right = ((x, GROUND + up, HUB + lean * (y - GROUND - up)) for x in (-half, half))
    return strut(name, left, right, *size, ellipse(8), "x")


FAMILIES = (
    Rig(
        "folding_chair/crossed",
        (
            *ranges(
                MEANINGS,
                seat_width=(0.36, 0.5),
                seat_height=(0.38, 0.46),
                seat_depth=(0.32, 0.42),
                seat_thickness=(0.02, 0.04),
                back_height=(0.38, 0.48),
                back_thickness=(0.016, 0.03),
                tube_size=(0.02, 0.034),
            ),
            Parameter("fold", 0.0, MEET, FOLD, "rad"),
        ),
        crossed,
        (*itself("seat", "back", "stretcher_1", "stretcher_2", "stretcher_3"), *LEGS),
        stack("stretcher_2", "seat"),
    ),
    Rig(
        "folding_chair/hoops",
        (
            *ranges(
                MEANINGS,
                seat_width=(0.36, 0.5),
                seat_height=(0.38, 0.46),
                seat_depth=(0.34, 0.44),
                seat_thickness=(0.02, 0.04),
                back_height=(0.34, 0.49),
                back_thickness=(0.012, 0.02),
                tube_size=(0.02, 0.034),
            ),
            Parameter("fold", 0.0, CLOSE, FOLD, "rad"),
        ),
        hoops,
        (*itself("seat", "back", "stretcher_1", "stretcher_2"), *LEGS, ("hub_left", "hub_right")),
    ),
    *lounger.FAMILIES,
)
