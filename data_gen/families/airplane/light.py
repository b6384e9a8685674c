"""Small airplanes: on wheels, on floats, with two wings above each other."""

from data_gen.families.airplane.pieces import (
    AIRFOIL,
    bar,
    between,
    body,
    fin,
    fuselage,
    pair,
    propeller,
    ranges,
    rib,
    rows_at,
    stabilizers,
    two,
    wheeled,
    wing,
)
from data_gen.families.airplane.profiles import CABIN, CANOPY, COWL, SLIM_TAIL
from data_gen.part import joined, loft, mirrored, rounded, section
from data_gen.rig import Contact, Rig

BOXY = rounded(0.35, 3)
PAIRS = (
    ("fuselage", "fuselage"),
    ("cockpit", "cockpit"),
    ("wing_left", "wing_right"),
    ("tail_fin", "tail_fin"),
    ("stabilizer_left", "stabilizer_right"),
)
FLOAT = (
    (0.5, 0.68, 0.33, 0.4),
    (0.42, 0.56, 0.77, 0.8),
    (0.1, 0.5, 1.1, 1),
    (-0.15, 0.5, 1.1, 1),
    (-0.5, 0.72, 0.66, 0.4),
)
"""A float from its front: where (share of its length), height of its middle, width, height (in units of its depth)."""
BRACED = (("strut_1", "strut_2"), ("gear_1", "gear_2"))


def _tail(p):
    """An upright fin at the end of the tail, and stabilizers below it."""
    width, rear = p.fuselage_width, -p.fuselage_length / 2
    top = (0, 0.3 * width + p.fin_height, rear + 0.06, 0.06, 0.01)
    upright = fin("tail_fin", (0, 0.3 * width, rear + 0.12, 0.12, 0.014), top)
    return upright, *stabilizers(p, 0, 0.14 * width, rear + 0.1, 0.095)


def _cabin(p):
    """A fuselage with an engine's cowl in front and a cabin with windows on it, its propeller, and its tail."""
    width, nose = p.fuselage_width, p.fuselage_length / 2
    cabin = body("cockpit", rows_at(CABIN, nose, width), BOXY)
    screw = propeller("propeller", (0, -0.08 * width, nose), p.propeller_diameter, 2)
    return fuselage(p, COWL, SLIM_TAIL, BOXY), cabin, screw, *_tail(p)


def _high_wings(p):
    """Wings that meet on top of the cabin, each held from below by a strut."""
    width = p.fuselage_width
    root, tip = wing(p, 0, 0.9 * width, p.fuselage_length / 2 - 1.5 * width, 0.026)
    x, y, front, chord, _ = between(root, tip, 0.5)
    foot = (0.4 * width, -0.3 * width, p.fuselage_length / 2 - 2.2 * width)
    strut = bar("strut_1", foot, (x, y, front - 0.35 * chord), (0.008, 0.02))
    return *pair("wing", [rib(*root), rib(*tip)]), *two(strut)


def high_wing(p):
    """A small airplane: a propeller at the nose, wings on the cabin, three wheels."""
    width, nose = p.fuselage_width, p.fuselage_length / 2
    low, front, back = -p.gear_height, nose - 0.6 * width, nose - 2.4 * width
    side = wheeled("gear_1", (0.3 * width, -0.4 * width, back), (0.9 * width, low, back), 0.05)
    front = wheeled("gear_3", (0, -0.3 * width, front), (0, low, front), 0.045)
    return *_cabin(p), *_high_wings(p), *two(side), front


def seaplane(p):
    """A small airplane on two floats."""
    width, nose = p.fuselage_width, p.fuselage_length / 2
    x, low, deep, middle = 1.1 * width, -p.gear_height, 0.05, nose - 2.2 * width
    cuts = [((x, low + up * deep, middle + at * p.float_length), (w * deep, h * deep)) for at, up, w, h in FLOAT]
    hull = loft("float_1", [section("z", at, size) for at, size in cuts], BOXY)
    legs = [
        bar("leg", (x, low + deep, middle + z), (0.3 * width, -0.4 * width, middle + 0.6 * z), (0.012, 0.02))
        for z in (0.1, -0.08)
    ]
    return *_cabin(p), *_high_wings(p), *two(hull), *two(joined("gear_1", *legs))


def _level(p, x, y, front, share=1.0):
    """A rib of a biplane's wing, whose chord may be a share of the root's."""
    return rib(x, y, front - 0.3 * (1 - share) * p.wing_chord, share * p.wing_chord, share * 0.018)


