"""Tables with drawers that slide out: a desk and a console."""

from data_gen.families.pieces.casework import WALL, drawer, knob, pulled, shell
from data_gen.families.pieces.legs import SYMMETRIC, carry, slanted_legs
from data_gen.families.pieces.ranges import ranges
from data_gen.families.table.tops import MEANINGS, slab
from data_gen.part import box
from data_gen.rig import FLOOR, Contact, Rig

DESK = ranges(
    MEANINGS,
    width=(0.75, 1.0),
    height=(0.42, 0.58),
    depth=(0.4, 0.52),
    top_thickness=(0.02, 0.045),
    body_width=(0.22, 0.34),
    leg_width=(0.025, 0.08),
    leg_depth=(0.025, 0.1),
    open_1=(0.0, 0.18),
    open_2=(0.0, 0.18),
    open_3=(0.0, 0.18),
)
CONSOLE = ranges(
    MEANINGS,
    width=(0.7, 1.0),
    height=(0.45, 0.65),
    depth=(0.24, 0.36),
    top_thickness=(0.018, 0.04),
    overhang=(0.015, 0.04),
    body_height=(0.09, 0.14),
    leg_width=(0.03, 0.065),
    tip_width=(0.014, 0.03),
    open_1=(0.0, 0.12),
    open_2=(0.0, 0.12),
)


def desk(p):
    """A desk: a body with three drawers on the right, two legs on the left, and a board behind the knees."""
    under, z = p.height - p.top_thickness, p.depth / 2 - 0.015
    right, left = p.width / 2 - 0.005, p.width / 2 - p.body_width
    body = shell("body", (left, right), (0, under), (-z, z))
    leg, x = (p.leg_width, under, p.leg_depth), (p.leg_width - p.width) / 2
    legs = [box(f"leg_{i}", (x, FLOOR + under / 2, end * (z - p.leg_depth / 2)), leg) for i, end in ((2, 1), (4, -1))]
    inner = p.leg_width - p.width / 2
    back = box("back", ((inner + left) / 2, FLOOR + 0.75 * under, 0.01 - z), (left - inner, under / 2, 0.02))
    thirds = [((left, right), (i * under / 3, (i + 1) * under / 3)) for i in (0, 1, 2)]
    return slab(p), body, *legs, back, *_drawers(p, thirds, z)


def console(p):
    """A narrow table with two drawers side by side in its body, on four legs that taper."""
    under, x, z = p.height - p.top_thickness, p.width / 2 - p.overhang, p.depth / 2 - p.overhang
    low = under - p.body_height
    body = shell("body", (-x, x), (low, under), (-z, z))
    halves = [((0, x), (low, under)), ((-x, 0), (low, under))]
    tip, head = p.tip_width / 2, p.leg_width / 2
    sizes = (p.tip_width, p.tip_width), (p.leg_width, p.leg_width)
    return slab(p), body, *slanted_legs((x - tip, z - tip), (x - head, z - head), low, *sizes), *_drawers(p, halves, z)


def _drawers(p, fronts, z):
    """Drawers whose fronts, spans along x and of height, lie before the plane z; and their slides."""
    found = []
    for i, (x, y) in enumerate(fronts, start=1):
        handle = knob((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, z + WALL, 0.02)
        found += [drawer(f"drawer_{i}", x, y, z, 2 * z - 2 * WALL, [handle]), pulled(i, p, x, y, z)]
    return found


FAMILIES = (
    Rig(
        "table/desk",
        DESK,
        desk,
        (("top", "top"),),
        (
            *carry("top", "body", "leg_2", "leg_4", "back"),
            Contact("back", "body", "face_x"),
            Contact("leg_4", "back", "face_x"),
        ),
    ),
    Rig(
        "table/console",
        CONSOLE,
        console,
        (("top", "top"), ("body", "body"), *SYMMETRIC, ("drawer_1", "drawer_2")),
        (*carry("body"), Contact("body", "top", "face_y")),
    ),
)
