"""Tables. `table/four_legs` is the paper's procedural table (section 4.4): a rectangular top, a leg at each corner."""

from data_gen.families.legs import LEG_DEPTH, LEG_WIDTH, SYMMETRIC, carry, four_legs
from data_gen.part import Box
from data_gen.rig import FLOOR, Contact, Parameter, Rig

TABLE = (
    Parameter("width", 0.5, 1.0, "edge of the top along x"),
    Parameter("height", 0.4, 1.0, "from the floor to the upper side of the top"),
    Parameter("depth", 0.4, 1.0, "edge of the top along z"),
    Parameter("top_thickness", 0.02, 0.1, "edge of the top along y"),
    LEG_WIDTH,
    LEG_DEPTH,
)
SHELF = (
    Parameter("shelf_height", 0.08, 0.25, "from the floor to the upper side of the shelf"),
    Parameter("shelf_thickness", 0.02, 0.06, "edge of the shelf along y"),
)


def with_four_legs(p):
    """A top on four legs that are flush with its corners."""
    top = Box(
        "top",
        centre=(0, FLOOR + p.height - p.top_thickness / 2, 0),
        extents=(p.width, p.top_thickness, p.depth),
    )
    return top, *four_legs(p, p.width, p.depth, p.height - p.top_thickness)


def with_shelf(p):
    """A table with a shelf between its legs, as deep as the top, that touches the inner sides of all four."""
    shelf = Box(
        "shelf",
        centre=(0, FLOOR + p.shelf_height - p.shelf_thickness / 2, 0),
        extents=(p.width - 2 * p.leg_width, p.shelf_thickness, p.depth),
    )
    return *with_four_legs(p), shelf


ON_SHELF_SIDES = (
    Contact("shelf", "leg_1", "face_x"),
    Contact("leg_2", "shelf", "face_x"),
    Contact("shelf", "leg_3", "face_x"),
    Contact("leg_4", "shelf", "face_x"),
)
FAMILIES = (
    Rig("table/four_legs", TABLE, with_four_legs, (("top", "top"), *SYMMETRIC), carry("top")),
    Rig(
        "table/shelf",
        TABLE + SHELF,
        with_shelf,
        (("top", "top"), *SYMMETRIC, ("shelf", "shelf")),
        carry("top") + ON_SHELF_SIDES,
    ),
)
