"""Boats with sails: a yacht on its keel, a catamaran."""

from data_gen.families.boat.pieces import SOFT, house, hull, mast, ranges
from data_gen.part import RECTANGLE, box, cylinder, joined, loft, mirrored, section
from data_gen.rig import FLOOR, Contact, Rig

YACHT = (
    (-0.5, 0.62, 0.45, 0.2),
    (-0.3, 0.88, 0.15, 0.05),
    (-0.1, 1, 0, 0),
    (0.14, 0.94, 0, 0),
    (0.32, 0.64, 0.12, 0.35),
    (0.44, 0.3, 0.35, 0.75),
    (0.5, 0.05, 0.65, 1),
)
SAIL = ((0, 1, 0), (0.2, 0.86, 0.65), (0.4, 0.69, 1), (0.6, 0.5, 0.95), (0.8, 0.28, 0.6), (1, 0.06, 0))
"""A sail from its foot up: height, width, push of the wind, all as shares."""
CLOTH = 0.006


def _sail(p, name, foot, height, width, z, way):
    """A sail whose upright edge is at z; `way` is 1 if the rest is before it, -1 if it is behind."""
    cuts = [
        section("y", (push * p.sail_belly, foot + up * height, z + 0.5 * way * wide * width), (CLOTH, wide * width))
        for up, wide, push in SAIL
    ]
    return loft(name, cuts, RECTANGLE)


def _rigging(p, step, z, jib_foot, jib_width):
    """A mast that stands at a height and z, a boom behind it, the main sail on that, and the jib before the mast."""
    boom_size, boom = (0.014, 0.014, 1.04 * p.sail_width), (0, step + 0.048, z - 0.52 * p.sail_width)
    return (
        mast(p, step, z),
        cylinder("boom", boom, boom_size, "z", 12),
        _sail(p, "sail_1", step + 0.06, p.mast_height - 0.08, p.sail_width, z - 0.012, -1),
        _sail(p, "sail_2", jib_foot, 0.8 * p.mast_height, jib_width, z + 0.02, 1),
    )


def sailboat(p):
    """A yacht: a hull on a keel, a rudder, a cabin, a mast that stands on it with a boom and two sails."""
    low, long, wide = FLOOR + p.keel_depth, p.hull_length, p.hull_width
    deck, roof = low + p.hull_height, low + p.hull_height + 0.045
    fin = (
        (FLOOR, -0.02, 0.05, 0.16),
        (FLOOR + 0.03, -0.02, 0.05, 0.16),
        (FLOOR + 0.04, -0.01, 0.02, 0.1),
        (low + 0.02, 0.01, 0.02, 0.14),
    )
    blade = ((low - 0.4 * p.keel_depth, 0.0, 0.012, 0.035), (low + 0.6 * p.hull_height, 0.01, 0.012, 0.05))
    return (
        hull(p, "hull", YACHT, low),
        _fin("keel", fin, 0),
        _fin("rudder", blade, -0.45 * long),
        house("cabin", (deck - 0.01, roof), (0.5 * wide, 0.4 * wide), ((-0.21, 0.21), (-0.2, 0.14)), long),
        *_rigging(p, roof, 0.06 * long, deck + p.bow_rise + 0.01, 0.4 * long),
    )


def _fin(name, rows, z):
    """A blade under a hull over rows (y, z, thickness, length) from below, around z."""
    return loft(name, [section("y", (0, y, z + at), size) for y, at, *size in rows], SOFT)


def catamaran(p):
    """A catamaran: two slim hulls, two beams and a cloth between them, a mast on the front beam, two sails."""
    x, top, long = p.hull_gap / 2, FLOOR + p.hull_height, p.hull_length
    right = hull(p, "hull_right", YACHT, FLOOR, x)
    beams = [cylinder("beam", (0, top, at * long), (p.hull_gap, 0.024, 0.024), "x", 12) for at in (0.1, -0.3)]
    blade = box("rudder_right", (x, FLOOR + 0.5 * p.hull_height, -0.5 * long - 0.01), (0.01, 0.9 * p.hull_height, 0.03))
    return (
        mirrored(right, "hull_left"),
        right,
        mirrored(blade, "rudder_left"),
        blade,
        box("deck", (0, top, -0.1 * long), (p.hull_gap - 0.4 * p.hull_width, 0.008, 0.4 * long)),
        joined("beam", *beams),
        *_rigging(p, top + 0.012, 0.1 * long, top + 0.052, 0.34 * long),
    )


SAILBOAT = ranges(
    hull_length=(0.5, 0.68),
    hull_width=(0.15, 0.22),
    hull_height=(0.07, 0.1),
    bow_rise=(0.0, 0.04),
    keel_depth=(0.07, 0.12),
    mast_height=(0.5, 0.7),
    sail_width=(0.18, 0.28),
    sail_belly=(0.0, 0.05),
)
CATAMARAN = ranges(
    hull_length=(0.44, 0.62),
    hull_width=(0.055, 0.09),
    hull_height=(0.06, 0.1),
    hull_gap=(0.22, 0.38),
    bow_rise=(0.01, 0.04),
    mast_height=(0.54, 0.78),
    sail_width=(0.16, 0.26),
    sail_belly=(0.0, 0.05),
)
MIDDLE = (("mast", "mast"), ("boom", "boom"))
SAILS = (
    Rig(
        "boat/sailboat",
        SAILBOAT,
        sailboat,
        (*((name, name) for name in ("hull", "keel", "rudder", "cabin")), *MIDDLE),
        (Contact("cabin", "mast", "face_y"),),
    ),
    Rig(
        "boat/catamaran",
        CATAMARAN,
        catamaran,
        (("hull_left", "hull_right"), ("rudder_left", "rudder_right"), ("deck", "deck"), ("beam", "beam"), *MIDDLE),
        (Contact("beam", "mast", "face_y"),),
    ),
)
