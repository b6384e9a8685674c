"""A round car: a domed roof, round lids, and fenders that swing over the wheels."""

import numpy as np

from data_gen.families.car.cabin import REAR, WHEELS, frame, glass, roof
from data_gen.families.car.pieces import LID, MEANINGS, STEP, alike, axles, bumpers, cowl, pair, slab, wheels
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import Section, ball, box, joined, loft
from data_gen.rig import FLOOR, Contact, Rig

BEETLE = ranges(
    MEANINGS,
    length=(0.66, 0.8),
    width=(0.35, 0.46),
    wheel_radius=(0.06, 0.08),
    clearance=(0.03, 0.055),
    belt_height=(0.18, 0.23),
    cabin_height=(0.12, 0.19),
    bonnet_length=(0.18, 0.25),
    boot_length=(0.09, 0.15),
    windscreen_slant=(0.035, 0.075),
    rear_slant=(0.05, 0.1),
    fender_width=(0.075, 0.115),
)
DOME = [
    (0, 0.76, 1),
    (0.15, 0.757, 0.985),
    (0.3, 0.745, 0.935),
    (0.45, 0.725, 0.86),
    (0.6, 0.69, 0.75),
    (0.74, 0.63, 0.6),
    (0.86, 0.555, 0.42),
    (0.94, 0.48, 0.26),
    (1, 0.4, 0.1),
]
"""A round lid: shares of its way, of the width of the car, and of its height."""
DROP, LID_HEIGHT = 0.08, 0.09
"""How far below the windows the lids begin, and their height there."""


def beetle(p):
    """A car with round lamps on its fenders, and running boards between them."""
    (front, back), end = axles(p, 0.03, 0.025), p.length / 2
    cabin = frame(p, p.boot_length - end, cowl(p), wide=(0.68, 0.5), thick=0.06)
    bonnet, boot = dome("bonnet", p, cabin.front, end), dome("boot", p, cabin.rear, -end)
    main = tub(p, cabin), roof(cabin), *wheels(p, (front, back), -0.012), bonnet, glass(cabin)
    return *main, *bumpers(p, 0.8), *lamps(p, front), boot, *fenders(p, front, back)


def tub(p, cabin):
    """A body that ends below the lids and reaches up to the windows between them."""
    low, high, end = FLOOR + p.clearance, FLOOR + p.belt_height, p.length / 2
    before = [(cabin.front + s * (end - cabin.front), w, high - DROP) for s, w, _ in DOME[1:]]
    behind = [(cabin.rear - s * (end + cabin.rear), w, high - DROP) for s, w, _ in DOME[:0:-1]]
    rear = (cabin.rear - STEP, 0.76, high - DROP), (cabin.rear + STEP, 0.76, high)
    front = (cabin.front - STEP, 0.76, high), (cabin.front + STEP, 0.76, high - DROP)
    return loft("body", [slab(z, w * p.width, low, y) for z, w, y in (*behind, *rear, *front, *before)])


def dome(name, p, start, end):
    """A round bonnet or boot, from the windows down to the end of the car."""
    low, span = FLOOR + p.belt_height - DROP, end - start
    return loft(name, [slab(start + s * span, w * p.width, low, low + h * LID_HEIGHT) for s, w, h in DOME], LID)


def fenders(p, front, back):
    """A fender over the wheels of each side, front and rear, with a running board between them."""
    reach, x = 1.28 * p.wheel_radius, p.width / 2 - p.fender_width
    over = [fender(x, z, p.wheel_radius, p.fender_width) for z in (front, back)]
    size = (0.1 * p.width, 0.02, front - back - 2 * reach)
    board = box("board", (0.43 * p.width, FLOOR + p.clearance + 0.02, (front + back) / 2), size)
    return pair("fender", joined("fender", *over, board))


def fender(x, z, radius, width):
    """A board bent round the upper half of a wheel, from x outwards by its width."""
    thick, y = 0.2 * radius, FLOOR + radius
    middle, turn = 1.08 * radius + thick / 2, np.linspace(-1.5, 1.5, 13)
    where = [
        (c, s, (x + width / 2, y + c * middle, z + s * middle)) for c, s in zip(np.cos(turn), np.sin(turn), strict=True)
    ]
    return loft("fender", [Section(centre, (width, 0, 0), (0, c * thick, s * thick)) for c, s, centre in where])


def lamps(p, front):
    """Two round lamps that stand on the fenders."""
    radius, x = p.wheel_radius, p.width / 2 - p.fender_width / 2
    centre = (x, FLOOR + 1.85 * radius, front + 0.95 * radius)
    return pair("headlight", ball("headlight", centre, (0.055, 0.055, 0.05), 16, 6))


FAMILIES = (
    Rig(
        "car/beetle",
        BEETLE,
        beetle,
        (
            *itself("body", "roof", "bonnet", "glass", "bumper_front", "bumper_rear", "boot"),
            *WHEELS,
            *alike("headlight", "fender"),
        ),
        (*stack("body", "roof"), *stack("body", "glass"), Contact("body", "bumper_front", "face_z"), *REAR),
    ),
)
