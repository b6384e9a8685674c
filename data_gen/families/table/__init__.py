"""Tables. `table/four_legs` is the paper's procedural table (section 4.4): a rectangular top, a leg at each corner."""

from data_gen.families.pieces.legs import SYMMETRIC, carry, four_legs
from data_gen.families.pieces.ranges import ranges
from data_gen.families.table import curved, drawers, legs, trestle
from data_gen.families.table.tops import MEANINGS, slab
from data_gen.part import box
from data_gen.rig import FLOOR, Contact, Rig

TABLE = ranges(
    MEANINGS,
    width=(0.5, 1.0),
    height=(0.4, 1.0),
    depth=(0.4, 1.0),
    top_thickness=(0.02, 0.1),
    leg_width=(0.03, 0.12),
    leg_depth=(0.03, 0.12),
)
SHELF = ranges(MEANINGS, shelf_height=(0.08, 0.25), shelf_thickness=(0.02, 0.06))
TWO_SHELVES = ranges(
    MEANINGS,
    width=(0.4, 0.75),
    height=(0.6, 0.95),
    depth=(0.28, 0.45),
    top_thickness=(0.02, 0.05),
    leg_width=(0.025, 0.065),
    leg_depth=(0.025, 0.065),
    shelf_height=(0.08, 0.2),
    shelf_thickness=(0.015, 0.05),
    shelf_distance=(0.18, 0.3),
)


def with_four_legs(p):
    """A top on four legs that are flush with its corners."""
    return slab(p), *four_legs(p, p.width, p.depth, p.height - p.top_thickness)


def with_shelf(p):
    """A table with a shelf between its legs, as deep as the top, that touches the inner sides of all four."""
    return *with_four_legs(p), _shelf("shelf", p, p.shelf_height)


def with_two_shelves(p):
    """A tall, slender table with two shelves between its legs."""
    upper = p.shelf_height + p.shelf_distance
    return *with_four_legs(p), _shelf("shelf_1", p, p.shelf_height), _shelf("shelf_2", p, upper)


def _shelf(name, p, height):
    """A shelf between legs that are flush with the top."""
    middle = (0, FLOOR + height - p.shelf_thickness / 2, 0)
    return box(name, middle, (p.width - 2 * p.leg_width, p.shelf_thickness, p.depth))


def _between_legs(shelf):
    """The contacts of a shelf with the inner sides of the legs."""
    right = (Contact(shelf, leg, "face_x") for leg in ("leg_1", "leg_3"))
    left = (Contact(leg, shelf, "face_x") for leg in ("leg_2", "leg_4"))
    return *right, *left


TOP = (("top", "top"), *SYMMETRIC)
FAMILIES = (
    Rig("table/four_legs", TABLE, with_four_legs, TOP, carry("top")),
    Rig(
        "table/shelf",
        TABLE + SHELF,
        with_shelf,
        (*TOP, ("shelf", "shelf")),
        carry("top") + _between_legs("shelf"),
    ),
    Rig(
        "table/two_shelves",
        TWO_SHELVES,
        with_two_shelves,
        (*TOP, ("shelf_1", "shelf_1"), ("shelf_2", "shelf_2")),
        carry("top") + _between_legs("shelf_1") + _between_legs("shelf_2"),
    ),
    *legs.FAMILIES,
    *curved.FAMILIES,
    *trestle.FAMILIES,
    *drawers.FAMILIES,
)
