"""Tables with one foot in the middle, or three legs, or a cage of wire; most of them round."""

import numpy as np

from data_gen.families.pieces.legs import CORNERS, carry, ring, three_legs
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import turned
from data_gen.families.table.tops import MEANINGS, disc, slab
from data_gen.part import Section, ellipse, joined, loft, rounded, section
from data_gen.rig import FLOOR, Contact, Rig

PEDESTAL = ranges(
    MEANINGS,
    width=(0.5, 0.95),
    height=(0.45, 0.9),
    top_thickness=(0.02, 0.05),
    column_width=(0.05, 0.12),
    foot_width=(0.3, 0.5),
    foot_height=(0.03, 0.08),
)
PEDESTAL_CROSS = ranges(
    MEANINGS,
    width=(0.55, 0.9),
    height=(0.45, 0.65),
    depth=(0.55, 0.9),
    top_thickness=(0.02, 0.05),
    column_width=(0.05, 0.12),
    foot_width=(0.4, 0.55),
    foot_height=(0.12, 0.2),
)
THREE_LEGS = ranges(
    MEANINGS,
    width=(0.4, 0.75),
    height=(0.35, 0.6),
    top_thickness=(0.02, 0.05),
    leg_width=(0.03, 0.06),
    tip_width=(0.012, 0.03),
    splay=(0.0, 0.1),
    shelf_thickness=(0.012, 0.04),
)
WIRE = ranges(
    MEANINGS,
    width=(0.4, 0.75),
    height=(0.35, 0.6),
    top_thickness=(0.02, 0.05),
    rod_width=(0.01, 0.026),
    foot_width=(0.3, 0.55),
)
RODS, TWIST = 12, 0.9
"""Rods that lean one way, and how far around the basket each of them goes, in radians."""


def pedestal(p):
    """A round top on one column, which stands on a round foot."""
    under, low, w = FLOOR + p.height - p.top_thickness, FLOOR + p.foot_height, p.column_width
    dome = ((0, 1), (0.25, 1), (0.6, 0.85), (1, 0.6))
    foot = turned("foot", [(FLOOR + share * p.foot_height, wide * p.foot_width) for share, wide in dome], sides=24)
    flare = [(low, w + 0.06), (low + 0.03, w + 0.02), (low + 0.1, w)]
    head = [(under - 0.08, w), (under - 0.02, w + 0.03), (under, w + 0.1)]
    return disc(p), turned("column", flare + head, sides=20), foot


def pedestal_cross(p):
    """A top with round corners on a turned column, from which four feet reach out."""
    under, w = FLOOR + p.height - p.top_thickness, p.column_width
    low, high = FLOOR + 0.35 * p.foot_height, FLOOR + 1.3 * p.foot_height
    hub = [(low, 0.4 * w), (low + 0.02, w + 0.02), (high, w + 0.02), (high + 0.01, w + 0.04), (high + 0.03, w)]
    head = [(0.4 * high + 0.6 * under, w + 0.03), (under - 0.05, w), (under - 0.03, w + 0.03), (under, w + 0.08)]
    feet = [_claw(f"foot_{i}", p, side, end) for i, (side, end) in enumerate(CORNERS, start=1)]
    return slab(p, rounded(0.15, 4)), turned("column", hub + head), *feet


def _claw(name, p, side, end):
    """A foot from the column outwards over a corner, from high to low, its end flat on the floor."""
    reach, h = (p.foot_width - 0.03) / 2, p.foot_height
    curve = ((0.08, 0.75, 0.5), (0.35, 0.66, 0.44), (0.65, 0.32, 0.34), (0.9, 0.1, 0.2), (1, 0.08, 0.16))
    sections = []
    for share, middle, thickness in curve:
        centre = (side * share * reach, FLOOR + middle * h, end * share * reach)
        sections.append(Section(centre, (0.03 * side, 0, -0.03 * end), (0, thickness * h, 0)))
    return loft(name, sections)


def side_table(p):
    """A round side table: three legs that stand astride, and a small round shelf between them."""
    under, head = p.height - p.top_thickness, 0.36 * p.width - p.leg_width / 2
    foot = head + p.splay
    wide, low = 2 * (0.6 * foot + 0.4 * head), FLOOR + 0.4 * under
    shelf = turned("shelf", [(low, wide - 0.01), (low + p.shelf_thickness, wide)], sides=24)
    return disc(p), *three_legs(foot, head, under, p.tip_width, p.leg_width), shelf


def wire(p):
    """A round top on a basket of rods that cross each other between two rings."""
    under, w = p.height - p.top_thickness, p.rod_width
    foot, head = (p.foot_width - w) / 2, (0.8 * p.width - w) / 2
    rods = []
    for turn in 2 * np.pi * np.arange(RODS) / RODS:
        for twist in (TWIST, -TWIST):
            low = (np.cos(turn) * foot, FLOOR + w / 2, np.sin(turn) * foot)
            high = (np.cos(turn + twist) * head, FLOOR + under - w / 2, np.sin(turn + twist) * head)
            rods.append(loft("rod", [section("y", at, (w, w)) for at in (low, high)], ellipse(8)))
    rings = ring("ring_1", FLOOR + w / 2, p.foot_width, w), ring("ring_2", FLOOR + under - w / 2, 0.8 * p.width, w)
    return disc(p), joined("basket", *rods), *rings


MIDDLE = (("top", "top"), ("column", "column"))
FAMILIES = (
    Rig(
        "table/pedestal",
        PEDESTAL,
        pedestal,
        (*MIDDLE, ("foot", "foot")),
        (Contact("foot", "column", "face_y"), Contact("column", "top", "face_y")),
    ),
    Rig(
        "table/pedestal_cross",
        PEDESTAL_CROSS,
        pedestal_cross,
        (*MIDDLE, ("foot_1", "foot_2"), ("foot_3", "foot_4")),
        (Contact("column", "top", "face_y"),),
    ),
    Rig(
        "table/three_legs",
        THREE_LEGS,
        side_table,
        (("top", "top"), ("leg_1", "leg_2"), ("leg_3", "leg_3"), ("shelf", "shelf")),
        carry("top", "leg_1", "leg_2", "leg_3"),
    ),
    Rig(
        "table/wire",
        WIRE,
        wire,
        (("top", "top"), ("basket", "basket"), ("ring_1", "ring_1"), ("ring_2", "ring_2")),
        (Contact("ring_2", "top", "face_y"),),
    ),
)
