"""Tables on four legs of a kind: splayed, turned, of two rods; and on two closed frames."""

from data_gen.families.pieces.legs import CORNERS, SIDES, SYMMETRIC, carry, loop, slanted_legs
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.turned import turned
from data_gen.families.table.tops import MEANINGS, slab
from data_gen.part import box, ellipse, joined, loft, rounded, section
from data_gen.rig import FLOOR, Contact, Rig

SPLAYED = ranges(
    MEANINGS,
    width=(0.6, 0.95),
    height=(0.35, 0.6),
    depth=(0.45, 0.7),
    top_thickness=(0.025, 0.05),
    overhang=(0.06, 0.12),
    leg_width=(0.04, 0.08),
    tip_width=(0.014, 0.04),
    splay=(0.02, 0.08),
)
FARMHOUSE = ranges(
    MEANINGS,
    width=(0.7, 1.0),
    height=(0.45, 0.65),
    depth=(0.45, 0.7),
    top_thickness=(0.02, 0.05),
    overhang=(0.02, 0.08),
    leg_width=(0.055, 0.1),
    apron_height=(0.05, 0.1),
)
HAIRPIN = ranges(
    MEANINGS,
    width=(0.6, 1.0),
    height=(0.25, 0.5),
    depth=(0.35, 0.6),
    top_thickness=(0.02, 0.06),
    overhang=(0.02, 0.08),
    rod_width=(0.01, 0.026),
    rod_spread=(0.05, 0.12),
)
SLED = ranges(
    MEANINGS,
    width=(0.6, 1.0),
    height=(0.35, 0.6),
    depth=(0.4, 0.65),
    top_thickness=(0.02, 0.05),
    overhang=(0.02, 0.08),
    frame_width=(0.03, 0.08),
    frame_thickness=(0.015, 0.045),
    stretcher_height=(0.15, 0.25),
)
BALUSTER = ((0, 0.5), (0.05, 0.75), (0.1, 0.5), (0.42, 0.72), (0.6, 0.95), (0.64, 0.62), (0.68, 1), (1, 1))
"""Height and width of a turned leg, as shares of its whole height and its largest width."""


def splayed(p):
    """A rounded top on four round legs that taper and stand astride."""
    x, z = (edge / 2 - p.overhang - p.leg_width / 2 for edge in (p.width, p.depth))
    low, high = (p.tip_width, p.tip_width), (p.leg_width, p.leg_width)
    legs = slanted_legs((x + p.splay, z + p.splay), (x, z), p.height - p.top_thickness, low, high, ellipse(12))
    return slab(p, rounded(0.2, 4)), *legs


def farmhouse(p):
    """A top on turned legs, an apron between them."""
    under, w = p.height - p.top_thickness, p.leg_width
    x, z = (edge / 2 - p.overhang - w / 2 for edge in (p.width, p.depth))
    profile = [(FLOOR + share * under, wide * w) for share, wide in BALUSTER]
    legs = [turned(f"leg_{i}", profile, side * x, end * z, 12) for i, (side, end) in enumerate(CORNERS, start=1)]
    y = FLOOR + under - p.apron_height / 2
    long = [box("apron", (0, y, end * z), (2 * x, p.apron_height, 0.02)) for end in (1, -1)]
    short = [box("apron", (side * x, y, 0), (0.02, p.apron_height, 2 * z)) for side in (1, -1)]
    return slab(p), *legs, joined("apron", *long, *short)


def hairpin(p):
    """A low slab on four legs, each of two thin rods that meet at the floor."""
    x, z = (edge / 2 - p.overhang - p.rod_width / 2 for edge in (p.width, p.depth))
    under, size, legs = FLOOR + p.height - p.top_thickness, (p.rod_width, p.rod_width), []
    for i, (side, end) in enumerate(CORNERS, start=1):
        foot = section("y", (side * x, FLOOR, end * z), size)
        heads = [(side * (x - p.rod_spread), under, end * z), (side * x, under, end * (z - p.rod_spread))]
        rods = [loft("rod", [foot, section("y", head, size)], ellipse(8)) for head in heads]
        legs.append(joined(f"leg_{i}", *rods))
    return slab(p), *legs


def sled(p):
    """A top on two closed frames that lie on the floor like runners, and a stretcher between them."""
    under, depth = p.height - p.top_thickness, p.depth - 2 * p.overhang
    x, bar = p.width / 2 - p.overhang - p.frame_width / 2, (p.frame_width, p.frame_thickness)
    centres = [(f"frame_{name}", (side * x, FLOOR + under / 2, 0)) for name, side in SIDES]
    frames = [loop(name, "x", centre, (under, depth), bar, 0.05) for name, centre in centres]
    behind = (0, FLOOR + p.stretcher_height, (p.frame_thickness - depth) / 2)
    return slab(p), *frames, box("stretcher", behind, (2 * x - p.frame_width, 0.04, p.frame_thickness))


TOP = (("top", "top"), *SYMMETRIC)
FAMILIES = (
    Rig("table/splayed", SPLAYED, splayed, TOP, carry("top")),
    Rig(
        "table/farmhouse",
        FARMHOUSE,
        farmhouse,
        (*TOP, ("apron", "apron")),
        (*carry("top"), Contact("apron", "top", "face_y")),
    ),
    Rig("table/hairpin", HAIRPIN, hairpin, TOP, carry("top")),
    Rig(
        "table/sled",
        SLED,
        sled,
        (("top", "top"), ("frame_left", "frame_right"), ("stretcher", "stretcher")),
        (
            *carry("top", "frame_left", "frame_right"),
            Contact("frame_left", "stretcher", "face_x"),
            Contact("stretcher", "frame_right", "face_x"),
        ),
    ),
)
