"""Beds with bars: one bed above the other, and a baby's."""

import numpy as np

from data_gen.families.bed.pieces import (
    AT_FOOT,
    AT_HEAD,
    AT_POSTS,
    MEANINGS,
    POSTS,
    between_posts,
    board,
    inner,
    posts,
)
from data_gen.families.chair.pieces import cushion, strut
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import RECTANGLE, box, ellipse, joined, loft, section
from data_gen.rig import FLOOR, Contact, Rig


def bunk(p):
    """Two beds one above the other between four posts, with guards and a ladder."""
    top = FLOOR + p.upper_height + p.guard_height
    found = posts(p, ((FLOOR, 1), (top - 0.01, 1), (top, 0.8)), RECTANGLE)
    berths = [one for i, height in ((1, p.frame_height), (2, p.upper_height)) for one in _berth(p, i, FLOOR + height)]
    ends = [_grid(p, name, end) for name, end in (("headboard", -1), ("footboard", 1))]
    return *found, *berths, *ends, _guard(p, "guard_left", -1, 1.0), _guard(p, "guard_right", 1, 0.35), _ladder(p)


def _berth(p, i, y):
    """A frame, a mattress and a pillow of one of the two beds."""
    frame = box(f"frame_{i}", (0, y - p.frame_thickness / 2, 0), (p.bed_width, p.frame_thickness, inner(p)))
    t, wide = p.mattress_thickness, p.bed_width - 0.06
    mattress = cushion(f"mattress_{i}", (0, y + t / 2, 0), (wide, t, inner(p) - 0.02), corner=0.05)
    pillow = cushion(f"pillow_{i}", (0, y + t + 0.02, 0.08 - inner(p) / 2), (0.7 * wide, 0.04, 0.11), corner=0.25)
    return frame, mattress, pillow


def _grid(p, name, end):
    """Bars between two posts beside the upper bed and, the same, beside the lower one."""
    size, z, half = 0.016, end * (p.bed_length - p.post_size) / 2, p.bed_width / 2 - p.post_size
    tall, found = p.guard_height + p.frame_thickness, []
    for low in (p.frame_height - p.frame_thickness, p.upper_height - p.frame_thickness):
        found += [box("rail", (0, FLOOR + low + y, z), (2 * half, 2 * size, size)) for y in (size, tall - size)]
        y, rod = FLOOR + low + tall / 2, (size, tall - 4 * size, size)
        found += [box("rod", (share * half, y, z), rod) for share in np.linspace(-0.85, 0.85, 6)]
    return joined(name, *found)


def _guard(p, name, side, front):
    """Two rails along a side of the upper bed, from the rear post to an upright a share of the way to the front one."""
    x, y = side * (p.bed_width - p.post_size) / 2, FLOOR + p.upper_height
    long, z = (1 + front) * inner(p) / 2, (front - 1) * inner(p) / 4
    rails = [box("rail", (x, y + share * p.guard_height, z), (0.016, 0.03, long)) for share in (0.55, 0.9)]
    upright = (x, y + p.guard_height / 2, front * inner(p) / 2 - 0.012)
    return joined(name, *rails, box("upright", upright, (0.02, p.guard_height, 0.024)))


def _ladder(p):
    """A ladder in front at the right side that leans on the upper frame and goes on upright beside its guard."""
    high, lean, size = p.upper_height, 0.09, (0.02, 0.02)
    x, z = p.bed_width / 2 + 0.01, 0.33 * p.bed_length - 0.03
    stops = ((x + lean, FLOOR), (x, FLOOR + high), (x, FLOOR + high + 0.5 * p.guard_height))
    found = [loft("side", [section("y", (out, y, z + s), size) for out, y in stops]) for s in (-0.06, 0.06)]
    for share in (0.14, 0.31, 0.48, 0.65, 0.82):
        left, right = ((x + lean * (1 - share), FLOOR + share * high, z + s) for s in (-0.05, 0.05))
        found.append(strut("rung", left, right, *2 * [(0.018, 0.018)], ellipse(8), "z"))
    return joined("ladder", *found)


