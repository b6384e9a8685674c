"""Bookcases: boards between walls, and books on some of them; those of other forms stand in `forms`."""

from data_gen.families.bookcase import forms
from data_gen.families.bookcase.parts import BACK, MEANINGS, SIDES, boards, books, case, inside, standing, storeys
from data_gen.families.pieces.casework import WALL, door, knob, shell
from data_gen.families.pieces.pairs import itself
from data_gen.families.pieces.ranges import ranges
from data_gen.families.pieces.soft import between
from data_gen.part import box, joined, mirrored
from data_gen.rig import Contact, Rig


def plain(p):
    """Walls, three shelves and no back, with two rows of books."""
    z = (-p.depth / 2, p.depth / 2)
    frame, x, y = case(p, 0.0, z, p.bottom_height)
    rooms = storeys(*y, 3, p.board_thickness)
    rows = books("books_1", x, rooms[1], z, 0, 9), books("books_2", x, rooms[2], z, 6, 8, from_right=True)
    return *frame, *boards(x, rooms, z, p.board_thickness), *rows


def with_back(p):
    """A tall bookcase with a back, on a plinth: four shelves and three rows of books."""
    z, half = (-p.depth / 2, p.depth / 2), p.width / 2
    free = (z[0] + BACK, z[1])
    frame, x, y = case(p, p.plinth_height, free)
    rooms = storeys(*y, 4, p.board_thickness)
    rows = [books(f"books_{i}", x, rooms[i], free, 4 * i, 12 - 2 * i, i == 2) for i in (1, 2, 3)]
    back = box("back", *between((-half, half), (p.plinth_height, p.height), (z[0], free[0])))
    plinth = box("plinth", *between((-half, half), (0, p.plinth_height), (z[0], z[1] - 0.02)))
    return *frame, back, plinth, *boards(x, rooms, free, p.board_thickness), *rows


def cubes(p):
    """Nine cubes, open to both sides, with baskets in three of them and books in a fourth."""
    z, t = (-p.depth / 2, p.depth / 2), p.board_thickness
    frame, x, y = case(p, 0.0, z)
    rooms, columns = storeys(*y, 2, t), storeys(*x, 2, t)
    walls = [box("wall", *between((columns[1][1], columns[2][0]), room, z)) for room in rooms]
    right = joined("divider_right", *walls)
    places = ((0, 0), (1, 2), (2, 1))
    baskets = [_basket(f"basket_{i}", p, columns[c], rooms[r], z) for i, (r, c) in enumerate(places, start=1)]
    rows = books("books_1", columns[0], rooms[2], z, 0, 14), books("books_2", columns[2], rooms[0], z, 2, 16)
    return *frame, *boards(x, rooms, z, t), mirrored(right, "divider_left"), right, *baskets, *rows


def _basket(name, p, x, y, z):
    """An open basket on the floor of a cube."""
    x, z = ((span[0] + 0.008, span[1] - 0.008) for span in (x, z))
    return shell(name, x, (y[0], y[0] + p.basket_height), z, wall=0.006, up=True)


def with_base(p):
    """A bookcase whose lower part is deeper and closed by two doors."""
    z, half, face = (-p.depth / 2, p.depth / 2), p.width / 2, p.base_depth - p.depth / 2
    free = (z[0] + BACK, z[1])
    frame, x, y = case(p, p.counter_height, free)
    rooms, low = storeys(*y, 2, p.board_thickness), (p.plinth_height, p.counter_height)
    right = door("door_right", (0.0, half), low, face, knob(0.03, 0.72 * p.counter_height, face + WALL))
    return (
        *frame,
        box("back", *between((-half, half), (p.counter_height, p.height), (z[0], free[0]))),
        box("body", *between((-half, half), low, (z[0], face))),
        box("plinth", *between((-half, half), (0, p.plinth_height), (z[0], face - 0.02))),
        mirrored(right, "door_left"),
        right,
        *boards(x, rooms, free, p.board_thickness),
        books("books_1", x, rooms[0], free, 1, 10),
        books("books_2", x, rooms[1], free, 7, 8, from_right=True),
    )


SIZE = {"depth": (0.15, 0.24), "board_thickness": (0.012, 0.028)}
CASE = (*SIDES, *itself("top", "bottom"))
FAMILIES = (
    Rig(
        "bookcase/plain",
        ranges(MEANINGS, width=(0.36, 0.65), height=(0.5, 0.8), **SIZE, bottom_height=(0.01, 0.09)),
        plain,
        (*CASE, *itself("shelf_1", "shelf_2", "shelf_3")),
        (*inside("top", "bottom", "shelf_1", "shelf_2", "shelf_3"), *standing("shelf_1", ["books_1"])),
    ),
    Rig(
        "bookcase/with_back",
        ranges(
            MEANINGS,
            width=(0.34, 0.6),
            height=(0.78, 1.0),
            **SIZE,
            plinth_height=(0.02, 0.08),
        ),
        with_back,
        (*CASE, *itself("back", "plinth", "shelf_1", "shelf_2", "shelf_3", "shelf_4")),
        (
            *inside("top", "bottom", "shelf_1", "shelf_2", "shelf_3", "shelf_4"),
            *standing("plinth", ["bottom", "side_left", "side_right"]),
            Contact("shelf_1", "books_1", "face_y"),
            Contact("back", "shelf_1", "face_z"),
        ),
    ),
    Rig(
        "bookcase/cubes",
        ranges(MEANINGS, width=(0.5, 0.8), height=(0.5, 0.8), **SIZE, basket_height=(0.06, 0.11)),
        cubes,
        (*CASE, *itself("shelf_1", "shelf_2"), ("divider_left", "divider_right")),
        (
            *inside("top", "bottom", "shelf_1", "shelf_2"),
            *standing("bottom", ["divider_left", "divider_right", "basket_1", "books_2"]),
        ),
    ),
    Rig(
        "bookcase/with_base",
        ranges(
            MEANINGS,
            width=(0.4, 0.66),
            height=(0.76, 1.0),
            **SIZE,
            plinth_height=(0.02, 0.06),
            counter_height=(0.26, 0.38),
            base_depth=(0.26, 0.32),
        ),
        with_base,
        (*CASE, *itself("back", "body", "plinth", "shelf_1", "shelf_2"), ("door_left", "door_right")),
        (
            *inside("top", "bottom", "shelf_1", "shelf_2"),
            *standing("body", ["back", "side_left", "side_right", "bottom"]),
            *standing("bottom", ["books_1"]),
            Contact("plinth", "body", "face_y"),
            Contact("body", "door_left", "face_z"),
            Contact("body", "door_right", "face_z"),
        ),
    ),
    *forms.FAMILIES,
)
