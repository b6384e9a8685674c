"""Ovens: hollow bodies with a door on a hinge: a microwave, whose door swings aside, and a cooker, whose door drops."""

from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.joint import hinge, slide
from data_gen.part import box, cylinder, joined, loft, section
from data_gen.rig import FLOOR, Contact, Parameter, Rig

MEANINGS = {
    "width": "edge of the body along x",
    "height": "from the floor to the upper side of the body",
    "depth": "edge of the body along z",
    "door_thickness": "edge of the door along z while it is closed",
    "window_margin": "from the edges of the door to its window",
    "panel_width": "from the door to the right edge of the body",
    "drawer_height": "edge of the drawer's front along y",
    "panel_height": "from the door to the upper side of the body",
    "splash_height": "from the body to the upper edge of the board behind the plates",
}
WALL, REAR, GAP = 0.025, -0.46, 0.004
"""Thickness of a wall; z of the rear, so far back that an open door stays inside; a gap beside a front."""


def hollow(p, low, high, right=WALL):
    """A box between two heights, open to the front; its wall on the right has its own thickness."""
    y, front, x = (low + high) / 2, REAR + p.depth, (WALL - right) / 2
    outer, inner = (p.width, high - low), (p.width - WALL - right, high - low - 2 * WALL)
    steps = ((0, y, REAR), outer), ((0, y, front), outer), ((x, y, front), inner), ((x, y, REAR + WALL), inner)
    return loft("body", [section("z", centre, size) for centre, size in steps])


def front(p, name, x, low, width, height):
    """A board on the front of the body, around x, from a height up."""
    return box(name, (x, low + height / 2, REAR + p.depth + p.door_thickness / 2), (width, height, p.door_thickness))


def pane(p, name, x, y, width, height):
    """A pane in a door that stands out a little on both of its sides."""
    return box(name, (x, y, REAR + p.depth + p.door_thickness / 2), (width, height, p.door_thickness + 0.008))


def grip(p, name, centre, length, axis):
    """A round bar on two posts on the front of a door; `centre` is x and y."""
    x, y = centre
    z = REAR + p.depth + p.door_thickness
    upright = axis == "y"
    size = (0.018, length, 0.018) if upright else (length, 0.018, 0.018)
    ends = [(x, y + s * length) if upright else (x + s * length, y) for s in (-0.4, 0.4)]
    posts = [box("post", (*at, z + 0.011), (0.014, 0.014, 0.022)) for at in ends]
    return joined(name, cylinder("bar", (x, y, z + 0.029), size, axis, 12), *posts)


def microwave(p):
    """A body with a door on its left edge and a glass plate behind it, and beside the door keys and a knob."""
    width, z = p.width - p.panel_width, REAR + p.depth
    x, y, right = -p.panel_width / 2, FLOOR + p.height / 2, (p.width - p.panel_width) / 2
    size = width - 2 * p.window_margin - 0.04, p.height - 2 * p.window_margin
    door = front(p, "door", x, FLOOR, width, p.height), pane(p, "window", x - 0.02, y, *size)
    handle = grip(p, "handle", (right - p.panel_width / 2 - 0.03, y), 0.7 * p.height, "y")
    turn = hinge("door_hinge", OPENED, "body", (0, -1, 0), (-p.width / 2, y, z), p.door_angle)
    plate = cylinder("plate", (x, FLOOR + WALL + 0.008, z - p.depth / 2), (0.3, 0.016, 0.3), "y", 24)
    keys = joined("keys", *(key(right, y + 0.04, z, i, j) for i in (-1, 0, 1) for j in range(-1, 3)))
    body = hollow(p, FLOOR, FLOOR + p.height, p.panel_width)
    return body, *door, handle, plate, keys, knob("knob", right, y - 0.08, z, 0.07), turn


OPENED = ("door", "window", "handle")
"""What turns with a door."""


def knob(name, x, y, z, size):
    """A round knob on the front."""
    return cylinder(name, (x, y, z + 0.012), (size, size, 0.024), "z", 16)


def key(x, y, z, column, row):
    """One key of a panel."""
    return box("key", (x + 0.032 * column, y + 0.032 * row, z + 0.004), (0.022, 0.022, 0.008))


