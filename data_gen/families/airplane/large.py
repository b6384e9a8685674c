"""Airplanes for passengers: two or four jets under the wing, two at the tail, two propellers."""

from data_gen.families.airplane.pieces import (
    between,
    body,
    fin,
    fuselage,
    jet,
    pair,
    propeller,
    ranges,
    rib,
    rows_at,
    stabilizers,
    two,
    windshield,
    wing,
    winglet,
)
from data_gen.families.airplane.profiles import BLUNT, JUMBO, SHARP, TAIL
from data_gen.part import box, joined, loft, moved, section
from data_gen.rig import Contact, Rig

SLIM = ((0, 0.5, 0.5), (0.06, 0.72, 0.8), (0.3, 0.85, 1), (0.65, 0.8, 0.9), (1, 0.3, 0.35))
"""An engine behind a propeller: share of its length, and width and height as shares of its diameter."""
PAIRS = (
    ("fuselage", "fuselage"),
    ("cockpit", "cockpit"),
    ("wing_left", "wing_right"),
    ("tail_fin", "tail_fin"),
    ("stabilizer_left", "stabilizer_right"),
    ("engine_1", "engine_2"),
)


def _hull(p, nose, glass, tail=TAIL):
    """A fuselage and the glass of its cockpit, which lies over these rows of the nose."""
    panes = rows_at(windshield(nose[glass]), p.fuselage_length / 2, p.fuselage_width)
    return fuselage(p, nose, tail), body("cockpit", panes)


def _low_wing(p):
    """Root and tip of a wing below the middle of the fuselage."""
    front = 0.14 * p.fuselage_length + 0.03
    return wing(p, 0.3 * p.fuselage_width, -0.3 * p.fuselage_width, front, 0.03)


def _swept(root, tip):
    """Wings whose rear edge has a bend and whose tips turn up."""
    x, y, front, _, thickness = between(root, tip, 0.36)
    bend = (x, y, front, 0.5 * root[3] + 0.36 * tip[3], thickness)
    end = (tip[0] - 0.4 * tip[3], *tip[1:])
    return pair("wing", [rib(*root), rib(*bend), rib(*end), *winglet(*end)])


def _fin(p, front):
    """A swept fin that ends above the tail; `front` is how far before the tail's end it begins."""
    top, rear = 0.36 * p.fuselage_width, -p.fuselage_length / 2
    tip = (0, top + p.fin_height, rear + 0.07, 0.06, 0.01)
    return fin("tail_fin", (0, top, rear + front, front - 0.02, 0.016), tip)


def _low_stabilizers(p):
    """Stabilizers at the sides of the tail."""
    return stabilizers(p, 0.1 * p.fuselage_width, 0.24 * p.fuselage_width, 0.13 - p.fuselage_length / 2, 0.1)


def _hung(p, i, root, tip, share):
    """A jet ahead of and below the wing, at a share of the way to its tip, with the pylon that carries it."""
    x, y, front = between(root, tip, share)[:3]
    nose, down = front + 0.55 * p.engine_length, y - 0.66 * p.engine_diameter
    nacelle = jet("nacelle", (x, down, nose), p.engine_length, p.engine_diameter)
    low = section("y", (x, down + 0.3 * p.engine_diameter, nose - 0.5 * p.engine_length), (0.01, 0.4 * p.engine_length))
    high = section("y", (x, y, front - 0.1 * p.engine_length), (0.01, 0.5 * p.engine_length))
    return two(joined(f"engine_{i}", nacelle, loft("pylon", [low, high])))


def airliner(p):
    """An airliner with a jet under each of its swept, low wings."""
    root, tip = _low_wing(p)
    hull = _hull(p, BLUNT, slice(3, 5))
    return *hull, *_swept(root, tip), _fin(p, 0.17), *_low_stabilizers(p), *_hung(p, 1, root, tip, 0.3)


def four_engines(p):
    """A jumbo: an upper deck behind the nose, and two jets under each wing."""
    root, tip = _low_wing(p)
    hull, jets = _hull(p, JUMBO, slice(3, 5)), (*_hung(p, 1, root, tip, 0.3), *_hung(p, 3, root, tip, 0.62))
    return *hull, *_swept(root, tip), _fin(p, 0.19), *_low_stabilizers(p), *jets


def business_jet(p):
    """A business jet: a jet at each side of its tail, the stabilizers on top of the fin."""
    hull, wings = _hull(p, SHARP, slice(3, 5)), _swept(*_low_wing(p))
    return *hull, *wings, _fin(p, 0.13), *_high_stabilizers(p, 0.085), *_beside_tail(p)


