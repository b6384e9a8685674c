"""What cars are made of: a hull with wheel arches, lids on it, wheels, bumpers, lamps, mirrors."""

import numpy as np

from data_gen.part import ellipse, loft, mirrored, prism, rounded, section
from data_gen.rig import FLOOR

MEANINGS = {
    "length": "edge of the body along z",
    "width": "edge of the car along x, without its mirrors",
    "wheel_radius": "from the axle of the front wheels to the road",
    "clearance": "from the floor to the underside of the body",
    "belt_height": "from the floor to the foot of the windows",
    "cabin_height": "from the foot of the windows to the upper side of the roof",
    "bonnet_length": "from the front of the body to the foot of the windscreen",
    "boot_length": "from the rear of the body to the foot of the rear window",
    "windscreen_slant": "how far the upper edge of the windscreen stands behind its foot",
    "rear_slant": "how far the upper edge of the rear window stands before its foot",
    "cargo_length": "edge of the room for the load along z",
    "cargo_height": "from the lower to the upper side of the room for the load",
    "spoiler_height": "from the lower to the upper side of the spoiler",
    "spoiler_length": "edge of the spoiler along z",
    "rack_height": "from the roof to the upper side of the rack",
    "sign_height": "edge of the sign along y",
    "fender_width": "edge of a fender along x",
    "rear_radius": "from the axle of the rear wheels to the road",
    "tub_height": "from the floor to the upper side of the driver's tub",
    "wing_width": "edge of the front wing along x",
    "pod_length": "edge along z of the pods beside the driver",
}
SIDES = (-1, 1)
STEP = 0.003
"""Half of what a step in a hull takes along z."""
ARCH = 1.14
"""Radius of a wheel arch, in wheel radii."""
TYRE = 0.62
"""Width of a wheel, in wheel radii."""
LID = np.array([(0.5, -0.5), (0.5, -0.15), (0.47, 0.12), (0.41, 0.3), (0.32, 0.42), (0.18, 0.49), (0.06, 0.5)])
LID = np.concatenate([LID, LID[::-1] * [-1, 1]])
"""An outline flat below and round above."""


def slab(z, width, low, high):
    """A section of a body perpendicular to z, between two heights."""
    return section("z", (0, (low + high) / 2, z), (width, high - low))


def axles(p, front=0.03, rear=0.03):
    """The z of the front and of the rear axle."""
    return 0.35 * p.length - front, rear - 0.35 * p.length


def hull(p, at, middle=(), behind=0, slope=0, nose=0.84, tail=0.88):
    """The body, with an arch over each pair of wheels at these z; its ends are `nose` and `tail` as wide as the rest.

    Up to the sections in the `middle`, if there are any, it lies `behind` deeper than the foot of the windows; before
    the windscreen it falls towards the nose by `slope`.
    """
    low, high, end = FLOOR + p.clearance, FLOOR + p.belt_height, p.length / 2
    front, rear = at
    fallen = [high - slope * (z - cowl(p)) if slope else high for z in (front, end)]
    first = *tip(p, -end, tail, low, high - behind)[::-1], *arch(p, rear, low, high - behind)
    last = *arch(p, front, low, fallen[0], slope), *tip(p, end, nose, low, fallen[1], slope)
    return loft("body", [*first, *middle, *last])


def cowl(p):
    """The z of the foot of the windscreen."""
    return p.length / 2 - p.bonnet_length


def tip(p, end, share, low, high, slope=0):
    """The sections of a body towards its end at this z, where it is narrower and its lower edge turns up."""
    side = np.sign(np.mean(end))
    steps = (0.03, 1, 0), (0.012, (1 + share) / 2, 0.004), (0, share, 0.012)
    return [slab(end - side * back, width * p.width, low + up, high + slope * back) for back, width, up in steps]


def arch(p, z, low, high, slope=0):
    """The sections of a body over a pair of wheels."""
    radius, axle = ARCH * p.wheel_radius, FLOOR + p.wheel_radius
    turn = np.linspace(-np.pi / 2, np.pi / 2, 9)
    under = [(side * (radius + 0.004), low) for side in (-1, 1)]
    over = [(radius * np.sin(t), axle + radius * np.cos(t)) for t in turn]
    return [slab(z + by, p.width, y, high - slope * by) for by, y in (under[0], *over, under[1])]


def lid(name, p, start, end, slope=0):
    """A bonnet or a boot on the body, from the glass at z = start to the end of the car: round, and thinner there."""
    low, span = FLOOR + p.belt_height, end - start
    along = (0, 0.93, 0.024), (0.4, 0.92, 0.022), (0.75, 0.88, 0.017), (0.93, 0.85, 0.011), (1, 0.8, 0.005)
    feet = [(start + s * span, w * p.width, low - s * slope * span, h) for s, w, h in along]
    return loft(name, [slab(z, width, y, y + height) for z, width, y, height in feet], LID)


def wheel(name, x, z, radius, width):
    """A wheel whose outer side is at x > 0: a tyre with a bevel, and a cap that lies deeper at its rim."""
    rings = [(-1, 1), (-0.12, 1), (0, 0.9), (0, 0.66), (-0.2, 0.6), (-0.06, 0.2)]
    y = FLOOR + radius
    return loft(name, [section("x", (x + s * width, y, z), (2 * r * radius,) * 2) for s, r in rings], ellipse(20))


def wheels(p, at, out=0.004):
    """Pairs of wheels at these z from front to rear, odd numbers at x > 0, that stand `out` of the car's sides."""
    found = []
    for i, z in enumerate(at):
        found.append(wheel(f"wheel_{2 * i + 1}", p.width / 2 + out, z, p.wheel_radius, TYRE * p.wheel_radius))
        found.append(mirrored(found[-1], f"wheel_{2 * i + 2}"))
    return found


def bumpers(p, share=0.88):
    """A bar before the front of the body and one behind its rear, above its lower edge."""
    y, size = FLOOR + p.clearance + 0.035, (share * p.width, 0.034, 0.02)
    ends = ("bumper_front", 1), ("bumper_rear", -1)
    return [prism(name, (0, y, side * (p.length / 2 + 0.01)), size, "x", rounded(0.4)) for name, side in ends]


def headlights(p, size=(0.07, 0.036), drop=0.034):
    """Two lamps on the front of the body, their middles `drop` below the foot of the windows."""
    centre = (0.29 * p.width, FLOOR + p.belt_height - drop, p.length / 2 + 0.005)
    return pair("headlight", prism("headlight", centre, (*size, 0.01), "z", rounded(0.45, 2)))


def mirrors(p, z):
    """Two mirrors on the edges of the body, their fronts at this z."""
    x, y, steps = 0.485 * p.width, FLOOR + p.belt_height, ((0, 0.5), (0.022, 1), (0.044, 0.9))
    arm = [section("x", (x + s, y + 0.016, z - 0.012), (0.032 * r, 0.024 * r)) for s, r in steps]
    return pair("mirror", loft("mirror", arm, rounded(0.3, 1)))


def pair(kind, part):
    """A part at x > 0 as the right one, and its mirror image as the left one."""
    left = mirrored(part, f"{kind}_left")
    return left, mirrored(left, f"{kind}_right")


def alike(*kinds):
    """The symmetric pairs of parts that come left and right."""
    return tuple((f"{kind}_left", f"{kind}_right") for kind in kinds)
