"""Tables on trestles: posts on feet, sawhorses, crossed legs, and the one with its benches."""

from data_gen.families.pieces.legs import SIDES, SYMMETRIC, between_crosses, carry, crossed_legs, slanted_legs, slats
from data_gen.families.pieces.ranges import ranges
from data_gen.families.table.tops import MEANINGS, slab
from data_gen.part import box, joined, loft, section
from data_gen.rig import FLOOR, Contact, Rig

TRESTLE = ranges(
    MEANINGS,
    width=(0.75, 1.0),
    height=(0.45, 0.65),
    depth=(0.4, 0.65),
    top_thickness=(0.03, 0.06),
    overhang=(0.08, 0.18),
    leg_width=(0.03, 0.075),
    leg_depth=(0.08, 0.16),
    foot_depth=(0.28, 0.38),
    stretcher_height=(0.14, 0.26),
)
SAWHORSES = ranges(
    MEANINGS,
    width=(0.8, 1.0),
    height=(0.42, 0.6),
    depth=(0.4, 0.6),
    top_thickness=(0.02, 0.045),
    overhang=(0.12, 0.2),
    leg_width=(0.022, 0.05),
    leg_depth=(0.025, 0.065),
    splay=(0.05, 0.1),
)
CROSS_LEGS = ranges(
    MEANINGS,
    width=(0.7, 1.0),
    height=(0.4, 0.6),
    depth=(0.4, 0.65),
    top_thickness=(0.02, 0.05),
    overhang=(0.04, 0.12),
    leg_width=(0.025, 0.045),
    leg_depth=(0.05, 0.09),
)
PICNIC = ranges(
    MEANINGS,
    width=(0.7, 1.0),
    height=(0.42, 0.54),
    depth=(0.3, 0.46),
    top_thickness=(0.02, 0.045),
    overhang=(0.08, 0.16),
    leg_width=(0.025, 0.055),
    leg_depth=(0.04, 0.09),
    seat_height=(0.22, 0.3),
    seat_depth=(0.1, 0.17),
    seat_distance=(0.04, 0.1),
)
FOOT, BEAM = 0.06, 0.05
"""How high the feet and the beams of trestles are."""


def trestle(p):
    """A top on two posts with a foot below and a beam above, and a stretcher between the posts."""
    under, x = p.height - p.top_thickness, p.width / 2 - p.overhang - p.leg_width / 2
    parts, post = [], (p.leg_width, under - FOOT - BEAM, p.leg_depth)
    for name, side in SIDES:
        parts.append(_runner(f"foot_{name}", side * x, p, p.foot_depth, FLOOR, FOOT))
        parts.append(box(f"leg_{name}", (side * x, FLOOR + (FOOT + under - BEAM) / 2, 0), post))
        parts.append(_runner(f"beam_{name}", side * x, p, p.depth - 0.06, FLOOR + under, -BEAM))
    size = (2 * x - p.leg_width, 0.06, 0.03)
    return slab(p), *parts, box("stretcher", (0, FLOOR + p.stretcher_height, 0), size)


def _runner(name, x, p, depth, base, height):
    """A bar along z, flat at `base`, of half its height (down if negative) at its ends."""
    ends = ((-0.5, 0.5), (-0.25, 1), (0.25, 1), (0.5, 0.5))
    size = abs(height)
    sections = [
        section("z", (x, base + share * height / 2, end * depth), (p.leg_width, share * size)) for end, share in ends
    ]
    return loft(name, sections)


def sawhorses(p):
    """A board on two sawhorses, each a beam on four legs with a rung before and behind."""
    under, w = p.height - p.top_thickness - BEAM, p.leg_width
    x, z = p.width / 2 - p.overhang - w, p.depth / 2 - 0.04 - p.leg_depth / 2
    size, rung = (w, p.leg_depth), (w + 1.4 * p.splay, 0.03, 0.6 * p.leg_depth)
    outer = slanted_legs((x + w / 2 + p.splay, z), (x + w / 2, z), under, size, size)
    inner = slanted_legs((x - w / 2 - p.splay, z), (x - w / 2, z), under, size, size, first=5)
    beams, rungs = [], []
    for name, side in SIDES:
        beams.append(box(f"beam_{name}", (side * x, FLOOR + under + BEAM / 2, 0), (2 * w, BEAM, p.depth - 0.04)))
        pair = [box("rung", (side * x, FLOOR + 0.3 * under, end * z), rung) for end in (1, -1)]
        rungs.append(joined(f"rung_{name}", *pair))
    return slab(p), *beams, *outer, *inner, *rungs


