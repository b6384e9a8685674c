"""Chairs with round seats: a bar chair on tall legs, a tulip on one foot."""

import numpy as np

from data_gen.families.chair.pieces import LEGS, MEANINGS, along, cushion, ends, legs, strut, wrapped
from data_gen.families.pieces.legs import carry, ring
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import turned
from data_gen.part import ellipse, joined
from data_gen.rig import FLOOR, Rig


def bar(p):
    """A bar chair: a round seat on tall splayed legs, a hoop around them for the feet, and a low wall for a back."""
    seat_y, half = FLOOR + p.seat_height, 0.3 * p.seat_width
    extents = (p.seat_width, p.seat_thickness, p.seat_width)
    seat = cushion("seat", (0, seat_y - p.seat_thickness / 2, 0), extents, outline=ellipse(32))
    radius, rail = p.seat_width / 2 - 0.02, 0.09
    wall = wrapped("wall", (0, seat_y + p.back_height - rail, 0), (radius, radius), (0.5 * rail, rail), 0.025, 1.3)
    posts = []
    for angle in (-0.8, 0, 0.8):
        x, z = radius * np.sin(angle), -radius * np.cos(angle)
        high = (x, seat_y + p.back_height - 0.6 * rail, z)
        posts.append(strut("post", (x, seat_y, z), high, *2 * [(0.016, 0.016)], ellipse(8)))
    places = ends(half, half, p.seat_height - p.seat_thickness, p.leg_splay)
    hoop = along(*places[0], 0.3)
    feet = ring("footrest", hoop[1], 2 * 2**0.5 * hoop[0] + 0.02, 0.02)
    return seat, joined("back", wall, *posts), *legs(places, p.leg_size, 0.7, ellipse(12)), feet


def tulip(p):
    """A pedestal chair: a round foot that flows into a thin column, a bowl with a cushion, and a wall around it."""
    rim, low = FLOOR + p.seat_height - 0.03, FLOOR + p.seat_height - p.seat_thickness - 0.03
    c, r, w = p.column_size, 2 * p.base_radius, p.seat_width
    stops = ((0, r), (0.012, r), (0.022, 0.7 * r), (0.04, 0.3 * r), (0.07, c))
    foot = turned("base", [(FLOOR + y, width) for y, width in stops], sides=32)
    stem = [(FLOOR + 0.07, c), (FLOOR + 0.12, 0.8 * c), (low - 0.06, 0.8 * c), (low, 1.6 * c)]
    bowl = [(low, 0.35 * w), (low + 0.3 * p.seat_thickness, 0.7 * w), (rim - 0.02, 0.96 * w), (rim, w)]
    pad = cushion("cushion", (0, rim + 0.015, 0.01), (0.9 * w, 0.03, 0.86 * w), outline=ellipse(32))
    radius = w / 2 - p.back_thickness / 2
    back = wrapped("back", (0, rim, 0), (radius, radius), (0.07, p.back_height + 0.03), p.back_thickness, 2.3)
    return turned("seat", bowl, sides=32), back, pad, foot, turned("column", stem)


FAMILIES = (
    Rig(
        "chair/bar",
        ranges(
            MEANINGS,
            seat_width=(0.3, 0.48),
            seat_height=(0.52, 0.74),
            seat_thickness=(0.03, 0.08),
            back_height=(0.14, 0.26),
            leg_size=(0.022, 0.05),
            leg_splay=(0.02, 0.1),
        ),
        bar,
        (*itself("seat", "back", "footrest"), *LEGS),
        (*carry("seat"), *stack("seat", "back")),
    ),
    Rig(
        "chair/tulip",
        ranges(
            MEANINGS,
            seat_width=(0.46, 0.62),
            seat_height=(0.38, 0.46),
            seat_thickness=(0.06, 0.12),
            back_height=(0.22, 0.46),
            back_thickness=(0.02, 0.045),
            base_radius=(0.18, 0.28),
            column_size=(0.035, 0.1),
        ),
        tulip,
        itself("seat", "back", "cushion", "base", "column"),
        stack("base", "column", "seat", "cushion"),
    ),
)
