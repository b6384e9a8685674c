"""The cabin of a car: glass under a roof on pillars; and the shell that most cars have in common."""

from typing import NamedTuple

from data_gen.families.car.pieces import alike, axles, bumpers, headlights, hull, lid, mirrors, wheels
from data_gen.families.pieces.pairs import itself
from data_gen.part import joined, loft, rounded, section
from data_gen.rig import FLOOR, Contact

ROOF, PILLAR = 0.02, 0.02
"""Thickness of a roof, and of a pillar."""
UPRIGHT = (0.93, 0.84)
"""Widths at foot and head of a cabin whose sides stand almost upright, as shares of the car's."""


class Frame(NamedTuple):
    """Where glass stands: its z at the rear and in front and its edge along x, at foot and head, and their heights."""

    rear: object
    front: object
    head_rear: object
    head_front: object
    width: object
    head_width: object
    foot: object
    head: object
    top: object


def frame(p, rear, front, rear_slant=None, wide=(0.93, 0.78), thick=ROOF):
    """The frame of a cabin whose foot reaches from z = rear to z = front, its windows leaning by the slants.

    `wide` is its width at foot and head as a share of the car's, `thick` the thickness of its roof.
    """
    foot = FLOOR + p.belt_height
    top = foot + p.cabin_height
    back = rear + (p.rear_slant if rear_slant is None else rear_slant)
    width, head_width = (share * p.width for share in wide)
    return Frame(rear, front, back, front - p.windscreen_slant, width, head_width, foot, top - thick, top)


def glass(f):
    """All windows of a cabin as one block."""
    ends = (f.foot, f.rear, f.front, f.width), (f.head, f.head_rear, f.head_front, f.head_width)
    return loft("glass", [section("y", (0, y, (a + b) / 2), (width, b - a)) for y, a, b, width in ends])


def roof(f, posts=(0.5,)):
    """A roof on pillars: one at each corner, others at these shares of the way from the rear to the windscreen."""
    size, middle = (f.head_width + 0.02, f.head_front - f.head_rear + 0.024), (f.head_front + f.head_rear) / 2
    steps = [(0, 1), (0.35, 0.98), (0.65, 0.93), (0.87, 0.83), (1, 0.66)]
    panel = [section("y", (0, f.head + s * (f.top - f.head), middle), [w * one for one in size]) for s, w in steps]
    pillars = [pillar(f, side, share) for share in (0, *posts, 1) for side in (-1, 1)]
    return joined("roof", loft("panel", panel, rounded(0.05, 2)), *pillars)


def pillar(f, side, share):
    """A post on the side of the glass, at a share of the way from the rear to the front, that stands out a little."""
    shift = (0.5 - share) * (PILLAR - 0.006)
    low, high = (a + share * (b - a) + shift for a, b in ((f.rear, f.front), (f.head_rear, f.head_front)))
    foot, head = (side * f.width / 2, f.foot, low), (side * (f.head_width / 2 - 0.004), f.head + 0.005, high)
    return loft("pillar", [section("y", centre, (0.7 * PILLAR, PILLAR)) for centre in (foot, head)])


def shell(p, cabin, posts=(0.5,)):
    """What most cars have: a body on wheels, a roof on posts, a bonnet, glass, bumpers, lamps, mirrors."""
    at = axles(p)
    main = hull(p, at), roof(cabin, posts), *wheels(p, at), lid("bonnet", p, cabin.front, p.length / 2 - 0.012)
    return *main, glass(cabin), *bumpers(p), *headlights(p), *mirrors(p, cabin.front)


WHEELS = (("wheel_1", "wheel_2"), ("wheel_3", "wheel_4"))
SYMMETRIC = (
    *itself("body", "roof", "bonnet", "glass", "bumper_front", "bumper_rear"),
    *WHEELS,
    *alike("headlight", "mirror"),
)
HEAVY = (*itself("body", "roof", "glass", "bumper_front"), *WHEELS, *alike("headlight", "mirror"))
CABIN = (
    Contact("body", "roof", "face_y"),
    Contact("body", "glass", "face_y"),
    Contact("body", "mirror_left", "face_y"),
    Contact("body", "mirror_right", "face_y"),
)
FRONT = (
    Contact("body", "bumper_front", "face_z"),
    Contact("body", "headlight_left", "face_z"),
    Contact("body", "headlight_right", "face_z"),
)
BONNET = (Contact("body", "bonnet", "face_y"), Contact("glass", "bonnet", "face_z"))
REAR = (Contact("bumper_rear", "body", "face_z"),)
CONTACTS = (*CABIN, *FRONT, *BONNET, *REAR)
