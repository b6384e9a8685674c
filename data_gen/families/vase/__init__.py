"""Vases, and flower pots with what grows in them, which stand in `plants.py`."""

from functools import partial

import numpy as np

from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import ear, rod, scaled, turned, vessel
from data_gen.families.vase.plants import cactus, leaves, topiary
from data_gen.part import Section, Tip, ball, ellipse, joined, loft, mirrored
from data_gen.rig import FLOOR, Contact, Rig

vase = partial(
    ranges,
    {
        "height": "from the floor to the rim",
        "width": "diameter of the body at its widest",
        "foot_width": "diameter of the body or its foot at the lower end",
        "neck_width": "diameter of the neck at its thinnest",
        "neck_height": "edge of the neck along y",
        "rim_width": "diameter of the rim",
        "handle_reach": "how far a handle stands out from where it is fixed",
        "handle_width": "thickness of a handle",
        "saucer_width": "diameter of the saucer",
        "stem_height": "from the rim to the upper end of the longest stem",
        "stem_width": "thickness of a stem",
        "spread": "from the axis to the end of a stem",
        "flower_width": "diameter of a flower",
        "crown_width": "diameter of the crown",
        "leaf_height": "from the soil to the highest point of a leaf",
        "leaf_reach": "from the axis to the highest point of a leaf",
        "leaf_width": "widest edge of a leaf across",
        "cactus_height": "from the soil to the upper end of the cactus",
        "cactus_width": "diameter of the cactus",
        "leg_height": "from the floor to the lower side of the body",
        "leg_width": "diameter of a leg at its upper end",
    },
)
BELLY = ((0, 0.4), (0.03, 0.44), (0.1, 0.57), (0.18, 0.71), (0.26, 0.84), (0.34, 0.93), (0.42, 0.98), (0.5, 1))
BELLY += ((0.58, 0.98), (0.65, 0.93), (0.72, 0.84), (0.79, 0.71), (0.85, 0.6), (0.9, 0.53), (0.94, 0.502), (1, 0.5))
URN = ((0, 0.26), (0.06, 0.316), (0.14, 0.42), (0.22, 0.54), (0.3, 0.66), (0.4, 0.785), (0.5, 0.88), (0.58, 0.945))
URN += ((0.65, 0.985), (0.71, 1), (0.77, 0.985), (0.83, 0.94), (0.88, 0.875), (0.92, 0.78), (0.96, 0.65), (1, 0.46))
"""Outlines of bodies: heights by their height, diameters by their width."""
WALL = 0.014


def amphora(p):
    """An amphora: a body that narrows to a foot, a neck that widens to its mouth, a handle at either side."""
    edge = [(FLOOR + 0.02, p.foot_width), (FLOOR + 0.05, 0.26 * p.width)]
    foot = turned("foot", [(FLOOR, p.foot_width), *edge], sides=20)
    low = FLOOR + p.height - p.neck_height
    body = turned("body", scaled(URN, FLOOR + 0.05, low - FLOOR - 0.05, p.width), sides=24)
    rings = [(0, 0.46 * p.width), (0.2, p.neck_width), (0.7, p.neck_width), (0.9, p.rim_width), (1, p.rim_width)]
    neck = vessel("neck", [(low + up * p.neck_height, width) for up, width in rings], WALL)
    ends = (0.46 * p.neck_width, low + 0.56 * p.neck_height), (0.38 * p.width, low - 0.08)
    right = rod("handle_right", ear(*ends, p.handle_reach), p.handle_width)
    return body, foot, neck, right, mirrored(right, "handle_left")


def flowers(p):
    """A vase with three flowers in it."""
    profile = scaled(BELLY, FLOOR, p.height, p.width)
    found = [vessel("body", profile, WALL, 24)]
    rim = FLOOR + p.height
    for i, (at, up, share) in enumerate(((0, 0.8, 1), (2.1, 1, 0.85), (4.2, 0.9, 0.7)), 1):
        out, long = share * p.spread, up * p.stem_height
        path = [(0, rim - 0.4 * p.height, 1.57), (0.25 * out, rim, 1.3), (0.7 * out, rim + 0.5 * long, 1.2)]
        path.append((out, rim + long, 1.4))
        found.append(_flower(f"flower_{i}", p, out, rim + long, at))
        found.append(rod(f"stem_{i}", path, p.stem_width, at, sides=8))
    return found


