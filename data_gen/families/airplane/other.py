"""Airplanes of other forms: a glider, a fighter with a delta wing and twin fins, a flying wing, a canard."""

from data_gen.families.airplane.pieces import (
    AIRFOIL,
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
    wing,
)
from data_gen.families.airplane.profiles import BOOM, CANOPY, NEEDLE, NOZZLES, POD, STUB
from data_gen.part import loft, mirrored, moved, rounded
from data_gen.rig import Contact, Rig

BOXY = rounded(0.3, 3)
AIR = ((3.5, 0.5, 0.75), (3.0, 0.64, 0.92), (3.1, 0.7, 1), (4.2, 0.75, 0.95))
FIRE = ((1.0, 0.72, 0.8), (0.55, 0.74, 0.76), (0.0, 0.56, 0.56), (0.0, 0.42, 0.42), (0.3, 0.36, 0.36))
"""A fighter's engine, in units of the fuselage's width: behind the nose or before the tail's end, width, height."""
HUMP = ((0, 0.5, 0.3), (0, 1.3, 0.7), (0.3, 1.4, 1), (0.7, 1.2, 0.8), (1, 0.9, 0.2))
"""An engine in a wing: share of its length, and width and height as shares of its diameter."""


def glider(p):
    """A glider: very long wings, a pod with a glass canopy, a thin boom, the stabilizers on the fin."""
    width, nose, rear = p.fuselage_width, p.fuselage_length / 2, -p.fuselage_length / 2
    root, tip = wing(p, 0.2 * width, 0.34 * width, nose - 2.0 * width, 0.018)
    x, _, front, chord, thickness = between(root, tip, 0.6)
    bend = (x, root[1] + 0.45 * p.wing_rise, front + 0.005, chord + 0.006, thickness)
    top = 0.2 * width + p.fin_height
    upright = fin("tail_fin", (0, 0.1 * width, rear + 0.085, 0.085, 0.014), (0, top, rear + 0.065, 0.045, 0.01))
    return (
        fuselage(p, POD, BOOM),
        body("cockpit", rows_at(CANOPY, nose - 0.5 * width, width, 0.32 * width)),
        *pair("wing", [rib(*root), rib(*bend), rib(*tip)]),
        upright,
        *stabilizers(p, 0, top, rear + 0.075, 0.06),
    )


def fighter(p):
    """A fighter: a pointed nose, a delta wing, two engines side by side, two fins that lean outwards."""
    width, rear = p.fuselage_width, -p.fuselage_length / 2
    root, tip = wing(p, 0.5 * width, 0.05 * width, rear + 0.09 + p.wing_chord, 0.018)
    x, y = 0.82 * width, 0.3 * width
    small = [(0.9 * width, 0, rear + 0.1, 0.1, 0.012), (p.stabilizer_span / 2, 0, rear, 0.05, 0.008)]
    return (
        fuselage(p, NEEDLE, NOZZLES),
        body("cockpit", rows_at(CANOPY, p.fuselage_length / 2 - 1.3 * width, width, 0.3 * width)),
        *pair("wing", [rib(*root), rib(*tip)]),
        *_fins((x, y, rear + 0.17, 0.13, 0.012), (x + p.fin_lean, y + p.fin_height, rear + 0.085, 0.06, 0.008)),
        *pair("stabilizer", [rib(*one) for one in small]),
        *_long_engines(p),
    )


def _fins(foot, top):
    """A left and a right fin, the right one between two ribs."""
    right = fin("tail_fin_right", foot, top)
    return mirrored(right, "tail_fin_left"), right


def _long_engines(p):
    """Engines beside the fuselage, from their intakes behind the cockpit to the tail."""
    width, half = p.fuselage_width, p.fuselage_length / 2
    intake = [(half - back * width, *size) for back, *size in AIR]
    nozzle = [(ahead * width - half, *size) for ahead, *size in FIRE]
    rows = [(z, -0.08 * width, wide * width, high * width) for z, wide, high in (*intake, *nozzle)]
    return two(moved(body("engine_1", rows, BOXY), by=(0.62 * width, 0, 0)))


def flying_wing(p):
    """A flying wing: no tail, only a thick middle between two swept wings, with a cockpit and two engines on it."""
    half, front = p.fuselage_width / 2, p.fuselage_length / 2
    root, tip = wing(p, half, 0, front - 0.8 * half, 0.04)
    long, thick, start = p.engine_length, p.engine_diameter, front - 0.24 * p.fuselage_length
    hump = body("engine_1", [(start - back * long, 0.026, w * thick, h * thick) for back, w, h in HUMP], BOXY)
    return (
        _thick_middle(p, root, front),
        body("cockpit", rows_at(CANOPY, front - 0.05, 0.065, 0.042)),
        *pair("wing", [rib(*root), rib(*tip)]),
        *two(moved(hump, by=(0.62 * half, 0, 0))),
    )


