"""Sofas that reach out into the room: with a chaise, with an ottoman, with footrests."""

from data_gen.families.pieces.feet import SYMMETRIC
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between, soft, tilted
from data_gen.families.sofa.parts import (
    APRON,
    ARMS,
    FRAME,
    LEGS,
    MEANINGS,
    MIDDLE,
    PILLOWS,
    WITH_ARMS,
    arms,
    back,
    base,
    behind,
    beside,
    block_feet,
    cushions,
    half_seat,
    on_base,
    seats,
    under_arms,
)
from data_gen.part import RECTANGLE, box, cylinder, joined, loft, mirrored, moved, section
from data_gen.rig import FLOOR, Contact, Rig

BACKWARDS = -0.14
"""How far behind the middle these sofas stand, to have room in front."""
FOOT = 0.035
"""Edge of a square foot."""
PADS = ((0.04, 0.48), (0.52, 0.96))
"""The pads of a reclining back, as shares of its height."""


def chaise(p):
    """A sofa whose seat on the right reaches far forward."""
    half = half_seat(p)
    x = (-half, half - p.chaise_width)
    found = [base(p, (-half, half)), *seats(p, x, 1), _long_seat(p), back(p, (-half, half)), *arms(p), _chaise(p)]
    found += [*block_feet(p), *_chaise_feet(p), *cushions(p, x, 2), *cushions(p, (x[1], half), 1, first=3)]
    return [moved(part, by=(0, 0, BACKWARDS)) for part in found]


def _long_seat(p):
    """The cushion from the back to the front end of the chaise."""
    x, height = (half_seat(p) - p.chaise_width, half_seat(p)), (p.seat_height - p.seat_thickness, p.seat_height)
    return soft("seat_2", *between(x, height, (p.back_thickness - p.depth / 2, p.depth / 2 + p.chaise_depth)))


def _chaise(p):
    """The part of the base that reaches out."""
    x, height = (half_seat(p) - p.chaise_width, half_seat(p)), (p.leg_height, p.seat_height - p.seat_thickness)
    front = p.depth / 2 - APRON
    return soft("chaise", *between(x, height, (front, front + p.chaise_depth)), radius=0.01)


def _chaise_feet(p):
    """Two more square feet under the front of the chaise."""
    z, low, high = p.depth / 2 + p.chaise_depth - 0.04, FLOOR, FLOOR + p.leg_height
    places = {"leg_5": half_seat(p) - 0.03, "leg_6": half_seat(p) - p.chaise_width + 0.03}
    sizes = ((low, FOOT / 2), (high, FOOT))
    return [loft(name, [section("y", (x, y, z), (a, a)) for y, a in sizes], RECTANGLE) for name, x in places.items()]


def ottoman(p):
    """A sofa for two and an ottoman in front of it."""
    x = (-half_seat(p), half_seat(p))
    found = [base(p, x), *seats(p, x, 2), back(p, x), *arms(p), *block_feet(p), *cushions(p, x, 2), _ottoman(p)]
    return [moved(part, by=(0, 0, BACKWARDS)) for part in found]


def _ottoman(p):
    """A cushion on a box on four feet, as high as the seat."""
    near, half = p.depth / 2 + 0.1, p.ottoman_width / 2
    x, z, level = (-half, half), (near, near + p.ottoman_depth), p.seat_height - p.seat_thickness
    pad = soft("pad", *between(x, (level, p.seat_height), z))
    body = soft(
        "body", *between((x[0] + 0.008, x[1] - 0.008), (p.leg_height, level), (z[0] + 0.008, z[1] - 0.008)), 0.01
    )
    spots = [(sx, sz) for sx in (x[0] + 0.015, x[1] - 0.05) for sz in (z[0] + 0.015, z[1] - 0.05)]
    feet = [box("foot", *between((a, a + FOOT), (0, p.leg_height), (b, b + FOOT))) for a, b in spots]
    return joined("ottoman", body, pad, *feet)


def recliner(p):
    """Two armchairs of a home cinema with a console between them, their footrests out."""
    half, level, z = half_seat(p), p.seat_height - p.seat_thickness, (-p.depth / 2, p.depth / 2)
    places = {1: (-half, -p.console_width / 2), 2: (p.console_width / 2, half)}
    right = soft("arm_right", *between((half, p.width / 2), (0, p.seat_height + p.arm_height), z), radius=0.027)
    return (
        soft("base", *between((-half, half), (0, level), (z[0], z[1] - APRON)), radius=0.01),
        *(soft(f"seat_{i}", *between(x, (level, p.seat_height), z), radius=0.024) for i, x in places.items()),
        *(_padded_back(p, f"back_{i}", x) for i, x in places.items()),
        mirrored(right, "arm_left"),
        right,
        _console(p, level),
        *(_footrest(p, f"footrest_{i}", x) for i, x in places.items()),
    )


