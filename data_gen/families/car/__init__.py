"""Cars. Here those that have a bonnet, a cabin, and four wheels under one body; the other files have the rest."""

from data_gen.families.car import curved, racing, roofless, room, truck
from data_gen.families.car.cabin import CONTACTS, SYMMETRIC, frame, glass, roof, shell
from data_gen.families.car.pieces import (
    MEANINGS,
    SIDES,
    axles,
    bumpers,
    cowl,
    headlights,
    hull,
    lid,
    mirrors,
    slab,
    wheels,
)
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import box, cylinder, joined, prism, rounded
from data_gen.rig import FLOOR, Contact, Rig

SEDAN = ranges(
    MEANINGS,
    length=(0.7, 0.94),
    width=(0.3, 0.43),
    wheel_radius=(0.056, 0.078),
    clearance=(0.024, 0.054),
    belt_height=(0.185, 0.24),
    cabin_height=(0.09, 0.155),
    bonnet_length=(0.15, 0.24),
    boot_length=(0.09, 0.17),
    windscreen_slant=(0.04, 0.1),
    rear_slant=(0.02, 0.08),
)
LIMOUSINE = ranges(
    MEANINGS,
    length=(0.86, 0.96),
    width=(0.26, 0.36),
    wheel_radius=(0.052, 0.07),
    clearance=(0.025, 0.05),
    belt_height=(0.165, 0.205),
    cabin_height=(0.085, 0.13),
    bonnet_length=(0.12, 0.21),
    boot_length=(0.07, 0.17),
    windscreen_slant=(0.03, 0.1),
    rear_slant=(0.02, 0.09),
)
HATCHBACK = ranges(
    MEANINGS,
    length=(0.56, 0.74),
    width=(0.29, 0.42),
    wheel_radius=(0.054, 0.07),
    clearance=(0.025, 0.052),
    belt_height=(0.175, 0.23),
    cabin_height=(0.1, 0.19),
    bonnet_length=(0.09, 0.19),
    windscreen_slant=(0.05, 0.12),
    rear_slant=(0.02, 0.1),
    spoiler_length=(0.03, 0.085),
)
SUV = ranges(
    MEANINGS,
    length=(0.76, 0.92),
    width=(0.34, 0.44),
    wheel_radius=(0.074, 0.094),
    clearance=(0.045, 0.07),
    belt_height=(0.225, 0.285),
    cabin_height=(0.1, 0.17),
    bonnet_length=(0.13, 0.26),
    windscreen_slant=(0.03, 0.1),
    rear_slant=(0.0, 0.06),
    rack_height=(0.025, 0.055),
)
COUPE = ranges(
    MEANINGS,
    length=(0.8, 0.94),
    width=(0.34, 0.44),
    wheel_radius=(0.06, 0.073),
    clearance=(0.02, 0.05),
    belt_height=(0.19, 0.225),
    cabin_height=(0.075, 0.12),
    bonnet_length=(0.25, 0.31),
    boot_length=(0.05, 0.1),
    windscreen_slant=(0.06, 0.12),
    rear_slant=(0.07, 0.14),
    spoiler_height=(0.03, 0.12),
)


def sedan(p):
    """A bonnet, a cabin and a boot."""
    cabin = frame(p, p.boot_length - p.length / 2, cowl(p))
    return *shell(p, cabin), boot(p, cabin)


def limousine(p):
    """A sedan drawn out, with five windows a side."""
    cabin = frame(p, p.boot_length - p.length / 2, cowl(p))
    return *shell(p, cabin, (0.2, 0.4, 0.6, 0.8)), boot(p, cabin)


def boot(p, cabin):
    """The lid behind a cabin."""
    return lid("boot", p, cabin.rear, 0.012 - p.length / 2)


