"""What cabinets share: the meaning of their parameters, and the body with what is above and below it."""

from data_gen.families.pieces.casework import WALL, drawer, knob, pulled
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.soft import between
from data_gen.part import box
from data_gen.rig import Contact

MEANINGS = {
    "width": "edge of the body along x",
    "height": "from the floor to the upper side of the top",
    "depth": "edge of the body along z, without the fronts",
    "top_thickness": "edge of the top along y",
    "top_overhang": "how far the top stands out to the sides and in front",
    "leg_height": "from the floor to the lower side of the body",
    "leg_splay": "how much farther out a leg stands on the floor, along x and z",
    "plinth_height": "from the floor to the upper side of the plinth",
    "door_width": "edge of a door along x",
    "drawer_height": "edge of the front of a drawer along y",
    "counter_height": "from the floor to the upper side of the counter",
    "rack_depth": "edge of the rack of shelves along z",
    "bar_width": "edge of the bars around the glass of a door",
    "screen_width": "edge of the television along x",
    **{f"open_{i}": f"how far drawer {i} is pulled out" for i in range(1, 5)},
}
LOW = {"top_thickness": (0.012, 0.035), "top_overhang": (0.0, 0.02)}
"""The ranges of the tops of low cabinets."""
MIDDLE = itself("body", "top")
DOORS = (("door_left", "door_right"),)
TOP = Contact("body", "top", "face_y")
PLINTH = Contact("plinth", "body", "face_y")


def spans(p, low):
    """The body between a height and the top, as spans along x, y and z."""
    return (-p.width / 2, p.width / 2), (low, p.height - p.top_thickness), (-p.depth / 2, p.depth / 2)


def top(p, overhang):
    """A board on the body, which stands out over the fronts."""
    half, front = p.width / 2 + overhang, p.depth / 2 + WALL + overhang
    return box("top", *between((-half, half), (p.height - p.top_thickness, p.height), (-p.depth / 2, front)))


def plinth(p, recess=0.02):
    """A block under the body, a little set back."""
    half, front = p.width / 2 - recess, p.depth / 2 - recess
    return box("plinth", *between((-half, half), (0, p.plinth_height), (-p.depth / 2, front)))


def cut(span, shares):
    """A span cut into parts of these shares."""
    found, low, length = [], span[0], span[1] - span[0]
    for share in shares:
        found.append((low, low + share * length))
        low = low + share * length
    return found


def drawers(p, x, y, z, shares, handles):
    """Drawers that fill a body from below, and their slides; `handles` makes what is on a front from its middle."""
    found = []
    for i, height in enumerate(cut(y, shares), start=1):
        front = handles(p, (height[0] + height[1]) / 2, z[1] + WALL)
        found.append(drawer(f"drawer_{i}", x, height, z[1], p.depth - 2 * WALL, front))
        found.append(pulled(i, p, x, height, z[1]))
    return found


def two_knobs(p, height, face):
    """Knobs left and right of the middle of a front."""
    return [knob(share * p.width, height, face) for share in (-0.26, 0.26)]


def on_front(*parts):
    """The contacts of closed fronts with the body behind them."""
    return tuple(Contact("body", part, "face_z") for part in parts)
