"""Wooden chairs: a dining chair with spindles, a country chair with a ladder back."""

from data_gen.families.chair.pieces import LEGS, MEANINGS, along, bowed, cushion, ends, legs, spindles, strut
from data_gen.families.pieces.legs import carry
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import ellipse, joined, loft, prism, rounded, section
from data_gen.rig import FLOOR, Rig


def dining(p):
    """A dining chair: tapered legs tied by an H of stretchers, and a back of spindles under a bowed rail."""
    seat_y, size = FLOOR + p.seat_height, 2 * (0.5 * p.leg_size,)
    x, z = (p.seat_width - p.leg_size) / 2 - 0.03, (p.seat_depth - p.leg_size) / 2 - 0.03
    places = ends(x, z, p.seat_height - p.seat_thickness, p.leg_splay)
    ties = [along(*place, 0.35) for place in places]
    left = strut("stretcher_left", ties[3], ties[1], size, size, ellipse(8), "z")
    right = strut("stretcher_right", ties[2], ties[0], size, size, ellipse(8), "z")
    cross = along(ties[3], ties[1], 0.5), along(ties[2], ties[0], 0.5)
    middle = strut("stretcher", *cross, size, size, ellipse(8), "x")
    extents = (p.seat_width, p.seat_thickness, p.seat_depth)
    seat = prism("seat", (0, seat_y - p.seat_thickness / 2, 0), extents, "y", rounded(0.15, 4))
    return seat, spindles(p, p.back_lean), *legs(places, p.leg_size), left, right, middle


def ladder_back(p):
    """A country chair: turned legs, the rear ones tall and leaning, with bowed slats and rungs between them."""
    seat_y, half, deep = FLOOR + p.seat_height, (p.seat_width - p.leg_size) / 2, (p.seat_depth - p.leg_size) / 2
    extents = (p.seat_width + 0.02, p.seat_thickness, p.seat_depth + 0.02)
    seat = cushion("seat", (0, seat_y - p.seat_thickness / 2, 0), extents)
    size, short = 2 * (p.leg_size,), p.seat_height - p.seat_thickness
    stubs = [
        strut(name, (x, FLOOR, deep), (x, FLOOR + short, deep), size, size, ellipse(12))
        for name, x in (("leg_1", half), ("leg_2", -half))
    ]
    posts = [_post(p, name, x, -deep) for name, x in (("leg_3", half), ("leg_4", -half))]
    slats = []
    for i, share in enumerate((0.25, 0.5, 0.75, 1.0), start=1):
        y, z = seat_y + share * p.back_height - 0.03, -deep - share * p.back_lean
        slats.append(bowed(f"back_{i}", (-half, y, z), (half, y, z), (0.06, 0.02), p.back_curve))
    return seat, *stubs, *posts, *slats, *_rungs(p, half, deep)


def _post(p, name, x, z):
    """A turned rear leg that goes on above the seat, leaning back, and ends in a knob."""
    found = [section("y", (x, FLOOR, z), (p.leg_size, p.leg_size))]
    for share, above, wide in ((0, 0, 1), (1, 0, 1), (1, 0.01, 0.6), (1, 0.02, 0.6), (1, 0.03, 1), (1, 0.05, 0.5)):
        at = (x, FLOOR + p.seat_height + share * p.back_height + above, z - share * p.back_lean)
        found.append(section("y", at, (wide * p.leg_size, wide * p.leg_size)))
    return loft(name, found, ellipse(12))


def _rungs(p, half, deep):
    """A rung between the front legs and two rungs on either side."""
    size = 2 * (0.6 * p.leg_size,)
    low, high = (FLOOR + share * p.seat_height for share in (0.25, 0.55))
    found = [strut("stretcher_front", (-half, high, deep), (half, high, deep), size, size, ellipse(8), "x")]
    for name, x in (("stretcher_left", -half), ("stretcher_right", half)):
        bars = [strut("rung", (x, y, -deep), (x, y, deep), size, size, ellipse(8), "z") for y in (low, high)]
        found.append(joined(name, *bars))
    return found


FAMILIES = (
    Rig(
        "chair/dining",
        ranges(
            MEANINGS,
            seat_width=(0.36, 0.58),
            seat_height=(0.36, 0.46),
            seat_depth=(0.38, 0.5),
            seat_thickness=(0.02, 0.05),
            back_height=(0.3, 0.52),
            back_thickness=(0.012, 0.036),
            back_lean=(0.02, 0.12),
            back_curve=(0.0, 0.06),
            leg_size=(0.028, 0.065),
            leg_splay=(0.0, 0.05),
        ),
        dining,
        (*itself("seat", "back"), *LEGS, ("stretcher_left", "stretcher_right"), *itself("stretcher")),
        (*carry("seat"), *stack("seat", "back")),
    ),
    Rig(
        "chair/ladder_back",
        ranges(
            MEANINGS,
            seat_width=(0.36, 0.56),
            seat_height=(0.34, 0.44),
            seat_depth=(0.36, 0.48),
            seat_thickness=(0.025, 0.065),
            back_height=(0.32, 0.5),
            back_lean=(0.0, 0.1),
            back_curve=(0.0, 0.06),
            leg_size=(0.026, 0.055),
        ),
        ladder_back,
        (
            *itself("seat", "back_1", "back_2", "back_3", "back_4", "stretcher_front"),
            *LEGS,
            ("stretcher_left", "stretcher_right"),
        ),
        carry("seat", "leg_1", "leg_2"),
    ),
)
