"""Mugs and what else one drinks from: cup, beer mug, wine glass; and a teapot to pour from."""

from functools import partial

import numpy as np

from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import content, ear, quarter, rod, scaled, turned, vessel
from data_gen.part import ball, cylinder, joined
from data_gen.rig import FLOOR, Contact, Rig

mug = partial(
    ranges,
    {
        "height": "from the floor to the rim",
        "width": "diameter of the body at its widest",
        "foot_width": "diameter of what it stands on",
        "foot_height": "edge of the foot along y",
        "wall": "thickness of the wall",
        "handle_reach": "how far the handle stands out from where it is fixed",
        "handle_width": "thickness of the handle",
        "saucer_width": "diameter of the saucer",
        "stem_height": "edge of the stem along y",
        "stem_width": "diameter of the stem at its thinnest",
        "foam_height": "from the rim to the upper end of the foam",
        "spout_length": "how far the spout stands out from the body",
        "lid_width": "diameter of the lid",
        "lid_height": "edge of the lid along y, without its knob",
        "knob_width": "diameter of the knob",
    },
)
CUP = ((0, 0.48), (0.06, 0.5), (0.14, 0.64), (0.3, 0.8), (0.5, 0.91), (0.75, 0.97), (1, 1))
TULIP = ((0, 0.14), (0.02, 0.28), (0.05, 0.42), (0.09, 0.56), (0.14, 0.68), (0.2, 0.79), (0.28, 0.9))
TULIP += ((0.36, 0.97), (0.45, 1), (0.55, 0.995), (0.66, 0.975), (0.78, 0.945), (0.9, 0.905), (1, 0.86))
POT = ((0, 0.5), (0.04, 0.56), (0.09, 0.69), (0.15, 0.8), (0.22, 0.89), (0.3, 0.96), (0.37, 0.99), (0.44, 1))
POT += ((0.51, 0.99), (0.59, 0.96), (0.67, 0.915), (0.74, 0.86), (0.81, 0.785), (0.88, 0.69), (0.94, 0.59), (1, 0.48))
"""Outlines of bodies: heights by their height, diameters by their width."""
DISH = 0.035
"""Height of a saucer."""


def plain(p):
    """A mug: a tapered body with a handle like an ear, and a drink in it."""
    rings = [(0, p.foot_width - 0.02), (0.04, p.foot_width), (0.8, 0.2 * p.foot_width + 0.8 * p.width), (1, p.width)]
    profile = [(FLOOR + up * p.height, width) for up, width in rings]
    ends = [((1 - s) * p.foot_width / 2 + s * p.width / 2 - p.wall / 2, FLOOR + s * p.height) for s in (0.84, 0.22)]
    handle = rod("handle", ear(*ends, p.handle_reach), p.handle_width)
    return vessel("body", profile, p.wall, 24), handle, content("drink", profile, p.wall, 2, 24)


def saucer(p):
    """A cup on a saucer, with a spoon."""
    low, high, wide = FLOOR + 0.4 * DISH, FLOOR + DISH, p.saucer_width
    dish = turned(
        "saucer", [(FLOOR, 0.5 * wide), (high, wide), (high + 0.008, 0.98 * wide), (low, 0.46 * wide)], sides=32
    )
    profile = scaled(CUP, low, p.height - 0.4 * DISH, p.width)
    ends = (0.47 * p.width, low + 0.84 * p.height), (0.4 * p.width, low + 0.26 * p.height)
    handle = rod("handle", ear(*ends, p.handle_reach), p.handle_width)
    y, z = high + 0.008, 0.39 * wide
    bowl = ball("", (-0.14, y, z), (0.1, 0.022, 0.07), 12, 6)
    spoon = joined("spoon", bowl, cylinder("", (0.03, y, z), (0.26, 0.014, 0.018), "x", 8))
    return vessel("body", profile, p.wall, 24), handle, content("drink", profile, p.wall, 5, 24), dish, spoon


def beer(p):
    """A beer mug: a heavy glass with a large handle, and foam over its rim."""
    low, rim = FLOOR + p.foot_height, FLOOR + p.height
    foot = turned("foot", scaled(((0, 1.04), (0.7, 1.06), (1, 0.96)), FLOOR, p.foot_height, p.width), sides=24)
    body = turned("body", [(low, 0.94 * p.width), (rim, p.width)], sides=24)
    ends = (0.48 * p.width, rim - 0.12 * p.height), (0.47 * p.width, FLOOR + 0.24 * p.height)
    handle = rod("handle", ear(*ends, p.handle_reach), p.handle_width)
    shares = ((0, 0.96), (0.1, 1.06), (0.4, 1.08), (0.6, 0.94), (0.72, 0.6), (0.78, 0))
    mound = turned("", scaled(shares, rim, p.foam_height, p.width), sides=24)
    blobs = [(0.28, 0.16, 0.44), (-0.1, 0.3, 0.5), (-0.3, -0.08, 0.42), (0.06, -0.24, 0.5)]
    blobs = [_blob(p, rim, x, z, size) for x, z, size in blobs]
    return body, handle, joined("foam", mound, *blobs), foot


