"""Beds. The head lies in the rear, at z < 0."""

import numpy as np

from data_gen.families.bed import bars, posts
from data_gen.families.bed.pieces import AT_HEAD, BEDDING, LIE, MEANINGS, SHEET, bedding
from data_gen.families.chair.pieces import LEGS, cushion, ends, legs, panel, tube
from data_gen.families.pieces.legs import carry
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.joint import slide
from data_gen.part import RECTANGLE, box, cylinder, joined
from data_gen.rig import FLOOR, Rig


def frame(p):
    """The box that carries the mattress."""
    y = FLOOR + p.frame_height - p.frame_thickness / 2
    return box("frame", (0, y, 0), (p.bed_width, p.frame_thickness, p.bed_length))


def _bedding(p):
    return bedding(p, p.bed_width - 2 * SHEET - 0.01, p.bed_length - 0.02)


def headboard(p):
    """A bed on tapered legs with a padded headboard in three fields."""
    y, third, z = FLOOR + p.frame_height - p.frame_thickness, p.bed_width / 3, -(p.bed_length + p.board_thickness) / 2
    high = p.headboard_height - p.frame_height + p.frame_thickness
    size = (third, high, p.board_thickness)
    pads = [cushion("pad", (i * third, y + high / 2, z), size, "z", 0.08) for i in (-1, 0, 1)]
    x, deep = (p.bed_width - p.leg_size) / 2 - 0.02, (p.bed_length - p.leg_size) / 2 - 0.02
    stand = legs(ends(x, deep, p.frame_height - p.frame_thickness, 0.0), p.leg_size)
    return frame(p), *_bedding(p), joined("headboard", *pads), *stand


def sleigh(p):
    """A sleigh bed: head- and footboard rise from the floor and curl outwards."""
    boards = []
    for name, side, high in (("headboard", -1, p.headboard_height), ("footboard", 1, p.footboard_height)):
        curl = ((high - 0.085, -side * 1.0, 0.1), (0.02, -side * 1.4, 0.03), (0.005, 0, 0))
        start = (0, FLOOR, side * (p.bed_length + p.board_thickness) / 2)
        boards.append(tube(name, start, np.pi / 2, curl, (p.bed_width + 0.03, p.board_thickness), outline=RECTANGLE))
    return frame(p), *_bedding(p), *boards


WALL = 0.015
"""Thickness of a platform's boards."""
GAP = 0.004
"""Between a drawer and the boards around it."""


def drawers(p):
    """A platform with two drawers on either side, and a headboard with round corners."""
    foot, wide = (0, FLOOR, -(p.bed_length + p.board_thickness) / 2), (p.bed_width, p.bed_width)
    look = {"corner": 0.12, "outline": RECTANGLE}
    board = panel("headboard", foot, wide, p.headboard_height, p.board_thickness, **look)
    places = ((1, 1, 1, p.open_1), (2, -1, 1, p.open_2), (3, 1, -1, p.open_3), (4, -1, -1, p.open_4))
    pulled = [one for place in places for one in _drawer(p, *place)]
    return _platform(p), *_bedding(p), board, *pulled


def _platform(p):
    """A box with four compartments that are open to the sides."""
    y, wide, long = FLOOR + p.frame_height / 2, p.bed_width, p.bed_length
    walls = [
        box("wall", (0, y, end * (long - WALL) / 2), (wide, p.frame_height - 2 * WALL, WALL)) for end in (-1, 0, 1)
    ]
    plates = [
        box("plate", (0, up, 0), (wide, WALL, long)) for up in (FLOOR + WALL / 2, FLOOR + p.frame_height - WALL / 2)
    ]
    return joined("frame", *walls, *plates)


def _drawer(p, i, side, end, distance):
    """A drawer with a knob that slides out of one compartment; its front is flush with the platform."""
    high, deep, long = p.frame_height - 2 * WALL - 2 * GAP, 0.4 * p.bed_width, p.bed_length / 2 - 1.5 * WALL - 2 * GAP
    y, z, face = FLOOR + p.frame_height / 2, end * (p.bed_length - WALL) / 4, side * p.bed_width / 2
    low, mid = y - high / 2, face - side * deep / 2
    sheets = [
        box("front", (face - side * WALL / 2, y, z), (WALL, high, long)),
        box("rear", (face - side * (deep - 0.004), y - 0.2 * high, z), (0.008, 0.6 * high, long)),
        box("floor", (mid, low + 0.004, z), (deep - 2 * WALL, 0.008, long)),
        *(
            box("wall", (mid, y - 0.2 * high, z + s * (long / 2 - 0.004)), (deep - 2 * WALL, 0.6 * high, 0.008))
            for s in (-1, 1)
        ),
        cylinder("knob", (face + side * 0.008, y, z), (0.016, 0.03, 0.03), "x", 12),
    ]
    name = f"drawer_{i}"
    return joined(name, *sheets), slide(f"slide_{i}", [name], "frame", (side, 0, 0), (face, y, z), distance)


STAND = (*itself("frame", "headboard"), *BEDDING)
FAMILIES = (
    Rig(
        "bed/headboard",
        ranges(
            MEANINGS,
            bed_width=(0.45, 0.85),
            bed_length=(0.76, 0.88),
            frame_height=(0.12, 0.2),
            frame_thickness=(0.03, 0.06),
            mattress_thickness=(0.07, 0.13),
            headboard_height=(0.4, 0.62),
            board_thickness=(0.02, 0.06),
            leg_size=(0.03, 0.06),
        ),
        headboard,
        (*STAND, *LEGS),
        (*LIE, AT_HEAD, *carry("frame")),
    ),
    Rig(
        "bed/sleigh",
        ranges(
            MEANINGS,
            bed_width=(0.45, 0.8),
            bed_length=(0.58, 0.72),
            frame_height=(0.12, 0.2),
            frame_thickness=(0.05, 0.1),
            mattress_thickness=(0.07, 0.13),
            headboard_height=(0.44, 0.64),
            footboard_height=(0.3, 0.42),
            board_thickness=(0.016, 0.04),
        ),
        sleigh,
        (*STAND, *itself("footboard")),
        LIE,
    ),
    Rig(
        "bed/drawers",
        ranges(
            MEANINGS,
            bed_width=(0.45, 0.66),
            bed_length=(0.8, 0.92),
            frame_height=(0.12, 0.2),
            mattress_thickness=(0.07, 0.13),
            headboard_height=(0.36, 0.56),
            board_thickness=(0.02, 0.04),
            open_1=(0.0, 0.14),
            open_2=(0.0, 0.14),
            open_3=(0.0, 0.14),
            open_4=(0.0, 0.14),
        ),
        drawers,
        (*STAND, ("drawer_1", "drawer_2"), ("drawer_3", "drawer_4")),
        (*LIE, AT_HEAD),
    ),
    *posts.FAMILIES,
    *bars.FAMILIES,
)
