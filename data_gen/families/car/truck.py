"""Trucks: a cab, and behind it a load on a frame over two axles."""

from data_gen.families.car.cabin import CABIN, FRONT, HEAVY, UPRIGHT, frame, glass, roof
from data_gen.families.car.pieces import MEANINGS, TYRE, arch, bumpers, headlights, mirrors, slab, tip, wheels
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import box, cylinder, ellipse, joined, loft, section
from data_gen.rig import FLOOR, Contact, Rig

CAB = {
    "length": (0.88, 0.96),
    "width": (0.32, 0.43),
    "wheel_radius": (0.062, 0.08),
    "clearance": (0.045, 0.06),
    "belt_height": (0.225, 0.27),
    "cabin_height": (0.11, 0.2),
    "windscreen_slant": (0.0, 0.07),
    "cargo_length": (0.48, 0.595),
}
TRUCK = ranges(MEANINGS, **CAB, cargo_height=(0.2, 0.44))
TANKER = ranges(MEANINGS, **CAB, cargo_height=(0.19, 0.32))
DECK = FLOOR + 0.175
"""The upper side of the frame of a truck."""


def cab(p, saddles=()):
    """All of a truck but its load: a cab over the front axle, and a frame over two axles behind it."""
    end, low, high = p.length / 2, FLOOR + p.clearance, FLOOR + p.belt_height
    rear, at = behind_cab(p) + 0.02, (end - 0.14, 0.29 - end, 0.12 - end)
    body = [slab(rear, p.width, low, high), *arch(p, at[0], low, high), *tip(p, end, 0.94, low, high)]
    cabin = frame(p, rear + 0.015, end - 0.014, 0, UPRIGHT)
    main = loft("body", body), roof(cabin, ()), *wheels(p, at), glass(cabin), chassis(p, rear, at[1:], saddles)
    return *main, bumpers(p, 0.96)[0], *headlights(p, (0.05, 0.04), 0.09), *mirrors(p, end - 0.03)


def behind_cab(p):
    """The z at which the load ends in front."""
    return 0.025 - p.length / 2 + p.cargo_length


def chassis(p, front, at, saddles):
    """A frame up to the cab, on an axle at each of these z; its saddles stand at these shares of the load's length."""
    end, inner, y = -p.length / 2, p.width - 2 * TYRE * p.wheel_radius + 0.008, FLOOR + p.wheel_radius
    beam = box("beam", (0, DECK - 0.025, (front + end) / 2), (0.4 * p.width, 0.05, front - end))
    axle = [cylinder("axle", (0, y, z), (inner, 0.03, 0.03), "x", 8) for z in at]
    block = [box("block", (0, (DECK - 0.05 + y) / 2, z), (0.2 * p.width, DECK - 0.05 - y, 0.06)) for z in at]
    middle = behind_cab(p) - p.cargo_length / 2
    size = (0.6 * p.width, 0.06, 0.03)
    saddle = [box("saddle", (0, DECK + 0.03, middle + s * p.cargo_length), size) for s in saddles]
    return joined("chassis", beam, *axle, *block, *saddle)


def truck(p):
    """A truck with a box."""
    centre = (0, DECK + p.cargo_height / 2, behind_cab(p) - p.cargo_length / 2)
    return *cab(p), box("cargo", centre, (p.width, p.cargo_height, p.cargo_length))


def tanker(p):
    """A truck whose load is a tank with domed ends, on two saddles."""
    y, z = DECK + 0.02 + p.cargo_height / 2, behind_cab(p) - p.cargo_length / 2
    rings = [(-0.5, 0.5), (-0.47, 0.82), (-0.4, 1), (0.4, 1), (0.47, 0.82), (0.5, 0.5)]
    tank = [section("z", (0, y, z + s * p.cargo_length), (0.92 * p.width * r, p.cargo_height * r)) for s, r in rings]
    return *cab(p, (-0.28, 0.28)), loft("cargo", tank, ellipse(20))


SYMMETRIC = (*HEAVY, ("wheel_5", "wheel_6"), *itself("cargo", "chassis"))
CONTACTS = (
    *CABIN,
    *FRONT,
    Contact("chassis", "body", "face_z"),
    *(Contact("chassis", f"wheel_{i}", "face_x") for i in (3, 5)),
    *(Contact(f"wheel_{i}", "chassis", "face_x") for i in (4, 6)),
)
FAMILIES = (
    Rig("car/truck", TRUCK, truck, SYMMETRIC, (*CONTACTS, *stack("chassis", "cargo"))),
    Rig("car/tanker", TANKER, tanker, SYMMETRIC, CONTACTS),
)
