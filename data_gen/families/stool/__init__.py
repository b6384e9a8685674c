"""Stools: seats for one, without a back."""

import numpy as np

from data_gen.families.pieces.legs import SIDES, SYMMETRIC, between_crosses, carry, crossed_legs, slanted_legs
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.seats import MEANINGS
from data_gen.families.stool import curved
from data_gen.part import Section, box, cylinder, joined, loft, rounded, section
from data_gen.rig import FLOOR, Contact, Rig

RUNGS = ranges(
    MEANINGS,
    seat_width=(0.36, 0.5),
    seat_height=(0.5, 0.85),
    seat_depth=(0.34, 0.46),
    seat_thickness=(0.03, 0.07),
    leg_width=(0.035, 0.055),
    splay=(0.02, 0.08),
)
STEP = ranges(
    MEANINGS,
    seat_width=(0.42, 0.6),
    seat_height=(0.5, 0.66),
    seat_depth=(0.26, 0.34),
    seat_thickness=(0.025, 0.05),
    step_height=(0.24, 0.32),
    step_depth=(0.2, 0.28),
    side_width=(0.025, 0.05),
)
CROSS_LEGS = ranges(
    MEANINGS,
    seat_width=(0.36, 0.5),
    seat_height=(0.48, 0.62),
    seat_depth=(0.38, 0.52),
    sag=(0.02, 0.08),
    leg_width=(0.025, 0.04),
    leg_depth=(0.035, 0.055),
)
CLOTH, RAIL = 0.012, 0.035


def rungs(p):
    """A square seat on four legs that stand astride, with rungs between them."""
    height, w = p.seat_height - p.seat_thickness, p.leg_width
    x, z = ((edge - w) / 2 - 0.03 for edge in (p.seat_width, p.seat_depth))
    legs = slanted_legs((x + p.splay, z + p.splay), (x, z), height, (w, w), (w, w), rounded(0.25, 2))
    edges = ((0, 0.02), (0.3, 0), (0.7, 0), (1, 0.03))
    levels = [(p.seat_height - (1 - share) * p.seat_thickness, inset) for share, inset in edges]
    sizes = [(FLOOR + y, (p.seat_width - inset, p.seat_depth - inset)) for y, inset in levels]
    seat = loft("seat", [section("y", (0, y, 0), size) for y, size in sizes], rounded(0.15))
    return seat, *legs, *_rungs(p, x, z, height)


def _rungs(p, x, z, height):
    """Round rungs between the legs: lower in front and behind, higher at the sides."""
    found = []
    for name, side, share in (("rung_1", 1, 0.28), ("rung_2", -1, 0.28)):
        out = (1 - share) * p.splay
        size = (2 * (x + out) - p.leg_width, 0.03, 0.03)
        found.append(cylinder(name, (0, FLOOR + share * height, side * (z + out)), size, "x", 12))
    for name, side in SIDES:
        size, out = (0.03, 0.03, 2 * (z + 0.55 * p.splay) - p.leg_width), 0.55 * p.splay
        found.append(cylinder(f"rung_{name}", (side * (x + out), FLOOR + 0.45 * height, 0), size, "z", 12))
    return found


def step(p):
    """A step stool: a seat, a step before it, two sides that carry both, and a board behind."""
    front = (p.seat_depth + p.step_depth) / 2
    middle, before = p.seat_depth / 2 - front, front - p.step_depth / 2
    t, x = p.seat_thickness, (p.seat_width - p.side_width) / 2 - 0.02
    seat = box("seat", (0, FLOOR + p.seat_height - t / 2, middle), (p.seat_width, t, p.seat_depth))
    tread = box("step", (0, FLOOR + p.step_height - t / 2, before), (p.seat_width, t, p.step_depth))
    high, low, deep = p.seat_height - t, p.step_height - t, p.seat_depth - 0.03
    tall = [box("side", (s * x, FLOOR + high / 2, middle), (p.side_width, high, deep)) for _, s in SIDES]
    short = [box("side", (s * x, FLOOR + low / 2, before - 0.015), (p.side_width, low, p.step_depth)) for _, s in SIDES]
    sides = [joined(f"side_{name}", *pair) for (name, _), *pair in zip(SIDES, tall, short, strict=True)]
    behind = (0, FLOOR + 0.75 * high, 0.03 - front)
    return seat, tread, *sides, box("back", behind, (2 * x - p.side_width, high / 2, 0.03))


def cross_legs(p):
    """A folding stool: a cloth that hangs between two rails, on two pairs of crossed legs."""
    height, x, z = p.seat_height - RAIL, p.seat_width / 2 + p.leg_width, (p.seat_depth - p.leg_depth) / 2
    legs = crossed_legs(x, z, height, (p.leg_width, p.leg_depth))
    rail = (2 * x + p.leg_width + 0.02, RAIL, RAIL)
    y = FLOOR + p.seat_height - RAIL / 2
    rails = [cylinder(f"rail_{i}", (0, y, end * z), rail, "x") for i, end in ((1, 1), (2, -1))]
    size = (2 * x - 3 * p.leg_width, 0.03, 0.03)
    return _cloth(p, z), *legs, *rails, cylinder("stretcher", (0, FLOOR + height / 2, 0), size, "x", 12)


def _cloth(p, z):
    """A strip that hangs from one rail to the other, lowest in the middle."""
    y, sections = FLOOR + p.seat_height - CLOTH / 2, []
    for share in np.linspace(-1, 1, 9):
        middle = (0, y - (1 - share**2) * p.sag, share * z)
        sections.append(Section(middle, (p.seat_width - p.leg_width, 0, 0), (0, CLOTH, 0)))
    return loft("seat", sections)


SEAT = (("seat", "seat"),)
FAMILIES = (
    Rig(
        "stool/rungs",
        RUNGS,
        rungs,
        (*SEAT, *SYMMETRIC, ("rung_1", "rung_1"), ("rung_2", "rung_2"), ("rung_left", "rung_right")),
        carry("seat"),
    ),
    Rig(
        "stool/step",
        STEP,
        step,
        (*SEAT, ("step", "step"), ("side_left", "side_right"), ("back", "back")),
        (
            *carry("seat", "side_left", "side_right"),
            Contact("side_left", "back", "face_x"),
            Contact("back", "side_right", "face_x"),
        ),
    ),
    Rig(
        "stool/cross_legs",
        CROSS_LEGS,
        cross_legs,
        (*SEAT, *SYMMETRIC, ("rail_1", "rail_1"), ("rail_2", "rail_2"), ("stretcher", "stretcher")),
        (*carry("rail_2", "leg_1", "leg_2"), *carry("rail_1", "leg_3", "leg_4"), *between_crosses("stretcher")),
    ),
    *curved.FAMILIES,
)
