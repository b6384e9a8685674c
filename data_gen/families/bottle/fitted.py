"""Bottles with more than a cap: a soap dispenser with a pump, a spray with a trigger, a baby bottle with a teat."""

from data_gen.families.bottle.pieces import body_of, bottle, cap_of, label_of, neck_of, stub
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.turned import ear, quarter, rod, turned
from data_gen.part import Section, cylinder, joined, loft, mirrored, rounded
from data_gen.rig import FLOOR, Rig


def dispenser(p):
    """A soap dispenser: a pump in the cap, with a spout to the side."""
    low = FLOOR + p.body_height + p.neck_height
    top, high = low + p.cap_height, low + p.cap_height + p.pump_height
    head = turned("", [(high - HEAD, 0.07), *quarter((high - 0.015, 0.085), (high, 0.06), 3)])
    pump = joined("pump", stub("", top, high - HEAD, 0.026), head)
    y = high - HEAD / 2
    path = [(0.03, y, 0), (p.spout_length - 0.02, y, -0.2), (p.spout_length, y - 0.035, -1.3)]
    return body_of(p, p.neck_width), neck_of(p), cap_of(p, low), label_of(p), pump, rod("spout", path, 0.022)


HEAD = 0.035


def spray(p):
    """A spray bottle: a head over the cap that reaches forward to a nozzle, and a trigger below it."""
    low = FLOOR + p.body_height + p.neck_height
    top, high = low + p.cap_height, low + p.cap_height + p.pump_height
    back, front, tall = -0.05, p.spout_length, 0.055
    stem = stub("", top, high - tall, 0.05)
    rings = [(back, 0.5, 0.15), (back + 0.02, 0.9, 0.0), (front - 0.05, 1, 0.0), (front, 0.7, 0.05)]
    y = high - tall / 2
    rings = [Section((x, y - down * tall, 0), (0, s * tall, 0), (0, 0, 0.06 * s)) for x, s, down in rings]
    head = joined("pump", stem, loft("", rings, rounded(0.3)))
    nozzle = cylinder("spout", (front + 0.015, y, 0), (0.03, 0.04, 0.04), "x", 12)
    path = ((-0.05, 0, -1.4), (-0.035, 0.05, -1.6), (-0.05, 0.1, -2.0))
    path = [(front + out, high - tall - down, lean) for out, down, lean in path]
    trigger = rod("trigger", path, 0.022)
    return body_of(p, p.neck_width), neck_of(p), cap_of(p, low), label_of(p), head, nozzle, trigger


def baby(p):
    """A baby bottle: a teat in a ring, and a handle at either side."""
    low = FLOOR + p.body_height + p.neck_height
    top = low + p.cap_height
    shares = ((0, 0.8), (0.12, 0.78), (0.35, 0.5), (0.55, 0.3), (0.75, 0.27), (0.9, 0.24), (0.97, 0.15), (1, 0))
    teat = turned("teat", [(top + up * p.teat_height, d * p.cap_width) for up, d in shares])
    y = FLOOR + 0.6 * p.body_height
    path = ear((p.width / 2 - 0.01, y + 0.1), (p.width / 2 - 0.01, y - 0.1), p.handle_reach)
    right = rod("handle_right", path, p.handle_width)
    return body_of(p, p.neck_width), neck_of(p), cap_of(p, low), teat, right, mirrored(right, "handle_left")


FAMILIES = (
    Rig(
        "bottle/dispenser",
        bottle(width=(0.18, 0.28), body_height=(0.34, 0.46), shoulder_height=(0.03, 0.08), neck_width=(0.06, 0.08))
        + bottle(neck_height=(0.01, 0.02), cap_width=(0.09, 0.12), cap_height=(0.03, 0.06), pump_height=(0.09, 0.15))
        + bottle(spout_length=(0.1, 0.16), label_height=(0.1, 0.2)),
        dispenser,
        itself("body", "neck", "cap", "pump", "label"),
        stack("body", "neck", "cap", "pump"),
    ),
    Rig(
        "bottle/spray",
        bottle(width=(0.2, 0.28), body_height=(0.4, 0.54), shoulder_height=(0.1, 0.2), neck_width=(0.06, 0.08))
        + bottle(neck_height=(0.01, 0.02), cap_width=(0.085, 0.11), cap_height=(0.03, 0.06), pump_height=(0.09, 0.13))
        + bottle(spout_length=(0.12, 0.18), label_height=(0.08, 0.16)),
        spray,
        itself("body", "neck", "cap", "label"),
        stack("body", "neck", "cap", "pump"),
    ),
    Rig(
        "bottle/baby",
        bottle(width=(0.16, 0.22), body_height=(0.32, 0.44), shoulder_height=(0.02, 0.05), neck_width=(0.12, 0.14))
        + bottle(neck_height=(0.01, 0.02), cap_width=(0.16, 0.19), cap_height=(0.04, 0.07), teat_height=(0.1, 0.16))
        + bottle(handle_reach=(0.06, 0.1), handle_width=(0.02, 0.032)),
        baby,
        (*itself("body", "neck", "cap", "teat"), ("handle_left", "handle_right")),
        stack("body", "neck", "cap", "teat"),
    ),
)
