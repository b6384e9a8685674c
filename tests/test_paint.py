"""The painter of contact sheets, against a slow twin that asks of every pixel and every triangle."""

import numpy as np
import pytest
import trimesh

from data_gen import paint as painter
from data_gen.paint import MARGIN, STEP, nearest, paint, tones, window_around

RED, BLUE = (200, 40, 40), (40, 40, 200)
FLAT = np.array([(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0)])
QUAD = np.array([(0, 1, 2), (0, 2, 3)])
FRONT = (0, 0, 1)
NEARER = np.array([0, 0, 0.3])


def twin(corners, pixels):
    """Barycentric coordinates of each pixel in each triangle, one after the other; of equals the later wins."""
    facing = [i for i, (a, b, c) in enumerate(corners) if turn(a, b, c) > 0]
    far = min(corners[..., 2].min(), 0)
    seen, depth = np.full((pixels, pixels), -1), np.full((pixels, pixels), -1)
    for i in facing:
        a, b, c = corners[i]
        for row, column in np.ndindex(pixels, pixels):
            p = (column, row)
            weights = np.array([turn(p, b, c), turn(a, p, c), turn(a, b, p)]) / turn(a, b, c)
            level = int((weights @ corners[i, :, 2] - far) / STEP)
            if (weights >= 0).all() and level >= depth[row, column]:
                seen[row, column], depth[row, column] = i, level
    return seen, depth


def turn(a, b, c):
    """Positive if a, b, c run counter-clockwise on a screen whose rows count downwards."""
    return (c[0] - a[0]) * (b[1] - a[1]) - (b[0] - a[0]) * (c[1] - a[1])


def box(extents=(1, 1, 1), centre=(0, 0, 0)):
    made = trimesh.creation.box(extents)
    return made.vertices + centre, made.faces


def plain(vertices, triangles, colour=RED, size=60, **options):
    return paint(vertices, triangles, np.tile(colour, (len(triangles), 1)), size, ground=False, **options).astype(int)


def painted(picture):
    """The rows and columns (2, 2), first and last, of what is not white."""
    rows, columns = np.nonzero((picture < 255).any(axis=2))
    return np.array([(rows.min(), rows.max()), (columns.min(), columns.max())])


@pytest.mark.parametrize("seed", range(4))
def test_each_pixel_sees_what_the_slow_twin_sees(seed):
    random = np.random.default_rng(seed)
    reach = (3, 10, 40, 200)[seed]  # from smaller than a pixel to far outside the picture
    corners = random.uniform(-6, 26, (60, 1, 3)) + random.normal(0, reach / 2, (60, 3, 3))
    corners[..., 2] = random.uniform(-0.8, 0.8, (60, 3))
    seen, depth = nearest(corners, 20)
    expected, level = twin(corners, 20)
    assert len(np.unique(expected)) > 1
    np.testing.assert_array_equal(seen, expected)
    np.testing.assert_allclose(depth, level, atol=1)


def test_triangles_that_meet_leave_no_pixel_between_them():
    random = np.random.default_rng(0)
    for _ in range(500):
        centre = random.integers(2, 19, 2) / random.integers(1, 3)  # on a pixel, where rounding hurts, or between two
        around = (random.uniform(0, 0.4, 3) + np.arange(3))[:, None] * 2 * np.pi / 3
        rim = centre + random.uniform(200, 300, (3, 1)) * np.hstack([np.cos(around), -np.sin(around)])
        fan = np.stack([np.broadcast_to(centre, rim.shape), rim, np.roll(rim, -1, 0)], axis=1)
        seen, _ = nearest(np.concatenate([fan, np.zeros((3, 3, 1))], axis=2), 21)
        assert (seen >= 0).all(), centre


@pytest.mark.parametrize("shape", [trimesh.creation.box((1, 1, 1)), trimesh.creation.icosphere(3, 0.5)])
@pytest.mark.parametrize("eye", [painter.EYE, (1, 1, 1), (0, 0.2, 1)])
def test_a_closed_convex_shape_has_no_cracks(shape, eye):
    inside = (plain(shape.vertices, shape.faces, eye=eye) < 250).any(axis=2)
    assert inside.any()
    for line in [*inside, *inside.T]:
        assert (np.diff(np.flatnonzero(line)) == 1).all()


