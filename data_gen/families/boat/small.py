"""Small boats without sails: a rowing boat, a cabin cruiser."""

import numpy as np

from data_gen.families.boat.pieces import SOFT, house, hull, ranges
from data_gen.part import RECTANGLE, Section, box, cylinder, ellipse, joined, loft, mirrored, section
from data_gen.rig import FLOOR, Contact, Rig

HALF = np.array([(0.5, -0.5), (0.5, -0.1), (0.43, 0.12), (0.3, 0.3), (0.14, 0.44), (0.0, 0.5)])
PLAN = np.concatenate([HALF, HALF[-2::-1] * [-1, 1]])
"""The outline (11, 2) of a boat from above: a flat stern, a pointed bow."""
SHELL = ((0, 0.5, 0.78), (0.3, 0.78, 0.9), (0.7, 0.95, 0.97), (1, 1, 1))
"""An open hull from below: height, width, length as shares."""
BENCHES = ((0.14, 0.84, 0.72), (-0.14, 0.91, 0.91), (-0.36, 0.9, 0.9))
"""Benches: where (share of the length), and how wide in the rear and in front (shares of the width)."""
OAR = (
    (-0.2, 0.02, 0.014, 0.014),
    (0.46, -0.046, 0.012, 0.012),
    (0.52, -0.052, 0.01, 0.045),
    (0.78, -0.078, 0.01, 0.055),
)
"""An oar: how far out (share of its length), how high, and its edges along y and z."""
CRUISER = (
    (-0.5, 0.9, 0.12, 0),
    (-0.35, 0.97, 0.06, 0),
    (-0.2, 1, 0.02, 0),
    (0.05, 1, 0, 0.1),
    (0.16, 0.94, 0.015, 0.22),
    (0.26, 0.83, 0.045, 0.4),
    (0.34, 0.67, 0.11, 0.57),
    (0.41, 0.48, 0.22, 0.75),
    (0.46, 0.29, 0.38, 0.88),
    (0.5, 0.05, 0.62, 1),
)
RAIL = ((0.9, 0.02, 0.07), (0.8, 0.2, 0.29), (0.58, 0.33, 0.55), (0.24, 0.44, 0.83), (0, 0.48, 0.94))
"""A rail from its right end to the bow: half its width, where, how high, as shares of the hull's and the bow's rise."""
ACROSS = ((1, 0.1), (0.9, 0.4), (0.8, 0.6), (0.6, 0.8), (0, 1))
"""Directions out of the boat at the points of the rail."""


def rowing_boat(p):
    """An open boat: three benches across it, and an oar over each side."""
    outside = [_plank(p, *row, 0) for row in SHELL]
    inside = [_plank(p, *row, 0.02) for row in SHELL[:0:-1]]
    high = FLOOR + 0.64 * p.hull_height + 0.25 * p.bow_rise
    benches = [_bench(p, f"seat_{i}", high, *row) for i, row in enumerate(BENCHES, 1)]
    return loft("hull", [*outside, *inside], PLAN), *benches, *_oars(p)


def _bench(p, name, y, at, rear, front):
    """A board across the hull, at a share of its length, that narrows with it towards the bow."""
    ends = ((-0.5, rear), (0.5, front))
    cuts = [((0, y, at * p.hull_length + s * p.seat_depth), (wide * p.hull_width - 0.03, 0.014)) for s, wide in ends]
    return loft(name, [section("z", *one) for one in cuts])


def _plank(p, up, wide, long, wall):
    """A section of an open hull at a share of its height, within its walls if they are thick; it rises to the bow."""
    size, rise = (wide * p.hull_width - 2 * wall, long * p.hull_length - 3 * wall), 0.8 * up * p.bow_rise
    return Section((0, FLOOR + up * p.hull_height + rise / 2, 0), (size[0], 0, 0), (0, rise, size[1]))


def _oars(p):
    """Oars that lie on the edges of the hull, their handles inside, their blades out and down."""
    edge, y, z = 0.46 * p.hull_width, FLOOR + p.hull_height + 0.4 * p.bow_rise + 0.016, -0.02 * p.hull_length
    cuts = [section("x", (edge + out * p.oar_length, y + up, z), size) for out, up, *size in OAR]
    right = loft("oar_right", cuts, ellipse(8))
    return mirrored(right, "oar_left"), right