def _padded_back(p, name, x):
    """A back that leans, with a pad for the loins and one for the head."""
    rear, front = -p.depth / 2, p.back_thickness - p.depth / 2
    plate = soft("plate", *between(x, (p.seat_height, p.seat_height + p.back_height), (rear, front)), radius=0.024)
    wide, deep = (x[0] + 0.012, x[1] - 0.012), (front - 0.03, front + 0.022)
    heights = [(p.seat_height + low * p.back_height, p.seat_height + high * p.back_height) for low, high in PADS]
    pads = [soft("pad", *between(wide, height, deep)) for height in heights]
    return tilted(joined(name, plate, *pads), p.seat_height, 0.2)


def _console(p, level):
    """A block between the seats with two cups' places."""
    half, top = p.console_width / 2, p.seat_height + 0.5 * p.arm_height
    block = soft("block", *between((-half, half), (level, top), (-p.depth / 2, p.depth / 2)), radius=0.012)
    places = [(0.1 * p.depth, 0.1 * p.depth + 0.055), (0.28 * p.depth, 0.28 * p.depth + 0.055)]
    rings = [cylinder("cup", *between((-0.0275, 0.0275), (top - 0.01, top + 0.006), z), sides=16) for z in places]
    return joined("console", block, *rings)


def _footrest(p, name, x):
    """A pad in front of a seat, and the two struts that carry it."""
    z, top = (p.depth / 2, p.depth / 2 + p.footrest_out), p.seat_height - 0.005
    pad = soft("pad", *between((x[0] + 0.01, x[1] - 0.01), (top - 0.045, top), z))
    struts = []
    for at in (x[0] + 0.04, x[1] - 0.04):
        rear, front = (at, FLOOR + p.seat_height - 0.12, z[0] - APRON - 0.004), (at, FLOOR + top - 0.04, z[1] - 0.02)
        struts.append(loft("strut", [section("z", end, (0.012, 0.018)) for end in (rear, front)], RECTANGLE))
    return joined(name, pad, *struts)


PAIRS = (("seat_1", "seat_2"), ("back_1", "back_2"), ("footrest_1", "footrest_2"))
FAMILIES = (
    Rig(
        "sofa/chaise",
        ranges(
            MEANINGS,
            width=(0.82, 1.0),
            **FRAME,
            **ARMS,
            **LEGS,
            **PILLOWS,
            chaise_width=(0.22, 0.3),
            chaise_depth=(0.2, 0.34),
        ),
        chaise,
        (*WITH_ARMS, *SYMMETRIC),
        (
            *beside("base"),
            *on_base("seat_1", "seat_2", "back"),
            *behind("seat_1", "seat_2"),
            *under_arms(),
            Contact("base", "chaise", "face_z"),
            Contact("chaise", "seat_2", "face_y"),
            Contact("seat_1", "seat_2", "face_x"),
            Contact("leg_5", "chaise", "face_y"),
            Contact("leg_6", "chaise", "face_y"),
        ),
    ),
    Rig(
        "sofa/ottoman",
        ranges(
            MEANINGS,
            width=(0.62, 0.84),
            **FRAME,
            **ARMS,
            **LEGS,
            **PILLOWS,
            ottoman_width=(0.2, 0.4),
            ottoman_depth=(0.16, 0.26),
        ),
        ottoman,
        (*WITH_ARMS, ("seat_1", "seat_2"), ("cushion_1", "cushion_2"), *itself("ottoman"), *SYMMETRIC),
        (*beside("base"), *on_base("seat_1", "seat_2", "back"), *behind("seat_1", "seat_2"), *under_arms()),
    ),
    Rig(
        "sofa/recliner",
        ranges(MEANINGS, width=(0.74, 0.94), **FRAME, **ARMS, console_width=(0.08, 0.14), footrest_out=(0.06, 0.16)),
        recliner,
        (MIDDLE[0], WITH_ARMS[2], *PAIRS, *itself("console")),
        (
            *beside("base"),
            *on_base("seat_1", "seat_2", "console"),
            Contact("seat_1", "console", "face_x"),
            Contact("console", "seat_2", "face_x"),
            Contact("seat_1", "back_1", "face_y"),
            Contact("seat_2", "back_2", "face_y"),
        ),
    ),
)
