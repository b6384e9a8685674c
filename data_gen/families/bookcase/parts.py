"""What bookcases share: the meaning of their parameters, boards between walls, and books."""

from data_gen.families.pieces.soft import between
from data_gen.part import box, joined, mirrored
from data_gen.rig import Contact

MEANINGS = {
    "width": "outer edge along x",
    "height": "from the floor to the upper end",
    "depth": "outer edge along z",
    "board_thickness": "thickness of walls and shelves",
    "bottom_height": "from the floor to the lower side of the lowest board",
    "column_width": "outer edge along x of the highest column",
    "plinth_height": "from the floor to the upper side of the plinth",
    "counter_height": "from the floor to the upper side of the part that is closed",
    "base_depth": "edge along z of the part that is closed",
    "bar_thickness": "edge of a post or a rail along x and z",
    "basket_height": "edge of a basket along y",
}
BOOKS = (
    *((0.05, 0.78), (0.035, 0.7), (0.06, 0.86), (0.04, 0.66), (0.04, 0.82), (0.07, 0.74), (0.03, 0.88), (0.05, 0.6)),
    *((0.045, 0.8), (0.03, 0.72), (0.06, 0.64), (0.05, 0.9), (0.035, 0.76)),
)
"""The width of each book as a share of its shelf, and its height as a share of the room above it."""
BACK = 0.008
"""Thickness of a back."""
SIDES = (("side_left", "side_right"),)


def standing(lower, upper):
    """The contacts of what stands on a part."""
    return tuple(Contact(lower, part, "face_y") for part in upper)


def inside(*shelves):
    """The contacts of boards with the walls on both sides."""
    return tuple(c for s in shelves for c in (Contact("side_left", s, "face_x"), Contact(s, "side_right", "face_x")))


def books(name, x, y, z, first=0, count=5, from_right=False):
    """Books side by side on a shelf from its left end, or from its right."""
    chosen, wide = [BOOKS[(first + i) % len(BOOKS)] for i in range(count)], x[1] - x[0]
    at, found = (1 - sum(share for share, _ in chosen)) * wide + x[0] if from_right else x[0], []
    for i, (share, high) in enumerate(chosen):
        front = z[1] - (0.08 + 0.05 * (i % 3)) * (z[1] - z[0])
        found.append(box("book", *between((at, at + share * wide), (y[0], y[0] + high * (y[1] - y[0])), (z[0], front))))
        at = at + share * wide
    return joined(name, *found)


def storeys(low, high, count, thickness):
    """The free heights between `count` boards at equal distances from low to high."""
    step = (high - low - count * thickness) / (count + 1)
    return [(low + i * (step + thickness), low + i * (step + thickness) + step) for i in range(count + 1)]


def case(p, low, z, lift=0.0):
    """Two walls from a height up, a top and, lifted, a bottom between them; the room inside as spans along x and y."""
    t, half = p.board_thickness, p.width / 2
    right = box("side_right", *between((half - t, half), (low, p.height), z))
    x, y = (t - half, half - t), (low + lift + t, p.height - t)
    top, bottom = (box(n, *between(x, s, z)) for n, s in (("top", (y[1], p.height)), ("bottom", (low + lift, y[0]))))
    return (mirrored(right, "side_left"), right, top, bottom), x, y


def boards(x, rooms, z, thickness):
    """The shelves between free heights."""
    floors = enumerate((room[1] for room in rooms[:-1]), start=1)
    return [box(f"shelf_{i}", *between(x, (at, at + thickness), z)) for i, at in floors]
