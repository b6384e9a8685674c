"""What bottles are made of: their parameters, round bodies, and paper around them."""

from functools import partial

from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import open_ring, quarter, turned
from data_gen.part import cylinder
from data_gen.rig import FLOOR

bottle = partial(
    ranges,
    {
        "width": "diameter of the body, or its edge along x",
        "depth": "edge of the body along z",
        "body_height": "from the floor to the upper end of the body",
        "shoulder_height": "from where the body narrows to its upper end",
        "neck_width": "diameter of the neck at its upper end",
        "neck_height": "edge of the neck along y",
        "cap_width": "diameter of the cap",
        "cap_height": "edge of the cap along y",
        "label_height": "edge of the label along y",
        "handle_reach": "how far the handle stands out from where it is fixed",
        "handle_width": "thickness of the handle",
        "spout_length": "from the axis to the end of the spout",
        "pump_height": "from the cap to the upper side of the pump",
        "teat_height": "edge of the teat along y",
    },
)
ROUND = 28
"""Sides of what is round."""
EDGE = 0.025
"""Radius of the lower edge of a body."""
THIN = 0.004
"""Thickness of a label."""


def body_of(p, top_width):
    """A round body: its lower edge rounded, its sides upright, its shoulder round up to the neck."""
    low = reversed(quarter((FLOOR + EDGE, p.width), (FLOOR, 0.86 * p.width), 3))
    top = FLOOR + p.body_height
    return turned("body", [*low, *quarter((top - p.shoulder_height, p.width), (top, top_width), 5)], sides=ROUND)


def neck_of(p, low_width=None):
    """A neck on the body, as wide at its lower end as is said there."""
    low, width = FLOOR + p.body_height, p.neck_width
    return turned("neck", [(low, width if low_width is None else low_width), (low + p.neck_height, width)], sides=ROUND)


def label_of(p, share=0.5):
    """A paper band around the upright part of a round body, some way up."""
    middle = FLOOR + EDGE + share * (p.body_height - p.shoulder_height - EDGE)
    ends = [(middle + sign * p.label_height / 2, p.width + 2 * THIN) for sign in (-1, 1)]
    return open_ring("label", ends, THIN, sides=ROUND)


def cap_of(p, low):
    """A screw cap whose upper edge is rounded."""
    high, width = low + p.cap_height, p.cap_width
    return turned("cap", [(low, width), *quarter((high - 0.012, width), (high, 0.86 * width), 3)], sides=ROUND)


def stub(name, low, high, width):
    """A short upright cylinder."""
    return cylinder(name, (0, (low + high) / 2, 0), (width, high - low, width))