def _high_stabilizers(p, front):
    """Stabilizers on top of the fin, as deep as their front lies before the end of the tail, but for a little."""
    top = 0.36 * p.fuselage_width + p.fin_height
    return stabilizers(p, 0, top, front - p.fuselage_length / 2, front - 0.01)


def _beside_tail(p):
    """A jet at each side of the tail, with the pylon that carries it."""
    width, long = p.fuselage_width, p.engine_length
    x, y = 0.5 * width + 0.62 * p.engine_diameter, 0.26 * width
    front = -p.fuselage_length / 2 + 1.3 * width + long
    pylon = box("pylon", (0.55 * width, y, front - 0.5 * long), (0.5 * width, 0.014, 0.4 * long))
    return two(joined("engine_1", jet("nacelle", (x, y, front), long, p.engine_diameter), pylon))


def turboprop(p):
    """A regional airplane: a propeller before each of its high, straight wings, the stabilizers on the fin."""
    root, tip = wing(p, 0, 0.53 * p.fuselage_width, 0.1 * p.fuselage_length, 0.026)
    hull, wings = _hull(p, BLUNT, slice(3, 5)), pair("wing", [rib(*root), rib(*tip)])
    return *hull, *wings, _fin(p, 0.15), *_high_stabilizers(p, 0.09), *_propelled(p, *between(root, tip, 0.36)[:3])


def _propelled(p, x, y, front):
    """Slim engines on the front of the wings, and their propellers."""
    nose, long, thick = front + 0.45 * p.engine_length, p.engine_length, p.engine_diameter
    low = y - 0.2 * thick
    rows = [(nose - back * long, low, wide * thick, high * thick) for back, wide, high in SLIM]
    screw = propeller("propeller_1", (x, low, nose), p.propeller_diameter, 4)
    return *two(moved(body("engine_1", rows), by=(x, 0, 0))), *two(screw)


AIRLINER = ranges(
    wing_span=(0.66, 1.0),
    wing_chord=(0.15, 0.25),
    tip_chord=(0.025, 0.075),
    wing_sweep=(0.06, 0.3),
    wing_rise=(-0.01, 0.1),
    fuselage_length=(0.64, 0.98),
    fuselage_width=(0.07, 0.13),
    fin_height=(0.09, 0.2),
    stabilizer_span=(0.22, 0.42),
    engine_length=(0.085, 0.16),
    engine_diameter=(0.045, 0.09),
)
BIG = ranges(
    wing_span=(0.8, 1.0),
    wing_chord=(0.17, 0.28),
    tip_chord=(0.03, 0.08),
    wing_sweep=(0.1, 0.3),
    wing_rise=(-0.01, 0.1),
    fuselage_length=(0.78, 0.98),
    fuselage_width=(0.085, 0.125),
    fin_height=(0.11, 0.21),
    stabilizer_span=(0.26, 0.44),
    engine_length=(0.08, 0.13),
    engine_diameter=(0.042, 0.07),
)
BUSINESS = ranges(
    wing_span=(0.48, 0.8),
    wing_chord=(0.11, 0.2),
    tip_chord=(0.03, 0.07),
    wing_sweep=(0.02, 0.22),
    wing_rise=(0.0, 0.07),
    fuselage_length=(0.5, 0.8),
    fuselage_width=(0.06, 0.1),
    fin_height=(0.08, 0.17),
    stabilizer_span=(0.16, 0.34),
    engine_length=(0.08, 0.16),
    engine_diameter=(0.035, 0.065),
)
TURBOPROP = ranges(
    wing_span=(0.68, 0.96),
    wing_chord=(0.08, 0.15),
    tip_chord=(0.04, 0.1),
    wing_sweep=(0.0, 0.06),
    wing_rise=(-0.01, 0.05),
    fuselage_length=(0.56, 0.84),
    fuselage_width=(0.07, 0.115),
    fin_height=(0.1, 0.19),
    stabilizer_span=(0.2, 0.38),
    engine_length=(0.1, 0.2),
    engine_diameter=(0.04, 0.07),
    propeller_diameter=(0.11, 0.19),
)
T_TAIL = (Contact("stabilizer_left", "stabilizer_right", "face_x"),)
MET = (Contact("wing_left", "wing_right", "face_x"),)
LARGE = (
    Rig("airplane/airliner", AIRLINER, airliner, PAIRS),
    Rig("airplane/four_engines", BIG, four_engines, (*PAIRS, ("engine_3", "engine_4"))),
    Rig("airplane/business_jet", BUSINESS, business_jet, PAIRS, T_TAIL),
    Rig("airplane/turboprop", TURBOPROP, turboprop, (*PAIRS, ("propeller_1", "propeller_2")), T_TAIL + MET),
)