def motorboat(p):
    """A cabin cruiser: a low cabin in the bow, slanting glass under a roof, a bench, a rail, an outboard engine."""
    deck, long, wide = FLOOR + p.hull_height, p.hull_length, p.hull_width
    low, glass, roof = deck + 0.36 * p.roof_height, deck + p.roof_height - 0.016, deck + p.roof_height
    return (
        hull(p, "hull", CRUISER, FLOOR),
        house("cabin", (deck - 0.01, low), (0.74 * wide, 0.6 * wide), ((-0.2, 0.38), (-0.2, 0.26)), long),
        house("windshield", (low, glass), (0.58 * wide, 0.52 * wide), ((-0.16, 0.16), (-0.14, 0.02)), long),
        house("roof", (glass, roof), (0.58 * wide, 0.56 * wide), ((-0.2, 0.05), (-0.19, 0.03)), long),
        _sofa(p, deck, -0.44 * long),
        _outboard(p, deck, -0.5 * long),
        _rail(p, deck),
    )


def _sofa(p, deck, rear):
    """A seat with a back that leans, across the deck."""
    seat = box("", (0, deck + 0.015, rear + 0.045 * p.hull_length), (0.56 * p.hull_width, 0.03, 0.09 * p.hull_length))
    rows = (0, 0), (0.035, -0.006), (0.055, -0.01)
    back = [section("y", (0, deck + y, rear + z), (0.56 * p.hull_width, 0.018)) for y, z in rows]
    return joined("seat_1", seat, loft("", back))


def _outboard(p, deck, stern):
    """An engine behind the stern: a hood, a leg down into the water, a propeller."""
    leg = [section("y", (0, y, stern - 0.025), (0.016, 0.03)) for y in (FLOOR + 0.012, deck)]
    rows = ((0, 0.05, 0.06), (0.7, 0.06, 0.075), (1, 0.045, 0.055))
    hood = [section("y", (0, deck - 0.02 + up * p.hood_height, stern - 0.02), size) for up, *size in rows]
    screw = cylinder("screw", (0, FLOOR + 0.03, stern - 0.045), (0.05, 0.05, 0.01), "z", 12)
    return joined("engine", loft("hood", hood, SOFT), loft("leg", leg, SOFT), screw)


def _rail(p, deck):
    """A rail on posts along the edge of the bow."""
    half = [(0.5 * wide * p.hull_width, deck + up * p.bow_rise, at * p.hull_length) for wide, at, up in RAIL]
    ring = [*half, *((-x, y, z) for x, y, z in half[-2::-1])]
    ways = [*ACROSS, *((-x, z) for x, z in ACROSS[-2::-1])]
    tube = [
        Section((x, y + 0.045, z), (0.008 * out, 0, 0.008 * ahead), (0, 0.008, 0))
        for (x, y, z), (out, ahead) in zip(ring, ways, strict=True)
    ]
    posts = [box("post", (x, y + 0.02, z), (0.008, 0.05, 0.008)) for x, y, z in (*ring[:4], *ring[5:])]
    return joined("rail", loft("tube", tube, RECTANGLE), *posts)


ROWING = ranges(
    hull_length=(0.46, 0.66),
    hull_width=(0.18, 0.27),
    hull_height=(0.09, 0.14),
    bow_rise=(0.0, 0.06),
    seat_depth=(0.04, 0.07),
    oar_length=(0.34, 0.46),
)
MOTORBOAT = ranges(
    hull_length=(0.56, 0.8),
    hull_width=(0.19, 0.26),
    hull_height=(0.08, 0.12),
    bow_rise=(0.03, 0.07),
    roof_height=(0.11, 0.17),
    hood_height=(0.06, 0.09),
)


def _middle(*names):
    return tuple((name, name) for name in names)


SMALL = (
    Rig(
        "boat/rowing_boat",
        ROWING,
        rowing_boat,
        (*_middle("hull", "seat_1", "seat_2", "seat_3"), ("oar_left", "oar_right")),
    ),
    Rig(
        "boat/motorboat",
        MOTORBOAT,
        motorboat,
        _middle("hull", "cabin", "windshield", "roof", "seat_1", "engine", "rail"),
        (Contact("cabin", "windshield", "face_y"), Contact("windshield", "roof", "face_y")),
    ),
)
