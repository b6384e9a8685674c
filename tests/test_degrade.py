"""Degraded clouds: noise of the deviation asked, and just what an eye far away sees."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import arrays_differ, tables

import data_gen
from data_gen import draw
from data_gen.points import Samples
from data_gen.sample import SAMPLED
from data_gen.visible import visible

DIRECTIONS = [(0, 0, 1), (0, 1, 0), (0.3, -0.5, -1)]
MIXED = ("table/shelf", "carton/two_flaps")


def seen_by_loops(vertices, triangles, point, own, direction):
    """Whether a ray from a point of triangle `own` meets no other triangle on its way (Moeller and Trumbore's test)."""
    a, b, c = vertices[triangles[own]]
    if np.dot(np.cross(b - a, c - a), direction) <= 0:
        return False
    for i, (a, b, c) in enumerate(vertices[triangles]):
        across = np.cross(direction, c - a)
        lean = np.dot(b - a, across)
        if i == own or abs(lean) < 1e-15:
            continue
        u = np.dot(point - a, across) / lean
        other = np.cross(point - a, b - a)
        v, far = np.dot(direction, other) / lean, np.dot(c - a, other) / lean
        if u >= 0 and v >= 0 and u + v <= 1 and far > 1e-9:
            return False
    return True


@pytest.mark.parametrize("name", ["table/shelf", "carton/two_flaps", "chair/four_legs"])
@pytest.mark.parametrize("direction", DIRECTIONS)
@settings(max_examples=3)
@given(seed=st.integers(0, 2**32 - 1))
def test_what_is_visible_is_what_rays_reach(name, direction, seed):
    rig, direction = data_gen.family(name), np.array(direction) / np.linalg.norm(direction)
    parameters = rig.draw(1, np.random.default_rng(seed))
    samples = draw.fresh(rig, parameters, 60, [np.random.default_rng((seed, i)) for i in range(4)]).row(0)
    vertices, points = rig.vertices(parameters)[0], rig.place(Samples(*samples), parameters)[0]
    slow = [
        seen_by_loops(vertices, rig.triangles, *each, direction) for each in zip(points, samples.faces, strict=True)
    ]
    np.testing.assert_array_equal(visible(vertices, rig.triangles, samples, direction), slow)
    assert 0 < np.sum(slow) < 60


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@pytest.mark.parametrize("family", ["table/four_legs", "carton/two_flaps", MIXED])
def test_all_that_is_seen_is_visible_and_where_the_shape_is(family, sampling):
    direction = np.array([0.36, 0.48, 0.8])
    shapes = data_gen.generate(family, count=4, points=50, sampling=sampling, dtype="float64")
    seen = data_gen.seen_from(shapes, 3 * direction, seed=1)
    assert {*arrays_differ(shapes, seen)} == set(SAMPLED)
    assert seen.points.shape == shapes.points.shape
    for i in range(4):
        rig = data_gen.family(seen.family(i))
        own = [seen.parameter_names.index(name) for name in rig.parameter_names]
        given = seen.parameters[i, own][None]
        assert visible(rig.vertices(given)[0], rig.triangles, seen.samples(i), direction).all()
        np.testing.assert_allclose(rig.place(seen.samples(i), given)[0], seen.points[i], atol=1e-12)
        parts = [rig.part_names[part] for part in rig.triangle_part[seen.samples(i).faces]]
        assert [seen.part_names[label] for label in seen.labels[i]] == parts
    assert seen.about["view"] == {"direction": pytest.approx(direction.tolist()), "seed": 1}
    assert (seen.about["sampling"], seen.about["corresponds"]) == ("fresh", False)


def test_from_above_one_sees_of_a_box_its_upper_face_and_from_a_corner_three_by_area():
    box = data_gen.generate("box/one", count=1, points=20_000)
    above = data_gen.seen_from(box, (0, 1, 0))
    np.testing.assert_allclose(above.points[0, :, 1], box.points[0, :, 1].max(), atol=1e-6)
    corner, (width, height, depth) = data_gen.seen_from(box, (1, 1, 1)), box.boxes[0, 0, 12:]
    shares = np.array([height * depth, depth * width, width * height])
    found = (np.abs(corner.rest[0] - 0.5) < 1e-6).sum(axis=0)
    expected = 20_000 * shares / shares.sum()
    assert (np.abs(found - expected) < 5 * np.sqrt(expected)).all()


def test_from_above_a_table_hides_its_legs():
    shapes = tables(points=200)
    assert (data_gen.seen_from(shapes, (0, 1, 0)).labels == shapes.part_names.index("top")).all()
    assert (data_gen.seen_from(shapes, (0, -1, 0)).labels != shapes.part_names.index("top")).any()


def test_views_follow_their_seed_and_the_first_shapes_those_of_fewer():
    shapes = data_gen.generate(MIXED, count=5, points=30)
    one = data_gen.seen_from(shapes, (0, 0, 1), seed=4)
    assert not arrays_differ(one, data_gen.seen_from(shapes, (0, 0, 1), seed=4))
    assert not arrays_differ(one[:2], data_gen.seen_from(shapes[:2], (0, 0, 1), seed=4))
    assert arrays_differ(one, data_gen.seen_from(shapes, (0, 0, 1), seed=5))


@pytest.mark.parametrize("family", ["table/four_legs", MIXED])
def test_pieces_are_degraded_as_the_whole_is(family):
    whole = data_gen.generate(family, count=7, points=30)
    for degrade in (
        lambda shapes, **row: data_gen.noisy(shapes, 0.01, 4, **row),
        lambda shapes, **row: data_gen.seen_from(shapes, (0, 0, 1), 4, **row),
    ):
        expected = degrade(whole)
        for start in (0, 3, 6):
            piece = degrade(whole[start : start + 3], first=start)
            assert not arrays_differ(piece, expected[start : start + 3])
            assert piece.about == {**expected.about, "split": None}


def test_noise_is_another_in_every_shape():
    still = data_gen.Collection(np.zeros((50, 40, 3)))
    drawn = data_gen.noisy(still, 1, seed=3).points.reshape(50, -1)
    assert len(np.unique(drawn)) == drawn.size
    correlations = np.corrcoef(drawn)[np.triu_indices(50, 1)]
    assert np.abs(correlations).max() < 6 / np.sqrt(120)


def test_new_samples_of_a_view_are_of_all_sides_and_clean():
    degraded = data_gen.noisy(data_gen.seen_from(tables(points=300), (0, 1, 0)), 0.02)
    again = data_gen.resample(degraded, 3)
    assert (again.labels > 0).any()
    assert not {"view", "noise"} & set(again.about)
    assert "noise" not in data_gen.seen_from(degraded, (0, 0, 1)).about


@pytest.mark.parametrize("dtype", ["float32", "float64"])
def test_noise_has_the_deviation_asked_and_leaves_all_else(dtype):
    shapes = data_gen.generate(MIXED, count=20, points=1000, dtype=dtype)
    noise = data_gen.noisy(shapes, 0.02, seed=6)
    moved = (noise.points - shapes.points).ravel()
    assert noise.points.dtype == dtype
    np.testing.assert_allclose(moved.std(), 0.02, rtol=5 / np.sqrt(2 * len(moved)))
    np.testing.assert_allclose(moved.mean(), 0, atol=5 * 0.02 / np.sqrt(len(moved)))
    np.testing.assert_allclose((moved**4).mean() / 0.02**4, 3, atol=0.1)  # as Gaussian noise has it
    assert arrays_differ(shapes, noise) == ["points"]
    assert noise.about == {**shapes.about, "noise": {"deviation": 0.02, "seed": 6}}
    assert not arrays_differ(noise, data_gen.noisy(shapes, 0.02, seed=6))
    assert arrays_differ(noise, data_gen.noisy(shapes, 0.02, seed=7)) == ["points"]


def test_degraded_clouds_can_be_saved(tmp_path):
    degraded = data_gen.noisy(data_gen.seen_from(data_gen.generate(MIXED, count=4, points=20), (0, 0, 1)), 0.01)
    data_gen.save(degraded, tmp_path / "a.npz")
    assert data_gen.load(tmp_path / "a.npz").about == degraded.about


def test_normalised_clouds_fill_their_cube():
    shapes = data_gen.generate(MIXED, count=6, points=100)
    cubes = data_gen.normalised(shapes)
    low, high = cubes.points.min(axis=1), cubes.points.max(axis=1)
    np.testing.assert_allclose((high - low).max(axis=1), 2, atol=1e-6)
    np.testing.assert_allclose((high + low) / 2, 0, atol=1e-6)
    across = lambda points: np.linalg.norm(points[:, 1:] - points[:, :1], axis=-1)
    ratio = across(cubes.points) / across(shapes.points)
    np.testing.assert_allclose(ratio, np.broadcast_to(ratio[:, :1], ratio.shape), rtol=1e-3)
    assert {*arrays_differ(shapes, cubes)} == {"points", "rest", "faces", "weights", "boxes", "joints"}
    assert cubes.boxes is None
    again = data_gen.resample(cubes, 2)
    np.testing.assert_allclose(np.abs(again.points).max(axis=(1, 2)), 1, atol=1e-6)
    assert arrays_differ(cubes, again) == ["points", "labels"]


def test_noise_after_normalising_is_in_the_unit_that_about_says():
    cubes = data_gen.normalised(data_gen.generate("box/one", count=20, points=1000))
    noise = data_gen.noisy(cubes, 0.1)
    np.testing.assert_allclose((noise.points - cubes.points).std(), 0.1, rtol=0.02)
    assert noise.about["units"] == "a cube of its own for each cloud, [-1, 1]^3"
    assert noise.about["noise"]["deviation"] == 0.1
    assert "noise" not in data_gen.resample(noise, 0).about


# what is refused


def test_noise_before_normalising():
    words = r"normalised: clouds must be without noise, got noise {'deviation': 0.1, 'seed': 2}; add it to normalised"
    with pytest.raises(ValueError, match=words):
        data_gen.normalised(data_gen.noisy(tables(), 0.1, 2))


@pytest.mark.parametrize("seed", [-1, 0.5])
def test_seeds_that_are_none(seed):
    words = f"seed must be a whole number >= 0, got {seed}; choose one"
    with pytest.raises(ValueError, match=f"noisy: {words}"):
        data_gen.noisy(tables(), 0.1, seed)
    with pytest.raises(ValueError, match=f"seen_from: {words}"):
        data_gen.seen_from(tables(), (0, 0, 1), seed)


def test_no_shapes_to_see():
    with pytest.raises(ValueError, match=r"seen_from: a collection must hold a shape or more, got none; choose other"):
        data_gen.seen_from(tables()[:0], (0, 0, 1))


@pytest.mark.parametrize("deviation", [-0.1, np.inf, np.nan])
def test_noise_that_is_no_deviation(deviation):
    with pytest.raises(
        ValueError, match=rf"noisy: deviation must be finite and >= 0, got {deviation}; 0.005 is a good"
    ):
        data_gen.noisy(tables(), deviation)


@pytest.mark.parametrize("direction", [(0, 0, 0), (1, 0), (0, np.nan, 1)])
def test_a_direction_of_no_length(direction):
    with pytest.raises(ValueError, match=r"seen_from: direction must be three numbers that are not all 0, got .*; try"):
        data_gen.seen_from(tables(), direction)


@pytest.mark.parametrize("shapes", [data_gen.Collection(np.zeros((2, 5, 3))), data_gen.normalised(tables())])
def test_shapes_of_which_the_mesh_is_not_known(shapes):
    with pytest.raises(
        ValueError, match=r"seen_from: shapes must hold their family and parameters, .*; use what generate"
    ):
        data_gen.seen_from(shapes, (0, 0, 1))
