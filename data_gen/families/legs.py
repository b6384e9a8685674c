"""Four legs at the corners of a rectangle, as tables and chairs have them."""

from data_gen.part import Box
from data_gen.rig import FLOOR, Contact, Parameter

LEG_WIDTH = Parameter("leg_width", 0.03, 0.12, "edge of a leg along x")
LEG_DEPTH = Parameter("leg_depth", 0.03, 0.12, "edge of a leg along z")
SYMMETRIC = (("leg_1", "leg_2"), ("leg_3", "leg_4"))


def four_legs(p, width, depth, height):
    """Legs from the floor to `height`, flush with a rectangle; 1 and 2 stand in front (z > 0), 1 and 3 at x > 0."""
    x, z = (width - p.leg_width) / 2, (depth - p.leg_depth) / 2
    feet = [(x, z), (-x, z), (x, -z), (-x, -z)]
    size = (p.leg_width, height, p.leg_depth)
    return tuple(Box(f"leg_{i}", (x, FLOOR + height / 2, z), size) for i, (x, z) in enumerate(feet, start=1))


def carry(part):
    """The contacts of a part that stands on the four legs."""
    return tuple(Contact(f"leg_{i}", part, "face_y") for i in (1, 2, 3, 4))