def cooker(p):
    """A body with four plates on top, knobs in front, a door that drops, and below it a drawer."""
    z, top, low = REAR + p.depth, FLOOR + p.height, FLOOR + p.drawer_height + GAP
    feet = [(x, z) for z in (1, -1) for x in (1, -1)]
    plates = [plate(p, f"plate_{i}", *foot, top) for i, foot in enumerate(feet, start=1)]
    knobs = [knob("knob", s * p.width, top - p.panel_height / 2, z, 0.05) for s in (-0.36, -0.18, 0, 0.18, 0.36)]
    splash = box("splash", (0, top + p.splash_height / 2, REAR + 0.012), (p.width, p.splash_height, 0.024))
    body = joined("body", hollow(p, FLOOR, low), hollow(p, low, top))
    pull = slide("drawer_slide", ["drawer"], "body", (0, 0, 1), (0, FLOOR + p.drawer_height / 2, z), p.drawer_out)
    return body, *dropping(p, low), *plates, joined("knobs", *knobs), splash, drawer(p, p.width - 2 * GAP), pull


def dropping(p, low):
    """A door with its window and handle, and the hinge along its lower edge."""
    height, wide = p.height - p.drawer_height - p.panel_height - 2 * GAP, p.width - 2 * GAP
    size = wide - 2 * p.window_margin, height - 2 * p.window_margin - 0.04
    window = pane(p, "window", 0, low + height / 2 - 0.02, *size)
    handle = grip(p, "handle", (0, low + height - 0.03), 0.7 * p.width, "x")
    turn = hinge("door_hinge", OPENED, "body", (1, 0, 0), (0, low, REAR + p.depth), p.door_angle)
    return front(p, "door", 0, low, wide, height), window, handle, turn


def plate(p, name, x, z, low):
    """A round plate to cook on."""
    centre = (0.23 * x * p.width, low + 0.006, REAR + 0.53 * p.depth + 0.21 * z * p.depth)
    return cylinder(name, centre, (0.34 * p.width, 0.012, 0.32 * p.depth), "y", 24)


def drawer(p, wide):
    """A drawer open above: its front covers the body's, its box runs back inside."""
    z, low = REAR + p.depth, FLOOR + WALL + 0.004
    board = front(p, "front", 0, FLOOR, wide, p.drawer_height)
    y, high = low, FLOOR + p.drawer_height - WALL
    size, inner, length = p.width - 2 * WALL - 0.02, p.width - 2 * WALL - 0.04, 0.8 * p.depth
    steps = (y, size, 0), (high, size, 0), (high, inner, 0.02), (y + 0.012, inner, 0.02)
    tray = [section("y", (0, at, z - length / 2), (across, length - less)) for at, across, less in steps]
    return joined("drawer", board, loft("tray", tray))


MICROWAVE = ranges(
    MEANINGS,
    width=(0.52, 0.66),
    height=(0.26, 0.42),
    depth=(0.36, 0.415),
    door_thickness=(0.02, 0.035),
    window_margin=(0.04, 0.06),
    panel_width=(0.12, 0.15),
)
COOKER = ranges(
    MEANINGS,
    width=(0.44, 0.7),
    height=(0.54, 0.64),
    depth=(0.42, 0.5),
    door_thickness=(0.02, 0.035),
    window_margin=(0.045, 0.07),
    drawer_height=(0.14, 0.18),
    panel_height=(0.08, 0.11),
    splash_height=(0.03, 0.2),
)
DOOR_ANGLE = "turn of the door outwards, 0 where it is closed"
DOOR = (Contact("body", "door", "face_z"), Contact("door", "handle", "face_z"))
FAMILIES = (
    Rig(
        "oven/microwave",
        (*MICROWAVE, Parameter("door_angle", 0.0, 1.7, DOOR_ANGLE, "rad")),
        microwave,
        (),
        (*DOOR, Contact("body", "keys", "face_z"), Contact("body", "knob", "face_z")),
    ),
    Rig(
        "oven/cooker",
        (
            *COOKER,
            Parameter("door_angle", 0.0, 1.5, DOOR_ANGLE, "rad"),
            Parameter("drawer_out", 0.0, 0.25, "how far the drawer is drawn out"),
        ),
        cooker,
        (
            *itself("body", "door", "window", "handle", "knobs", "splash", "drawer"),
            ("plate_1", "plate_2"),
            ("plate_3", "plate_4"),
        ),
        (
            *DOOR,
            *(Contact("body", f"plate_{i}", "face_y") for i in (1, 2, 3, 4)),
            *stack("body", "splash"),
            Contact("body", "knobs", "face_z"),
        ),
    ),
)
