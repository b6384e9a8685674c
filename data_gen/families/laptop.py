"""Laptops: a base with keys and a touchpad, and a screen that turns."""

import numpy as np

from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.joint import hinge
from data_gen.part import box, cylinder, joined, loft, prism, rounded, section
from data_gen.rig import FLOOR, Contact, Parameter, Rig

MEANINGS = {
    "width": "edge of the base along x",
    "depth": "edge of the base along z",
    "base_thickness": "edge of the base along y",
    "screen_height": "edge of the screen along y while it stands upright",
    "screen_thickness": "edge of the screen along z while it stands upright",
    "bezel": "from the edge of the screen to what lights up",
    "key_depth": "edge of all keys together along z",
    "touchpad_width": "edge of the touchpad along x",
    "neck_height": "from the base to the lower edge of the screen",
}
SCREEN_ANGLE = "turn of the screen backwards, 0 where it stands upright"
BARREL, REAR = 0.03, -0.14
"""Diameter of the barrel of the hinge; z of the rear of the base, with room behind it for a screen that leans back."""
ROWS = ((1,) * 12,) * 4 + ((1.5, 1.5, 6, 1.5, 1.5),)
"""Widths of the keys in each row, which sum to 12; the last has a long key in the middle."""


def base(p, margin):
    """A base with round corners, keys that begin `margin` before its rear, and the touchpad before them."""
    top, z = FLOOR + p.base_thickness, REAR + p.depth / 2
    steps = (FLOOR, 0.95), (FLOOR + 0.4 * p.base_thickness, 1), (top, 1)
    slab = loft("base", [section("y", (0, y, z), (s * p.width, s * p.depth)) for y, s in steps], rounded(0.06))
    before, front = REAR + margin + p.key_depth + 0.025, REAR + p.depth - 0.025
    pad = box("touchpad", (0, top + 0.002, (before + front) / 2), (p.touchpad_width, 0.004, front - before))
    return slab, keyboard(p, top, REAR + margin), pad


def keyboard(p, low, rear):
    """All keys, in rows from the rear to the front."""
    deep = p.key_depth / len(ROWS)
    return joined(
        "keyboard", *(key for i, row in enumerate(ROWS) for key in keys(p, row, low, rear + (i + 0.5) * deep, deep))
    )


def keys(p, widths, low, z, deep):
    """A row of keys around z, of these widths in twelfths of the keyboard's."""
    step, starts = 0.88 * p.width / 12, np.cumsum((-6, *widths[:-1]))
    places = [((start + wide / 2) * step, low + 0.004, z) for start, wide in zip(starts, widths, strict=True)]
    sizes = [((wide - 0.2) * step, 0.008, 0.8 * deep) for wide in widths]
    return [box("key", *one) for one in zip(places, sizes, strict=True)]


def screen(p, low, z):
    """A screen that stands upright on `low`, and in its frame what lights up."""
    y, size = low + p.screen_height / 2, (p.width, p.screen_height, p.screen_thickness)
    lit = (p.width - 2 * p.bezel, p.screen_height - 2 * p.bezel, 0.004)
    return (
        prism("screen", (0, y, z), size, "z", rounded(0.05)),
        box("display", (0, y, z + p.screen_thickness / 2 + 0.002), lit),
    )


def tilt(p, low, z):
    """The hinge about which the screen leans back."""
    return hinge("screen_hinge", ["screen", "display"], "barrel", (-1, 0, 0), (0, low, z), p.screen_angle)


def clamshell(p):
    """A base, and a screen on a barrel along its rear."""
    low, z = FLOOR + p.base_thickness + BARREL / 2, REAR + BARREL / 2
    barrel = cylinder("barrel", (0, low, z), (0.7 * p.width, BARREL, BARREL), "x", 12)
    return *base(p, 0.06), barrel, *screen(p, low, z), tilt(p, low, z)


def swivel(p):
    """A base, and a screen on a barrel on a neck that turns: the neck carries the barrel, and the barrel the screen."""
    top, z = FLOOR + p.base_thickness, REAR + 0.075
    low = top + p.neck_height + BARREL / 2
    neck = cylinder("neck", (0, top + p.neck_height / 2, z), (0.1, p.neck_height, 0.1), "y", 20)
    barrel = cylinder("barrel", (0, low, z), (0.3 * p.width, BARREL, BARREL), "x", 12)
    turn = hinge("neck_hinge", ["neck", "barrel"], "base", (0, 1, 0), (0, top, z), p.neck_angle)
    return *base(p, 0.15), neck, barrel, *screen(p, low, z), turn, tilt(p, low, z)


LAPTOP = {
    "width": (0.66, 0.94),
    "depth": (0.46, 0.6),
    "base_thickness": (0.025, 0.045),
    "screen_height": (0.42, 0.56),
    "screen_thickness": (0.014, 0.026),
    "bezel": (0.02, 0.045),
    "key_depth": (0.18, 0.23),
    "touchpad_width": (0.16, 0.28),
}
SWIVEL = {"width": (0.6, 0.74), "depth": (0.5, 0.6), "screen_height": (0.38, 0.48), "key_depth": (0.17, 0.21)}
MIDDLE = itself("base", "keyboard", "touchpad", "barrel", "screen", "display")
ON_BASE = (
    *stack("base", "keyboard"),
    *stack("base", "touchpad"),
    Contact("screen", "display", "face_z"),
)
FAMILIES = (
    Rig(
        "laptop/clamshell",
        (*ranges(MEANINGS, **LAPTOP), Parameter("screen_angle", -0.9, 0.6, SCREEN_ANGLE, "rad")),
        clamshell,
        MIDDLE,
        (*ON_BASE, *stack("base", "barrel")),
    ),
    Rig(
        "laptop/swivel",
        (
            *ranges(MEANINGS, **LAPTOP | SWIVEL | {"neck_height": (0.03, 0.05)}),
            Parameter("screen_angle", -0.5, 0.4, SCREEN_ANGLE, "rad"),
            Parameter("neck_angle", -0.9, 0.9, "turn of the screen about the neck, 0 where it faces the front", "rad"),
        ),
        swivel,
        (*MIDDLE, *itself("neck")),
        (*ON_BASE, *stack("base", "neck", "barrel")),
    ),
)
