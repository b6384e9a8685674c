"""Desk lamps: an arm on an arm, a head on the second, all of them on hinges. At rest they stand straight up."""

from functools import partial

from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import quarter, turned
from data_gen.joint import hinge
from data_gen.part import ball, box, cylinder, joined
from data_gen.rig import FLOOR, Contact, Parameter, Rig

lengths = partial(
    ranges,
    {
        "base_width": "diameter of the base",
        "base_height": "edge of the base along y, up to where its bracket or post begins",
        "arm_1_length": "between the hinges of the lower arm",
        "arm_2_length": "between the hinges of the upper arm",
        "arm_width": "thickness of an arm",
        "head_width": "diameter of the head's opening",
        "head_length": "from the head's hinge to its opening",
    },
)
LENGTHS = lengths(
    base_width=(0.2, 0.3),
    base_height=(0.02, 0.045),
    arm_1_length=(0.34, 0.42),
    arm_2_length=(0.32, 0.4),
    arm_width=(0.024, 0.036),
    head_width=(0.16, 0.24),
    head_length=(0.15, 0.21),
)
ANGLES = (
    Parameter("arm_1_angle", -0.15, 0.4, "turn of the lower arm towards -x, 0 where it is upright", "rad"),
    Parameter("arm_2_angle", -1.7, -1.1, "turn of the upper arm towards -x, 0 where it prolongs the lower", "rad"),
    Parameter("head_angle", -1.5, -1.0, "turn of the head towards -x, 0 where it looks along the upper arm", "rad"),
)
TURN = (Parameter("post_angle", -0.7, 0.7, "turn of the post about the vertical", "rad"),)
X, UP, SIDE, WALL = -0.2, 0.055, 0.009, 0.008
"""Where the base stands, how far above it the first hinge is, thickness of a fork's prongs and of the head."""
Z = (0, 0, 1)
BELL = ((0.1, 0.2), (0.16, 0.36), (0.4, 0.42), (0.5, 0.56))
"""A head up to where it opens into a cone: distances from its hinge by its length, diameters by its width."""


def bracket(p):
    """A desk lamp: a bar of an arm between two cheeks on the base, a fork on it, a cone of a head in the fork."""
    low = FLOOR + p.base_height
    base = joined("base", _foot(p), *_prongs(p, low, low + UP + 0.02, 1.6), _pin(p, low + UP))
    y_1, y_2, y_3 = _hinges(p)
    head = joined("head", _knuckle(p, y_3), _cone(p, y_3))
    return base, _bar("arm_1", p, y_1, y_2), _fork("arm_2", p, y_2, y_3), head, _light(p, y_3), *_hung(p, "base", ())


def balanced(p):
    """A desk lamp on a post that turns: a fork on it, a bar in the fork with a weight behind, a dome of a head."""
    low = FLOOR + p.base_height
    y_1, y_2, y_3 = _hinges(p)
    stub = turned("", [(low, 0.07), (low + 0.012, 0.07), (low + 0.02, 0.035), (y_1, 0.02)], X)
    post = joined("post", stub, _knuckle(p, y_1))
    arm = joined(
        "arm_2", _bar("", p, y_2, y_3), cylinder("", (X, y_2 - BEHIND / 2, 0), (0.016, BEHIND, 0.016), sides=8)
    )
    weight = cylinder("weight", (X, y_2 - BEHIND - 0.025, 0), (0.06, 0.05, 0.06))
    prongs = _prongs(p, y_3 - 0.5 * p.arm_width, y_3 + 0.33 * p.head_length, 1.2)
    head = joined("head", *prongs, _pin(p, y_3), _dome(p, y_3))
    turn = hinge("post_turn", ["post"], "base", (0, 1, 0), (X, low, 0), p.post_angle)
    parts = _foot(p), post, _fork("arm_1", p, y_1, y_2), arm, weight, head, _light(p, y_3)
    return *parts, turn, *_hung(p, "post", ("weight",))


BEHIND = 0.08


def _hinges(p):
    """The heights of the three hinges at rest."""
    first = FLOOR + p.base_height + UP
    return first, first + p.arm_1_length, first + p.arm_1_length + p.arm_2_length


def _hung(p, on, weights):
    """The three hinges: the lower arm on the base or post, the upper arm on it, the head and its bulb on that."""
    first, second, third = ((X, y, 0) for y in _hinges(p))
    return (
        hinge("arm_1_hinge", ["arm_1"], on, Z, first, p.arm_1_angle),
        hinge("arm_2_hinge", ["arm_2", *weights], "arm_1", Z, second, p.arm_2_angle),
        hinge("head_hinge", ["head", "bulb"], "arm_2", Z, third, p.head_angle),
    )


def _foot(p):
    low, high, width = FLOOR, FLOOR + p.base_height, p.base_width
    return turned("base", [(low, width), *quarter((high - 0.012, width), (high, 0.88 * width), 3)], X, sides=24)


def _knuckle(p, y):
    """The round end of a bar about its hinge."""
    return cylinder("", (X, y, 0), (1.6 * p.arm_width, 1.6 * p.arm_width, p.arm_width), "z", 12)


def _bar(name, p, low, high):
    """An arm with a round end about each of its hinges."""
    middle = box("", (X, (low + high) / 2, 0), (p.arm_width, high - low, 0.8 * p.arm_width))
    return joined(name, _knuckle(p, low), middle, _knuckle(p, high))


def _prongs(p, low, high, width):
    """Two plates beside a bar, `width` times as wide as the bar."""
    side, wide = (p.arm_width + SIDE) / 2, width * p.arm_width
    return [box("", (X, (low + high) / 2, sign * side), (wide, high - low, SIDE)) for sign in (-1, 1)]


def _fork(name, p, low, high):
    """An arm of two plates beside the bars that it joins, with a pin through each hinge."""
    return joined(name, *_prongs(p, low, high, 0.7), _pin(p, low), _pin(p, high))


def _pin(p, y):
    """A pin through a hinge that stands out at both sides."""
    return cylinder("", (X, y, 0), (0.7 * p.arm_width, 0.7 * p.arm_width, p.arm_width + 4 * SIDE), "z", 12)


def _cone(p, y):
    """A head that opens upwards at rest: a socket that widens into a cone."""
    outside = [(y + up * p.head_length, d * p.head_width) for up, d in (*BELL, (1, 1))]
    inside = [(y + p.head_length, p.head_width - 2 * WALL), (y + 0.55 * p.head_length, 0.5 * p.head_width)]
    return turned("", [*outside, *inside], X, sides=28)


def _dome(p, y):
    """A head that opens upwards at rest: half an egg."""
    low, high = y + 0.3 * p.head_length, y + p.head_length
    outside = quarter((high, p.head_width), (low, 0.3 * p.head_width), 7)
    inside = quarter((high, p.head_width - 2 * WALL), (low + WALL, 0.2 * p.head_width), 7)
    return turned("", [*reversed(outside), *inside], X, sides=28)


def _light(p, y):
    low, size = y + 0.5 * p.head_length, 0.42 * p.head_width
    return ball("bulb", (X, low + 0.3 * p.head_length, 0), (size, 0.6 * p.head_length, size), 12, 8)


FAMILIES = (
    Rig("desk_lamp/bracket", LENGTHS + ANGLES, bracket),
    Rig("desk_lamp/balanced", LENGTHS + TURN + ANGLES, balanced, contacts=(Contact("base", "post", "face_y"),)),
)
