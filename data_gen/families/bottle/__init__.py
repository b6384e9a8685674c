"""Bottles: for wine and beer, a hip flask, a jar, a jug; those with a pump or a teat stand in `fitted.py`."""

from data_gen.families.bottle import fitted
from data_gen.families.bottle.pieces import ROUND, THIN, body_of, bottle, cap_of, label_of, neck_of
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.turned import ear, open_ring, rod, turned
from data_gen.part import loft, rounded, section
from data_gen.rig import FLOOR, Rig

FOIL, LIP = 0.08, 0.02


def wine(p):
    """A wine bottle: round shoulders, a straight neck, foil around its upper end, a label."""
    high, width = FLOOR + p.body_height + p.neck_height, p.neck_width
    outside = [(high - FOIL, width + 0.012), (high - LIP, width + 0.012), (high - LIP, width + 0.024)]
    foil = turned("cap", [(high, width), (high - FOIL, width), *outside, (high + 0.006, width + 0.02)], sides=ROUND)
    return body_of(p, width), neck_of(p), foil, label_of(p)


def beer(p):
    """A beer bottle: a long neck that narrows upwards, a crown cap, a label on the body and one on the neck."""
    low, wide = FLOOR + p.body_height, 1.7 * p.neck_width
    at = [(low + share * p.neck_height, wide + share * (p.neck_width - wide) + 2 * THIN) for share in (0.25, 0.6)]
    high = low + p.neck_height
    crown = [(high, p.neck_width + 0.026), (high + 0.006, p.neck_width + 0.026), (high + 0.022, p.neck_width + 0.006)]
    collar = open_ring("label_top", at, THIN, sides=ROUND)
    return body_of(p, wide), neck_of(p, wide), turned("cap", crown, sides=ROUND), label_of(p), collar


def flask(p):
    """A hip flask: flat and rounded, a screw cap on a short neck, leather around its lower half."""
    top = FLOOR + p.body_height
    rings = [(FLOOR, 0.9), (FLOOR + 0.02, 1), (top - p.shoulder_height, 1), (top - 0.3 * p.shoulder_height, 0.84)]
    rings = [section("y", (0, y, 0), (size * p.width, size * p.depth)) for y, size in (*rings, (top, 0.6))]
    low, high = FLOOR + 0.03, FLOOR + 0.03 + p.label_height
    sizes = ((low, 2 * THIN), (high, 2 * THIN), (high, 0), (low, 0))
    band = [section("y", (0, y, 0), (p.width + more, p.depth + more)) for y, more in sizes]
    outline = rounded(0.4, 6)
    parts = loft("body", rings, outline), neck_of(p), cap_of(p, top + p.neck_height)
    return *parts, loft("label", band, outline, closed=True)


def jar(p):
    """A jar: wide, on its short neck a lid, around it a label."""
    lid = FLOOR + p.body_height + p.neck_height
    return body_of(p, p.neck_width), neck_of(p), cap_of(p, lid), label_of(p)


def jug(p):
    """A jug with a cork in its neck, and a handle from the neck to the shoulder."""
    low, high = FLOOR + p.body_height, FLOOR + p.body_height + p.neck_height
    shares = ((0, 1.3), (0.2, 1.02), (0.75, 0.96), (0.8, 1.25), (1, 1.25))
    neck = turned("neck", [(low + up * p.neck_height, d * p.neck_width) for up, d in shares], sides=ROUND)
    cork = turned("cap", [(high, 0.8 * p.neck_width), (high + p.cap_height, 0.95 * p.neck_width)])
    ends = (0.4 * p.neck_width, low + 0.65 * p.neck_height), (0.44 * p.width, low - 0.65 * p.shoulder_height)
    path = ear(*ends, 0.28 * p.width)
    return body_of(p, 1.3 * p.neck_width), neck, cork, rod("handle", path, p.handle_width)


FAMILIES = (
    Rig(
        "bottle/wine",
        bottle(width=(0.18, 0.3), body_height=(0.46, 0.62), shoulder_height=(0.05, 0.18))
        + bottle(neck_width=(0.06, 0.11), neck_height=(0.18, 0.34), label_height=(0.1, 0.24)),
        wine,
        itself("body", "neck", "cap", "label"),
        stack("body", "neck"),
    ),
    Rig(
        "bottle/beer",
        bottle(width=(0.15, 0.24), body_height=(0.32, 0.48), shoulder_height=(0.03, 0.12))
        + bottle(neck_width=(0.045, 0.075), neck_height=(0.16, 0.32), label_height=(0.07, 0.16)),
        beer,
        itself("body", "neck", "cap", "label", "label_top"),
        stack("body", "neck", "cap"),
    ),
    Rig(
        "bottle/flask",
        bottle(width=(0.26, 0.38), depth=(0.09, 0.15), body_height=(0.32, 0.44), shoulder_height=(0.05, 0.1))
        + bottle(neck_width=(0.06, 0.08), neck_height=(0.02, 0.04), cap_width=(0.085, 0.11), cap_height=(0.03, 0.06))
        + bottle(label_height=(0.12, 0.2)),
        flask,
        itself("body", "neck", "cap", "label"),
        stack("body", "neck", "cap"),
    ),
    Rig(
        "bottle/jar",
        bottle(width=(0.33, 0.46), body_height=(0.26, 0.44), shoulder_height=(0.02, 0.08))
        + bottle(neck_width=(0.22, 0.27), neck_height=(0.015, 0.03), cap_width=(0.28, 0.32), cap_height=(0.04, 0.07))
        + bottle(label_height=(0.08, 0.16)),
        jar,
        itself("body", "neck", "cap", "label"),
        stack("body", "neck", "cap"),
    ),
    Rig(
        "bottle/jug",
        bottle(width=(0.32, 0.44), body_height=(0.44, 0.58), shoulder_height=(0.12, 0.28))
        + bottle(neck_width=(0.09, 0.16), neck_height=(0.12, 0.24), cap_height=(0.025, 0.08))
        + bottle(handle_width=(0.03, 0.05)),
        jug,
        itself("body", "neck", "cap"),
        stack("body", "neck", "cap"),
    ),
    *fitted.FAMILIES,
)