@pytest.mark.parametrize("order", [1, -1])
def test_the_nearer_hides_the_farther_whatever_the_order(order):
    vertices = np.concatenate([FLAT, FLAT + NEARER])
    triangles, colours = np.concatenate([QUAD, QUAD + 4]), np.array([RED, RED, BLUE, BLUE])
    picture = paint(vertices, triangles[::order], colours[::order], 40, eye=FRONT)
    red, _, blue = picture[20, 20].astype(int)
    assert blue > red + 50


def test_of_flush_faces_the_later_is_seen_everywhere():
    small = FLAT * 0.5
    triangles, colours = np.concatenate([QUAD, QUAD + 4]), np.array([RED, RED, BLUE, BLUE])
    picture = paint(np.concatenate([FLAT, small]), triangles, colours, 200, ground=False)
    inside = np.s_[85:115, 85:115]
    np.testing.assert_array_equal(picture[inside], plain(small, QUAD, BLUE, size=200)[inside])
    assert np.ptp(picture[inside], axis=(0, 1)).max() == 0


@pytest.mark.parametrize("eye", [painter.EYE, (1, 0.3, 0.5)])
def test_the_unit_cube_just_fits_and_half_a_cube_is_half_as_large(eye):
    whole, half = (painted(plain(*box((edge,) * 3), size=200, eye=eye)) for edge in (1, 0.5))
    extent = (whole[:, 1] - whole[:, 0] + 1).max()
    assert extent == pytest.approx(200 * (1 - 2 * MARGIN), abs=1.5)
    np.testing.assert_allclose(np.diff(half), np.diff(whole) / 2, atol=1.5)
    np.testing.assert_allclose(whole.mean(axis=1), 99.5, atol=1)
    np.testing.assert_allclose(half.mean(axis=1), 99.5, atol=1)


def test_up_is_up_right_is_right_and_front_is_down_left():
    middle = painted(plain(*box((0.1,) * 3))).mean(axis=1)
    moved = [painted(plain(*box((0.1,) * 3, step))).mean(axis=1) - middle for step in 0.3 * np.eye(3)]
    (_, right), (up, aside), (down, left) = moved
    assert right > 5
    assert up < -5
    assert aside == pytest.approx(0, abs=0.6)
    assert down > 3
    assert left < -3


def test_what_is_outside_the_picture_changes_nothing():
    vertices, triangles = box((0.5,) * 3)
    expected = plain(vertices, triangles)
    for step in (5, -5, 1e6) * np.eye(3):
        beyond = np.concatenate([vertices, vertices + step])
        np.testing.assert_array_equal(plain(beyond, np.concatenate([triangles, triangles + 8])), expected)


def test_a_window_is_a_piece_of_the_picture():
    vertices, triangles = box((0.9, 0.5, 0.7))
    whole = plain(vertices, triangles, size=80)
    piece = plain(vertices, triangles, size=40, window=(0.25, 0.5, 0.5))
    np.testing.assert_array_equal(piece, whole[40:80, 20:60])


def test_the_window_around_points_shows_them_all_and_little_else():
    vertices, triangles = box((0.2, 0.3, 0.1), (0.3, -0.1, 0.2))
    found = painted(plain(vertices, triangles, size=100, window=window_around(vertices)))
    assert found.min() >= 1
    assert found.max() <= 98
    assert np.diff(found).max() >= 90


def test_what_turns_away_or_has_no_area_is_not_seen():
    white = np.full((40, 40, 3), 255)
    np.testing.assert_array_equal(plain(FLAT, QUAD[:, ::-1], size=40, eye=FRONT), white)
    np.testing.assert_array_equal(plain(FLAT, np.array([(0, 0, 1), (2, 2, 2)]), size=40, eye=FRONT), white)
    np.testing.assert_array_equal(plain(FLAT, QUAD, size=40, eye=(1, 0, 0)), white)  # from its edge
    nothing = np.zeros((0, 3), int)
    np.testing.assert_array_equal(paint(FLAT, nothing, nothing, 40), white)


