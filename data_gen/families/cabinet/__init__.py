"""Cabinets, closed below their top or open in part; those that are tall stand in `tall`."""

from data_gen.families.cabinet import tall
from data_gen.families.cabinet.parts import (
    DOORS,
    LOW,
    MEANINGS,
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
from data_gen.families.pieces.casework import WALL, bar_handle, door, knob, shelf, shell
from data_gen.families.pieces.feet import SYMMETRIC, four_feet, under
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between
from data_gen.part import RECTANGLE, box, joined, mirrored
from data_gen.rig import Contact, Rig


def sideboard(p):
    """A long low cabinet on splayed legs: a door at either end, three drawers between them."""
    x, y, z = spans(p, p.leg_height)
    inner = p.width / 2 - p.door_width
    right = door("door_right", (inner, x[1]), y, z[1], knob(inner + 0.03, (y[0] + y[1]) / 2, z[1] + WALL))
    fronts = []
    for i, height in enumerate(cut(y, (0.36, 0.34, 0.3)), start=1):
        handle = bar_handle(0, (height[0] + height[1]) / 2, z[1] + WALL, 0.09)
        fronts.append(door(f"drawer_{i}", (-inner, inner), height, z[1], handle))
    feet = four_feet(p.width / 2 - 0.07, p.depth / 2 - 0.05, p.leg_height, 0.036, p.leg_splay)
    return box("body", *between(x, y, z)), top(p, p.top_overhang), mirrored(right, "door_left"), right, *fronts, *feet


def chest(p):
    """A chest of four drawers that slide, the lower ones higher, with two knobs each."""
    x, y, z = spans(p, p.plinth_height)
    sliding = drawers(p, x, y, z, (0.29, 0.27, 0.24, 0.2), two_knobs)
    return shell("body", x, y, z), top(p, p.top_overhang), plinth(p), *sliding


def filing(p):
    """A filing cabinet: a narrow body down to the floor with three high drawers, each with a handle and a label."""
    x, y, z = spans(p, 0.0)
    return shell("body", x, y, z), top(p, 0), *drawers(p, x, y, z, (1 / 3, 1 / 3, 1 / 3), _handle_and_label)


def _handle_and_label(p, height, face):
    label = box("label", *between((-0.03, 0.03), (height + 0.035, height + 0.06), (face, face + 0.004)))
    return [bar_handle(0, height, face, 0.1), label]


def nightstand(p):
    """A small cabinet on legs: a drawer that slides above an open compartment."""
    x, y, z = spans(p, p.leg_height)
    level = y[1] - p.drawer_height
    feet = four_feet(p.width / 2 - 0.025, p.depth / 2 - 0.025, p.leg_height, 0.03, p.leg_splay)
    sliding = drawers(p, x, (level, y[1]), z, (1,), _one_knob)
    return shell("body", x, y, z), top(p, p.top_overhang), shelf(1, x, level, z), *sliding, *feet


def _one_knob(p, height, face):
    return [knob(0, height, face)]


def tv_stand(p):
    """A low bench with doors at its ends, an open compartment with a shelf between them, and a television on top."""
    x, y, z = spans(p, p.leg_height)
    inner, depth = p.width / 2 - p.door_width, (z[0] + WALL, z[1])
    right = door("door_right", (inner, x[1]), y, z[1], knob(inner + 0.03, (y[0] + y[1]) / 2, z[1] + WALL))
    wall = box("divider_right", *between((inner, inner + WALL), (y[0] + WALL, y[1] - WALL), depth))
    middle = (y[0] + y[1] - WALL) / 2
    return (
        shell("body", x, y, z),
        top(p, p.top_overhang),
        mirrored(right, "door_left"),
        right,
        mirrored(wall, "divider_left"),
        wall,
        box("shelf_1", *between((-inner, inner), (middle, middle + WALL), depth)),
        *four_feet(p.width / 2 - 0.06, p.depth / 2 - 0.05, p.leg_height, 0.036, outline=RECTANGLE),
        _television(p),
    )


def _television(p):
    """A flat screen on a foot."""
    half, low = p.screen_width / 2, p.height + 0.03
    screen = box("screen", *between((-half, half), (low, low + 0.56 * p.screen_width), (-0.012, 0.012)))
    neck = box("neck", *between((-0.03, 0.03), (p.height + 0.01, low), (-0.01, 0.01)))
    foot = box("foot", *between((-0.35 * half, 0.35 * half), (p.height, p.height + 0.01), (-0.06, 0.06)))
    return joined("screen", foot, neck, screen)


OPEN = (0.0, 0.16)
FAMILIES = (
    Rig(
        "cabinet/sideboard",
        ranges(
            MEANINGS,
            width=(0.65, 0.94),
            height=(0.34, 0.48),
            depth=(0.24, 0.34),
            **LOW,
            leg_height=(0.06, 0.16),
            leg_splay=(0.0, 0.05),
            door_width=(0.18, 0.24),
        ),
        sideboard,
        (*MIDDLE, *DOORS, *itself("drawer_1", "drawer_2", "drawer_3"), *SYMMETRIC),
        (TOP, *on_front("door_left", "door_right", "drawer_1", "drawer_2", "drawer_3"), *under("body")),
    ),
    Rig(
        "cabinet/chest",
        ranges(
            MEANINGS,
            width=(0.36, 0.6),
            height=(0.42, 0.62),
            depth=(0.26, 0.36),
            **LOW,
            plinth_height=(0.02, 0.07),
            **{f"open_{i}": OPEN for i in (1, 2, 3, 4)},
        ),
        chest,
        (*MIDDLE, *itself("plinth", "drawer_1", "drawer_2", "drawer_3", "drawer_4")),
        (TOP, PLINTH),
    ),
    Rig(
        "cabinet/filing",
        ranges(
            MEANINGS,
            width=(0.2, 0.28),
            height=(0.5, 0.68),
            depth=(0.28, 0.38),
            top_thickness=(0.008, 0.02),
            **{f"open_{i}": (0.0, 0.2) for i in (1, 2, 3)},
        ),
        filing,
        (*MIDDLE, *itself("drawer_1", "drawer_2", "drawer_3")),
        (TOP,),
    ),
    Rig(
        "cabinet/nightstand",
        ranges(
            MEANINGS,
            width=(0.22, 0.34),
            height=(0.26, 0.38),
            depth=(0.2, 0.3),
            **LOW,
            leg_height=(0.04, 0.09),
            leg_splay=(0.0, 0.03),
            drawer_height=(0.06, 0.09),
            open_1=(0.0, 0.12),
        ),
        nightstand,
        (*MIDDLE, *itself("shelf_1", "drawer_1"), *SYMMETRIC),
        (TOP, *under("body")),
    ),
    Rig(
        "cabinet/tv_stand",
        ranges(
            MEANINGS,
            width=(0.68, 0.94),
            height=(0.2, 0.3),
            depth=(0.24, 0.34),
            **LOW,
            leg_height=(0.03, 0.08),
            door_width=(0.15, 0.23),
            screen_width=(0.45, 0.65),
        ),
        tv_stand,
        (
            *MIDDLE,
            *DOORS,
            ("divider_left", "divider_right"),
            *itself("shelf_1", "screen"),
            *SYMMETRIC,
        ),
        (
            TOP,
            *on_front("door_left", "door_right"),
            *under("body"),
            Contact("divider_left", "shelf_1", "face_x"),
            Contact("shelf_1", "divider_right", "face_x"),
            Contact("top", "screen", "face_y"),
        ),
    ),
    *tall.FAMILIES,
)
