"""What beds share: what they are measured by, a mattress with pillows and a blanket, posts and what is between them."""

from data_gen.families.chair.pieces import corners, cushion, panel
from data_gen.families.pieces.pairs import itself, stack
from data_gen.part import RECTANGLE, box, ellipse, joined, loft, section
from data_gen.rig import FLOOR, Contact

MEANINGS = {
    "bed_width": "edge of the frame along x",
    "bed_length": "edge of the frame along z",
    "frame_height": "from the floor to the upper side of the frame, where the mattress lies",
    "frame_thickness": "edge of the frame along y",
    "mattress_thickness": "edge of the mattress along y",
    "headboard_height": "from the floor to the upper end of the headboard",
    "footboard_height": "from the floor to the upper end of the footboard",
    "board_thickness": "edge of a head- or footboard along z",
    "post_height": "from the floor to the upper end of the posts",
    "post_size": "edge of a post along x and z",
    "leg_size": "edge of a leg along x and z",
    "upper_height": "from the floor to the upper side of the upper frame",
    "guard_height": "from the upper side of the upper frame to the upper side of its guard",
    "open_1": "how far the front right drawer is pulled out",
    "open_2": "how far the front left drawer is pulled out",
    "open_3": "how far the rear right drawer is pulled out",
    "open_4": "how far the rear left drawer is pulled out",
    "roof_height": "edge of the cloth around the roof along y",
    "side_height": "from the upper side of the frame to the upper side of a side",
}
SHEET = 0.012
"""How thick a blanket is."""
BEDDING = (*itself("mattress", "blanket"), ("pillow_left", "pillow_right"))
"""Which parts of it mirror each other."""
LIE = (*stack("frame", "mattress", "pillow_left"), *stack("mattress", "pillow_right"))
"""What lies on what."""
POSTS = (("post_1", "post_2"), ("post_3", "post_4"))
AT_POSTS = (
    *(Contact("frame", f"post_{i}", "face_z") for i in (1, 2)),
    *(Contact(f"post_{i}", "frame", "face_z") for i in (3, 4)),
)
AT_HEAD, AT_FOOT = Contact("headboard", "frame", "face_z"), Contact("frame", "footboard", "face_z")


def bedding(p, width, length):
    """A mattress on the frame, two pillows in the rear and a blanket that hangs over the other two thirds."""
    y = FLOOR + p.frame_height
    extents = (width, p.mattress_thickness, length)
    mattress = cushion("mattress", (0, y + p.mattress_thickness / 2, 0), extents, corner=0.05)
    top = y + p.mattress_thickness
    size = (0.4 * width, 0.05, 0.13)
    left, right = (
        cushion(name, (side * 0.24 * width, top + 0.025, 0.085 - length / 2), size, corner=0.25)
        for name, side in (("pillow_left", -1), ("pillow_right", 1))
    )
    return mattress, left, right, _blanket(p, width, length, top)


def _blanket(p, width, length, top):
    """A cloth over the front of the mattress: upon it, down its sides, and turned down near the pillows."""
    deep, z, low = 0.7 * length, 0.15 * length, 0.6 * p.mattress_thickness
    over = box("over", (0, top + SHEET / 2, z), (width + 2 * SHEET, SHEET, deep))
    sides = [box("side", (side * (width + SHEET) / 2, top - low / 2, z), (SHEET, low, deep)) for side in (-1, 1)]
    fold = cushion("fold", (0, top + 1.5 * SHEET, z - deep / 2 + 0.05), (width + 2 * SHEET, SHEET, 0.1), corner=0.05)
    return joined("blanket", over, *sides, fold)


def posts(p, stops, outline=None):
    """Four posts at the corners: 1 and 2 in front, 1 and 3 at x > 0; stops are (y, share of their size) from below."""
    outline, found = ellipse(12) if outline is None else outline, []
    for i, (x, z) in enumerate(corners((p.bed_width - p.post_size) / 2, (p.bed_length - p.post_size) / 2), start=1):
        rings = [section("y", (x, y, z), (share * p.post_size, share * p.post_size)) for y, share in stops]
        found.append(loft(f"post_{i}", rings, outline))
    return found


def between_posts(p):
    """The frame, as wide as the bed, from the rear posts to the front ones."""
    y = FLOOR + p.frame_height - p.frame_thickness / 2
    return box("frame", (0, y, 0), (p.bed_width, p.frame_thickness, inner(p)))


def inner(p):
    """How far the front posts stand from the rear ones."""
    return p.bed_length - 2 * p.post_size


def board(p, name, end, high, corner=0.15):
    """A board between two posts at an end of the frame, from its lower side up, with round corners."""
    low, wide = p.frame_height - p.frame_thickness, p.bed_width - 2 * p.post_size
    foot = (0, FLOOR + low, end * (inner(p) + p.board_thickness) / 2)
    return panel(name, foot, (wide, wide), high - low, p.board_thickness, corner=corner, outline=RECTANGLE)
