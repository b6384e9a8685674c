"""Beds between four posts: with knobs on them, with a roof and curtains."""

from data_gen.families.bed.pieces import (
    AT_FOOT,
    AT_HEAD,
    AT_POSTS,
    BEDDING,
    LIE,
    MEANINGS,
    POSTS,
    SHEET,
    bedding,
    between_posts,
    board,
    inner,
    posts,
)
from data_gen.families.chair.pieces import corners
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.part import box, joined, loft, rounded, section
from data_gen.rig import FLOOR, Rig


def _lie(p):
    return bedding(p, p.bed_width - 2 * SHEET - 0.004, inner(p) - 0.006)


def four_poster(p):
    """A bed between four turned posts with knobs, a high board at the head and a low one at the foot."""
    top, bed = FLOOR + p.post_height, FLOOR + p.frame_height
    stops = [(FLOOR, 0.7), (FLOOR + 0.03, 1), (bed + 0.04, 1), (bed + 0.06, 0.6), (bed + 0.09, 0.95)]
    stops += [(top - 0.11, 0.55), (top - 0.1, 0.9), (top - 0.08, 0.45), (top - 0.05, 1), (top - 0.02, 0.9), (top, 0.3)]
    ends = board(p, "headboard", -1, p.headboard_height), board(p, "footboard", 1, p.footboard_height)
    return between_posts(p), *_lie(p), *ends, *posts(p, stops)


OVERHANG = 0.03
"""How far a roof reaches beyond the posts along x."""
GATHERED = ((0, 0.14), (0.15, 0.11), (0.32, 0.05), (0.37, 0.05), (0.55, 0.12), (0.8, 0.18), (1, 0.21))
"""A curtain from below: share of its height, its edge along z."""


def canopy(p):
    """A bed under a roof of cloth on four slender posts, each with a tied curtain."""
    high = FLOOR + p.post_height
    return (
        between_posts(p),
        *_lie(p),
        board(p, "headboard", -1, p.headboard_height),
        *posts(p, ((FLOOR, 1), (high, 1)), rounded(0.2, 1)),
        _roof(p, high),
        *_curtains(p),
    )


def _roof(p, high):
    """A roof on the posts, and a strip of cloth that hangs from each of its edges."""
    thin, wide, long = 0.008, p.bed_width + 2 * OVERHANG, p.bed_length + 0.016
    y, inside = high - p.roof_height / 2, (wide - thin) / 2
    top = box("roof", (0, high + 0.0075, 0), (wide, 0.015, long))
    ends = [box("cloth", (0, y, side * (long - thin) / 2), (wide, p.roof_height, thin)) for side in (-1, 1)]
    sides = [box("cloth", (side * inside, y, 0), (thin, p.roof_height, long - 2 * thin)) for side in (-1, 1)]
    return joined("roof", top, *ends, *sides)


def _curtains(p):
    """Curtains outside the posts, gathered at a third of their height."""
    found = []
    for i, (a, b) in enumerate(corners(1, 1), start=1):
        sections = []
        for share, wide in GATHERED:
            y, z = FLOOR + 0.02 + share * (p.post_height - 0.02), p.bed_length / 2 - wide / 2
            sections.append(section("y", (a * (p.bed_width / 2 + 0.012), y, b * z), (0.018, wide)))
        found.append(loft(f"curtain_{i}", sections, rounded(0.3, 2)))
    return found


BED = {"mattress_thickness": (0.07, 0.13), "frame_height": (0.14, 0.22), "frame_thickness": (0.03, 0.06)}
FAMILIES = (
    Rig(
        "bed/four_poster",
        ranges(
            MEANINGS,
            bed_width=(0.5, 0.85),
            bed_length=(0.78, 0.96),
            **BED,
            headboard_height=(0.42, 0.6),
            footboard_height=(0.3, 0.4),
            board_thickness=(0.012, 0.04),
            post_height=(0.62, 0.95),
            post_size=(0.035, 0.065),
        ),
        four_poster,
        (*itself("frame", "headboard", "footboard"), *BEDDING, *POSTS),
        (*LIE, *AT_POSTS, AT_HEAD, AT_FOOT),
    ),
    Rig(
        "bed/canopy",
        ranges(
            MEANINGS,
            bed_width=(0.5, 0.85),
            bed_length=(0.78, 0.96),
            **BED,
            headboard_height=(0.36, 0.5),
            board_thickness=(0.012, 0.04),
            post_height=(0.8, 0.98),
            post_size=(0.025, 0.055),
            roof_height=(0.05, 0.12),
        ),
        canopy,
        (
            *itself("frame", "headboard", "roof"),
            *BEDDING,
            *POSTS,
            ("curtain_1", "curtain_2"),
            ("curtain_3", "curtain_4"),
        ),
        (*LIE, *AT_POSTS, AT_HEAD),
    ),
)
