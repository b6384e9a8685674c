"""Upholstered chairs: with bent arms, with wings."""

import numpy as np

from data_gen.families.chair.pieces import LEGS, MEANINGS, cushion, ends, legs, panel, sided, tube
from data_gen.families.pieces.legs import carry
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import box, cylinder, joined, loft, rounded, section
from data_gen.rig import FLOOR, Rig


def with_arms(p):
    """An upholstered chair on tapered legs with a bent loop of wood on either side for an arm."""
    seat_y = FLOOR + p.seat_height
    x, z = (p.seat_width - p.leg_size) / 2 - 0.03, (p.seat_depth - p.leg_size) / 2 - 0.03
    width, foot = p.seat_width - 2 * p.arm_width - 0.05, (p.back_thickness - p.seat_depth) / 2
    look = {"corner": 0.15, "outline": rounded(0.25, 2)}
    back = panel("back", (0, seat_y, foot), (width, width), p.back_height, p.back_thickness, p.back_lean, **look)
    seat = cushion("seat", (0, seat_y - p.seat_thickness / 2, 0), (p.seat_width, p.seat_thickness, p.seat_depth))
    stand = legs(ends(x, z, p.seat_height - p.seat_thickness, 0.02), p.leg_size)
    return seat, back, *stand, _loop(p, "arm_left", -1), _loop(p, "arm_right", 1)


def _loop(p, name, side):
    """An arm that stands on the seat: up at the rear, forward, and down in front, its corners rounded."""
    size, radius = 0.03, 0.06
    x, up = side * ((p.seat_width - p.arm_width) / 2 - 0.015), p.arm_height - size / 2 - radius
    start = (x, FLOOR + p.seat_height, 0.06 - p.seat_depth / 2)
    moves = ((up, -np.pi / 2, radius), (p.seat_depth - 0.12 - 2 * radius, -np.pi / 2, radius), (up, 0, 0))
    return tube(name, start, np.pi / 2, moves, (p.arm_width, size), outline=rounded(0.25, 2))


LEAN = 0.16
"""How far a back leans backwards for each unit of its height."""


def wing(p):
    """An upholstered chair with rolled arms, a high leaning back and wings beside the head."""
    seat_y, low = FLOOR + p.seat_height, FLOOR + p.leg_height
    wide, inner = p.seat_width + 2 * p.arm_width, p.seat_width
    body_y = seat_y - p.seat_thickness
    body = box("base", (0, (low + body_y) / 2, 0), (inner, body_y - low, p.seat_depth))
    extents = (inner, p.seat_thickness, p.seat_depth - 0.02)
    seat = cushion("seat", (0, seat_y - p.seat_thickness / 2, 0.02), extents, corner=0.06)
    foot = (0, seat_y, (p.back_thickness - p.seat_depth) / 2)
    look = {"corner": 0.15, "outline": rounded(0.2, 2)}
    back = panel("back", foot, (inner, inner), p.back_height, p.back_thickness, LEAN * p.back_height, **look)
    x, z = (wide - p.leg_size) / 2 - 0.02, (p.seat_depth - p.leg_size) / 2 - 0.02
    sides = [piece(p, side, low) for piece in (_arm, _wing) for side in (-1, 1)]
    return seat, back, body, *sides, *legs(ends(x, z, p.leg_height, 0.0), p.leg_size)


def _arm(p, side, low):
    """A panel from the legs up and a roll on it."""
    name, x, top = sided("arm", side), side * (p.seat_width + p.arm_width) / 2, FLOOR + p.seat_height + p.arm_height
    roll = 1.1 * p.arm_width
    high = top - roll / 2 - low
    wall = box("wall", (x, low + high / 2, 0), (p.arm_width, high, p.seat_depth - 0.02))
    return joined(name, wall, cylinder("roll", (x, top - roll / 2, 0), (roll, roll, p.seat_depth), "z", 16))


def _wing(p, side, _low):
    """A wall on the arm beside the back, whose front edge runs back to it at the upper end."""
    foot, high = FLOOR + p.seat_height + p.arm_height, p.back_height - p.arm_height
    x, found = side * (p.seat_width / 2 + 0.3 * p.arm_width), []
    for share, deep in ((0, 0.75), (0.2, 0.9), (0.45, 1.0), (0.7, 0.95), (0.88, 0.75), (0.97, 0.5), (1.0, 0.3)):
        edge, rear = deep * p.wing_depth, -p.seat_depth / 2 - LEAN * (p.arm_height + share * high)
        at = (x, foot - 0.02 + share * high, rear + edge / 2)
        found.append(section("y", at, (0.6 * p.arm_width, edge)))
    return loft(sided("wing", side), found, rounded(0.3, 2))


FAMILIES = (
    Rig(
        "chair/arms",
        ranges(
            MEANINGS,
            seat_width=(0.4, 0.64),
            seat_height=(0.32, 0.44),
            seat_depth=(0.38, 0.56),
            seat_thickness=(0.06, 0.11),
            back_height=(0.3, 0.54),
            back_thickness=(0.04, 0.09),
            back_lean=(0.0, 0.12),
            arm_height=(0.17, 0.26),
            arm_width=(0.03, 0.06),
            leg_size=(0.028, 0.065),
        ),
        with_arms,
        (*itself("seat", "back"), *LEGS, ("arm_left", "arm_right")),
        (*carry("seat"), *stack("seat", "back"), *stack("seat", "arm_left"), *stack("seat", "arm_right")),
    ),
    Rig(
        "chair/wing",
        ranges(
            MEANINGS,
            seat_width=(0.34, 0.54),
            seat_height=(0.32, 0.4),
            seat_depth=(0.42, 0.6),
            seat_thickness=(0.07, 0.12),
            back_height=(0.4, 0.6),
            back_thickness=(0.06, 0.1),
            arm_height=(0.14, 0.2),
            arm_width=(0.07, 0.11),
            wing_depth=(0.14, 0.24),
            leg_height=(0.06, 0.14),
            leg_size=(0.03, 0.075),
        ),
        wing,
        (*itself("seat", "back", "base"), ("arm_left", "arm_right"), ("wing_left", "wing_right"), *LEGS),
        (*stack("base", "seat", "back"), *carry("arm_right", "leg_1", "leg_3"), *carry("arm_left", "leg_2", "leg_4")),
    ),
)
