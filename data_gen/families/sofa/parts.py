"""What sofas share: the meaning of their parameters, and an upholstered frame with cushions in it."""

from data_gen.families.pieces.feet import four_feet, under
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.soft import between, soft, tilted
from data_gen.part import RECTANGLE, mirrored
from data_gen.rig import Contact

MEANINGS = {
    "width": "outer edge along x",
    "depth": "edge along z, without a chaise, a footrest or an ottoman",
    "seat_height": "from the floor to the upper side of the seat",
    "back_height": "from the upper side of the seat to the upper end of the back",
    "back_thickness": "edge of the back along z",
    "seat_thickness": "edge of a seat cushion along y",
    "cushion_thickness": "edge of a loose back cushion along z",
    "arm_width": "edge of an arm along x",
    "arm_height": "from the upper side of the seat to the upper side of an arm",
    "arm_slope": "how much lower an arm is in front than at the back",
    "leg_height": "from the floor to the lower side of the base",
    "leg_splay": "how much farther out a leg stands on the floor, along x and z",
    "roll_diameter": "diameter of the rolls on the arms and the back",
    "hump_height": "how much higher the back is in the middle than at its sides",
    "chaise_width": "edge of the chaise along x",
    "chaise_depth": "how far the chaise reaches in front of the other seats",
    "ottoman_width": "edge of the ottoman along x",
    "ottoman_depth": "edge of the ottoman along z",
    "footrest_out": "how far the footrests stand in front of the seats",
    "console_width": "edge of the console between the seats along x",
    "bar_thickness": "thickness of the wooden bars",
    "bolster_diameter": "diameter of the bolsters",
}
FRAME = {
    "depth": (0.34, 0.48),
    "seat_height": (0.17, 0.23),
    "back_height": (0.13, 0.26),
    "back_thickness": (0.06, 0.1),
    "seat_thickness": (0.05, 0.08),
}
TALL = {**FRAME, "seat_height": (0.2, 0.25), "seat_thickness": (0.05, 0.075)}
"""A frame on legs one sees."""
ARMS = {"arm_width": (0.05, 0.13), "arm_height": (0.04, 0.12)}
LEGS = {"leg_height": (0.02, 0.06)}
PILLOWS = {"cushion_thickness": (0.05, 0.08)}
MIDDLE = itself("base", "back")
WITH_ARMS = (*MIDDLE, ("arm_left", "arm_right"))
PILLOW = 0.13
"""Edge of a small square cushion."""
APRON = 0.012
"""How far the cushions of a seat stand out over the base."""


def half_seat(p):
    """Half the width between the arms."""
    return p.width / 2 - p.arm_width


def even(span, count):
    """A span cut into equal ones."""
    step = (span[1] - span[0]) / count
    return [(span[0] + i * step, span[0] + (i + 1) * step) for i in range(count)]


def base(p, x):
    """The box that the cushions lie on."""
    height = (p.leg_height, p.seat_height - p.seat_thickness)
    return soft("base", *between(x, height, (-p.depth / 2, p.depth / 2 - APRON)), radius=0.01)


def back(p, x):
    """An upright back on the rear edge of the base."""
    height = (p.seat_height - p.seat_thickness, p.seat_height + p.back_height)
    return soft("back", *between(x, height, (-p.depth / 2, p.back_thickness - p.depth / 2)), radius=0.025)


def seats(p, x, count, first=1):
    """Seat cushions side by side in front of the back."""
    height, depth = (p.seat_height - p.seat_thickness, p.seat_height), (p.back_thickness - p.depth / 2, p.depth / 2)
    return [soft(f"seat_{i}", *between(one, height, depth)) for i, one in enumerate(even(x, count), start=first)]


def cushions(p, x, count, first=1):
    """Loose cushions on the seat that lean on the upper edge of the back."""
    rear, top = p.back_thickness - p.depth / 2, p.seat_height + p.back_height
    depth, height = (rear, rear + p.cushion_thickness), (p.seat_height, top)
    spans = enumerate(even(x, count), start=first)
    return [tilted(soft(f"cushion_{i}", *between(one, height, depth), radius=0.024), top) for i, one in spans]


def arms(p):
    """Two boxes beside the base, from its lower side up."""
    x, height = (half_seat(p), p.width / 2), (p.leg_height, p.seat_height + p.arm_height)
    right = soft("arm_right", *between(x, height, (-p.depth / 2, p.depth / 2)), radius=0.024)
    return mirrored(right, "arm_left"), right


def pillows(p, x, front):
    """Two small cushions at x and -x that lean on what stands behind the plane z = front."""
    height, depth = (p.seat_height, p.seat_height + PILLOW), (front, front + 0.05)
    spot = between((x - PILLOW / 2, x + PILLOW / 2), height, depth)
    right = tilted(soft("pillow_right", *spot, radius=0.022), p.seat_height + PILLOW, 0.25)
    return mirrored(right, "pillow_left"), right


def block_feet(p, thickness=0.035):
    """Four square feet under the corners."""
    x, z = p.width / 2 - 0.03, p.depth / 2 - 0.03
    return four_feet(x, z, p.leg_height, thickness, outline=RECTANGLE)


def beside(part):
    """The contacts of a part in the middle with the two arms."""
    return Contact("arm_left", part, "face_x"), Contact(part, "arm_right", "face_x")


def on_base(*parts):
    """The contacts of parts that stand on the base."""
    return tuple(Contact("base", part, "face_y") for part in parts)


def behind(*parts):
    """The contacts of seat cushions with the back behind them."""
    return tuple(Contact("back", part, "face_z") for part in parts)


def under_arms():
    """The contacts of the feet with the arms above them."""
    return under("arm_right", "arm_left", "arm_right", "arm_left")