def cross_legs(p):
    """A top on two pairs of crossed legs, and a stretcher where they cross."""
    under, x = p.height - p.top_thickness, p.width / 2 - p.overhang - p.leg_width / 2
    legs = crossed_legs(x, p.depth / 2 - 0.03 - p.leg_depth / 2, under, (p.leg_width, p.leg_depth))
    size = (2 * x - 3 * p.leg_width, 0.05, 0.03)
    return slab(p), *legs, box("stretcher", (0, FLOOR + under / 2, 0), size)


def picnic(p):
    """A picnic table: planks on slanted legs, and beams between these that carry a seat in front and one behind."""
    planks, y = p.top_thickness, FLOOR + p.seat_height - p.top_thickness
    top = slats("top", 5, 0.012, (0, FLOOR + p.height - planks / 2, 0), (p.width, planks, p.depth))
    z = p.depth / 2 + p.seat_distance + p.seat_depth / 2
    size = (p.width, planks, p.seat_depth)
    seats = [slats(f"seat_{i}", 2, 0.012, (0, y + planks / 2, end * z), size) for i, end in ((1, 1), (2, -1))]
    x, foot = p.width / 2 - p.overhang - p.leg_width / 2, (p.leg_width, p.leg_depth)
    legs = slanted_legs((x, p.depth / 2 + p.seat_distance), (x, p.depth / 2 - 0.08), p.height - planks, foot, foot)
    size = (0.03, 0.05, 2 * z + p.seat_depth - 0.03)
    inside = x - p.leg_width / 2 - 0.015
    return top, *seats, *legs, *(box(f"beam_{name}", (side * inside, y - 0.025, 0), size) for name, side in SIDES)


FAMILIES = (
    Rig(
        "table/trestle",
        TRESTLE,
        trestle,
        (
            ("top", "top"),
            ("stretcher", "stretcher"),
            *((f"{part}_left", f"{part}_right") for part in ("foot", "leg", "beam")),
        ),
        (
            *(Contact(f"foot_{name}", f"leg_{name}", "face_y") for name, _ in SIDES),
            *(Contact(f"leg_{name}", f"beam_{name}", "face_y") for name, _ in SIDES),
            *carry("top", "beam_left", "beam_right"),
            Contact("leg_left", "stretcher", "face_x"),
            Contact("stretcher", "leg_right", "face_x"),
        ),
    ),
    Rig(
        "table/sawhorses",
        SAWHORSES,
        sawhorses,
        (
            ("top", "top"),
            ("beam_left", "beam_right"),
            ("rung_left", "rung_right"),
            *((f"leg_{i}", f"leg_{i + 1}") for i in (1, 3, 5, 7)),
        ),
        (
            *carry("top", "beam_left", "beam_right"),
            *carry("beam_right", "leg_1", "leg_3", "leg_5", "leg_7"),
            *carry("beam_left", "leg_2", "leg_4", "leg_6", "leg_8"),
        ),
    ),
    Rig(
        "table/cross_legs",
        CROSS_LEGS,
        cross_legs,
        (("top", "top"), *SYMMETRIC, ("stretcher", "stretcher")),
        (
            *carry("top"),
            *between_crosses("stretcher"),
        ),
    ),
    Rig(
        "table/picnic",
        PICNIC,
        picnic,
        (("top", "top"), ("seat_1", "seat_1"), ("seat_2", "seat_2"), *SYMMETRIC, ("beam_left", "beam_right")),
        (
            *carry("top"),
            *(Contact(f"beam_{name}", seat, "face_y") for name, _ in SIDES for seat in ("seat_1", "seat_2")),
        ),
    ),
)
