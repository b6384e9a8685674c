"""Swings: a bar on two pairs of splayed legs, and under it seats that swing about it."""

import numpy as np

from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.joint import hinge
from data_gen.part import box, cylinder, ellipse, joined, loft, prism, rounded, section
from data_gen.rig import FLOOR, Contact, Parameter, Rig

MEANINGS = {
    "width": "edge of the frame along x",
    "height": "from the floor to the upper side of the bar",
    "depth": "edge of the frame along z",
    "leg_width": "edge of a leg along x",
    "rope_length": "from the bar to the upper side of the seat",
    "seat_width": "edge of a seat along x",
    "seat_depth": "edge of a seat along z",
    "back_height": "from the upper side of the seat to the upper end of its back",
    "canopy_depth": "edge of the canopy along z",
}
BAR, ROPE, LEG, SEAT = 0.04, 0.014, 0.03, 0.026
"""Diameters of the bar and of a rope, edge of a leg along z, thickness of a seat."""
GABLE = np.array([(0.5, 0), (-0.2, 0.5), (-0.5, 0.5), (-0.5, -0.5), (-0.2, -0.5)])
"""The outline of a canopy, (y, z)."""
SIDES = {"left": -1, "right": 1}


def angle(name, low, high, meaning):
    """A parameter for a turn about the bar."""
    return Parameter(name, low, high, meaning, "rad")


def frame(p):
    """A bar on four legs, two at each end that meet below it, and a brace across each pair."""
    low = under(p)
    bar = cylinder("bar", (0, low + BAR / 2, 0), (p.width, BAR, BAR), "x", 16)
    feet = [(x, z) for z in (1, -1) for x in (1, -1)]
    legs = [leg(p, f"leg_{i}", x, z, low) for i, (x, z) in enumerate(feet, start=1)]
    return bar, *legs, *(brace(p, f"brace_{side}", x) for side, x in SIDES.items())


def under(p):
    """The height of the underside of the bar."""
    return FLOOR + p.height - BAR


def leg(p, name, x, z, top):
    """A leg from the corner of the frame to the underside of the bar, where it stands beside its partner."""
    x, size = x * (p.width - p.leg_width) / 2, (p.leg_width, LEG)
    ends = (x, FLOOR, z * (p.depth - LEG) / 2), (x, top, z * LEG / 2)
    return loft(name, [section("y", centre, size) for centre in ends])


def brace(p, name, x):
    """A bar across a pair of legs, at two fifths of their height."""
    y, length = FLOOR + 0.4 * (p.height - BAR), 0.6 * (p.depth - LEG)
    return box(name, (x * (p.width - p.leg_width) / 2, y, 0), (0.5 * p.leg_width, 0.025, length))


def rope(p, name, x, feet, low):
    """A rope, or two, from the bar down to a height, its feet at these z."""
    top = under(p)
    ends = [((x, top, 0), (x, low, z)) for z in feet]
    both = [loft("rope", [section("y", at, (ROPE, ROPE)) for at in pair], ellipse(8)) for pair in ends]
    return joined(name, *both)


def board(p, name, x):
    """A seat under the ends of its ropes, round in front and behind."""
    y = under(p) - p.rope_length - SEAT / 2
    return prism(name, (x, y, 0), (p.seat_width, SEAT, p.seat_depth), "x", rounded(0.3))


def swung(p, name, parts, x, turn):
    """The hinge of what hangs from the bar at x, and swings to the front."""
    return hinge(name, [part.name for part in parts], "bar", (-1, 0, 0), (x, under(p), 0), turn)


def single(p):
    """One seat on two ropes."""
    x, low = p.seat_width / 2 - 0.02, under(p) - p.rope_length
    hung = board(p, "seat", 0), *(rope(p, f"rope_{side}", s * x, [0], low) for side, s in SIDES.items())
    return *frame(p), *hung, swung(p, "seat_hinge", hung, x, p.seat_angle)


def double(p):
    """Two seats side by side, each on its own two ropes."""
    right = hung_at(p, "right", 0.23 * p.width, (3, 1), p.right_angle)
    left = hung_at(p, "left", -0.23 * p.width, (2, 4), p.left_angle)
    return *frame(p), *right, *left


def hung_at(p, side, x, numbers, turn):
    """A seat at x, its two ropes by number from left to right, and their hinge."""
    apart, low = p.seat_width / 2 - 0.02, under(p) - p.rope_length
    ropes = [rope(p, f"rope_{i}", x + s * apart, [0], low) for i, s in zip(numbers, (-1, 1), strict=True)]
    parts = board(p, f"seat_{side}", x), *ropes
    return *parts, swung(p, f"{side}_hinge", parts, x + apart, turn)