def _flower(name, p, out, y, at):
    """Petals around a middle."""
    x, z = np.cos(at) * out, np.sin(at) * out
    middle = ball("", (x, y + 0.015, z), (0.3 * p.flower_width, 0.05, 0.3 * p.flower_width), 8, 6)
    return joined(name, middle, *(_petal(p, x, y, z, 2 * np.pi * k / PETALS) for k in range(PETALS)))


PETALS = 7


def _petal(p, x, y, z, turn):
    """From the middle of a flower outwards, and a little upwards."""
    c, s = np.cos(turn), np.sin(turn)
    rings = []
    for share, up, wide in ((0.16, 0.01, 0.12), (0.3, 0.02, 0.24), (0.42, 0.035, 0.22)):
        centre = (x + c * share * p.flower_width, y + up, z + s * share * p.flower_width)
        rings.append(Section(centre, (-s * wide * p.flower_width, 0, c * wide * p.flower_width), (0, 0.016, 0)))
    middle, end = Tip((x, y, z)), Tip((x + c * p.flower_width / 2, y + 0.045, z + s * p.flower_width / 2))
    return loft("", [middle, *rings, end], ellipse(8))


FAMILIES = (
    Rig(
        "vase/flowers",
        vase(height=(0.28, 0.5), width=(0.22, 0.42), stem_height=(0.26, 0.44), stem_width=(0.01, 0.024))
        + vase(spread=(0.12, 0.24), flower_width=(0.14, 0.28)),
        flowers,
        itself("body"),
    ),
    Rig(
        "vase/cactus",
        vase(
            height=(0.34, 0.46),
            width=(0.3, 0.42),
            foot_width=(0.22, 0.28),
            leg_height=(0.12, 0.18),
            leg_width=(0.03, 0.045),
        )
        + vase(cactus_height=(0.28, 0.46), cactus_width=(0.1, 0.15)),
        cactus,
        (
            *itself("body", "soil", "stem", "flower"),
            *(("leg_1", "leg_2"), ("leg_3", "leg_4"), ("stem_left", "stem_right")),
        ),
        (*stack("soil", "stem"), *(Contact(f"leg_{i}", "body", "face_y") for i in (1, 2, 3, 4))),
    ),
    Rig(
        "vase/amphora",
        vase(
            height=(0.66, 1.0),
            width=(0.36, 0.5),
            foot_width=(0.18, 0.28),
            neck_width=(0.12, 0.18),
            neck_height=(0.2, 0.28),
        )
        + vase(rim_width=(0.2, 0.3), handle_reach=(0.06, 0.12), handle_width=(0.025, 0.045)),
        amphora,
        (*itself("foot", "body", "neck"), ("handle_left", "handle_right")),
        stack("foot", "body", "neck"),
    ),
    Rig(
        "vase/leaves",
        vase(height=(0.22, 0.36), width=(0.28, 0.4), foot_width=(0.18, 0.26), saucer_width=(0.32, 0.42))
        + vase(leaf_height=(0.24, 0.5), leaf_reach=(0.16, 0.26), leaf_width=(0.06, 0.12)),
        leaves,
        (*itself("saucer", "body", "soil"), ("leaf_1", "leaf_2"), ("leaf_3", "leaf_4"), ("leaf_5", "leaf_6")),
    ),
    Rig(
        "vase/topiary",
        vase(height=(0.24, 0.36), width=(0.3, 0.42), foot_width=(0.2, 0.28), saucer_width=(0.34, 0.44))
        + vase(stem_height=(0.24, 0.42), stem_width=(0.02, 0.04), crown_width=(0.24, 0.44)),
        topiary,
        itself("saucer", "body", "soil", "stem", "crown"),
        stack("soil", "stem"),
    ),
)
