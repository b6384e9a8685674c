"""The smallest family possible: one box, three parameters."""

from data_gen.part import box
from data_gen.rig import FLOOR, Parameter, Rig

BOX = (
    Parameter("width", 0.3, 1.0, "edge along x"),
    Parameter("height", 0.3, 1.0, "edge along y"),
    Parameter("depth", 0.3, 1.0, "edge along z"),
)


def one(p):
    """A box that stands on the floor."""
    return (box("body", centre=(0, FLOOR + p.height / 2, 0), extents=(p.width, p.height, p.depth)),)


FAMILIES = (Rig("box/one", BOX, one, (("body", "body"),)),)