def crib(p):
    """A baby's bed: bars on both sides between posts with knobs, round boards at both ends."""
    top, y = FLOOR + p.post_height, FLOOR + p.frame_height + p.mattress_thickness
    stops = [(FLOOR, 0.9), (top - 0.06, 0.9), (top - 0.055, 0.5), (top - 0.045, 0.5), (top - 0.035, 1)]
    stops += [(top - 0.015, 1), (top, 0.4)]
    extents = (p.bed_width - p.post_size, p.mattress_thickness, inner(p) - 0.004)
    mattress = cushion("mattress", (0, y - p.mattress_thickness / 2, 0), extents, corner=0.05)
    pillow = cushion("pillow", (0, y + 0.015, 0.07 - inner(p) / 2), (0.6 * p.bed_width, 0.03, 0.09), corner=0.25)
    sides = [_side(p, name, side) for name, side in (("side_left", -1), ("side_right", 1))]
    ends = [board(p, name, end, p.post_height - 0.03, 0.3) for name, end in (("headboard", -1), ("footboard", 1))]
    return between_posts(p), mattress, pillow, *sides, *ends, *posts(p, stops)


def _side(p, name, side):
    """Upright rods between a rail on the frame and one above."""
    x, low, half, rail = side * (p.bed_width / 2 - 0.01), FLOOR + p.frame_height, inner(p) / 2, 0.02
    high = low + p.side_height - rail
    found = [box("rail", (x, y + rail / 2, 0), (0.02, rail, 2 * half)) for y in (low, high)]
    for share in np.linspace(-0.88, 0.88, 9):
        ends = (x, low + rail, share * half), (x, high, share * half)
        found.append(strut("rod", *ends, *2 * [(0.011, 0.011)], ellipse(8)))
    return joined(name, *found)


FAMILIES = (
    Rig(
        "bed/bunk",
        ranges(
            MEANINGS,
            bed_width=(0.4, 0.6),
            bed_length=(0.8, 0.98),
            frame_height=(0.14, 0.2),
            frame_thickness=(0.03, 0.05),
            mattress_thickness=(0.05, 0.08),
            upper_height=(0.54, 0.78),
            guard_height=(0.14, 0.2),
            post_size=(0.028, 0.055),
        ),
        bunk,
        (
            *POSTS,
            *(pair for i in (1, 2) for pair in itself(f"frame_{i}", f"mattress_{i}", f"pillow_{i}")),
            *itself("headboard", "footboard"),
        ),
        (
            *(contact for i in (1, 2) for contact in stack(f"frame_{i}", f"mattress_{i}", f"pillow_{i}")),
            *(Contact(f"frame_{k}", f"post_{i}", "face_z") for k in (1, 2) for i in (1, 2)),
            *(Contact(f"post_{i}", f"frame_{k}", "face_z") for k in (1, 2) for i in (3, 4)),
        ),
    ),
    Rig(
        "bed/crib",
        ranges(
            MEANINGS,
            bed_width=(0.28, 0.42),
            bed_length=(0.5, 0.72),
            frame_height=(0.14, 0.22),
            frame_thickness=(0.03, 0.05),
            mattress_thickness=(0.04, 0.07),
            side_height=(0.14, 0.24),
            post_height=(0.46, 0.56),
            post_size=(0.026, 0.05),
            board_thickness=(0.01, 0.03),
        ),
        crib,
        (
            *itself("frame", "headboard", "footboard", "mattress", "pillow"),
            ("side_left", "side_right"),
            *POSTS,
        ),
        (
            *stack("frame", "mattress", "pillow"),
            *stack("frame", "side_left"),
            *stack("frame", "side_right"),
            *AT_POSTS,
            AT_HEAD,
            AT_FOOT,
        ),
    ),
)
