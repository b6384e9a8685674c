"""Round stools: on three legs, on a column, and upholstered all around."""

from data_gen.families.pieces.legs import carry, ring, three_legs
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.seats import MEANINGS
from data_gen.families.pieces.turned import turned
from data_gen.part import cylinder, joined
from data_gen.rig import FLOOR, Contact, Rig

THREE_LEGS = ranges(
    MEANINGS,
    seat_width=(0.38, 0.55),
    seat_height=(0.42, 0.62),
    seat_thickness=(0.04, 0.08),
    leg_width=(0.05, 0.075),
    tip_width=(0.025, 0.05),
    splay=(0.03, 0.1),
)
BAR = ranges(
    MEANINGS,
    seat_width=(0.36, 0.5),
    seat_height=(0.75, 1.0),
    seat_thickness=(0.06, 0.11),
    column_width=(0.05, 0.1),
    ring_height=(0.26, 0.4),
    ring_width=(0.3, 0.42),
    foot_width=(0.4, 0.54),
    foot_height=(0.02, 0.05),
)
DRUM = ranges(
    MEANINGS,
    seat_width=(0.42, 0.66),
    seat_height=(0.42, 0.62),
    seat_thickness=(0.07, 0.12),
    bulge=(0.0, 0.1),
    foot_height=(0.03, 0.06),
)


def milking(p):
    """A milking stool: a thick round seat, hollowed a little, on three legs that stand astride."""
    low, t, w = FLOOR + p.seat_height - p.seat_thickness, p.seat_thickness, p.seat_width
    edge = ((0, 0.8), (0.3, 0.96), (0.6, 1), (0.9, 0.98), (1, 0.92), (0.85, 0.6), (0.8, 0.2))
    seat = turned("seat", [(low + share * t, wide * w) for share, wide in edge], sides=36)
    head = 0.36 * w - p.leg_width / 2
    return seat, *three_legs(head + p.splay, head, p.seat_height - t, p.tip_width, p.leg_width)


def bar(p):
    """A bar stool: a round cushion on a column with a ring for the feet, on a round foot."""
    low, t, w = FLOOR + p.seat_height - p.seat_thickness, p.seat_thickness, p.seat_width
    puff = ((0, 0.8), (0.15, 0.94), (0.4, 1), (0.65, 1), (0.88, 0.93), (1, 0.75))
    seat = turned("seat", [(low + share * t, wide * w) for share, wide in puff], sides=32)
    c, neck, h = p.column_width, FLOOR + p.ring_height + 0.06, p.foot_height
    tube = [(FLOOR + h, c + 0.07), (FLOOR + h + 0.02, c), (neck, c), (neck + 0.01, 0.6 * c), (low - 0.05, 0.6 * c)]
    column = turned("column", [*tube, (low, c + 0.06)])
    plate = ((0, 1), (0.4, 1), (1, 0.5))
    foot = turned("foot", [(FLOOR + share * h, wide * p.foot_width) for share, wide in plate], sides=32)
    return seat, column, _footring(p), foot


def _footring(p):
    """A ring around the column, and two bars across that carry it."""
    y, thick = FLOOR + p.ring_height, 0.026
    sizes = {"x": (p.ring_width - thick, 0.02, 0.02), "z": (0.02, 0.02, p.ring_width - thick)}
    bars = [cylinder("bar", (0, y, 0), size, axis, 8) for axis, size in sizes.items()]
    return joined("ring", ring("ring", y, p.ring_width, thick), *bars)


def drum(p):
    """A pouf: a round, bulging body between two bands, a cushion on it and a foot below."""
    low, high, w = FLOOR + p.foot_height, FLOOR + p.seat_height - p.seat_thickness, p.seat_width
    shares = [(s, 4 * s * (1 - s)) for s in (0, 0.12, 0.25, 0.38, 0.5, 0.62, 0.75, 0.88, 1)]
    body = turned("body", [(low + s * (high - low), w - 0.03 + out * p.bulge) for s, out in shares], sides=36)
    puff = ((0, 0.95), (0.08, 0.98), (0.2, 1), (0.5, 1), (0.66, 0.99), (0.8, 0.96), (0.92, 0.9), (1, 0.8))
    seat = turned("seat", [(high + share * p.seat_thickness, wide * w) for share, wide in puff], sides=36)
    foot = turned("foot", [(FLOOR, w - 0.12), (low, w - 0.1)], sides=36)
    return seat, body, ring("band_1", low + 0.012, w - 0.01, 0.024), ring("band_2", high - 0.012, w - 0.01, 0.024), foot


SEAT = (("seat", "seat"),)
FAMILIES = (
    Rig(
        "stool/three_legs",
        THREE_LEGS,
        milking,
        (*SEAT, ("leg_1", "leg_2"), ("leg_3", "leg_3")),
        carry("seat", "leg_1", "leg_2", "leg_3"),
    ),
    Rig(
        "stool/bar",
        BAR,
        bar,
        (*SEAT, ("column", "column"), ("ring", "ring"), ("foot", "foot")),
        (Contact("foot", "column", "face_y"), Contact("column", "seat", "face_y")),
    ),
    Rig(
        "stool/drum",
        DRUM,
        drum,
        (*SEAT, ("body", "body"), ("band_1", "band_1"), ("band_2", "band_2"), ("foot", "foot")),
        (Contact("foot", "body", "face_y"), Contact("body", "seat", "face_y")),
    ),
)
