"""Lamps that hang from the ceiling."""

import numpy as np

from data_gen.families.lamp.pieces import CANOPY, CEILING, WALL, bell, canopy, cord, hung, lamp
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.turned import arc, dome, rod, turned
from data_gen.part import ball, box, cylinder, joined
from data_gen.rig import Contact, Rig

SOCKET = 0.05
"""Height of the socket of a pendant."""
PAN = 0.012
"""How far the pan under a candle stands above the end of its arm."""
BEAM, STUB = 0.025, 0.03
"""Thickness of a bar, and how far below it its shades begin."""
BALUSTER = (
    *((0, 0), (0.03, 0.25), (0.08, 0.3), (0.12, 0.18), (0.18, 0.4), (0.3, 0.9), (0.42, 1), (0.54, 0.85)),
    *((0.62, 0.4), (0.68, 0.3), (0.74, 0.55), (0.8, 0.55), (0.86, 0.3), (1, 0.2)),
)
"""The outline of a chandelier's body: height by its height, diameter by its diameter."""
ARMS = {1: 54, 2: 126, 3: -18, 4: 198, 5: 270}
"""Where the arms of a chandelier point, in degrees from +x towards +z."""


def pendant(p):
    """A pendant: one bell of a shade on a cord, its bulb looking out below."""
    high = CEILING - CANOPY - p.cord_length
    top = high - SOCKET
    middle, width = top - p.shade_height / 2, p.shade_top
    socket = turned("socket", [(middle, 0.035), (top, 0.035), (top, width), (top + 0.02, 0.85 * width), (high, 0.02)])
    light = hung("bulb", middle, top - p.shade_height, p.bulb_width)
    shade = bell("shade", top - p.shade_height, p)
    return shade, light, cord("cord", high, high + p.cord_length), socket, canopy(p)


def cluster(p):
    """Three globes on cords of three lengths below one plate."""
    found = []
    for i, length in enumerate((p.cord_1_length, p.cord_2_length, p.cord_3_length), 1):
        around, high = (i - 1) * 2 * np.pi / 3, CEILING - CANOPY - length
        x, z = np.cos(around) * p.spread, np.sin(around) * p.spread
        middle = high - 0.03 - p.shade_width / 2
        socket = turned(f"socket_{i}", [(high - 0.04, 0.06), (high - 0.025, 0.06), (high, 0.02)], x, z, 12)
        globe = ball(f"shade_{i}", (x, middle, z), (p.shade_width,) * 3, 24, 12)
        found += [globe, cord(f"cord_{i}", high, high + length, x, z), socket]
    plate = (p.canopy_width, CANOPY, p.canopy_width)
    return *found, cylinder("canopy", (0, CEILING - CANOPY / 2, 0), plate, sides=32)


def chandelier(p):
    """A chandelier: a turned body on a cord, five arms around it that sag and rise, a candle on each."""
    high = CEILING - CANOPY - p.cord_length
    body = [(high - (1 - share) * p.body_height, d * p.body_width) for share, d in BALUSTER]
    found = [turned("body", body, sides=24), cord("cord", high, high + p.cord_length), canopy(p)]
    y = high - 0.5 * p.body_height
    for i, at in ARMS.items():
        x, z = np.cos(np.deg2rad(at)).round(15) * p.arm_length, np.sin(np.deg2rad(at)).round(15) * p.arm_length
        found += [_arm(p, i, np.deg2rad(at), y, x, z), _candle(p, i, y + PAN, x, z)]
    return found


def _arm(p, i, around, y, x, z):
    """An arm from within the body, down and up to a pan under the candle."""
    across = (p.arm_length - 0.02) / (1 + np.cos(0.15 * np.pi))
    path = arc(p.arm_length - across, y, across, p.arm_sag, 1.15 * np.pi, 2 * np.pi, 9)
    pan = turned("", [(y - 0.004, 0.02), (y + PAN / 2, 0.07), (y + PAN, 0.08)], x, z, 12)
    return joined(f"arm_{i}", rod("", path, 0.016, around, sides=8), pan)


