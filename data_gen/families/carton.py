"""Cartons: open boxes of board whose flaps turn about the upper edges of their walls; flaps may carry tucks."""

from data_gen.families.pieces.pairs import itself, stack
from data_gen.joint import hinge
from data_gen.part import loft, section
from data_gen.rig import FLOOR, Contact, Parameter, Rig

WIDTH = Parameter("width", 0.36, 0.56, "edge of the body along x")
HEIGHT = Parameter("height", 0.25, 0.5, "from the floor to the upper side of the walls")
DEPTH = Parameter("depth", 0.36, 0.56, "edge of the body along z")
LENGTH = "from the hinge of a flap to its edge"
WALL = 0.03
"""Thickness of a wall, as a share of the edge across it."""
BOARD = 0.01
"""Thickness of a flap."""
TAPER = 0.3
"""How much a flap narrows to each side towards its free edge, as a share of its length: leaning in, it stays clear."""
TUCK = 0.5
"""Length of a tuck, as a share of its flap's."""
REST = {"flap": "it stands upright", "tuck": "it goes on as its flap does"}
SIDES = {"left": (-1, 0), "right": (1, 0), "front": (0, 1), "rear": (0, -1)}
"""Which way each wall faces, along x and z."""


def angles(low, high, *names, of="flap"):
    """A parameter for the turn of each flap or tuck."""
    which = [(name, f"turn of the {name.split('_')[0]} {of} outwards, 0 where {REST[of]}") for name in names]
    return tuple(Parameter(f"{name}_angle", low, high, meaning, "rad") for name, meaning in which)


def body(p):
    """Four walls and a floor: a skin that goes up outside and down inside."""
    top, inner = FLOOR + p.height, 1 - 2 * WALL
    steps = (FLOOR, 1), (top, 1), (top, inner), (FLOOR + WALL * p.height, inner)
    return loft("body", [section("y", (0, y, 0), (share * p.width, share * p.depth)) for y, share in steps])


def edge(p, side, height):
    """The middle of the upper edge of a wall, or the point that much above it."""
    x, z = SIDES[side]
    return x * (1 - WALL) * p.width / 2, FLOOR + p.height + height, z * (1 - WALL) * p.depth / 2


def panel(p, name, side, low, length, narrower):
    """A board over the upper edge of a wall, from a height above it, cut on both sides by so much at foot and head."""
    x = SIDES[side][0]
    wide = p.depth if x else (1 - 2 * WALL) * p.width
    rings = [(low, wide - 2 * narrower[0]), (low + length, wide - 2 * narrower[1])]
    sizes = [(y, (BOARD, w) if x else (w, BOARD)) for y, w in rings]
    return loft(name, [section("y", edge(p, side, y), size) for y, size in sizes])


def turned(p, name, part, side, on, height, angle):
    """A hinge at a height above the upper edge of a wall: its part turns outwards."""
    x, z = SIDES[side]
    return hinge(f"{name}_hinge", [part], on, (z, 0, -x), edge(p, side, height), angle)


def flap(p, side, taper=TAPER):
    """A flap on a wall, and its hinge."""
    board = panel(p, f"flap_{side}", side, 0, p.flap_length, (0, taper * p.flap_length))
    return board, turned(p, side, board.name, side, "body", 0, getattr(p, f"{side}_angle"))


def tuck(p, side):
    """A tuck on a flap, and its hinge, which the flap carries."""
    length = p.flap_length
    board = panel(p, f"tuck_{side}", side, length, TUCK * length, (TAPER * length, 1.8 * TAPER * length))
    angle = getattr(p, f"{side}_tuck_angle")
    return board, turned(p, f"{side}_tuck", board.name, side, f"flap_{side}", length, angle)


def two_flaps(p):
    """A body with a flap over its left and its right wall."""
    return body(p), *flap(p, "left", 0), *flap(p, "right", 0)


def four_flaps(p):
    """A body with a flap over each wall."""
    return body(p), *(one for side in SIDES for one in flap(p, side))


def eight_flaps(p):
    """A body with a flap over each wall, and a tuck on each flap that turns with it."""
    return *four_flaps(p), *(one for side in SIDES for one in tuck(p, side))


def tuck_lid(p):
    """A body with a lid on its rear wall, long enough to close it, a tuck on the lid, and two dust flaps."""
    lid = panel(p, "lid", "rear", 0, p.depth, (0, 0))
    board = panel(p, "tuck", "rear", p.depth, p.tuck_length, (0, 0.03))
    hinges = (
        turned(p, "lid", "lid", "rear", "body", 0, p.lid_angle),
        turned(p, "tuck", "tuck", "rear", "lid", p.depth, p.tuck_angle),
    )
    return body(p), *flap(p, "left"), *flap(p, "right"), lid, board, *hinges


ON_WALLS = tuple(Contact("body", f"flap_{side}", "face_y") for side in SIDES)
ON_FLAPS = tuple(Contact(f"flap_{side}", f"tuck_{side}", "face_y") for side in SIDES)
TWO = (*itself("body"), ("flap_left", "flap_right"))
FOUR = (*TWO, *itself("flap_front", "flap_rear"))
EIGHT = (*FOUR, ("tuck_left", "tuck_right"), *itself("tuck_front", "tuck_rear"))
FAMILIES = (
    Rig(
        "carton/two_flaps",
        (WIDTH, HEIGHT, DEPTH, Parameter("flap_length", 0.12, 0.17, LENGTH), *angles(-1.5, 2.4, "left", "right")),
        two_flaps,
        TWO,
        ON_WALLS[:2],
    ),
    Rig(
        "carton/four_flaps",
        (WIDTH, HEIGHT, DEPTH, Parameter("flap_length", 0.12, 0.2, LENGTH), *angles(-0.3, 2.4, *SIDES)),
        four_flaps,
        FOUR,
        ON_WALLS,
    ),
    Rig(
        "carton/eight_flaps",
        (
            WIDTH,
            HEIGHT,
            DEPTH,
            Parameter("flap_length", 0.1, 0.14, LENGTH),
            *angles(-0.3, 2.0, *SIDES),
            *angles(-1.0, 0.9, *(f"{side}_tuck" for side in SIDES), of="tuck"),
        ),
        eight_flaps,
        EIGHT,
        (*ON_WALLS, *ON_FLAPS),
    ),
    Rig(
        "carton/tuck_lid",
        (
            WIDTH,
            Parameter("height", 0.2, 0.36, HEIGHT.meaning),
            Parameter("depth", 0.3, 0.42, DEPTH.meaning),
            Parameter("flap_length", 0.1, 0.16, LENGTH),
            Parameter("tuck_length", 0.06, 0.1, "from the hinge of the tuck to its edge"),
            *angles(0.0, 2.2, "left", "right"),
            Parameter("lid_angle", -1.3, 0.5, "turn of the lid outwards, 0 where it is upright", "rad"),
            Parameter("tuck_angle", -1.2, 0.3, "turn of the tuck outwards, 0 where it goes on as the lid does", "rad"),
        ),
        tuck_lid,
        (*TWO, *itself("lid", "tuck")),
        (*ON_WALLS[:2], *stack("body", "lid", "tuck")),
    ),
)
