"""Tall cabinets: a wardrobe, a glazed one, a dresser with a rack above its counter, one for a corner."""

import numpy as np

from data_gen.families.cabinet.parts import DOORS, MEANINGS, MIDDLE, PLINTH, TOP, on_front, plinth, spans, top
from data_gen.families.pieces.casework import REVEAL, WALL, bar_handle, door, frame, inset, knob, shelf, shell
from data_gen.families.pieces.feet import BUN, SYMMETRIC, four_feet, under
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between
from data_gen.part import Section, box, joined, loft, mirrored, prism
from data_gen.rig import FLOOR, Contact, Rig

COUNTER = 0.025
"""Thickness of a counter."""
SHELVES = itself("shelf_1", "shelf_2")
COUNTERED = (Contact("body", "counter", "face_y"), *on_front("door_left", "door_right"))
PENTAGON = np.array([(0.5, 0.5), (-0.5, 0.5), (-0.5, 0.2), (0.0, -0.5), (0.5, 0.2)])
"""What stands in a corner, seen from above: the front is the last edge along z."""


def wardrobe(p):
    """Two tall doors above two drawers that lie side by side, under a cornice."""
    x, y, z = spans(p, p.plinth_height)
    level, face = p.plinth_height + p.drawer_height, z[1] + WALL
    handle = bar_handle(0.022, (level + y[1]) / 2, face, 0.16, across=False)
    right = door("door_right", (0.0, x[1]), (level, y[1]), z[1], handle)
    knobs = knob(x[1] / 2, (p.plinth_height + level) / 2, face)
    front = door("drawer_1", (0.0, x[1]), (p.plinth_height, level), z[1], knobs)
    body = box("body", *between(x, y, z))
    return (
        body,
        top(p, p.top_overhang),
        plinth(p),
        mirrored(right, "door_left"),
        right,
        front,
        mirrored(front, "drawer_2"),
    )


def display(p):
    """A cabinet on bun feet whose doors are glazed: bars around nothing, and three shelves behind them."""
    x, y, z = spans(p, p.leg_height)
    bars = frame("bars", inset((0.0, x[1])), inset(y), (z[1], z[1] + WALL), p.bar_width)
    middle = (y[0] + y[1]) / 2
    cross = box("bar", *between((p.bar_width, x[1] - p.bar_width), (middle - 0.01, middle + 0.01), (z[1], z[1] + WALL)))
    right = joined("door_right", bars, cross, knob(p.bar_width / 2 + REVEAL, middle, z[1] + WALL))
    shelves = [shelf(i, x, y[0] + share * (y[1] - y[0]), z) for i, share in enumerate((0.25, 0.5, 0.75), start=1)]
    feet = four_feet(p.width / 2 - 0.035, p.depth / 2 - 0.035, p.leg_height, 0.055, profile=BUN)
    return shell("body", x, y, z), top(p, p.top_overhang), mirrored(right, "door_left"), right, *shelves, *feet


def hutch(p):
    """A dresser: a closed cabinet below, and on its counter a rack of shelves that is less deep."""
    x, z, low, level = (
        (-p.width / 2, p.width / 2),
        (-p.depth / 2, p.depth / 2),
        p.plinth_height,
        p.counter_height - COUNTER,
    )
    face = z[1] + WALL
    right = door("door_right", (0.0, x[1]), (low, level), z[1], knob(0.03, (low + level) / 2, face))
    inner, y, rack = (
        (x[0] + 0.012, x[1] - 0.012),
        (p.counter_height, p.height - p.top_thickness),
        (z[0], z[0] + p.rack_depth),
    )
    heights = [y[0] + share * (y[1] - y[0]) for share in (0.4, 0.7)]
    return (
        box("body", *between(x, (low, level), z)),
        box("top", *between(x, (y[1], p.height), (z[0], rack[1] + 0.015))),
        plinth(p),
        mirrored(right, "door_left"),
        right,
        box("counter", *between((x[0] - 0.012, x[1] + 0.012), (level, p.counter_height), (z[0], face + 0.012))),
        shell("rack", inner, y, rack),
        *(shelf(i, inner, height, rack) for i, height in enumerate(heights, start=1)),
    )