def hatchback(p):
    """A short car whose rear window is its rear, with a spoiler over it."""
    cabin, length = frame(p, 0.03 - p.length / 2, cowl(p)), p.spoiler_length
    centre, size = (0, cabin.top + 0.007, cabin.head_rear + 0.04 - length / 2), (0.62 * p.width, 0.014, length)
    return *shell(p, cabin), prism("spoiler", centre, size, "y", rounded(0.2))


def suv(p):
    """A tall car with a rack on its roof and a spare wheel on its tail."""
    cabin = frame(p, 0.03 - p.length / 2, cowl(p))
    centre = (0, FLOOR + p.belt_height - 0.05, -p.length / 2 - 0.02)
    return *shell(p, cabin), rack(p, cabin), cylinder("spare_wheel", centre, (0.15, 0.15, 0.04), "z", 20)


def rack(p, cabin):
    """Two rails on feet on a roof, and three bars across."""
    middle, length = (cabin.head_front + cabin.head_rear) / 2, cabin.head_front - cabin.head_rear - 0.09
    x, top, height = 0.22 * p.width, cabin.top + p.rack_height, p.rack_height - 0.012
    rails = [box("rail", (side * x, top - 0.006, middle), (0.014, 0.012, length)) for side in SIDES]
    bars = [box("bar", (0, top - 0.006, middle + s * length), (2 * x - 0.014, 0.01, 0.014)) for s in (-0.3, 0, 0.3)]
    places = [(side * x, cabin.top + height / 2, middle + s * length) for side in SIDES for s in (-0.34, 0.34)]
    return joined("rack", *rails, *bars, *(box("foot", place, (0.012, height, 0.02)) for place in places))


def coupe(p):
    """A low car with a long falling bonnet, a roof that runs down to the tail, and a wing on two struts."""
    at, cabin, fall = axles(p, 0.015), frame(p, p.boot_length - p.length / 2, cowl(p)), 0.12
    step = slab(cabin.front, p.width, FLOOR + p.clearance, FLOOR + p.belt_height)
    bonnet = lid("bonnet", p, cabin.front, p.length / 2 - 0.012, slope=fall)
    main = hull(p, at, [step], slope=fall), roof(cabin, [0.6]), *wheels(p, at), bonnet, glass(cabin)
    return *main, *bumpers(p), *headlights(p, drop=0.066), *mirrors(p, cabin.front), boot(p, cabin), wing(p)


def wing(p):
    """A wing on two struts over the tail."""
    low, z, height = FLOOR + p.belt_height, 0.045 - p.length / 2, p.spoiler_height
    blade = prism("blade", (0, low + height - 0.008, z), (0.9 * p.width, 0.016, 0.075), "x", rounded(0.35))
    strut = (0.014, height - 0.016, 0.04)
    struts = [box("strut", (side * 0.33 * p.width, low + height / 2 - 0.008, z), strut) for side in SIDES]
    return joined("spoiler", blade, *struts)


def rig(name, parameters, build, alone=(), contacts=()):
    """A family that adds parts in the middle to the shell."""
    return Rig(f"car/{name}", parameters, build, (*SYMMETRIC, *itself(*alone)), (*CONTACTS, *contacts))


BOOT = stack("body", "boot")
SLOPED = tuple(one for one in CONTACTS if one not in stack("body", "bonnet"))
SUV_CONTACTS = (*stack("roof", "rack"), Contact("spare_wheel", "body", "face_z"))
OTHERS = (roofless, curved, racing, room, truck)
FAMILIES = (
    rig("sedan", SEDAN, sedan, ["boot"], BOOT),
    rig("limousine", LIMOUSINE, limousine, ["boot"], BOOT),
    rig("hatchback", HATCHBACK, hatchback, ["spoiler"], stack("roof", "spoiler")),
    rig("suv", SUV, suv, ["rack", "spare_wheel"], SUV_CONTACTS),
    Rig(
        "car/coupe", COUPE, coupe, (*SYMMETRIC, *itself("boot", "spoiler")), (*SLOPED, *BOOT, *stack("body", "spoiler"))
    ),
    *(one for other in OTHERS for one in other.FAMILIES),
)
