"""What boats are made of: hulls lofted from stern to bow, houses on their decks, masts."""

import numpy as np

from data_gen.part import ellipse, loft, rounded, section
from data_gen.rig import Parameter

MEANINGS = {
    "hull_length": "edge of a hull along z",
    "hull_width": "edge of a hull along x",
    "hull_height": "from the lower side of a hull to its deck amidships",
    "hull_gap": "from the middle of one hull to the middle of the other",
    "bow_rise": "how far the deck at the bow lies above the deck amidships",
    "keel_depth": "from the hull down to the lower side of the keel",
    "seat_depth": "edge of a seat along z",
    "oar_length": "from the handle of an oar to the end of its blade along x",
    "roof_height": "from the deck amidships to the upper side of the roof",
    "hood_height": "edge of the hood of the engine along y",
    "cabin_length": "edge of the cabins along z",
    "cabin_height": "from the deck amidships to the upper side of the cabins",
    "bridge_height": "edge of the bridge along y",
    "funnel_height": "edge of a funnel along y",
    "cargo_height": "from the deck amidships to the upper side of the cargo",
    "mast_height": "edge of the mast along y",
    "sail_width": "edge of the main sail along z",
    "sail_belly": "how far the wind pushes the sails out",
}
SIDE = [(0.5, 0.5), (0.495, 0.25), (0.475, 0.05), (0.43, -0.13), (0.36, -0.28), (0.25, -0.41), (0.12, -0.48), (0, -0.5)]
HULL = np.concatenate([SIDE, np.array(SIDE[-2::-1]) * [-1, 1]])
"""An outline (15, 2) across a hull: flat on top, round below."""
SOFT = rounded(0.3, 5)


def ranges(**ends):
    """Parameters of boats by name, each with the ends of its range."""
    return tuple(Parameter(name, low, high, MEANINGS[name]) for name, (low, high) in ends.items())


def hull(p, name, rows, floor, x=0.0):
    """A decked hull whose lower side is at y = floor, lofted over rows from stern to bow.

    A row says where (share of the length), how wide, how far the keel is up (share of the height), and how far the
    deck is up (share of the bow's rise).
    """
    cuts = []
    for at, wide, keel, sheer in rows:
        low, top = floor + keel * p.hull_height, floor + p.hull_height + sheer * p.bow_rise
        size = (wide * p.hull_width, (1 - keel) * p.hull_height + sheer * p.bow_rise)
        cuts.append(section("z", (x, (low + top) / 2, at * p.hull_length), size))
    return loft(name, cuts, HULL)


def house(name, heights, widths, spans, long=1.0):
    """A house with soft edges: heights, widths, and spans (rear, front) as shares of a length, each below and above."""
    cuts = [
        section("y", (0, y, (rear + front) / 2 * long), (wide, (front - rear) * long))
        for y, wide, (rear, front) in zip(heights, widths, spans, strict=True)
    ]
    return loft(name, cuts, SOFT)


def mast(p, low, z):
    """A round mast that grows thinner."""
    cuts = [section("y", (0, low + up * p.mast_height, z), (thick, thick)) for up, thick in ((0, 0.018), (1, 0.01))]
    return loft("mast", cuts, ellipse(12))