def corner(p):
    """A cabinet for a corner: five-sided, closed below its counter, with open shelves above."""
    y, z, level = (p.counter_height, p.height - p.top_thickness), p.depth / 2, p.counter_height - COUNTER
    right = door("door_right", (0.0, p.width / 2), (p.plinth_height, level), z, knob(0.03, 0.6 * level, z + WALL))
    wall = joined("wall_right", *_corner_walls(p, y))
    floors = [(y[0] + share * (y[1] - y[0]), y[0] + share * (y[1] - y[0]) + WALL) for share in (0.32, 0.65)]
    return (
        _slab("body", p, (p.plinth_height, level), 0.0),
        _slab("top", p, (y[1], p.height), 0.02),
        _slab("plinth", p, (0, p.plinth_height), -0.03),
        mirrored(right, "door_left"),
        right,
        _slab("counter", p, (level, p.counter_height), 0.03),
        mirrored(wall, "wall_left"),
        wall,
        *(_floor(f"shelf_{i}", p, floor) for i, floor in enumerate(floors, start=1)),
    )


def _slab(name, p, y, more):
    """A five-sided slab as wide and deep as the cabinet and a little more, flush with it at the rear corner."""
    half, rear = (p.width + more) / 2, -p.depth / 2
    return prism(name, *between((-half, half), y, (rear, p.depth / 2 + more)), "y", PENTAGON)


def _floor(name, p, y):
    """A five-sided shelf between the walls, whose slanted edges end inside them."""
    half, rear = p.width / 2 - WALL, 1.5 * WALL - p.depth / 2
    return prism(name, *between((-half, half), y, (rear, p.depth / 2 - WALL)), "y", PENTAGON)


def _corner_walls(p, y):
    """The walls of the right half: one from the rear corner along the wall of the room, a short one to the front."""
    rear, bend = -p.depth / 2, 0.2 * p.depth
    side = box("side", *between((p.width / 2 - WALL, p.width / 2), y, (bend, p.depth / 2)))
    a, b, centre = (p.width / 2, 0, bend - rear), (0, 0, WALL), (p.width / 4, (rear + bend) / 2 + WALL / 2)
    return side, loft("wall", [Section((centre[0], FLOOR + at, centre[1]), a, b) for at in y])


TALL = {"height": (0.78, 1.0), "top_thickness": (0.015, 0.04), "plinth_height": (0.02, 0.07)}
FAMILIES = (
    Rig(
        "cabinet/wardrobe",
        ranges(
            MEANINGS, width=(0.44, 0.7), depth=(0.26, 0.36), **TALL, top_overhang=(0.0, 0.03), drawer_height=(0.1, 0.2)
        ),
        wardrobe,
        (*MIDDLE, *itself("plinth"), *DOORS, ("drawer_1", "drawer_2")),
        (TOP, PLINTH, *on_front("door_left", "door_right", "drawer_1", "drawer_2")),
    ),
    Rig(
        "cabinet/display",
        ranges(
            MEANINGS,
            width=(0.36, 0.56),
            height=(0.66, 0.92),
            depth=(0.2, 0.3),
            top_thickness=(0.015, 0.04),
            top_overhang=(0.0, 0.03),
            leg_height=(0.02, 0.06),
            bar_width=(0.015, 0.035),
        ),
        display,
        (*MIDDLE, *DOORS, *SHELVES, *itself("shelf_3"), *SYMMETRIC),
        (TOP, *on_front("door_left", "door_right"), *under("body")),
    ),
    Rig(
        "cabinet/hutch",
        ranges(
            MEANINGS, width=(0.46, 0.7), depth=(0.24, 0.32), **TALL, counter_height=(0.36, 0.46), rack_depth=(0.1, 0.18)
        ),
        hutch,
        (*MIDDLE, *itself("plinth"), *DOORS, *itself("counter", "rack"), *SHELVES),
        (PLINTH, *COUNTERED, Contact("counter", "rack", "face_y"), Contact("rack", "top", "face_y")),
    ),
    Rig(
        "cabinet/corner",
        ranges(MEANINGS, width=(0.44, 0.6), depth=(0.28, 0.36), **TALL, counter_height=(0.32, 0.46)),
        corner,
        (*MIDDLE, *itself("plinth"), *DOORS, *itself("counter"), ("wall_left", "wall_right"), *SHELVES),
        (
            PLINTH,
            *COUNTERED,
            *(Contact("counter", wall, "face_y") for wall in ("wall_left", "wall_right")),
            *(Contact(wall, "top", "face_y") for wall in ("wall_left", "wall_right")),
        ),
    ),
)
