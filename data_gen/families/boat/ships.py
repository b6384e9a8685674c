"""Ships: a passenger ship, a freighter."""

from data_gen.families.boat.pieces import house, hull, mast, ranges
from data_gen.part import ball, box, ellipse, joined, loft, mirrored, section
from data_gen.rig import FLOOR, Contact, Rig

SHIP = (
    (-0.5, 0.7, 0.5, 0.3),
    (-0.47, 0.82, 0.33, 0.2),
    (-0.43, 0.92, 0.17, 0.1),
    (-0.34, 1, 0, 0),
    (0.2, 1, 0, 0),
    (0.28, 0.93, 0, 0.13),
    (0.35, 0.79, 0, 0.32),
    (0.41, 0.59, 0.04, 0.54),
    (0.46, 0.34, 0.17, 0.77),
    (0.5, 0.05, 0.5, 1),
)


def liner(p):
    """A passenger ship: cabins in two decks, a bridge, two funnels, a mast, and boats along both sides."""
    deck, top, wide = FLOOR + p.hull_height, FLOOR + p.hull_height + p.cabin_height, p.hull_width
    middle, tier = -0.06 * p.hull_length, 0.5 * p.cabin_height
    front = middle + 0.5 * p.cabin_length - 0.12
    return (
        hull(p, "hull", SHIP, FLOOR),
        box("cabin_1", (0, deck + tier / 2, middle), (0.84 * wide, tier, p.cabin_length)),
        box("cabin_2", (0, deck + 1.5 * tier, middle - 0.02), (0.66 * wide, tier, p.cabin_length - 0.08)),
        _bridge(p, top, 0.9 * wide, front),
        _funnel(p, "funnel_1", top, middle + 0.06 * p.cabin_length),
        _funnel(p, "funnel_2", top, middle - 0.22 * p.cabin_length),
        mast(p, top + p.bridge_height, front - 0.01),
        *_lifeboats(p, deck + tier, middle),
    )


def freighter(p):
    """A freighter: containers before and behind a house with the bridge on top, a funnel, a mast."""
    deck, long, wide = FLOOR + p.hull_height, p.hull_length, p.hull_width
    high, z = p.cargo_height + 0.02, -0.24 * long
    top = deck + high
    stacks = [
        _containers(p, f"cargo_{i}", deck, at * long, 0.14 * long - 0.01)
        for i, at in enumerate((0.21, 0.07, -0.07, -0.41), start=1)
    ]
    return (
        hull(p, "hull", SHIP, FLOOR),
        box("cabin_1", (0, deck + high / 2, z), (0.8 * wide, high, 0.13 * long)),
        _bridge(p, top, 0.98 * wide, z + 0.02),
        _funnel(p, "funnel_1", top, z - 0.04 * long),
        mast(p, top + p.bridge_height, z + 0.015),
        *stacks,
    )


def _bridge(p, low, wide, z):
    """The bridge, its glass leaning back."""
    spans = ((z - 0.05, z + 0.05), (z - 0.05, z + 0.035))
    return house("bridge", (low, low + p.bridge_height), (wide, 0.94 * wide), spans)


def _funnel(p, name, low, z):
    """A funnel that leans back."""
    cuts = [section("y", (0, low + up * p.funnel_height, z - 0.03 * up), (0.05, 0.075 - 0.01 * up)) for up in (0, 1)]
    return loft(name, cuts, ellipse(16))


def _lifeboats(p, low, middle):
    """Three boats that stand on the lower cabins along each side."""
    size = (0.08 * p.hull_width + 0.008, 0.024, 0.075)
    at = [(0.375 * p.hull_width, low + 0.012, middle - 0.02 + share * p.cabin_length) for share in (-0.28, -0.04, 0.2)]
    right = joined("lifeboat_right", *(ball("boat", spot, size, 8, 6) for spot in at))
    return mirrored(right, "lifeboat_left"), right


def _containers(p, name, low, z, long):
    """Three containers side by side, the middle one highest."""
    wide = 0.28 * p.hull_width
    rows = [(x * (wide + 0.004), share * p.cargo_height) for x, share in ((-1, 0.67), (0, 1), (1, 0.67))]
    return joined(name, *(box("container", (x, low + high / 2, z), (wide, high, long)) for x, high in rows))


LINER = ranges(
    hull_length=(0.8, 1.0),
    hull_width=(0.15, 0.25),
    hull_height=(0.08, 0.16),
    bow_rise=(0.02, 0.09),
    cabin_length=(0.4, 0.58),
    cabin_height=(0.07, 0.17),
    bridge_height=(0.03, 0.07),
    funnel_height=(0.09, 0.17),
    mast_height=(0.1, 0.2),
)
FREIGHTER = ranges(
    hull_length=(0.76, 1.0),
    hull_width=(0.15, 0.25),
    hull_height=(0.08, 0.17),
    bow_rise=(0.02, 0.09),
    cargo_height=(0.05, 0.16),
    bridge_height=(0.03, 0.06),
    funnel_height=(0.05, 0.14),
    mast_height=(0.06, 0.18),
)
MAST = Contact("bridge", "mast", "face_y")
TOWER = (Contact("cabin_1", "bridge", "face_y"), Contact("cabin_1", "funnel_1", "face_y"), MAST)
DECKS = (
    *(Contact("cabin_2", name, "face_y") for name in ("bridge", "funnel_1", "funnel_2")),
    *(Contact("cabin_1", name, "face_y") for name in ("cabin_2", "lifeboat_left", "lifeboat_right")),
    MAST,
)
ABOARD = tuple((name, name) for name in ("hull", "cabin_1", "bridge", "funnel_1", "mast"))
CARGO = tuple((f"cargo_{i}", f"cargo_{i}") for i in (1, 2, 3, 4))
LIFE = (("cabin_2", "cabin_2"), ("funnel_2", "funnel_2"), ("lifeboat_left", "lifeboat_right"))
SHIPS = (
    Rig("boat/liner", LINER, liner, ABOARD + LIFE, DECKS),
    Rig("boat/freighter", FREIGHTER, freighter, ABOARD + CARGO, TOWER),
)