def bench(p):
    """A garden swing: a bench with a back and arms on slanted ropes, and a canopy that tips on the bar."""
    x, low, z = p.seat_width / 2 - 0.012, under(p) - p.rope_length, p.seat_depth / 2
    ends, size = [(0, low, 0.015 - z), (0, low + p.back_height, -0.025 - z)], (p.seat_width - 0.06, 0.03)
    back = loft("back", [section("y", end, size) for end in ends], rounded(0.2))
    arms = [arm(p, f"arm_{side}", s * x, low) for side, s in SIDES.items()]
    ropes = [rope(p, f"rope_{side}", s * x, [0.03 - z, z - 0.03], low) for side, s in SIDES.items()]
    parts = board(p, "seat", 0), back, *arms, *ropes
    return *frame(p), *canopy(p), *parts, swung(p, "seat_hinge", parts, x, p.seat_angle)


def arm(p, name, x, low):
    """An arm of a bench between its ropes."""
    size = (0.024, 0.02, 0.5 * p.seat_depth)
    post = box("post", (x, low + 0.035, -0.1 * p.seat_depth), (0.016, 0.07, 0.02))
    return joined(name, box("rest", (x, low + 0.08, 0), size), post)


def canopy(p):
    """A roof with a ridge along the bar, and the hinge on which it tips to the front."""
    low, height = under(p) + BAR, 0.07
    roof = prism("canopy", (0, low + height / 2, 0), (p.width, height, p.canopy_depth), "x", GABLE)
    return roof, hinge("canopy_hinge", ["canopy"], "bar", (1, 0, 0), (0, low, 0), p.canopy_angle)


RANGES = {
    "width": (0.52, 0.92),
    "height": (0.76, 0.97),
    "depth": (0.5, 0.75),
    "leg_width": (0.024, 0.056),
    "rope_length": (0.4, 0.62),
    "seat_width": (0.2, 0.36),
    "seat_depth": (0.1, 0.2),
}
PLAIN = ranges(MEANINGS, **RANGES)
DOUBLE = ranges(MEANINGS, **RANGES | {"width": (0.78, 0.96), "seat_width": (0.2, 0.28)})
WIDE = {"width": (0.78, 0.92), "height": (0.74, 0.88), "seat_width": (0.4, 0.6), "seat_depth": (0.18, 0.3)}
MORE = {"rope_length": (0.38, 0.52), "back_height": (0.14, 0.24), "canopy_depth": (0.36, 0.6)}
BENCH = ranges(MEANINGS, **RANGES | WIDE | MORE)
SEAT_ANGLE = "turn of the seat to the front, 0 where it hangs"
MIDDLE = (*itself("bar"), ("leg_1", "leg_2"), ("leg_3", "leg_4"), ("brace_left", "brace_right"))
ON_LEGS = tuple(Contact(f"leg_{i}", "bar", "face_y") for i in (1, 2, 3, 4))
HUNG = (*itself("seat"), ("rope_left", "rope_right"))
ROPED = (*stack("seat", "rope_left", "bar"), *stack("seat", "rope_right", "bar"))
TWO = (("left", 2), ("left", 4), ("right", 1), ("right", 3))
TWO_ROPED = tuple(one for side, i in TWO for one in stack(f"seat_{side}", f"rope_{i}", "bar"))
FAMILIES = (
    Rig(
        "swing/single",
        (*PLAIN, angle("seat_angle", -0.65, 0.65, SEAT_ANGLE)),
        single,
        (*MIDDLE, *HUNG),
        (*ON_LEGS, *ROPED),
    ),
    Rig(
        "swing/double",
        (
            *DOUBLE,
            angle("left_angle", -0.65, 0.65, "turn of the left seat to the front, 0 where it hangs"),
            angle("right_angle", -0.65, 0.65, "turn of the right seat to the front, 0 where it hangs"),
        ),
        double,
        (*MIDDLE, ("seat_left", "seat_right"), ("rope_1", "rope_2"), ("rope_3", "rope_4")),
        (*ON_LEGS, *TWO_ROPED),
    ),
    Rig(
        "swing/bench",
        (
            *BENCH,
            angle("seat_angle", -0.4, 0.4, SEAT_ANGLE),
            angle("canopy_angle", -0.3, 0.3, "turn of the canopy to the front, 0 where it lies level"),
        ),
        bench,
        (*MIDDLE, *HUNG, ("arm_left", "arm_right"), *itself("back", "canopy")),
        (
            *ON_LEGS,
            *ROPED,
            *stack("bar", "canopy"),
            *(Contact("seat", part, "face_y") for part in ("back", "arm_left", "arm_right")),
        ),
    ),
)
