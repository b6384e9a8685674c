"""Cabinets that open: every door turns about the edge it hangs on, every drawer slides."""

from data_gen.families.cabinet.parts import (
    DOORS,
    LOW,
    MIDDLE,
    PLINTH,
    TOP,
    cut,
    drawers,
    on_front,
    plinth,
    spans,
    top,
    two_knobs,
)
from data_gen.families.cabinet.parts import MEANINGS as CABINET
from data_gen.families.pieces.casework import WALL, bar_handle, door, drawer, knob, pulled, shelf, shell, swung
from data_gen.families.pieces.feet import SYMMETRIC, four_feet, under
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between
from data_gen.joint import hinge
from data_gen.part import Part, box, joined, mirrored, moved
from data_gen.rig import FLOOR, Contact, Parameter, Rig

MEANINGS = {**CABINET, "flap_height": "edge of the flap along y while it stands upright"}
BACKWARDS = -0.14
"""How far behind the middle these cabinets stand, to have room in front for what opens."""


def angles(**meanings):
    """Angles of doors, closed at 0 and open at a little more than a right angle."""
    return tuple(Parameter(f"{name}_angle", 0.0, 1.75, meaning, "rad") for name, meaning in meanings.items())


PAIR = angles(left="turn of the left door, 0 where it is closed", right="turn of the right door, 0 where it is closed")
SINGLE = angles(
    lower="turn of the lower door, 0 where it is closed", upper="turn of the upper door, 0 where it is closed"
)
FLAP = Parameter("flap_angle", 0.0, 1.57, "turn of the flap, 0 where it stands upright", "rad")


def set_back(*built):
    """Parts and joints moved backwards."""
    by = (0, 0, BACKWARDS)
    return [moved(one, by=by) if isinstance(one, Part) else _hung_back(one) for one in built]


def _hung_back(joint):
    x, y, z = joint.pivot
    return joint._replace(pivot=(x, y, z + BACKWARDS))


def pair(p, x, y, z):
    """Two doors that meet in the middle, and their hinges at the outer edges."""
    middle = (y[0] + y[1]) / 2
    right = door("door_right", (0.0, x[1]), y, z, knob(0.035, middle, z + WALL))
    return (
        mirrored(right, "door_left"),
        right,
        swung("door_left", x[0], middle, z, p.left_angle, -1),
        swung("door_right", x[1], middle, z, p.right_angle, 1),
    )


def two_doors(p):
    """A cupboard with two doors and two shelves behind them, on four feet."""
    x, y, z = spans(p, p.leg_height)
    shelves = [shelf(i, x, y[0] + share * (y[1] - y[0]), z) for i, share in enumerate((0.35, 0.68), start=1)]
    feet = four_feet(p.width / 2 - 0.03, p.depth / 2 - 0.03, p.leg_height, 0.04)
    return set_back(shell("body", x, y, z), top(p, p.top_overhang), *shelves, *pair(p, x, y, z[1]), *feet)


def doors_and_drawers(p):
    """A sideboard on a plinth with two drawers side by side above two doors."""
    x, y, z = spans(p, p.plinth_height)
    level = y[1] - p.drawer_height
    found = [shell("body", x, y, z), top(p, p.top_overhang), plinth(p), shelf(1, x, level, z)]
    found += pair(p, x, (y[0], level), z[1])
    for i, half in enumerate(((x[0], 0.0), (0.0, x[1])), start=1):
        handle = knob((half[0] + half[1]) / 2, (level + y[1]) / 2, z[1] + WALL)
        found.append(drawer(f"drawer_{i}", half, (level, y[1]), z[1], p.depth - 2 * WALL, [handle]))
        found.append(pulled(i, p, half, (level, y[1]), z[1]))
    return set_back(*found)


def tall(p):
    """A tall narrow cabinet: a door below, a drawer, and a door above, both doors hung on the left."""
    x, y, z = spans(p, p.plinth_height)
    low, middle, high = cut(y, (0.36, 0.14, 0.5))
    levels = enumerate((low[1], high[0] + WALL, (high[0] + high[1]) / 2), start=1)
    found = [shell("body", x, y, z), top(p, p.top_overhang), plinth(p), *(shelf(i, x, level, z) for i, level in levels)]
    for name, height, angle in (("door_1", low, p.lower_angle), ("door_2", high, p.upper_angle)):
        at = (height[0] + height[1]) / 2
        found.append(door(name, x, height, z[1], bar_handle(x[1] - 0.03, at, z[1] + WALL, 0.1, across=False)))
        found.append(swung(name, x[0], at, z[1], angle, -1))
    return set_back(*found, *drawers(p, x, middle, z, (1,), _one_handle))


