"""The tops of tables, and what all tables are measured by."""

from data_gen.families.pieces.legs import LEG_DEPTH, LEG_WIDTH
from data_gen.part import RECTANGLE, ellipse, loft, prism, section
from data_gen.rig import FLOOR

MEANINGS = {
    "width": "edge of the top along x",
    "height": "from the floor to the upper side of the top",
    "depth": "edge of the top along z",
    "top_thickness": "edge of the top along y",
    "overhang": "how far the top reaches beyond what carries it",
    "leg_width": LEG_WIDTH.meaning,
    "leg_depth": LEG_DEPTH.meaning,
    "tip_width": "edge along x of the lower end of a leg that tapers",
    "splay": "how far the foot of a leg stands outside its upper end, along each axis it leans",
    "shelf_height": "from the floor to the upper side of the lowest shelf",
    "shelf_thickness": "edge of a shelf along y",
    "shelf_distance": "from the upper side of a shelf to that of the next",
    "apron_height": "edge of the apron along y",
    "rod_width": "thickness of a rod",
    "rod_spread": "how far apart the two rods of a leg are under the top",
    "frame_width": "edge of a frame along x",
    "frame_thickness": "thickness of the bar of a frame, seen along x",
    "stretcher_height": "from the floor to the middle of the stretcher",
    "column_width": "width of the column where it is thinnest",
    "foot_width": "edge along x of the foot, or of all feet together",
    "foot_height": "edge of a foot along y",
    "foot_depth": "edge of a foot along z",
    "seat_height": "from the floor to the upper side of a seat",
    "seat_depth": "edge of a seat along z",
    "seat_distance": "along z from the top to a seat",
    "body_width": "edge of the body along x",
    "body_height": "edge of the body along y",
    "open_1": "how far drawer 1 is pulled out",
    "open_2": "how far drawer 2 is pulled out",
    "open_3": "how far drawer 3 is pulled out",
}


def slab(p, outline=RECTANGLE):
    """A flat top."""
    middle = FLOOR + p.height - p.top_thickness / 2
    return prism("top", (0, middle, 0), (p.width, p.top_thickness, p.depth), "y", outline)


def disc(p):
    """A round top, its edge eased."""
    eased = ((1.0, 0.03), (0.65, 0.0), (0.3, 0.0), (0.0, 0.012))
    places = [(FLOOR + p.height - down * p.top_thickness, p.width - off) for down, off in eased]
    return loft("top", [section("y", (0, y, 0), (width, width)) for y, width in places], ellipse(32))
