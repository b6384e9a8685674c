"""Chairs of bent plywood and of bent tubes."""

import numpy as np

from data_gen.families.chair.pieces import LEGS, MEANINGS, cushion, ends, legs, panel, strut, tube
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.part import Section, ellipse, loft, rounded
from data_gen.rig import FLOOR, Contact, Rig

SEAT_CURVE = (
    (0.5, -0.05, 0.66, 30),
    (0.493, -0.032, 0.77, 42),
    (0.47, -0.018, 0.86, 54),
    (0.43, -0.008, 0.93, 66),
    (0.37, -0.002, 0.975, 78),
    (0.28, 0, 0.995, 87),
    (0.2, 0, 1, 90),
    (-0.1, 0, 0.96, 90),
    (-0.32, 0.006, 0.84, 105),
    (-0.44, 0.03, 0.72, 130),
    (-0.49, 0.075, 0.62, 155),
)
"""A bent seat from its front: z as a share of the depth, height, width as a share, and the angle it faces."""
WAIST, WIDEST = 0.62, 0.55
"""How wide a bent back is where it begins, as a share of the seat, and how high up it is as wide as the seat."""


def bent(p):
    """A chair of bent plywood, seat and back in one curve with a waist, on splayed round legs."""
    seat_y, sheet = FLOOR + p.seat_height - p.seat_thickness / 2, []
    for share, up, wide, angle in SEAT_CURVE:
        across, face = (wide * p.seat_width, 0, 0), np.array([0, np.sin(np.radians(angle)), -np.cos(np.radians(angle))])
        sheet.append(Section((0, seat_y + up, share * p.seat_depth), across, tuple(f * p.seat_thickness for f in face)))
    rise, back = p.back_height - 0.075, []
    for share in (0, 0.1, 0.22, 0.36, WIDEST, 0.7, 0.82, 0.9, 0.95, 0.98, 1):
        at = (0, seat_y + 0.075 + share * rise, -0.49 * p.seat_depth - share * p.back_lean)
        back.append(Section(at, (_wide(share) * p.seat_width, 0, 0), sheet[-1].b))
    stand = legs(
        ends(0.32 * p.seat_width, 0.26 * p.seat_depth, p.seat_height - p.seat_thickness, p.leg_splay),
        p.leg_size,
        0.6,
        ellipse(12),
    )
    return loft("seat", sheet, rounded(0.2, 2)), loft("back", back, rounded(0.2, 2)), *stand


def _wide(share):
    """The width of a bent back a share of the way up: it swings out of the waist and ends in half an ellipse."""
    if share < WIDEST:
        return WAIST + (1 - WAIST) * np.sin(np.pi / 2 * share / WIDEST) ** 2
    return (1 - 0.9 * ((share - WIDEST) / (1 - WIDEST)) ** 2) ** 0.5


RADIUS = 0.05
"""Radius of the bends of a tube's middle line."""
LEAN = 0.18
"""Angle by which the backs of chairs of tube lean back."""


def sled(p):
    """A chair on two runners of bent tube, which go up in front to the seat and in the rear to the back."""
    up, t = p.seat_height - RADIUS - p.tube_size / 2, p.tube_size
    moves = (
        (up, -np.pi / 2, RADIUS),
        (p.seat_depth - 2 * RADIUS - t, -np.pi / 2, RADIUS),
        (up + 0.02, LEAN, 0.2),
        (0.85 * p.back_height, 0, 0),
    )
    start = (0, FLOOR + p.seat_height, (p.seat_depth - t) / 2)
    frames = _frames(p, start, -np.pi / 2, moves)
    return *_between(p), *frames, _tie(p, FLOOR + 0.6 * p.seat_height, (t - p.seat_depth) / 2)


def cantilever(p):
    """A chair without rear legs: two tubes run along the floor, up in front, back along the seat and up the back."""
    t, deep = p.tube_size, p.seat_depth - p.tube_size
    moves = (
        (deep - RADIUS, np.pi / 2, RADIUS),
        (p.seat_height - t - 2 * RADIUS, np.pi / 2, RADIUS),
        (deep - 2 * RADIUS, -np.pi / 2 + LEAN, RADIUS),
        (0.9 * p.back_height, 0, 0),
    )
    frames = _frames(p, (0, FLOOR + t / 2, -deep / 2), 0, moves)
    return *_between(p), *frames, _tie(p, FLOOR + t / 2, 0.02 - deep / 2)


def _frames(p, start, heading, moves):
    """The same bent tube on either side."""
    x, size = (p.seat_width + p.tube_size) / 2, (p.tube_size, p.tube_size)
    places = (("leg_left", -x), ("leg_right", x))
    return [tube(name, (side, *start[1:]), heading, moves, size) for name, side in places]


def _between(p):
    """A seat and a leaning back that just fit between the tubes."""
    seat_y, t = FLOOR + p.seat_height, p.seat_thickness
    seat = cushion("seat", (0, seat_y - t / 2, 0), (p.seat_width, t, p.seat_depth), corner=0.06)
    gap, tan, w = 0.3, np.tan(LEAN), p.seat_width
    foot = (0, seat_y + gap * p.back_height, (p.tube_size - p.seat_depth) / 2 - gap * p.back_height * tan)
    high = (1 - gap) * p.back_height
    return seat, panel("back", foot, (w, w), high, p.back_thickness, high * tan)


def _tie(p, y, z):
    """A bar from one tube to the other."""
    half, size = p.seat_width / 2, (p.tube_size, p.tube_size)
    return strut("stretcher", (-half, y, z), (half, y, z), size, size, rounded(0.3, 2), "x")


TUBES = (*itself("seat", "back", "stretcher"), ("leg_left", "leg_right"))
BESIDE = (Contact("leg_left", "seat", "face_x"), Contact("seat", "leg_right", "face_x"))
FAMILIES = (
    Rig(
        "chair/bent",
        ranges(
            MEANINGS,
            seat_width=(0.4, 0.56),
            seat_height=(0.36, 0.46),
            seat_depth=(0.36, 0.48),
            seat_thickness=(0.012, 0.036),
            back_height=(0.4, 0.54),
            back_lean=(0.04, 0.14),
            leg_size=(0.022, 0.05),
            leg_splay=(0.02, 0.08),
        ),
        bent,
        (*itself("seat", "back"), *LEGS),
    ),
    Rig(
        "chair/sled",
        ranges(
            MEANINGS,
            seat_width=(0.36, 0.58),
            seat_height=(0.36, 0.46),
            seat_depth=(0.38, 0.54),
            seat_thickness=(0.03, 0.06),
            back_height=(0.28, 0.52),
            back_thickness=(0.016, 0.06),
            tube_size=(0.018, 0.045),
        ),
        sled,
        TUBES,
        BESIDE,
    ),
    Rig(
        "chair/cantilever",
        ranges(
            MEANINGS,
            seat_width=(0.38, 0.6),
            seat_height=(0.36, 0.46),
            seat_depth=(0.42, 0.56),
            seat_thickness=(0.03, 0.07),
            back_height=(0.28, 0.52),
            back_thickness=(0.016, 0.06),
            tube_size=(0.02, 0.048),
        ),
        cantilever,
        TUBES,
        BESIDE,
    ),
)
