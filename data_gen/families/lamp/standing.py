"""Lamps that stand on the floor of a room: on a pole, a tripod, an arc."""

import numpy as np

from data_gen.families.lamp.pieces import BAR, WALL, bulb, chain, cone_shade, cord, foot, holder, hung, lamp, pole
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.turned import arc, dome, quarter, rod, turned, vessel
from data_gen.part import Section, ball, cylinder, ellipse, loft
from data_gen.rig import FLOOR, Contact, Rig

SHADE = lamp(shade_width=(0.3, 0.42), shade_top=(0.16, 0.28), shade_height=(0.16, 0.28))
BASE = lamp(base_width=(0.2, 0.34), base_height=(0.015, 0.04), pole_width=(0.014, 0.04))
FEET = {1: 30, 2: 150, 3: 270}
"""Where the legs of a tripod stand, in degrees from +x towards +z."""
HUB = 0.05
"""Height of the body that joins the legs of a tripod."""


def floor(p):
    """A floor lamp: a pole on a round base, a cone shade on the pole, and a chain to switch it with."""
    bottom = FLOOR + p.height - p.shade_height
    switch = chain(bottom - 0.12, holder(p, bottom) - BAR, 0.09)
    stands = pole(p, FLOOR + p.base_height, holder(p, bottom))
    return foot(p), stands, cone_shade(p, bottom), bulb("bulb", holder(p, bottom), 0.22 * p.shade_top), switch


def tripod(p):
    """A drum shade on three legs that spread from a body below it."""
    bottom = FLOOR + p.height - p.shade_height
    hub = bottom - 0.04 - HUB
    legs = [_leg(p, i, np.deg2rad(at), hub) for i, at in FEET.items()]
    body = cylinder("body", (0, hub + HUB / 2, 0), (0.11, HUB, 0.11), sides=20)
    stands = cylinder("pole", (0, (hub + HUB + holder(p, bottom)) / 2, 0), (0.02, holder(p, bottom) - hub - HUB, 0.02))
    return stands, cone_shade(p, bottom), bulb("bulb", holder(p, bottom), 0.22 * p.shade_top), body, *legs


def _leg(p, i, around, high):
    """A leg from the floor, where it is thinner, to the height of the hub."""
    c, s = np.cos(around).round(15), np.sin(around).round(15)
    ends = ((FLOOR, p.spread, 0.7 * p.leg_width), (high, 0.03, p.leg_width))
    rings = [Section((c * out, y, s * out), (width, 0, 0), (0, 0, width)) for y, out, width in ends]
    return loft(f"leg_{i}", rings, ellipse(12))


def arched(p):
    """An arc lamp: a pole that bends over far to one side, and a dome that hangs from its end."""
    across = p.reach / (1 + np.cos(END))
    bow = arc(
        across - p.reach / 2,
        FLOOR + p.height - p.pole_width / 2 - RISE * p.reach,
        across,
        RISE * p.reach,
        np.pi,
        END,
        14,
    )
    x, y, _ = bow[-1]
    pipe = rod("pole", [(-p.reach / 2, FLOOR + p.base_height, np.pi / 2), *bow], p.pole_width)
    rim = y - HANG - p.shade_height
    shade = dome("shade", rim, p.shade_width, p.shade_height, WALL, x, sides=32)
    light = hung("bulb", y - HANG - WALL / 2, rim, p.bulb_width, x)
    return foot(p, -p.reach / 2), pipe, shade, light, cord("cord", y - HANG, y, x)


RISE, END, HANG = 0.5, 0.12 * np.pi, 0.05
"""An arc's height by its reach, the angle of its ellipse where it ends, and how far below it the shade begins."""


def torchiere(p):
    """A torchiere: a slender pole that carries a bowl open to the ceiling."""
    bottom = FLOOR + p.height - p.shade_height
    stands = turned("pole", [(FLOOR + p.base_height, p.pole_width), (bottom - 0.03, 0.8 * p.pole_width)], sides=12)
    cup = turned("socket", [(bottom - 0.03, 0.04), (bottom, 0.07)])
    profile = quarter((FLOOR + p.height, p.shade_width), (bottom, 0.07), 9)[::-1]
    light = bulb("bulb", profile[1][0], 0.5 * p.shade_height)
    return foot(p), stands, vessel("shade", profile, WALL, sides=32), light, cup


def globe(p):
    """A garden lamp: a tapered pole on a stepped base, and a globe in a collar."""
    low, bottom = FLOOR + p.base_height, FLOOR + p.height - p.shade_width - 0.02
    steps = [
        (FLOOR, p.base_width),
        (FLOOR + 0.4 * p.base_height, p.base_width),
        (FLOOR + 0.5 * p.base_height, 0.7 * p.base_width),
    ]
    base = turned("base", [*steps, (low, 0.45 * p.base_width)], sides=20)
    stands = turned("pole", [(low, p.pole_width), (bottom - 0.05, 0.7 * p.pole_width)], sides=12)
    collar = turned("socket", [(bottom - 0.05, 0.05), (bottom - 0.03, 0.11), (bottom + 0.02, 0.12)], sides=24)
    shade = ball("shade", (0, bottom + p.shade_width / 2, 0), (p.shade_width,) * 3, 32, 16)
    top = FLOOR + p.height
    finial = turned("finial", [(top - 0.024, 0.04), (top - 0.012, 0.03), (top, 0)], sides=12)
    return base, stands, shade, collar, finial


LIT = itself("shade", "bulb")
FAMILIES = (
    Rig(
        "lamp/floor",
        lamp(height=(0.8, 1.0)) + BASE + SHADE,
        floor,
        LIT + itself("base", "pole"),
        stack("base", "pole", "bulb"),
    ),
    Rig(
        "lamp/tripod",
        lamp(height=(0.75, 0.95), spread=(0.2, 0.32), leg_width=(0.02, 0.05)) + SHADE,
        tripod,
        (*LIT, ("body", "body"), ("pole", "pole"), ("leg_1", "leg_2"), ("leg_3", "leg_3")),
        (*(Contact(f"leg_{i}", "body", "face_y") for i in FEET), *stack("body", "pole", "bulb")),
    ),
    Rig(
        "lamp/arc",
        lamp(
            height=(0.8, 1.0),
            reach=(0.52, 0.66),
            base_width=(0.2, 0.3),
            base_height=(0.03, 0.06),
            pole_width=(0.014, 0.03),
        )
        + lamp(shade_width=(0.2, 0.32), shade_height=(0.09, 0.16), bulb_width=(0.08, 0.14)),
        arched,
        (),
        (Contact("base", "pole", "face_y"),),
    ),
    Rig(
        "lamp/torchiere",
        lamp(height=(0.8, 1.0)) + BASE + lamp(shade_width=(0.24, 0.4), shade_height=(0.07, 0.14)),
        torchiere,
        LIT + itself("base", "pole", "socket"),
        stack("base", "pole", "socket", "shade"),
    ),
    Rig(
        "lamp/globe",
        lamp(height=(0.7, 1.0), base_width=(0.16, 0.28), base_height=(0.06, 0.14), pole_width=(0.025, 0.05))
        + lamp(shade_width=(0.18, 0.3)),
        globe,
        itself("base", "pole", "socket", "shade", "finial"),
        stack("base", "pole", "socket"),
    ),
)
