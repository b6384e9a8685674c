"""A racing car: a slim tub between wheels that stand free, with wings in front and behind."""

from data_gen.families.car.cabin import WHEELS
from data_gen.families.car.pieces import LID, MEANINGS, SIDES, alike, pair, slab, wheel
from data_gen.families.pieces.pairs import itself, stack
from data_gen.families.pieces.ranges import ranges
from data_gen.part import ball, box, joined, loft, mirrored, prism, rounded, section
from data_gen.rig import FLOOR, Contact, Rig

FORMULA = ranges(
    MEANINGS,
    length=(0.86, 0.96),
    width=(0.38, 0.5),
    wheel_radius=(0.06, 0.084),
    rear_radius=(0.074, 0.1),
    clearance=(0.02, 0.04),
    tub_height=(0.105, 0.15),
    wing_width=(0.3, 0.5),
    spoiler_height=(0.05, 0.14),
    pod_length=(0.18, 0.3),
)
TUB = 0.14
"""Width of the tub."""
BLADE = rounded(0.35)


def formula(p):
    """A racing car: a slim tub, pods beside it, wings in front and behind, and wheels that stand free on arms."""
    front, back, low = p.length / 2 - 0.21, 0.13 - p.length / 2, FLOOR + p.tub_height
    main = tub(p), *axle(p, (1, 2), front, p.wheel_radius, 0.06), *axle(p, (3, 4), back, p.rear_radius, 0.08)
    driver = ball("driver", (0, low + 0.03, 0.04), (0.056, 0.06, 0.064), 16, 8)
    arm = arms("arms_front", p, front, p.wheel_radius, 0.06), arms("arms_rear", p, back, p.rear_radius, 0.08)
    return *main, front_wing(p), rear_wing(p), *pods(p, low), driver, cover(p, low), *arm


def axle(p, numbers, z, radius, width):
    """A wheel at x > 0 and its mirror image."""
    right = wheel(f"wheel_{numbers[0]}", p.width / 2, z, radius, width)
    return right, mirrored(right, f"wheel_{numbers[1]}")


def tub(p):
    """The body: slim, flat behind the driver, with a nose that falls to its tip."""
    low, high, end = FLOOR + p.clearance, FLOOR + p.tub_height, p.length / 2
    steps = [(-end, 0.07, 0.02, -0.03), (0.12 - end, 0.1, 0, 0), (-0.15, TUB, 0, 0), (0.1, TUB, 0, 0)]
    steps += [(0.6 * end, 0.1, 0.015, -0.02), (end - 0.04, 0.06, 0.025, -0.05), (end, 0.035, 0.028, -0.058)]
    return loft("body", [slab(z, w, low + up, high + down) for z, w, up, down in steps], LID)


def cover(p, low):
    """The cover of the engine, with the scoop for its air behind the driver's head."""
    rear = 0.05 - p.length / 2
    slim = (rear, 0.03, 0.02), (rear + 0.1, 0.05, 0.035)
    scoop = (-0.06, 0.07, 0.085), (-0.015, 0.064, 0.095), (0, 0.05, 0.09)
    return loft("cover", [slab(z, w, low, low + h) for z, w, h in (*slim, *scoop)], LID)


def pods(p, high):
    """A pod on each side of the tub, open to the air in front and slim behind."""
    low, wide = FLOOR + p.clearance, 0.3 * p.width - 0.02
    tall, along = high - 0.02 - low, ((-1, 0.2, 0.5), (-0.6, 0.75, 0.8), (-0.15, 1, 1), (0, 0.95, 0.96))
    places = [(TUB / 2 + w * wide / 2, low + h * tall / 2, 0.05 + s * p.pod_length) for s, w, h in along]
    sizes = [(w * wide, h * tall) for _, w, h in along]
    return pair("pod", loft("pod", [section("z", *one) for one in zip(places, sizes, strict=True)], rounded(0.2)))


def front_wing(p):
    """A blade under the nose with a plate at each end."""
    y, z = FLOOR + p.clearance + 0.016, p.length / 2 - 0.045
    blade = prism("blade", (0, y, z), (p.wing_width, 0.018, 0.09), "x", BLADE)
    plates = [box("plate", (side * (p.wing_width / 2 - 0.005), y + 0.016, z), (0.01, 0.06, 0.1)) for side in SIDES]
    return joined("wing", blade, *plates)


def rear_wing(p):
    """Two blades between plates, on a post at the tail."""
    low, z, height, width = FLOOR + p.tub_height + 0.03, 0.04 - p.length / 2, p.spoiler_height, 0.62 * p.width
    plates = [box("plate", (side * width / 2, low + height / 2, z), (0.01, height, 0.08)) for side in SIDES]
    size = (width - 0.01, 0.014, 0.07)
    blades = [prism("blade", (0, low + y, z), size, "x", BLADE) for y in (0.012, height - 0.012)]
    return joined("spoiler", *plates, *blades, box("post", (0, low - 0.022, z), (0.02, 0.06, 0.03)))


def arms(name, p, z, radius, tyre):
    """Two bars on each side from the tub to the wheels, in a V, and a tie above them."""
    y, x = FLOOR + radius, p.width / 2 - tyre
    ends = (-0.06, -0.012, -0.012), (0.06, 0.012, -0.012), (0, 0, 0.014)
    half = [bar((0.02, y + up, z + a), (x, y + up, z + b)) for a, b, up in ends]
    return joined(name, *half, *(mirrored(one, "bar") for one in half))


def bar(start, end):
    """A thin bar along x between two points."""
    return loft("bar", [section("x", centre, (0.01, 0.014)) for centre in (start, end)])


FAMILIES = (
    Rig(
        "car/formula",
        FORMULA,
        formula,
        (*itself("body", "wing", "spoiler", "driver", "cover", "arms_front", "arms_rear"), *WHEELS, *alike("pod")),
        (
            *stack("body", "driver"),
            *stack("body", "cover"),
            Contact("body", "pod_right", "face_x"),
            Contact("pod_left", "body", "face_x"),
            Contact("arms_front", "wheel_1", "face_x"),
            Contact("wheel_2", "arms_front", "face_x"),
            Contact("arms_rear", "wheel_3", "face_x"),
            Contact("wheel_4", "arms_rear", "face_x"),
        ),
    ),
)