def _wings_above(p, low, front, ahead):
    """A pair of lower wings, and one upper wing that reaches from tip to tip."""
    half, up = p.wing_span / 2, low + p.wing_gap
    lower = [
        _level(p, 0.2 * p.fuselage_width, low, front),
        _level(p, half - 0.06, low, front),
        _level(p, half - 0.03, low, front, 0.6),
    ]
    upper = [
        _level(p, x, up, ahead, share) for x, share in ((-half, 0.6), (0.03 - half, 1), (half - 0.03, 1), (half, 0.6))
    ]
    return *pair("wing", lower), loft("upper_wing", upper, AIRFOIL)


def _struts(p, low, front, ahead):
    """Two struts far out on each side, and four that hold the upper wing above the fuselage."""
    width, up, chord = p.fuselage_width, low + p.wing_gap, p.wing_chord
    posts = [
        [
            bar("post", (x, y, front - back * chord), (out, up, ahead - back * chord), (0.008, 0.014))
            for back in (0.2, 0.65)
        ]
        for x, out, y in ((0.37 * p.wing_span, 0.37 * p.wing_span, low), (0.35 * width, 0.7 * width, 0.3 * width))
    ]
    middle = [joined("half", *posts[1]), mirrored(joined("half", *posts[1]), "half")]
    return *two(joined("strut_1", *posts[0])), joined("strut_3", *middle)


def biplane(p):
    """A biplane: two wings above each other with struts between them, a round engine, an open seat, two wheels."""
    width, nose = p.fuselage_width, p.fuselage_length / 2
    low, front = -0.36 * width, nose - 0.8 * width
    engine = [(0, 0, 0.5, 0.5), (0.02, 0, 0.94, 0.94), (0.12, 0, 1.1, 1.1), (0.5, 0, 1.1, 1.1)]
    leg = wheeled("gear_1", (0.3 * width, low, front - 0.03), (0.8 * width, -p.gear_height, front), 0.07)
    return (
        fuselage(p, COWL[1:], SLIM_TAIL),
        body("cockpit", rows_at(CANOPY, nose - 2.6 * width, 0.7 * width, 0.42 * width)),
        body("engine", rows_at(engine, nose, width)),
        propeller("propeller", (0, 0, nose), p.propeller_diameter, 2),
        *_wings_above(p, low, front, front + 0.03),
        *_tail(p),
        *_struts(p, low, front, front + 0.03),
        *two(leg),
    )


SMALL = ranges(
    wing_span=(0.54, 0.88),
    wing_chord=(0.085, 0.15),
    tip_chord=(0.05, 0.12),
    wing_sweep=(0.0, 0.06),
    wing_rise=(-0.01, 0.05),
    fuselage_length=(0.44, 0.66),
    fuselage_width=(0.06, 0.095),
    fin_height=(0.05, 0.13),
    stabilizer_span=(0.16, 0.32),
    propeller_diameter=(0.1, 0.18),
)
HIGH_WING = SMALL + ranges(gear_height=(0.1, 0.15))
SEAPLANE = SMALL + ranges(gear_height=(0.12, 0.19), float_length=(0.3, 0.54))
BIPLANE = ranges(
    wing_span=(0.5, 0.84),
    wing_chord=(0.085, 0.15),
    wing_gap=(0.1, 0.18),
    fuselage_length=(0.42, 0.62),
    fuselage_width=(0.062, 0.088),
    fin_height=(0.05, 0.12),
    stabilizer_span=(0.17, 0.32),
    propeller_diameter=(0.12, 0.19),
    gear_height=(0.1, 0.135),
)
TAIL = Contact("stabilizer_left", "stabilizer_right", "face_x")
HIGH = (TAIL, Contact("wing_left", "wing_right", "face_x"))
ON_FLOATS = (Contact("float_1", "gear_1", "face_y"), Contact("float_2", "gear_2", "face_y"))
BIPLANE_PAIRS = tuple((name, name) for name in ("engine", "propeller", "upper_wing", "strut_3"))
PROPELLER, NOSE_WHEEL, FLOATS = ("propeller", "propeller"), ("gear_3", "gear_3"), ("float_1", "float_2")
LIGHT = (
    Rig("airplane/high_wing", HIGH_WING, high_wing, (*PAIRS, *BRACED, PROPELLER, NOSE_WHEEL), HIGH),
    Rig("airplane/seaplane", SEAPLANE, seaplane, (*PAIRS, *BRACED, PROPELLER, FLOATS), HIGH + ON_FLOATS),
    Rig("airplane/biplane", BIPLANE, biplane, (*PAIRS, *BRACED, *BIPLANE_PAIRS), (TAIL,)),
)