def _candle(p, i, y, x, z):
    high = y + p.candle_height
    flame = turned("", [(high, 0.008), (high + 0.016, 0.024), (high + 0.05, 0)], x, z, 8)
    return joined(f"bulb_{i}", turned("", [(y, 0.03), (high, 0.03)], x, z, 12), flame)


def bar(p):
    """A bar on two cords, for a long table: three domes in a row below it, a globe in each."""
    high = CEILING - CANOPY - p.cord_length
    out, top = 0.4 * p.bar_length, high - BEAM - STUB
    plate = box("canopy", (0, CEILING - CANOPY / 2, 0), (p.canopy_width, CANOPY, 0.1))
    x = 0.4 * p.canopy_width
    cords = [cord(f"cord_{side}", high, high + p.cord_length, sign * x) for side, sign in (("left", -1), ("right", 1))]
    beam = [box("", (0, high - BEAM / 2, 0), (p.bar_length, BEAM, BEAM))]
    lights = []
    for i, x in enumerate((out, -out, 0), 1):
        beam.append(turned("", [(top - WALL / 2, 0.04), (high - BEAM, 0.025)], x, sides=12))
        bottom = top - p.shade_height
        lights.append(dome(f"shade_{i}", bottom, p.shade_width, p.shade_height, WALL, x, sides=24))
        lights.append(hung(f"bulb_{i}", top - 2 * WALL / 3, bottom, p.bulb_width, x))
    return *lights, *cords, joined("bar", *beam), plate


FAMILIES = (
    Rig(
        "lamp/pendant",
        lamp(canopy_width=(0.1, 0.16), cord_length=(0.2, 0.52), bulb_width=(0.1, 0.18))
        + lamp(shade_width=(0.34, 0.54), shade_top=(0.05, 0.12), shade_height=(0.16, 0.26)),
        pendant,
        itself("canopy", "cord", "socket", "shade", "bulb"),
        stack("bulb", "socket", "cord", "canopy"),
    ),
    Rig(
        "lamp/cluster",
        lamp(canopy_width=(0.36, 0.5), spread=(0.12, 0.16), shade_width=(0.14, 0.2))
        + lamp(cord_1_length=(0.2, 0.4), cord_2_length=(0.3, 0.6), cord_3_length=(0.4, 0.7)),
        cluster,
        itself("canopy"),
        tuple(contact for i in (1, 2, 3) for contact in stack(f"socket_{i}", f"cord_{i}", "canopy")),
    ),
    Rig(
        "lamp/chandelier",
        lamp(canopy_width=(0.1, 0.16), cord_length=(0.1, 0.35), body_width=(0.08, 0.14), body_height=(0.25, 0.36))
        + lamp(arm_length=(0.28, 0.42), arm_sag=(0.06, 0.14), candle_height=(0.06, 0.12)),
        chandelier,
        (
            *itself("canopy", "cord", "body", "arm_5", "bulb_5"),
            *(("arm_1", "arm_2"), ("arm_3", "arm_4"), ("bulb_1", "bulb_2"), ("bulb_3", "bulb_4")),
        ),
        (*stack("body", "cord", "canopy"), *(Contact(f"arm_{i}", f"bulb_{i}", "face_y") for i in ARMS)),
    ),
    Rig(
        "lamp/bar",
        lamp(canopy_width=(0.2, 0.4), cord_length=(0.2, 0.55), bar_length=(0.7, 0.9))
        + lamp(shade_width=(0.18, 0.26), shade_height=(0.1, 0.18), bulb_width=(0.07, 0.13)),
        bar,
        (
            *itself("canopy", "bar", "shade_3", "bulb_3"),
            *(("cord_left", "cord_right"), ("shade_1", "shade_2"), ("bulb_1", "bulb_2")),
        ),
        (*stack("bar", "cord_left", "canopy"), *stack("bar", "cord_right", "canopy")),
    ),
)