def _one_handle(p, height, face):
    return [bar_handle(0, height, face, 0.1)]


def secretary(p):
    """A writing cabinet on legs: a flap that comes down to write on, pigeonholes behind it, and three drawers below."""
    x, y, z = spans(p, p.leg_height)
    level, inner = y[1] - WALL - p.flap_height, (x[0] + WALL, x[1] - WALL)
    return set_back(
        shell("body", x, y, z),
        top(p, p.top_overhang),
        _flap(inner, (level, y[1] - WALL), z[1]),
        hinge("flap_hinge", ["flap"], "body", (1, 0, 0), (0, FLOOR + level, z[1]), p.flap_angle),
        shelf(1, x, level, z),
        _pigeonholes(inner, (level, y[1] - WALL), (z[0] + WALL, z[0] + 0.5 * p.depth)),
        *drawers(p, x, (y[0], level), z, (1 / 3, 1 / 3, 1 / 3), two_knobs),
        *four_feet(p.width / 2 - 0.03, p.depth / 2 - 0.03, p.leg_height, 0.034),
    )


def _flap(x, y, z):
    """A board that stands inside the body, flush with its front."""
    board = box("board", *between((x[0] + 0.002, x[1] - 0.002), y, (z - WALL, z)))
    return joined("flap", board, knob(0, y[1] - 0.04, z))


def _pigeonholes(x, y, z):
    """Three upright boards and one that lies across them."""
    middle, step = (y[0] + y[1]) / 2, (x[1] - x[0]) / 4
    found = [box("board", *between(x, (middle, middle + 0.006), z))]
    for i in (1, 2, 3):
        at = (x[0] + i * step - 0.003, x[0] + i * step + 0.003)
        found += [box("board", *between(at, room, z)) for room in ((y[0], middle), (middle + 0.006, y[1]))]
    return joined("rack", *found)


OPEN = (0.0, 0.18)
FAMILIES = (
    Rig(
        "cabinet_doors/two_doors",
        (
            *ranges(
                MEANINGS, width=(0.42, 0.64), height=(0.46, 0.74), depth=(0.24, 0.34), **LOW, leg_height=(0.03, 0.1)
            ),
            *PAIR,
        ),
        two_doors,
        (*MIDDLE, *DOORS, *itself("shelf_1", "shelf_2"), *SYMMETRIC),
        (TOP, *on_front("door_left", "door_right"), *under("body")),
    ),
    Rig(
        "cabinet_doors/doors_and_drawers",
        (
            *ranges(
                MEANINGS,
                width=(0.5, 0.72),
                height=(0.36, 0.5),
                depth=(0.24, 0.34),
                **LOW,
                plinth_height=(0.02, 0.06),
                drawer_height=(0.08, 0.13),
                open_1=OPEN,
                open_2=OPEN,
            ),
            *PAIR,
        ),
        doors_and_drawers,
        (*MIDDLE, *DOORS, *itself("plinth", "shelf_1"), ("drawer_1", "drawer_2")),
        (TOP, PLINTH, *on_front("door_left", "door_right")),
    ),
    Rig(
        "cabinet_doors/tall",
        (
            *ranges(
                MEANINGS,
                width=(0.28, 0.42),
                height=(0.78, 1.0),
                depth=(0.26, 0.34),
                **LOW,
                plinth_height=(0.02, 0.06),
                open_1=OPEN,
            ),
            *SINGLE,
        ),
        tall,
        (*MIDDLE, *itself("plinth", "shelf_1", "shelf_2", "shelf_3", "drawer_1")),
        (TOP, PLINTH, *on_front("door_1", "door_2")),
    ),
    Rig(
        "cabinet_doors/secretary",
        (
            *ranges(
                MEANINGS,
                width=(0.4, 0.6),
                height=(0.62, 0.76),
                depth=(0.24, 0.32),
                **LOW,
                leg_height=(0.04, 0.1),
                flap_height=(0.2, 0.28),
                **{f"open_{i}": OPEN for i in (1, 2, 3)},
            ),
            FLAP,
        ),
        secretary,
        (
            *MIDDLE,
            *itself("flap", "shelf_1", "rack", "drawer_1", "drawer_2", "drawer_3"),
            *SYMMETRIC,
        ),
        (TOP, Contact("shelf_1", "flap", "face_y"), Contact("shelf_1", "rack", "face_y"), *under("body")),
    ),
)