def test_top_front_and_right_of_a_box_get_three_tones():
    vertices, triangles = box()
    normals = np.cross(*np.moveaxis(np.diff(vertices[triangles], axis=1), 1, 0))
    sides = np.eye(3)[[1, 2, 0]]
    top, front, right = tones(vertices[triangles])[(normals @ sides.T).argmax(axis=0)]
    left, below = tones(vertices[triangles])[(normals @ -sides[[2, 0]].T).argmax(axis=0)]
    assert 1.05 > top > front + 0.05 > front > left > right + 0.05 > right > below > 0.2
    picture = plain(vertices, triangles, (100, 100, 100), size=80)[..., 0]
    faces = [picture[15, 40], picture[50, 20], picture[50, 65]]
    np.testing.assert_array_equal(faces, np.round(100 * np.array([top, front, right])))


def test_lines_are_where_colours_meet_and_depths_jump_and_nowhere_else():
    colours = np.array([RED, BLUE])
    two = paint(FLAT, QUAD, colours, 60, eye=FRONT, supersample=1, ground=False).astype(int).sum(axis=2)
    one = plain(FLAT, QUAD, size=60, eye=FRONT, supersample=1).sum(axis=2)
    (top, bottom), (left, right) = painted(one[..., None])
    dark = one < one[30, 30]
    rim = np.zeros_like(dark)
    rim[top : bottom + 1, left : right + 1] = True
    rim[top + 1 : bottom, left + 1 : right] = False
    np.testing.assert_array_equal(dark, rim)
    assert (two[top + 1 : bottom, left + 1 : right] < 0.6 * one[30, 30]).any(axis=1).all(), "along the diagonal"


def test_a_line_is_drawn_where_a_part_stands_before_another_of_its_colour():
    stacked = np.concatenate([FLAT, FLAT * 0.5 + NEARER])
    picture = plain(stacked, np.concatenate([QUAD, QUAD + 4]), size=60, eye=FRONT, supersample=1).sum(axis=2)
    (top, _), _ = painted(picture[..., None])
    assert (picture[top + 1 : 30, 30] < 0.6 * picture[30, 30]).sum() == 1


def test_a_pixel_is_the_mean_of_those_it_is_supersampled_from():
    vertices, triangles = box((0.7, 0.4, 0.6))
    fine = plain(vertices, triangles, size=120, supersample=1)
    expected = fine.reshape(40, 3, 40, 3, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(plain(vertices, triangles, size=40, supersample=3), expected, atol=2)


def test_the_shadow_lies_on_the_floor_only_and_fades_with_height():
    colours = np.tile(RED, (12, 1))
    darkest = []
    for height in (-0.35, -0.1, 0.3):
        vertices, triangles = box((0.5, 0.05, 0.5), (0, height, 0))
        bare = paint(vertices, triangles, colours, 80, ground=False)
        standing = paint(vertices, triangles, colours, 80)
        solid = (plain(vertices, triangles, (0, 0, 0), size=80) == 0).all(axis=2)
        np.testing.assert_array_equal(standing[solid], bare[solid])
        added = bare.astype(int) - standing
        assert added.min() >= -1
        assert np.ptp(standing[(bare == 255).all(axis=2)], axis=1).max() == 0, "grey"
        darkest.append(added.max())
    assert darkest[0] > darkest[1] > darkest[2] > 3


def test_the_shadow_is_of_the_underside():
    def added(height):
        vertices, triangles = box((0.4, height, 0.4), (0, height / 2 - 0.5, 0))
        return plain(vertices, triangles) - paint(vertices, triangles, np.tile(RED, (12, 1)), 60)

    assert added(0.9).max() == pytest.approx(added(0.1).max(), rel=0.3)
