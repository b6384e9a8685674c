"""A sun lounger, whose back hangs on its frame and whose prop hangs on the back."""

from data_gen.families.chair.pieces import LEGS, MEANINGS, cushion, legs, strut
from data_gen.families.pieces.legs import carry
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.joint import hinge
from data_gen.part import box, ellipse, joined
from data_gen.rig import FLOOR, Parameter, Rig

LOUNGER = (
    *ranges(
        MEANINGS, seat_width=(0.3, 0.4), seat_height=(0.2, 0.3), seat_thickness=(0.04, 0.07), leg_size=(0.03, 0.05)
    ),
    Parameter("length", 0.84, 0.98, "edge along z where all lies flat"),
    Parameter("back_angle", 0.0, 1.15, "turn of the back out of the level of the seat", "rad"),
    Parameter("foot_angle", 0.0, 0.5, "turn of the footrest out of the level of the seat", "rad"),
)
RIGHT = (1.0, 0.0, 0.0)
"""The axis about which a positive angle lifts what points to the rear and lowers what points to the front."""
LAYER = 0.02
"""Between the rails and the cushions: where the battens lie, the hinges turn, and the prop is put away."""
RAIL = 0.035
"""Edge of a rail along y."""
HIP, KNEE = -0.06, 0.26
"""Where the back and the footrest hang, as shares of the length."""
PROP = 0.17
"""Length of the prop, and how far behind the hip it hangs, as shares of the length: so its foot stays on the rails."""


def lounger(p):
    """Cushions on two rails; the foot of the prop runs along the rails while the back turns."""
    rail, long = FLOOR + p.seat_height - p.seat_thickness - LAYER, p.length
    middle = rail + LAYER / 2
    hip, hung, knee = ((0, middle, share * long) for share in (HIP, HIP - PROP, KNEE))
    pillow = (0, rail + LAYER + p.seat_thickness + 0.014, -0.5 * long + 0.06)
    return (
        cushion("seat", *_span(p, rail, HIP, KNEE), corner=0.08),
        joined(
            "back", cushion("pad", *_span(p, rail, -0.5, HIP), corner=0.08), *_battens(p, middle, HIP - 1.8 * PROP, HIP)
        ),
        joined("footrest", cushion("pad", *_span(p, rail, KNEE, 0.5), corner=0.08), *_battens(p, middle, KNEE, 0.46)),
        cushion("headrest", pillow, (0.8 * p.seat_width, 0.028, 0.09), corner=0.2),
        _frame(p, rail),
        *_legs(p, rail - RAIL),
        _prop(p, middle),
        hinge("back_hinge", ("back", "headrest"), "frame", RIGHT, hip, p.back_angle),
        hinge("prop_hinge", ("prop",), "back", RIGHT, hung, -2 * p.back_angle),
        hinge("foot_hinge", ("footrest",), "frame", RIGHT, knee, p.foot_angle),
    )


def _span(p, rail, rear, front):
    """Centre and edges of a cushion between two shares of the length."""
    y, long = rail + LAYER + p.seat_thickness / 2, p.length
    return (0, y, (rear + front) / 2 * long), (p.seat_width, p.seat_thickness, (front - rear) * long - 0.006)


def _battens(p, y, rear, front):
    """Two battens below a cushion."""
    z, long = (rear + front) / 2 * p.length, (front - rear) * p.length
    return [box("batten", (side * 0.35 * p.seat_width, y, z), (0.02, LAYER, long)) for side in (-1, 1)]


def _frame(p, rail):
    """Two rails from the rear to the knee, and battens across them below the seat."""
    long = (KNEE + 0.47) * p.length
    z, x = (KNEE - 0.47) / 2 * p.length, p.seat_width / 2 - 0.014
    rails = [box("rail", (side * x, rail - RAIL / 2, z), (0.028, RAIL, long)) for side in (-1, 1)]
    wide = 2 * x + 0.028
    across = [
        box("batten", (0, rail + LAYER / 2, share * p.length), (wide, LAYER, 0.03)) for share in (-0.02, 0.1, 0.22)
    ]
    return joined("frame", *rails, *across)


def _legs(p, top):
    """Legs below the rails, which lean outwards along z."""
    x, low, high = p.seat_width / 2 - 0.014, [], []
    for foot, head in ((0.25, 0.2), (-0.42, -0.36)):
        for side in (1, -1):
            low.append((side * x, FLOOR, foot * p.length))
            high.append((side * x, top, head * p.length))
    return legs(zip(low, high, strict=True), p.leg_size, 0.8, ellipse(12))


def _prop(p, y):
    """Two arms and a rod across the rails: flat below the back where that is flat."""
    hung, foot = ((HIP - share * PROP) * p.length for share in (1, 2))
    size, rod = 2 * [(0.012, 0.012)], 2 * [(LAYER, LAYER)]
    arms = [
        strut("arm", (side * 0.2 * p.seat_width, y, foot), (side * 0.2 * p.seat_width, y, hung), *size, axis="z")
        for side in (-1, 1)
    ]
    ends = [
        strut("rod", (-wide * p.seat_width, y, z), (wide * p.seat_width, y, z), *rod, ellipse(12), "x")
        for wide, z in ((0.5, foot), (0.3, hung))
    ]
    return joined("prop", *arms, *ends)


FAMILIES = (
    Rig(
        "folding_chair/lounger",
        LOUNGER,
        lounger,
        (*itself("seat", "back", "footrest", "headrest", "frame", "prop"), *LEGS),
        (*carry("frame"), *stack("frame", "seat")),
    ),
)
