"""Round pieces that many families need: turned on a lathe about an upright axis, or bent from a rod.

A profile is a list of (y, diameter); a diameter of 0 at its end is a point. All of it is linear in heights and widths.
"""

import numpy as np

from data_gen.part import Section, Tip, ellipse, loft, section


def turned(name, profile, x=0, z=0, sides=16, closed=False):
    """A profile turned about the upright line through x and z; `closed` joins its end to its start, as in a ring."""
    return loft(name, [_disc(x, y, z, width) for y, width in profile], ellipse(sides), closed)


def quarter(start, end, steps=4):
    """A quarter of an ellipse between two points of a profile: upright where it starts, level where it ends."""
    (low, wide), (high, narrow) = start, end
    turn = np.pi / 2 * np.arange(1, steps) / steps
    between = [
        (low + s * (high - low), narrow + c * (wide - narrow)) for s, c in zip(np.sin(turn), np.cos(turn), strict=True)
    ]
    return [start, *between, end]


def open_ring(name, profile, wall, x=0, z=0, sides=16):
    """A wall turned about an axis, open at both ends: the profile outside, and its inside `wall` away."""
    return turned(name, [*profile, *reversed(_within(profile, wall))], x, z, sides, closed=True)


def dome(name, bottom, width, height, wall, x=0, z=0, sides=16):
    """A hollow half of a ball, open below."""
    outside = quarter((bottom, width), (bottom + height, 0), 8)
    inside = quarter((bottom, width - 2 * wall), (bottom + height - wall, 0), 8)
    return turned(name, [*reversed(inside), *outside], x, z, sides)


def scaled(shares, bottom, height, width):
    """A profile from an outline: pairs of a share of the height and a share of the width."""
    return [(bottom + up * height, across * width) for up, across in shares]


def vessel(name, profile, wall, sides=20):
    """A hollow vessel, open above; it is solid up to the second point of its profile."""
    return turned(name, [*profile, *reversed(_within(profile[1:], wall))], sides=sides)


def content(name, profile, wall, points, sides=20):
    """What stands in a vessel up to the height of the profile's point of that number."""
    return turned(name, _within(profile[1 : points + 1], wall), sides=sides)


def _within(profile, wall):
    return [(y, width - 2 * wall) for y, width in profile]


def arc(out, y, across, rise, start, stop, steps=8):
    """A path for `rod` on an ellipse about (out, y) between two angles, 0 where it is farthest out."""
    turn = np.linspace(start, stop, steps + 1)
    points = zip(turn, np.cos(turn), np.sin(turn), strict=True)
    return [(out + c * across, y + s * rise, t + np.pi / 2 * np.sign(stop - start)) for t, c, s in points]


def ear(high, low, reach, steps=12):
    """A path for a handle like an ear, between two points (out, y) one above the other, `reach` beyond them."""
    (high_out, high_y), (low_out, low_y) = high, low
    turn = np.linspace(0, np.pi, steps + 1)
    shares = zip(turn, (1 - np.cos(turn)) / 2, np.sin(turn), strict=True)
    return [(high_out + d * (low_out - high_out) + s * reach, high_y + d * (low_y - high_y), -t) for t, d, s in shares]


def rod(name, path, thickness, around=0.0, x=0, z=0, sides=10, closed=False, breadth=None):
    """A rod along a path in an upright plane: points (out, y, lean), `lean` the angle of the path, 0 outwards.

    The plane stands on the line through x and z; `around`, 0 at +x and a quarter turn at +z, says where it goes out.
    A thickness within the plane, and a breadth across it if that is another: one for all points, or a list.
    """
    c, s = np.cos(around), np.sin(around)
    thick = _each(thickness, path)
    sections = []
    for (out, y, lean), t, w in zip(path, thick, thick if breadth is None else _each(breadth, path), strict=True):
        a = (-np.sin(lean) * c * t, np.cos(lean) * t, -np.sin(lean) * s * t)
        sections.append(Section((x + c * out, y, z + s * out), a, (-s * w, 0, c * w)))
    return loft(name, sections, ellipse(sides), closed)


def _each(size, path):
    return size if isinstance(size, list) else [size] * len(path)


def _disc(x, y, z, width):
    return Tip((x, y, z)) if np.all(width == 0) else section("y", (x, y, z), (width, width))
