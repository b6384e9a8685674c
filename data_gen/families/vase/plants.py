"""Plants in flower pots."""

import numpy as np

from data_gen.families.pieces.turned import arc, quarter, rod, turned
from data_gen.part import Section, ball, ellipse, loft, mirrored
from data_gen.rig import FLOOR

RIM, SOIL = 0.06, 0.03
"""Height of a pot's rim, and how far below it the soil is."""


def _pot(p, low):
    """A flower pot from a height up, thick at its rim, and the soil in it."""
    rim, inner = FLOOR + p.height, p.width - 0.07
    outside = [(low, p.foot_width), (rim - RIM, p.width - 0.03), (rim - RIM, p.width), (rim, p.width)]
    inside = [(rim, inner), (rim - RIM, inner), (low + 0.02, p.foot_width - 0.05)]
    soil = turned("soil", [(rim - RIM, inner), (rim - SOIL, inner)], sides=24)
    return turned("body", [*outside, *inside], sides=24), soil


def _saucer(p):
    low, high, width = FLOOR + 0.012, FLOOR + 0.04, p.saucer_width
    edge = [(high, width), (high, width - 0.03), (low, 0.8 * width)]
    return turned("saucer", [(FLOOR, 0.84 * width), *edge], sides=24)


def topiary(p):
    """A little tree cut to a ball, in a flower pot on a saucer."""
    low, high = FLOOR + p.height - SOIL, FLOOR + p.height + p.stem_height
    stem = turned("stem", [(low, 1.3 * p.stem_width), (high, p.stem_width)], sides=12)
    crown = ball("crown", (0, high, 0), (p.crown_width,) * 3, 20, 12)
    return *_pot(p, FLOOR + 0.012), _saucer(p), crown, stem


def leaves(p):
    """A plant of arching leaves in a flower pot on a saucer."""
    found = [*_pot(p, FLOOR + 0.012), _saucer(p)]
    low = FLOOR + p.height - SOIL
    for i, (at, up) in enumerate(((50, 0.8), (130, 0.8), (-10, 1), (190, 1), (-70, 0.9), (250, 0.9)), 1):
        path = arc(p.leaf_reach + 0.02, low, p.leaf_reach, up * p.leaf_height, np.pi, 0.3 * np.pi, 8)
        breadth = [share * p.leaf_width for share in (0.3, 0.42, 0.6, 0.8, 0.95, 1, 0.9, 0.6, 0.12)]
        found.append(rod(f"leaf_{i}", path, 0.012, np.deg2rad(at), sides=8, breadth=breadth))
    return found


def cactus(p):
    """A cactus with two arms, in a pot on four legs."""
    low, top = FLOOR + p.height - SOIL, FLOOR + p.height - SOIL + p.cactus_height
    body = FLOOR + p.leg_height
    legs = [_leg(p, f"leg_{i}", x, z, body) for i, (x, z) in enumerate(((1, 1), (-1, 1), (1, -1), (-1, -1)), 1)]
    stem = [(low, 0.8 * p.cactus_width), (low + 0.05, p.cactus_width)]
    stem = turned("stem", [*stem, *quarter((top - 0.5 * p.cactus_width, p.cactus_width), (top, 0), 5)], sides=16)
    y, out, size = low + 0.4 * p.cactus_height, 0.95 * p.cactus_width, 0.55 * p.cactus_width
    bend = arc(out - 0.35 * p.cactus_width, y + 0.35 * p.cactus_width, *(0.35 * p.cactus_width,) * 2, -1.4, 0, 4)
    ends = [(out, top - down * p.cactus_height, np.pi / 2) for down in (0.3, 0.26)]
    path = [(0.3 * p.cactus_width, y, 0), *bend, *ends]
    right = rod("stem_right", path, [size] * (len(path) - 1) + [0.5 * size], sides=12)
    bloom = turned("flower", [(top - 0.01, 0.03), (top + 0.015, 0.07), (top + 0.03, 0.08), (top + 0.05, 0)], sides=12)
    return *_pot(p, body), *legs, stem, right, mirrored(right, "stem_left"), bloom


def _leg(p, name, x, z, high):
    rings = []
    for y, out, width in ((FLOOR, 0.5 * p.width, 0.7 * p.leg_width), (high, 0.3 * p.foot_width, p.leg_width)):
        rings.append(Section((x * 0.7 * out, y, z * 0.7 * out), (width, 0, 0), (0, 0, width)))
    return loft(name, rings, ellipse(12))
