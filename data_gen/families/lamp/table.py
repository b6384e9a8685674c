"""Lamps that stand on a table: turned, a mushroom, a banker's lamp, a lantern."""

import numpy as np

from data_gen.families.lamp.pieces import BAR, WALL, bulb, chain, cone_shade, foot, holder, lamp, pole
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.turned import arc, dome, quarter, rod, turned
from data_gen.part import Section, ball, box, cylinder, joined, loft, section
from data_gen.rig import FLOOR, Contact, Rig

VASE = (
    *((0, 0.5), (0.06, 0.57), (0.13, 0.69), (0.2, 0.8), (0.28, 0.9), (0.38, 0.97), (0.5, 1), (0.58, 0.97)),
    *((0.66, 0.9), (0.73, 0.79), (0.79, 0.66), (0.85, 0.52), (0.9, 0.42), (0.95, 0.34), (1, 0.3)),
)
"""The outline of a turned body: height by its height, diameter by its diameter."""
NECK = 0.05


def table(p):
    """A table lamp: a round body like a vase on a base, and a cone shade on its neck."""
    bottom, low = FLOOR + p.height - p.shade_height, FLOOR + p.base_height
    high = bottom - NECK / 2
    body = turned("body", [(low + share * (high - low), d * p.body_width) for share, d in VASE], sides=32)
    neck = cylinder("pole", (0, (high + holder(p, bottom)) / 2, 0), (0.025, holder(p, bottom) - high, 0.025), sides=12)
    return foot(p), neck, cone_shade(p, bottom), bulb("bulb", holder(p, bottom), 0.22 * p.shade_top), body


def mushroom(p):
    """A mushroom: a stem that widens towards its base, under a dome that hangs over it."""
    low, bottom = FLOOR + p.base_height, FLOOR + p.height - p.shade_height
    stem = quarter((bottom, p.pole_width), (low, 0.75 * p.base_width), 6)
    tip = [(bottom + 0.6 * p.shade_height, p.pole_width), (bottom + p.shade_height - WALL / 2, 0.02)]
    stem = turned("body", [*reversed(stem), *tip], sides=24)
    light = ball(
        "bulb",
        (0, bottom + 0.3 * p.shade_height, 0),
        (0.34 * p.shade_width, 0.5 * p.shade_height, 0.34 * p.shade_width),
        16,
        8,
    )
    return foot(p), dome("shade", bottom, p.shade_width, p.shade_height, WALL, sides=32), light, stem


def banker(p):
    """A banker's lamp: half a tube of glass that lies across a pole, a tube of light in it, a chain to switch it."""
    bottom = FLOOR + p.height - p.shade_height
    y, x = bottom + 0.4 * p.shade_height, 0.3 * p.shade_length
    tube = cylinder("bulb", (0, y, 0.0175 + p.pole_width / 2), (0.84 * p.shade_length, 0.035, 0.035), "x", 12)
    return (
        foot(p),
        pole(p, FLOOR + p.base_height, FLOOR + p.height - WALL),
        _half_tube(p, bottom),
        tube,
        chain(bottom - 0.12, FLOOR + p.height - WALL / 2, x),
    )


def _half_tube(p, bottom):
    """A plate bent over the bulb in sections along x, from a little below the middle of its arc to the other side."""
    sections = []
    for turn in np.linspace(0, np.pi, 13):
        c, s = np.cos(turn), np.sin(turn)
        centre = (0, bottom + s * (p.shade_height - WALL / 2), c * p.shade_width / 2)
        sections.append(Section(centre, (p.shade_length, 0, 0), (0, s * WALL, c * WALL)))
    return loft("shade", sections)


def lantern(p):
    """A lantern: a candle between four posts under a roof, with a ring to carry it by."""
    low, eaves = FLOOR + p.base_height, FLOOR + p.height - RING - p.roof_height
    base = box("base", (0, FLOOR + p.base_height / 2, 0), (p.base_width, p.base_height, p.base_width))
    out = 0.42 * p.base_width
    feet = [(out, out), (-out, out), (out, -out), (-out, -out)]
    posts = [box(f"post_{i}", (x, (low + eaves) / 2, z), (POST, eaves - low, POST)) for i, (x, z) in enumerate(feet, 1)]
    roof = [(0, 1.1), (0.12, 1.1), (0.5, 0.6), (0.85, 0.3), (1, 0.3)]
    roof = [section("y", (0, eaves + up * p.roof_height, 0), (d * p.base_width,) * 2) for up, d in roof]
    ring = arc(0, FLOOR + p.height - RING / 2, (RING - BAR) / 2, (RING - BAR) / 2, 0, 2 * np.pi, 20)[:-1]
    return base, _candle(p, low), loft("roof", roof), rod("handle", ring, BAR, sides=8, closed=True), *posts


def _candle(p, low):
    high = low + p.candle_height
    wax = turned("", [(low, 0.07), (high, 0.07)])
    return joined("bulb", wax, turned("", [(high, 0.008), (high + 0.02, 0.028), (high + 0.06, 0)], sides=12))


RING, POST = 0.1, 0.018
FAMILIES = (
    Rig(
        "lamp/table",
        lamp(height=(0.42, 0.58), base_width=(0.12, 0.2), base_height=(0.015, 0.04), body_width=(0.12, 0.24))
        + lamp(shade_width=(0.26, 0.38), shade_top=(0.12, 0.24), shade_height=(0.14, 0.22)),
        table,
        itself("base", "body", "pole", "shade", "bulb"),
        stack("base", "body", "pole", "bulb"),
    ),
    Rig(
        "lamp/mushroom",
        lamp(height=(0.34, 0.54), base_width=(0.16, 0.28), base_height=(0.015, 0.04), pole_width=(0.04, 0.08))
        + lamp(shade_width=(0.26, 0.44), shade_height=(0.1, 0.18)),
        mushroom,
        itself("base", "body", "shade", "bulb"),
        stack("base", "body"),
    ),
    Rig(
        "lamp/banker",
        lamp(height=(0.36, 0.48), base_width=(0.18, 0.28), base_height=(0.015, 0.04), pole_width=(0.016, 0.03))
        + lamp(shade_length=(0.3, 0.46), shade_width=(0.16, 0.24), shade_height=(0.08, 0.12)),
        banker,
        itself("base", "pole", "shade", "bulb"),
        stack("base", "pole"),
    ),
    Rig(
        "lamp/lantern",
        lamp(height=(0.46, 0.66), base_width=(0.22, 0.34), base_height=(0.02, 0.05))
        + lamp(roof_height=(0.08, 0.16), candle_height=(0.05, 0.12)),
        lantern,
        (*itself("base", "roof", "handle", "bulb"), ("post_1", "post_2"), ("post_3", "post_4")),
        (
            *(Contact("base", f"post_{i}", "face_y") for i in (1, 2, 3, 4)),
            *(Contact(f"post_{i}", "roof", "face_y") for i in (1, 2, 3, 4)),
            *stack("roof", "handle"),
            *stack("base", "bulb"),
        ),
    ),
)
