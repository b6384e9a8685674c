"""Open cars: a convertible, and a pickup with its open bed."""

from data_gen.families.car.cabin import CONTACTS, FRONT, REAR, SYMMETRIC, UPRIGHT, WHEELS, frame, glass, roof
from data_gen.families.car.pieces import (
    MEANINGS,
    SIDES,
    STEP,
    alike,
    axles,
    bumpers,
    cowl,
    headlights,
    hull,
    lid,
    mirrors,
    pair,
    slab,
    wheels,
)
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import box, joined, loft, rounded, section
from data_gen.rig import FLOOR, Rig

CONVERTIBLE = ranges(
    MEANINGS,
    length=(0.82, 0.94),
    width=(0.33, 0.43),
    wheel_radius=(0.06, 0.074),
    clearance=(0.025, 0.055),
    belt_height=(0.18, 0.23),
    cabin_height=(0.06, 0.13),
    bonnet_length=(0.24, 0.31),
    boot_length=(0.24, 0.3),
    windscreen_slant=(0.02, 0.1),
)
PICKUP = ranges(
    MEANINGS,
    length=(0.86, 0.96),
    width=(0.34, 0.44),
    wheel_radius=(0.066, 0.086),
    clearance=(0.045, 0.064),
    belt_height=(0.265, 0.305),
    cabin_height=(0.1, 0.17),
    bonnet_length=(0.17, 0.25),
    windscreen_slant=(0.04, 0.1),
    cargo_length=(0.285, 0.38),
)


def convertible(p):
    """An open car: a windscreen, and two seats in a pit between the doors."""
    at, front, rear, depth = axles(p, 0.005, 0.005), cowl(p), p.boot_length - p.length / 2, 0.09
    high = FLOOR + p.belt_height
    lids = lid("bonnet", p, front, p.length / 2 - 0.012), lid("boot", p, rear, 0.012 - p.length / 2)
    main = open_body(p, at, rear, front, depth), *wheels(p, at), lids[0], screen(p, front)
    return *main, *bumpers(p), *headlights(p), *mirrors(p, front), lids[1], *seats(p, rear + STEP, high - depth)


def open_body(p, at, rear, front, depth):
    """A hull with a pit between doors from z = rear to z = front."""
    low, high, width = FLOOR + p.clearance, FLOOR + p.belt_height, 0.024
    steps = (rear - STEP, high), (rear + STEP, high - depth), (front - STEP, high - depth), (front + STEP, high)
    size, x = (width, depth, front - rear - 2 * STEP), (p.width - width) / 2
    doors = [box("door", (side * x, high - depth / 2, (rear + front) / 2), size) for side in SIDES]
    return joined("body", hull(p, at, [slab(z, p.width, low, y) for z, y in steps]), *doors)


def screen(p, front):
    """A windscreen that leans back."""
    foot, size = (0, FLOOR + p.belt_height, front - 0.008), (0.88 * p.width, 0.016)
    head = (0, foot[1] + p.cabin_height, foot[2] - p.windscreen_slant)
    return loft("glass", [section("y", foot, size), section("y", head, (0.74 * p.width, 0.012))])


def seats(p, rear, floor):
    """Two seats with backs that lean."""
    x, width = 0.21 * p.width, 0.32 * p.width
    seat = box("seat", (x, floor + 0.025, rear + 0.11), (width, 0.05, 0.1))
    steps = (0, 0.05), (0.11, 0.03), (0.145, 0.022)
    back = loft("back", [section("y", (x, floor + y, rear + z), (width, 0.036)) for y, z in steps], rounded(0.3))
    return pair("seat", joined("seat", seat, back))


def pickup(p):
    """A cab with two seats, and behind it an open bed with a tailgate."""
    at, end, depth = axles(p), -p.length / 2, 0.075
    rear, low, high = end + p.cargo_length, FLOOR + p.clearance, FLOOR + p.belt_height
    cabin = frame(p, rear + 0.01, cowl(p), 0, UPRIGHT)
    step = slab(rear - STEP, p.width, low, high - depth), slab(rear + STEP, p.width, low, high)
    bonnet = lid("bonnet", p, cabin.front, p.length / 2 - 0.012)
    main = hull(p, at, step, depth, tail=0.98), roof(cabin, ()), *wheels(p, at), bonnet, glass(cabin)
    return *main, *bumpers(p), *headlights(p), *mirrors(p, cabin.front), bed(p, end, rear - STEP, high - depth, depth)


def bed(p, end, rear, low, depth):
    """The walls of a bed, from the end of the car to the rear of its cab."""
    wide, thick, y = 0.98 * p.width, 0.02, low + depth / 2
    size, across = (thick, depth, rear - end), (wide - 2 * thick, depth, thick)
    sides = [box("side", (s * (wide - thick) / 2, y, (end + rear) / 2), size) for s in SIDES]
    gates = [box("gate", (0, y, z), across) for z in (end + thick / 2, rear - thick / 2)]
    return joined("bed", *sides, *gates)


FAMILIES = (
    Rig(
        "car/convertible",
        CONVERTIBLE,
        convertible,
        (
            *itself("body", "bonnet", "glass", "bumper_front", "bumper_rear", "boot"),
            *WHEELS,
            *alike("headlight", "mirror", "seat"),
        ),
        (*FRONT, *REAR, *stack("body", "bonnet"), *stack("body", "boot"), *stack("body", "glass")),
    ),
    Rig("car/pickup", PICKUP, pickup, (*SYMMETRIC, *itself("bed")), CONTACTS),
)
