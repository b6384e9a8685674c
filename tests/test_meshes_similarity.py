"""The similarity into the training box, the axis that points up, and samples spread by area."""

import numpy as np
import pytest
import torch
import trimesh
from hypothesis import given
from hypothesis import strategies as st

import data_gen
from dsn_lite.data import Frame
from dsn_lite.files import as_shapes
from dsn_lite.meshes import Similarity, sample, up_axis

FRAME = Frame(64, 0.9, (0.5, 0.0, 0.5), (0.0, -0.5, 0.1))
ONTO_ITS_BACK = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # y up to z up, front +z to front -y


@given(scale=st.sampled_from([1e-3, 1.0, 1e3]), seed=st.integers(0, 2**16), up=st.sampled_from(["y", "z"]))
def test_undo_undoes_apply(scale, seed, up):
    points = scale * np.random.default_rng(seed).standard_normal((9, 3)) + scale
    similarity = Similarity.into(FRAME, points, up)
    inside = similarity.apply(points)
    np.testing.assert_allclose(similarity.undo(inside), points, atol=1e-9 * scale)
    np.testing.assert_allclose(similarity.undo_offsets(inside - inside[0]), points - points[0], atol=1e-9 * scale)


@given(seed=st.integers(0, 2**16), up=st.sampled_from(["y", "z"]))
def test_into_gives_the_box_of_the_frame(seed, up):
    points = np.random.default_rng(seed).random((20, 3)) * [3.0, 1.0, 2.0]
    similarity = Similarity.into(FRAME, points, up)
    inside = similarity.apply(points)
    low, high = inside.min(0), inside.max(0)
    assert (high - low).max() == pytest.approx(0.9)
    np.testing.assert_allclose(low + FRAME.share * (high - low), FRAME.anchor, atol=1e-12)
    np.testing.assert_allclose(similarity.rotation @ similarity.rotation.T, np.eye(3))
    assert np.linalg.det(similarity.rotation) == pytest.approx(1)


def test_z_up_is_turned_upright():
    upright = np.random.default_rng(0).random((20, 3))
    expected = Similarity.into(FRAME, upright, "y").apply(upright)
    lying = upright @ ONTO_ITS_BACK.T
    np.testing.assert_allclose(Similarity.into(FRAME, lying, "z").apply(lying), expected, atol=1e-12)


def test_a_training_shape_of_mean_size_stays_where_it_is():
    shapes = as_shapes(data_gen.generate("table/four_legs", count=50, points=512, seed=0))
    frame, points = Frame.of(shapes), shapes.points
    longest = (points.amax(1) - points.amin(1)).amax(-1)
    usual = points[(longest - frame.size).abs().argmin()].double().numpy()
    assert np.abs(Similarity.into(frame, usual).apply(usual) - usual).max() < 0.03


def test_one_point_is_refused():
    with pytest.raises(ValueError, match="points must have an extent, all of them are one point"):
        Similarity.into(FRAME, np.ones((5, 3)))


def test_up_is_seen_on_tables():
    for points in data_gen.generate("table/four_legs", count=10, points=512, seed=1).points:
        assert up_axis(points) == "y"
        assert up_axis(points @ ONTO_ITS_BACK.T) == "z"


def test_up_is_y_where_form_does_not_tell():
    chairs = data_gen.generate("chair/four_legs", count=10, points=512, seed=1).points
    assert {up_axis(points) for points in chairs} == {"y"}
    assert up_axis(sample(trimesh.creation.box((1, 1, 1)), 512)) == "y"


def scene():
    """A unit square, and one three times as wide that the scene stretches to nine."""
    square = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], process=False)
    scene = trimesh.Scene()
    scene.add_geometry(square, node_name="small")
    scene.add_geometry(
        square.copy().apply_scale([3, 1, 1]),
        node_name="large",
        transform=np.diag([3.0, 1, 1, 1]) + np.array([[0, 0, 0, 20.0]] + [[0] * 4] * 3),
    )
    scene.add_geometry(trimesh.PointCloud(np.full((5, 3), 1e3)), node_name="points")
    return scene


def test_samples_are_spread_by_area_where_the_scene_puts_it():
    points = sample(scene(), 4000, seed=0)
    assert points.shape == (4000, 3)
    assert points.dtype == np.float32
    far = points[:, 0] > 10
    assert far.mean() == pytest.approx(0.9, abs=0.02)
    np.testing.assert_allclose(points[far].mean(0), [24.5, 0.5, 0], atol=0.15)
    np.testing.assert_allclose(np.square(points[far] - [24.5, 0.5, 0]).mean(0), [81 / 12, 1 / 12, 0], rtol=0.06)


def test_the_same_seed_gives_the_same_samples():
    assert np.array_equal(sample(scene(), 50, seed=3), sample(scene(), 50, seed=3))
    assert not np.array_equal(sample(scene(), 50, seed=3), sample(scene(), 50, seed=4))


def test_faces_without_area_get_no_samples():
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 9, 9]]
    mesh = trimesh.Trimesh(vertices, [[3, 3, 3], [0, 1, 2], [3, 3, 0]], process=False)
    assert sample(mesh, 500).max() <= 1


@pytest.mark.parametrize(
    ("mesh", "n", "words"),
    [
        (trimesh.creation.box(), 0, "sample: n must be at least 1, got 0"),
        (trimesh.Scene(), 5, "sample: a mesh needs faces, got none"),
        (
            trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]], process=False),
            5,
            "sample: a mesh needs an area",
        ),
    ],
)
def test_what_cannot_be_sampled_is_refused(mesh, n, words):
    with pytest.raises(ValueError, match=words):
        sample(mesh, n)


def test_frame_and_samples_meet_in_torch():
    similarity = Similarity.into(FRAME, sample(scene(), 64))
    assert torch.as_tensor(similarity.apply(sample(scene(), 64))).dtype == torch.float64
