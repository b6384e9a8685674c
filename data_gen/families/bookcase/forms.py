"""Bookcases of other forms: a leaning ladder, stairs of cubes, planks between iron posts."""

from data_gen.families.bookcase.parts import MEANINGS, SIDES, books, inside, standing, storeys
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between
from data_gen.part import RECTANGLE, box, joined, loft, mirrored, moved, section
from data_gen.rig import FLOOR, Contact, Rig

RUNGS = (0.08, 0.31, 0.54, 0.77)
"""The heights of a ladder's shelves as shares of its height."""
RAIL = 0.03
"""Edge of a ladder's rail along z."""

COLUMNS = (3, 3, 2, 1)
"""How many cubes high the walls of stairs are from left to right, and how many wide the floors are from below."""


def ladder(p):
    """Rails that lean on uprights like a ladder; the higher a shelf between them, the less deep it is."""
    rear, foot, half, t = -p.depth / 2, (p.depth - RAIL) / 2, p.width / 2, p.bar_thickness
    ends = ((FLOOR, foot), (FLOOR + p.height, -foot))
    rail = loft("rail", [section("y", (half - t / 2, y, z), (t, RAIL)) for y, z in ends], RECTANGLE)
    right = joined(
        "side_right", rail, box("upright", *between((half - t, half), (0, p.height - 0.1), (rear, rear + 0.02)))
    )
    x, found, rows = (t - half, half - t), [], []
    for i, share in enumerate(RUNGS, start=1):
        level, z = share * p.height, (rear, foot - share * (p.depth - RAIL))
        found.append(box(f"shelf_{i}", *between(x, (level, level + p.board_thickness), z)))
        if i in (2, 3):
            room = (level + p.board_thickness, level + 0.2 * p.height)
            rows.append(books(f"books_{i - 1}", x, room, z, 5 * i, 14 - 2 * i, i == 3))
    return mirrored(right, "side_left"), right, *found, *rows


def stairs(p):
    """Columns of three, two and one open cubes, so that they form stairs, with books and a box in them."""
    t, z, start = p.board_thickness, (-p.depth / 2, p.depth / 2), -p.width / 2
    rooms = storeys(t, p.height - t, 2, t)
    columns = [(start + t, start + p.column_width - t), *storeys(start + p.column_width, -start - t, 1, t)]
    lefts = [start, *(column[1] for column in columns)]
    steps = zip(("side_left", "divider_1", "divider_2", "side_right"), lefts, COLUMNS, strict=True)
    floors = zip(("bottom", "shelf_1", "shelf_2", "top"), (0.0, *(room[1] for room in rooms)), COLUMNS, strict=True)
    return (
        *(joined(name, *(box("wall", *between((x, x + t), room, z)) for room in rooms[:n])) for name, x, n in steps),
        *(box(name, *between((start, lefts[n] + t), (y, y + t), z)) for name, y, n in floors),
        books("books_1", columns[0], rooms[2], z, 0, 13),
        books("books_2", columns[1], rooms[0], z, 3, 16),
        books("books_3", columns[1], rooms[1], z, 5, 10, from_right=True),
    )


def posts(p):
    """Four planks between iron posts, with a cross of braces at the rear, and two rows of books."""
    t, inner = p.bar_thickness, p.depth / 2 - p.bar_thickness
    x, z = (-p.width / 2, p.width / 2), (-inner, inner)
    low, high = p.bottom_height, 0.96 * p.height - 0.05
    levels = [low + share * (high - low) for share in (0, 1 / 3, 2 / 3, 1)]
    planks = [between(x, (at, at + p.board_thickness), z) for at in levels]
    rooms = [(at + p.board_thickness, at + 0.26 * p.height) for at in levels[1:3]]
    front = box("post", *between((x[1] - t, x[1]), (0, p.height), (inner, inner + t)))
    rear = moved(front, by=(0, 0, -2 * inner - t))
    return (
        *(box(f"shelf_{i}", *plank) for i, plank in enumerate(planks, start=1)),
        *(moved(front, "post_1"), mirrored(front, "post_2"), moved(rear, "post_3"), mirrored(rear, "post_4")),
        _cross(p, (levels[0], levels[-1])),
        books("books_1", x, rooms[0], z, 1, 11),
        books("books_2", x, rooms[1], z, 8, 8, from_right=True),
    )


def _cross(p, y):
    """Two bars that cross behind the planks."""
    half, z, thick = p.width / 2 - p.bar_thickness, (p.bar_thickness - p.depth) / 2, (0.016, 0.5 * p.bar_thickness)
    ends = [(x, FLOOR + at, z) for x, at in ((-half, y[0]), (half, y[1]))]
    bar = loft("bar", [section("x", end, thick) for end in ends], RECTANGLE)
    return joined("brace", bar, mirrored(bar, "bar"))


POSTS = (("post_1", "post_2"), ("post_3", "post_4"))
SHELVES = itself("shelf_1", "shelf_2", "shelf_3", "shelf_4")
FAMILIES = (
    Rig(
        "bookcase/ladder",
        ranges(
            MEANINGS,
            width=(0.28, 0.46),
            height=(0.75, 1.0),
            depth=(0.24, 0.38),
            board_thickness=(0.012, 0.028),
            bar_thickness=(0.016, 0.034),
        ),
        ladder,
        (*SIDES, *SHELVES),
        (*inside("shelf_1", "shelf_2", "shelf_3", "shelf_4"), Contact("shelf_2", "books_1", "face_y")),
    ),
    Rig(
        "bookcase/stairs",
        ranges(
            MEANINGS,
            width=(0.6, 0.85),
            height=(0.5, 0.85),
            depth=(0.15, 0.24),
            board_thickness=(0.012, 0.028),
            column_width=(0.18, 0.3),
        ),
        stairs,
        itself("bottom", "shelf_1"),
        (
            *standing("bottom", ["side_left", "divider_1", "divider_2", "side_right", "books_2"]),
            *standing("shelf_1", ["books_3"]),
            *standing("shelf_2", ["books_1"]),
            Contact("side_right", "shelf_1", "face_y"),
            Contact("divider_2", "shelf_2", "face_y"),
            Contact("side_left", "top", "face_y"),
        ),
    ),
    Rig(
        "bookcase/posts",
        ranges(
            MEANINGS,
            width=(0.4, 0.7),
            height=(0.7, 1.0),
            depth=(0.16, 0.26),
            board_thickness=(0.014, 0.034),
            bar_thickness=(0.014, 0.032),
            bottom_height=(0.01, 0.14),
        ),
        posts,
        (*SHELVES, *POSTS, ("brace", "brace")),
        (
            *(Contact(f"shelf_{i}", "post_1", "face_z") for i in (1, 2, 3, 4)),
            *(Contact("post_3", f"shelf_{i}", "face_z") for i in (1, 2, 3, 4)),
            Contact("shelf_2", "books_1", "face_y"),
            Contact("shelf_3", "books_2", "face_y"),
        ),
    ),
)
