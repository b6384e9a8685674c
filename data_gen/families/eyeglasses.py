"""Eyeglasses: they stand on their rims, looking forward; each temple turns about an upright hinge behind its rim."""

import numpy as np

from data_gen.joint import hinge
from data_gen.part import RECTANGLE, Section, ball, box, ellipse, joined, loft, mirrored, prism, rounded, section
from data_gen.rig import FLOOR, Contact, Parameter, Rig

TEMPLES = (
    Parameter("temple_length", 0.64, 0.8, "from the hinge of a temple to its end along z"),
    Parameter("temple_height", 0.022, 0.045, "edge of a temple along y where it is straight"),
    Parameter("ear_drop", 0.05, 0.11, "how far a temple bends down behind the ear"),
    Parameter("left_angle", 0.0, 1.5, "turn of the left temple, 0 where it is open", "rad"),
    Parameter("right_angle", 0.0, 1.5, "turn of the right temple, 0 where it is open", "rad"),
)
FRONT, BACK = 0.44, 0.385
"""The z of the middle of the rims and of the hinges."""
DEPTH = 0.03
"""The edge of a rim along z."""
WIDTH = 0.02
"""The edge of a temple along x."""
TILT = 0.06
"""The left hinge leans by this much, so that the left temple folds over the right one."""
EAR = ((0, 0, 0, 1), (0.68, 0, 0, 1), (0.76, 0.1, 0.35, 0.95), (0.86, 0.42, 0.6, 0.9), (1, 1, 0.6, 0.8))
"""A temple from its hinge: length and drop as shares, slope in radians, height as a share."""
SQUARE = rounded(0.28, 4), 2 * rounded(0.5, 4)
SOFT = rounded(0.38, 5), 2 * rounded(0.5, 5)
ROUND = ellipse(24), 2 * ellipse(24)
"""Forms of an opening: its points, and the outward directions there."""


def _parameters(width, height, thickness):
    """The parameters of a pair of glasses, with the ranges of its openings and rims."""
    return (
        Parameter("lens_width", *width, "edge of the opening of a rim along x"),
        Parameter("lens_height", *height, "edge of the opening of a rim along y"),
        Parameter("rim_thickness", *thickness, "from the opening of a rim to its outer edge"),
        Parameter("bridge_width", 0.08, 0.13, "from rim to rim along x"),
        *TEMPLES,
    )


def _middle(p):
    """The x and y of the middle of the right opening."""
    return p.bridge_width / 2 + p.rim_thickness + p.lens_width / 2, FLOOR + p.rim_thickness + p.lens_height / 2


def _rim(p, form):
    """The right rim, closed around its opening."""
    (x, y), thick = _middle(p), p.rim_thickness
    size, around = (p.lens_width + thick, p.lens_height + thick), zip(*form, strict=True)
    ring = [
        Section((x + q * size[0], y + r * size[1], FRONT), (out * thick, up * thick, 0), (0, 0, DEPTH))
        for (q, r), (out, up) in around
    ]
    return loft("rim_right", ring, RECTANGLE, closed=True)


def _bridge(p, y, rise):
    """An arch from rim to rim."""
    steps = ((-0.5, 0), (-0.3, 0.7), (0, 1), (0.3, 0.7), (0.5, 0))
    at = [(share * p.bridge_width, y + up * rise, FRONT + 0.3 * up * rise) for share, up in steps]
    return loft("bridge", [section("x", centre, (0.024, 0.022)) for centre in at], rounded(0.3, 2))


def _temple(p, x, y):
    """The right temple, straight back from its hinge and bent down at its end."""
    cuts = []
    for back, down, turn, share in EAR:
        upright = (0, share * np.cos(turn) * p.temple_height, -share * np.sin(turn) * p.temple_height)
        cuts.append(Section((x, y - down * p.ear_drop, BACK - back * p.temple_length), (WIDTH, 0, 0), upright))
    return loft("temple_right", cuts, rounded(0.3, 2))


def _frame(p, form, share, rise):
    """Rims, ends, temples, bridge, hinges; the ends stand out from the rims `share` of a lens above its middle."""
    x, y = _middle(p)
    side, high = x + p.lens_width / 2 + p.rim_thickness, y + share * p.lens_height
    middle, depth = (FRONT + DEPTH / 2 + BACK) / 2, FRONT + DEPTH / 2 - BACK
    end = box("end_right", (side + WIDTH / 2, high, middle), (WIDTH, 0.04, depth))
    return (
        *_both(_rim(p, form)),
        *_both(end),
        *_both(_temple(p, side + WIDTH / 2, high)),
        _bridge(p, high, rise),
        hinge("left_hinge", ["temple_left"], "end_left", (0, -1, TILT), (-side, high, BACK), p.left_angle),
        hinge("right_hinge", ["temple_right"], "end_right", (0, 1, 0), (side, high, BACK), p.right_angle),
    )


def _both(right):
    """A part's mirror image on the left, and the part."""
    return mirrored(right, right.name.replace("right", "left")), right


def rectangular(p):
    """Rectangular rims with round corners."""
    return _frame(p, SQUARE, 0.14, 0.012)


def round_rims(p):
    """Round rims and two pads for the nose."""
    _, y = _middle(p)
    spot = (0.3 * p.bridge_width, y - 0.12 * p.lens_height, FRONT - 0.045)
    ends = (spot, (0.5 * p.bridge_width + 0.2 * p.rim_thickness, y, FRONT))
    wire = loft("wire", [section("z", at, (0.008, 0.008)) for at in ends])
    pad = joined("pad_right", ball("pad", spot, (0.016, 0.06, 0.03), 12, 6), wire)
    return *_frame(p, ROUND, 0.0, 0.05), *_both(pad)


def sunglasses(p):
    """Wide, soft rims with dark glass in them."""
    size = (p.lens_width + 0.6 * p.rim_thickness, p.lens_height + 0.6 * p.rim_thickness, 0.01)
    glass = prism("lens_right", (*_middle(p), FRONT), size, "z", SOFT[0])
    return *_both(glass), *_frame(p, SOFT, 0.06, 0.02)


def _rig(name, parameters, build, *kinds):
    """A pair of glasses that has rims, ends, temples, and these kinds of parts on both sides."""
    pairs = [(f"{kind}_left", f"{kind}_right") for kind in ("rim", "end", "temple", *kinds)]
    return Rig(f"eyeglasses/{name}", parameters, build, (*pairs, ("bridge", "bridge")), CONTACTS)


CONTACTS = (
    Contact("temple_left", "end_left", "face_z"),
    Contact("temple_right", "end_right", "face_z"),
    Contact("end_left", "rim_left", "face_x"),
    Contact("rim_right", "end_right", "face_x"),
    Contact("rim_left", "bridge", "face_x"),
    Contact("bridge", "rim_right", "face_x"),
)
FAMILIES = (
    _rig("rectangular", _parameters((0.24, 0.33), (0.18, 0.28), (0.016, 0.032)), rectangular),
    _rig("round", _parameters((0.25, 0.31), (0.24, 0.32), (0.012, 0.024)), round_rims, "pad"),
    _rig("sunglasses", _parameters((0.24, 0.33), (0.22, 0.31), (0.02, 0.036)), sunglasses, "lens"),
)