def _blob(p, y, x, z, size):
    centre = (x * p.width, y + 0.6 * p.foam_height, z * p.width)
    return ball("", centre, (size * p.width, 0.8 * p.foam_height, size * p.width), 12, 6)


def goblet(p):
    """A wine glass: a bowl like a tulip on a stem, half full."""
    plate, low = FLOOR + 0.03, FLOOR + 0.03 + p.stem_height
    shares = ((0, 1), (0.25, 1), (0.5, 0.5), (1, 0.14))
    foot = turned("foot", scaled(shares, FLOOR, 0.03, p.foot_width), sides=24)
    ends = (plate, 0.14 * p.foot_width), (plate + 0.2 * p.stem_height, p.stem_width)
    stem = turned("stem", [*ends, (plate + 0.8 * p.stem_height, p.stem_width), (low, 0.14 * p.width)], sides=12)
    profile = scaled(TULIP, low, FLOOR + p.height - low, p.width)
    return vessel("body", profile, p.wall, 24), content("drink", profile, p.wall, 11, 24), stem, foot


def teapot(p):
    """A teapot: a round body with a spout to the left and a handle to the right, its lid with a knob."""
    profile, rim = scaled(POT, FLOOR, p.height, p.width), FLOOR + p.height
    lid = turned(
        "lid", [(rim, p.lid_width), *quarter((rim + 0.01, p.lid_width), (rim + p.lid_height, 0.03), 5)], sides=24
    )
    middle = rim + p.lid_height + p.knob_width / 2
    knob = ball("knob", (0, middle, 0), (p.knob_width,) * 3, 16, 8)
    ends = (0.42 * p.width, FLOOR + 0.82 * p.height), (0.45 * p.width, FLOOR + 0.26 * p.height)
    handle = rod("handle", ear(*ends, p.handle_reach), p.handle_width)
    return turned("body", profile, sides=24), handle, lid, knob, _spout(p)


def _spout(p):
    """A spout that leaves the body level, turns up, and narrows."""
    points = ((0.0, 0.26, 0.3, 0.3), (0.25, 0.34, 0.6, 0.24), (0.5, 0.48, 0.95, 0.17), (0.72, 0.68, 1.05, 0.13))
    points = (*points, (0.88, 0.86, 0.95, 0.1), (1, 0.96, 0.8, 0.09))
    start, reach = 0.44 * p.width, p.spout_length + 0.06 * p.width
    path = [(start + out * reach, FLOOR + up * p.height, lean) for out, up, lean, _ in points]
    return rod("spout", path, [width * p.height for *_, width in points], around=np.pi, sides=12)


FAMILIES = (
    Rig(
        "mug/plain",
        mug(height=(0.4, 0.58), width=(0.36, 0.5), foot_width=(0.3, 0.44), wall=(0.014, 0.04))
        + mug(handle_reach=(0.12, 0.18), handle_width=(0.035, 0.06)),
        plain,
        itself("body", "drink"),
    ),
    Rig(
        "mug/saucer",
        mug(height=(0.22, 0.4), width=(0.34, 0.5), wall=(0.012, 0.03), saucer_width=(0.66, 0.9))
        + mug(handle_reach=(0.08, 0.15), handle_width=(0.022, 0.045)),
        saucer,
        itself("saucer", "body", "drink"),
    ),
    Rig(
        "mug/beer",
        mug(height=(0.5, 0.76), width=(0.32, 0.48), foot_height=(0.03, 0.1), foam_height=(0.08, 0.18))
        + mug(handle_reach=(0.12, 0.22), handle_width=(0.045, 0.085)),
        beer,
        itself("foot", "body"),
        (*stack("foot", "body"), Contact("body", "foam", "face_y")),
    ),
    Rig(
        "mug/goblet",
        mug(height=(0.72, 0.94), width=(0.34, 0.46), foot_width=(0.26, 0.44), wall=(0.008, 0.022))
        + mug(stem_height=(0.2, 0.46), stem_width=(0.02, 0.05)),
        goblet,
        itself("foot", "stem", "body", "drink"),
        stack("foot", "stem", "body"),
    ),
    Rig(
        "mug/teapot",
        mug(
            height=(0.32, 0.56),
            width=(0.4, 0.54),
            lid_width=(0.2, 0.29),
            lid_height=(0.03, 0.07),
            knob_width=(0.05, 0.09),
        )
        + mug(handle_reach=(0.13, 0.18), handle_width=(0.035, 0.055), spout_length=(0.14, 0.2)),
        teapot,
        itself("body", "lid", "knob"),
        stack("body", "lid", "knob"),
    ),
)