def _thick_middle(p, root, front):
    """A body between the roots of two wings, thickest and longest in its middle."""
    x, chord = 0.45 * root[0], 0.5 * (p.fuselage_length + p.wing_chord)
    right = [(x, 0, front - 0.8 * x, chord, 0.075), root]
    left = [(-one[0], *one[1:]) for one in right[::-1]]
    return loft("fuselage", [rib(*one) for one in (*left, (0, 0, front, p.fuselage_length, 0.095), *right)], AIRFOIL)


def canard(p):
    """A canard: the small wings at the nose, the large ones and a propeller at the rear, fins on the wing tips."""
    width, nose, rear = p.fuselage_width, p.fuselage_length / 2, -p.fuselage_length / 2
    root, tip = wing(p, 0.3 * width, -0.1 * width, rear + 0.04 + p.wing_chord, 0.022)
    end, y, front, chord, _ = tip
    top = (end - 0.006, y + p.fin_height, front - 0.7 * chord, 0.6 * chord, 0.008)
    small = [(x, 0.05 * width, nose - 0.35 * width, 0.05, 0.01) for x in (0.1 * width, p.stabilizer_span / 2)]
    return (
        fuselage(p, POD, STUB),
        body("cockpit", rows_at(CANOPY, nose - 0.8 * width, width, 0.32 * width)),
        *pair("wing", [rib(*root), rib(*tip)]),
        *_fins((end - 0.006, y - 0.015, front, chord, 0.012), top),
        *pair("stabilizer", [rib(*one) for one in small]),
        propeller("propeller", (0, 0.1 * width, rear - 0.02), p.propeller_diameter, 2),
    )


GLIDER = ranges(
    wing_span=(0.78, 1.0),
    wing_chord=(0.045, 0.1),
    tip_chord=(0.018, 0.05),
    wing_sweep=(-0.01, 0.05),
    wing_rise=(0.0, 0.11),
    fuselage_length=(0.42, 0.62),
    fuselage_width=(0.04, 0.06),
    fin_height=(0.06, 0.14),
    stabilizer_span=(0.14, 0.3),
)
FIGHTER = ranges(
    wing_span=(0.4, 0.7),
    wing_chord=(0.22, 0.38),
    tip_chord=(0.03, 0.12),
    wing_sweep=(0.1, 0.26),
    wing_rise=(-0.04, 0.03),
    fuselage_length=(0.58, 0.86),
    fuselage_width=(0.055, 0.09),
    fin_height=(0.07, 0.17),
    fin_lean=(0.0, 0.09),
    stabilizer_span=(0.22, 0.44),
)
FLYING_WING = ranges(
    wing_span=(0.74, 1.0),
    wing_chord=(0.14, 0.24),
    tip_chord=(0.025, 0.09),
    wing_sweep=(0.16, 0.29),
    wing_rise=(-0.02, 0.04),
    fuselage_length=(0.3, 0.48),
    fuselage_width=(0.22, 0.36),
    engine_length=(0.11, 0.2),
    engine_diameter=(0.04, 0.07),
)
CANARD = ranges(
    wing_span=(0.52, 0.86),
    wing_chord=(0.11, 0.21),
    tip_chord=(0.035, 0.09),
    wing_sweep=(0.04, 0.2),
    wing_rise=(-0.01, 0.06),
    fuselage_length=(0.42, 0.58),
    fuselage_width=(0.052, 0.082),
    fin_height=(0.05, 0.14),
    stabilizer_span=(0.2, 0.42),
    propeller_diameter=(0.11, 0.19),
)
BODY = (("fuselage", "fuselage"), ("cockpit", "cockpit"), ("wing_left", "wing_right"))
TAILS = (("tail_fin_left", "tail_fin_right"), ("stabilizer_left", "stabilizer_right"))
JETS = (("engine_1", "engine_2"),)
ONE_FIN = (("tail_fin", "tail_fin"), ("stabilizer_left", "stabilizer_right"))
T_TAIL = (Contact("stabilizer_left", "stabilizer_right", "face_x"),)
WINGS_ON = (Contact("fuselage", "wing_right", "face_x"), Contact("wing_left", "fuselage", "face_x"))
OTHER = (
    Rig("airplane/glider", GLIDER, glider, BODY + ONE_FIN, T_TAIL),
    Rig("airplane/fighter", FIGHTER, fighter, BODY + TAILS + JETS),
    Rig("airplane/flying_wing", FLYING_WING, flying_wing, BODY + JETS, WINGS_ON),
    Rig("airplane/canard", CANARD, canard, (*BODY, *TAILS, ("propeller", "propeller"))),
)
