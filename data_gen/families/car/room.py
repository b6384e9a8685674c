"""Cars with much room: a van and a bus."""

from data_gen.families.car.cabin import (
    CABIN,
    CONTACTS,
    FRONT,
    HEAVY,
    REAR,
    SYMMETRIC,
    UPRIGHT,
    frame,
    glass,
    roof,
    shell,
)
from data_gen.families.car.pieces import MEANINGS, axles, bumpers, cowl, headlights, hull, mirrors, wheels
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import box, loft, prism, rounded, section
from data_gen.rig import FLOOR, Contact, Rig

VAN = ranges(
    MEANINGS,
    length=(0.8, 0.96),
    width=(0.33, 0.43),
    wheel_radius=(0.06, 0.078),
    clearance=(0.03, 0.058),
    belt_height=(0.19, 0.25),
    cabin_height=(0.15, 0.28),
    bonnet_length=(0.05, 0.13),
    windscreen_slant=(0.05, 0.13),
    cargo_length=(0.3, 0.42),
)
BUS = ranges(
    MEANINGS,
    length=(0.84, 0.96),
    width=(0.31, 0.43),
    wheel_radius=(0.058, 0.08),
    clearance=(0.03, 0.052),
    belt_height=(0.2, 0.26),
    cabin_height=(0.13, 0.26),
    windscreen_slant=(0.0, 0.07),
    sign_height=(0.025, 0.07),
)


def van(p):
    """A short bonnet, a cab, and behind it a closed room for the load as high as the cab."""
    end, low = 0.02 - p.length / 2, FLOOR + p.belt_height
    cabin = frame(p, end + p.cargo_length, cowl(p), 0, UPRIGHT)
    upright = (low, 0.96), (low + 0.6 * p.cabin_height, 0.92)
    round_off = (cabin.top - 0.03, 0.87), (cabin.top - 0.01, 0.8), (cabin.top, 0.68)
    middle, size = end + p.cargo_length / 2, p.cargo_length
    sections = [section("y", (0, y, middle), (s * p.width, size)) for y, s in (*upright, *round_off)]
    return *shell(p, cabin, ()), loft("cargo", sections)


def bus(p):
    """A long room of windows under one roof, with a sign over the windscreen."""
    at, end = axles(p, 0.06, 0.04), p.length / 2
    cabin = frame(p, 0.03 - end, end - 0.012, 0, UPRIGHT)
    place = (0, cabin.top + p.sign_height / 2, cabin.head_front - 0.06)
    sign = box("sign", place, (0.4 * p.width, p.sign_height, 0.04))
    cooler = prism("cooler", (0, cabin.top + 0.015, -0.1), (0.45 * p.width, 0.03, 0.22), "z", rounded(0.3))
    main = hull(p, at, nose=0.97, tail=0.97), roof(cabin, (0.17, 0.34, 0.5, 0.66, 0.83)), *wheels(p, at), glass(cabin)
    return *main, *bumpers(p, 0.94), *headlights(p, (0.06, 0.04), 0.065), *mirrors(p, end - 0.02), sign, cooler


FAMILIES = (
    Rig(
        "car/van",
        VAN,
        van,
        (*SYMMETRIC, *itself("cargo")),
        (*CONTACTS, *stack("body", "cargo"), Contact("cargo", "glass", "face_z")),
    ),
    Rig(
        "car/bus",
        BUS,
        bus,
        (*HEAVY, *itself("bumper_rear", "sign", "cooler")),
        (*CABIN, *FRONT, *REAR, *stack("roof", "sign"), *stack("roof", "cooler")),
    ),
)
