"""What lamps are made of: their parameters, feet, bulbs and shades, all of it hollow where light comes out."""

from functools import partial

from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import open_ring, quarter, turned
from data_gen.part import ball, box, cylinder, joined
from data_gen.rig import FLOOR

CEILING = -FLOOR
WALL = 0.008
"""Thickness of a shade."""
HELD = 0.35
"""How far up a shade the bars are that hold it, as a share of its height."""
BAR = 0.006
BULB = ((0, 0.45), (0.25, 0.45), (0.33, 0.55), (0.48, 0.86), (0.64, 1.0), (0.8, 0.9), (0.93, 0.55), (1, 0))
GLOBE = ((0, 0), (0.05, 0.44), (0.15, 0.71), (0.3, 0.92), (0.5, 1), (0.7, 0.92), (0.85, 0.71), (0.94, 0.47))
LONG = 1.5
"""Length of a bulb by its width."""

lamp = partial(
    ranges,
    {
        "height": "from the floor to the upper end",
        "cord_length": "edge of the cord along y",
        "cord_1_length": "edge of the first cord along y",
        "cord_2_length": "edge of the second cord along y",
        "cord_3_length": "edge of the third cord along y",
        "base_width": "diameter of the base",
        "base_height": "edge of the base along y",
        "body_width": "diameter of the body at its widest",
        "body_height": "edge of the body along y",
        "pole_width": "diameter of the pole at its lower end",
        "shade_width": "diameter of the shade at its widest",
        "shade_top": "diameter of the shade at its upper end",
        "shade_height": "edge of the shade along y",
        "shade_length": "edge of the shade along x",
        "bulb_width": "diameter of the bulb",
        "leg_width": "diameter of a leg at its upper end",
        "spread": "from the axis to the middle of a foot or a shade",
        "reach": "from the base to the middle of the shade, along x",
        "arm_length": "from the axis to the middle of the candle on an arm",
        "arm_sag": "from the ends of an arm down to its lowest point",
        "candle_height": "edge of a candle along y, without its flame",
        "bar_length": "edge of the bar along x",
        "roof_height": "edge of the roof along y",
        "canopy_width": "diameter of the canopy, or its edge along x",
    },
)


def foot(p, x=0):
    """A round base on the floor whose upper edge is rounded."""
    low, width = FLOOR, p.base_width
    profile = [(low, width), (low + 0.5 * p.base_height, width), (low + 0.85 * p.base_height, 0.96 * width)]
    return turned("base", [*profile, (low + p.base_height, 0.86 * width)], x, sides=32)


def pole(p, low, high, x=0):
    """A round pole between two heights."""
    return cylinder("pole", (x, (low + high) / 2, 0), (p.pole_width, high - low, p.pole_width), sides=12)


def bulb(name, y, width):
    """A bulb that stands on the axis and whose socket begins at a height."""
    return turned(name, [(y + LONG * share * width, d * width) for share, d in BULB])


def hung(name, high, rim, width, x=0):
    """A round bulb on a stem from a height down to the rim of a shade, below which most of it looks out."""
    low = rim - 0.75 * width
    profile = [(low + share * width, d * width) for share, d in GLOBE]
    return turned(name, [*profile, (low + 0.98 * width, 0.024), (high, 0.024)], x, sides=16)


def cone_shade(p, bottom, x=0):
    """A cone open at both ends, held from within by two bars that lie on a pole at `holder(p, bottom)`."""
    skin = open_ring("", [(bottom, p.shade_width), (bottom + p.shade_height, p.shade_top)], WALL, x, sides=32)
    inner = (1 - HELD) * p.shade_width + HELD * p.shade_top - WALL
    y = holder(p, bottom) - BAR / 2
    return joined("shade", skin, box("", (x, y, 0), (inner, BAR, BAR)), box("", (x, y, 0), (BAR, BAR, inner)))


def holder(p, bottom):
    """The height of the upper side of the bars of a cone shade: where its pole ends and its bulb begins."""
    return bottom + HELD * p.shade_height


def bell(name, bottom, p, x=0):
    """A shade that falls like a bell from its upper end to its edge, open at both."""
    high, narrow = bottom + p.shade_height, p.shade_top
    skirt = quarter((bottom + 0.12 * p.shade_height, 0.96 * p.shade_width), (high, narrow), 8)
    return open_ring(name, [(bottom, p.shade_width), *skirt], WALL, x, sides=32)


def canopy(p):
    """The round plate under the ceiling that a lamp hangs from; CANOPY is its height."""
    low, width = CEILING - CANOPY, p.canopy_width
    return turned("canopy", [(low, 0.35 * width), (low + CANOPY / 3, 0.9 * width), (CEILING, width)], sides=20)


CANOPY = 0.03


def cord(name, low, high, x=0, z=0):
    """A cord between two heights."""
    return cylinder(name, (x, (low + high) / 2, z), (CORD, high - low, CORD), sides=8)


CORD = 0.008


def chain(low, high, x):
    """A chain to switch a lamp with: a cord with a ball at its lower end."""
    return joined("chain", cord("", low, high, x), ball("", (x, low, 0), (0.024, 0.024, 0.024), 12, 6))
