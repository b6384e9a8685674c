"""Chairs for the porch: a rocking chair, a garden chair of boards."""

import numpy as np

from data_gen.families.chair.pieces import LEGS, MEANINGS, along, corners, legs, panel, sided, spindles, strut
from data_gen.families.pieces.legs import carry
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import RECTANGLE, box, ellipse, joined, loft, prism, rounded, section
from data_gen.rig import FLOOR, Rig

ARMS = (("arm_left", "arm_right"),)
LEAN = 0.19
"""How far the back of a rocking chair leans for each unit of its height."""

ROCKER = 0.035
"""Edge of a rocker along y."""


def rocking(p):
    """A rocking chair: spindles in the back, arms on posts, and splayed legs on two bent rockers."""
    seat_y, half = FLOOR + p.seat_height, p.seat_width / 2 - 0.04
    extents = (p.seat_width, p.seat_thickness, p.seat_depth)
    seat = prism("seat", (0, seat_y - p.seat_thickness / 2, 0), extents, "y", rounded(0.15, 4))
    foot, head = FLOOR + ROCKER + 0.25 * p.rocker_rise - 0.004, FLOOR + p.seat_height - p.seat_thickness
    low = [(x, foot, z) for x, z in corners(half + 0.02, p.rocker_length / 4)]
    high = [(x, head, z) for x, z in corners(half - 0.02, p.seat_depth / 2 - 0.05)]
    stand = legs(zip(low, high, strict=True), p.leg_size, 0.8, ellipse(12))
    rockers = [_rocker(p, sided("rocker", side), side * (half + 0.02)) for side in (-1, 1)]
    arms = [_open_arm(p, side) for side in (-1, 1)]
    return seat, spindles(p, LEAN * (p.back_height - 0.07)), *stand, *arms, *rockers


def _rocker(p, name, x):
    """A board bent along a parabola that touches the floor in the middle."""
    found = []
    for share in np.linspace(-0.5, 0.5, 17):
        at = (x, FLOOR + ROCKER / 2 + 4 * share**2 * p.rocker_rise, share * p.rocker_length)
        found.append(section("z", at, (0.03, ROCKER)))
    return loft(name, found)


def _open_arm(p, side):
    """A board from the outer bar of the back to the front, on a post that stands on the seat."""
    x, y = side * (p.seat_width / 2 - 0.045), FLOOR + p.seat_height + p.arm_height
    rear, front = 0.035 - p.seat_depth / 2 - LEAN * p.arm_height, p.seat_depth / 2 - 0.01
    sizes = ((0.7 * p.arm_width, 0.022), (p.arm_width, 0.022))
    board = strut("board", (x, y - 0.011, rear), (x, y - 0.011, front), *sizes, rounded(0.2, 2), "z")
    low, high = (x, FLOOR + p.seat_height, front - 0.06), (x, y - 0.022, front - 0.04)
    return joined(sided("arm", side), board, strut("post", low, high, *2 * [(0.026, 0.026)], ellipse(8)))


def garden(p):
    """A garden chair of boards: a sloping seat on two stringers, a fan of tall slats, broad arms on front legs."""
    half = p.seat_width / 2
    return (
        _seat_slats(p),
        _fan(p),
        *(_stringer(p, f"leg_{i}", side * (half - 0.02)) for i, side in ((3, 1), (4, -1))),
        *(_front(p, f"leg_{i}", side * (half + 0.015)) for i, side in ((1, 1), (2, -1))),
        *(_broad_arm(p, side) for side in (-1, 1)),
    )


BOARD = 0.022
"""Thickness of a garden chair's boards."""
TILT = 0.32
"""How far its back leans for each unit of height."""
STRINGER = 0.09
"""Edge of a stringer along y."""


def _slope(p):
    """The upper edge of a stringer: its front end, under the seat, and its rear end on the floor."""
    high = FLOOR + p.seat_height - BOARD
    return (0, high, p.seat_depth / 2), (0, FLOOR + STRINGER, -0.95 * p.seat_depth)


def _stringer(p, name, x):
    (_, high, front), (_, low, rear) = _slope(p)
    size = 2 * [(0.03, STRINGER)]
    return strut(name, (x, low - STRINGER / 2, rear), (x, high - STRINGER / 2, front), *size, axis="z")


def _seat_slats(p):
    """Boards across the upper edges of the stringers, from the front backwards."""
    slats = []
    for share in (0.045, 0.17, 0.295, 0.42, 0.545):
        _, y, z = along(*_slope(p), share)
        slats.append(box("slat", (0, y + BOARD / 2, z), (p.seat_width, BOARD, 0.085)))
    return joined("seat", *slats)


def _hip(p):
    """Where the back stands on the stringers."""
    return along(*_slope(p), 0.66)


def _fan(p):
    """Five leaning slats, the middle one the highest."""
    _, y, z = _hip(p)
    slats, gap = [], p.seat_width / 5
    for i, share in enumerate((0.86, 0.96, 1.0, 0.96, 0.86)):
        foot = ((i - 2) * (gap + 0.002), y, z)
        high = share * (FLOOR + p.seat_height + p.back_height - y)
        slats.append(panel("slat", foot, (gap - 0.016, gap - 0.004), high, BOARD, TILT * high, 0.06, outline=RECTANGLE))
    return joined("back", *slats)


def _front(p, name, x):
    """A board from the floor to the arm."""
    high = p.seat_height + p.arm_height - BOARD
    return box(name, (x, FLOOR + high / 2, p.seat_depth / 2 - 0.07), (0.03, high, p.leg_size))


def _broad_arm(p, side):
    """A board on a front leg, which runs back to the outer slat of the back."""
    x, y = side * (p.seat_width / 2 + 0.015), FLOOR + p.seat_height + p.arm_height - BOARD / 2
    _, foot, z = _hip(p)
    front, rear = p.seat_depth / 2 + 0.02, z - TILT * (y - foot) - BOARD
    sizes = ((0.6 * p.arm_width, BOARD), (p.arm_width, BOARD))
    return strut(sided("arm", side), (x, y, rear), (x, y, front), *sizes, rounded(0.2, 2), "z")


FAMILIES = (
    Rig(
        "chair/rocking",
        ranges(
            MEANINGS,
            seat_width=(0.4, 0.6),
            seat_height=(0.34, 0.42),
            seat_depth=(0.4, 0.5),
            seat_thickness=(0.02, 0.05),
            back_height=(0.34, 0.56),
            back_thickness=(0.012, 0.034),
            back_curve=(0.0, 0.05),
            arm_height=(0.16, 0.24),
            arm_width=(0.035, 0.1),
            leg_size=(0.026, 0.06),
            rocker_length=(0.66, 0.92),
            rocker_rise=(0.03, 0.1),
        ),
        rocking,
        (*itself("seat", "back"), *LEGS, *ARMS, ("rocker_left", "rocker_right")),
        (*carry("seat"), *stack("seat", "back"), *stack("seat", "arm_left"), *stack("seat", "arm_right")),
    ),
    Rig(
        "chair/garden",
        ranges(
            MEANINGS,
            seat_width=(0.4, 0.64),
            seat_height=(0.3, 0.38),
            seat_depth=(0.38, 0.52),
            back_height=(0.34, 0.56),
            arm_height=(0.14, 0.22),
            arm_width=(0.07, 0.13),
            leg_size=(0.06, 0.12),
        ),
        garden,
        (*itself("seat", "back"), *LEGS, *ARMS),
        (*stack("leg_1", "arm_right"), *stack("leg_2", "arm_left")),
    ),
)
