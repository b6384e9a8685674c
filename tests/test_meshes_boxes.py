"""Oriented boxes of parts: tight, right-handed, and with their axes in one order."""

import numpy as np
import pytest
import torch
import trimesh
from scipy.spatial.transform import Rotation

import data_gen
from dsn_lite.handles import BoxHandles
from dsn_lite.meshes.boxes import boxes_of, oriented, rest_of

CORNERS = trimesh.creation.box().vertices
SIZE = np.array([3.0, 0.1, 1.0])


def parted(box):
    return box[:3], box[3:12].reshape(3, 3), box[12:]


@pytest.mark.parametrize("angles", [(0, 0, 0), (10, 20, -15), (0, 40, 0), (-30, 25, 25)])
def test_a_turned_box_is_found_again(angles):
    R = Rotation.from_euler("xyz", angles, degrees=True).as_matrix()
    center, rotation, extents = parted(oriented(SIZE * CORNERS @ R.T + [5, -2, 1]))
    np.testing.assert_allclose(center, [5, -2, 1], atol=1e-6)
    np.testing.assert_allclose(rotation, R, atol=1e-6)
    np.testing.assert_allclose(extents, SIZE, atol=1e-6)


@pytest.mark.parametrize("size", [(1, 2, 3), (3, 2, 1), (2, 3, 1), (1, 1, 1), (2, 2, 0.1)])
def test_extents_are_in_the_order_of_the_axes(size):
    _, rotation, extents = parted(oriented(np.array(size) * CORNERS))
    assert np.array_equal(rotation, np.eye(3))
    np.testing.assert_allclose(extents, size)


@pytest.mark.parametrize("seed", range(20))
def test_every_box_holds_its_points_tightly_and_is_right_handed(seed):
    rng = np.random.default_rng(seed)
    points = rng.standard_normal((60, 3)) * rng.random(3) @ Rotation.random(rng=rng).as_matrix()
    center, R, extents = parted(oriented(points))
    local = (points - center) @ R
    np.testing.assert_allclose(R.T @ R, np.eye(3), atol=1e-9)
    assert np.linalg.det(R) == pytest.approx(1)
    np.testing.assert_allclose([local.min(0), local.max(0)], [-extents / 2, extents / 2], atol=1e-9)
    assert extents.prod() <= 1.25 * trimesh.bounds.oriented_bounds(points)[1].prod()
    best = max(np.trace(R[:, order] * signs) for order in ORDERS for signs in SIGNS if proper(R[:, order] * signs))
    assert np.trace(R) == pytest.approx(best)  # no other naming of the axes turns it less


ORDERS = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]]
SIGNS = np.array(np.meshgrid(*[[1, -1]] * 3)).T.reshape(-1, 3)


def proper(R):
    return np.linalg.det(R) > 0


@pytest.mark.parametrize(
    "points",
    [
        CORNERS @ Rotation.from_euler("y", 3, degrees=True).as_matrix(),
        SIZE * CORNERS @ Rotation.from_euler("y", 1, degrees=True).as_matrix(),
        trimesh.creation.cylinder(1, 0.1, sections=8).vertices,
        trimesh.creation.cylinder(1, 5, sections=31).vertices,
        trimesh.creation.icosphere(3).vertices,
    ],
    ids=["cube", "slab", "eight sides", "round", "ball"],
)
def test_what_is_nearly_aligned_or_round_is_aligned(points):
    center, R, extents = parted(oriented(points))
    low, high = points.min(0), points.max(0)
    assert np.array_equal(R, np.eye(3))
    np.testing.assert_allclose([center, extents], [(low + high) / 2, high - low], atol=1e-12)


def test_a_slanted_round_leg_does_not_spin():
    tilt = Rotation.from_euler("zx", [12, 75], degrees=True).as_matrix()
    _, R, extents = parted(oriented(trimesh.creation.cylinder(0.05, 1, sections=32).vertices @ tilt.T))
    axis = tilt[:, 2] * np.sign(tilt[1, 2])
    np.testing.assert_allclose(R[:, 1], axis, atol=1e-6)
    np.testing.assert_allclose(extents, [0.1, 1, 0.1], rtol=0.02)
    least = Rotation.align_vectors(axis, [0, 1, 0])[0].magnitude()
    assert Rotation.from_matrix(R).magnitude() == pytest.approx(least, abs=1e-3)


@pytest.mark.parametrize(
    ("points", "extents"),
    [
        (CORNERS * [0, 1, 2], [0, 1, 2]),
        (CORNERS * [0, 0, 2], [0, 0, 2]),
        (np.ones((4, 3)), [0, 0, 0]),
        (np.ones((1, 3)), [0, 0, 0]),
        ([[0, 0, 0], [0, 1, 0]], [0, 1, 0]),
    ],
    ids=["sheet", "wire", "same points", "one point", "two points"],
)
def test_parts_without_extent_have_boxes(points, extents):
    points = np.array(points, dtype=np.float64)
    center, R, found = parted(oriented(points))
    np.testing.assert_allclose(found, extents, atol=1e-12)
    assert np.array_equal(R, np.eye(3))
    np.testing.assert_allclose(center, np.mean([np.min(points, 0), np.max(points, 0)], 0), atol=1e-12)


def test_a_slanted_sheet_keeps_its_form():
    R = Rotation.from_euler("xyz", [20, 15, 5], degrees=True).as_matrix()
    _, rotation, extents = parted(oriented(CORNERS * [0, 1, 2] @ R.T))
    assert extents[0] == 0
    np.testing.assert_allclose(extents[1:], [1, 2], rtol=1e-6)
    np.testing.assert_allclose(rotation[:, 0], R[:, 0], atol=1e-6)


def test_the_order_of_points_and_the_unit_do_not_matter():
    points = (
        SIZE
        * trimesh.creation.icosphere(4).vertices.clip(-0.6, 0.6)
        @ Rotation.from_euler("xyz", [30, 20, 10]).as_matrix()
    )
    box = oriented(points)
    np.testing.assert_allclose(oriented(np.random.default_rng(0).permutation(points)), box, atol=1e-9)
    large = oriented(1000 * points + 50)
    expected = box * np.repeat([1000, 1, 1000], [3, 9, 3]) + np.repeat([50, 0], [3, 12])
    np.testing.assert_allclose(large, expected, atol=1e-5)


def test_many_points_are_held_to_the_last_one():
    points = np.random.default_rng(3).standard_normal((30000, 3)) * [3, 1, 0.2]
    center, R, extents = parted(oriented(points @ Rotation.from_euler("y", 30, degrees=True).as_matrix()))
    local = (points @ Rotation.from_euler("y", 30, degrees=True).as_matrix() - center) @ R
    np.testing.assert_allclose([local.min(0), local.max(0)], [-extents / 2, extents / 2], atol=1e-9)


@pytest.mark.parametrize("family", ["table/four_legs", "sofa/two_seater"])
def test_boxes_of_vertices_are_those_of_the_rig(family):
    """data_gen tells the boxes of its own parts: upright ones here, where the two must be the same handles."""
    shape = data_gen.generate(family, count=1, points=64, seed=2)
    scene = data_gen.mesh(family, shape.parameters[0])
    labels = np.repeat(range(len(shape.part_names)), [len(scene.geometry[name].vertices) for name in shape.part_names])
    vertices = np.concatenate([scene.geometry[name].vertices for name in shape.part_names])
    boxes = boxes_of(vertices, labels, len(shape.part_names))
    aligned = (boxes[:, 3:12] == np.eye(3).reshape(-1)).all(1)
    assert aligned.sum() >= 4
    np.testing.assert_allclose(boxes[aligned], shape.boxes[0][aligned], atol=1e-5)


def test_handles_of_the_boxes_put_every_vertex_where_it_is():
    scene = data_gen.mesh("chair/arms", data_gen.generate("chair/arms", count=1, points=16, seed=0).parameters[0])
    pieces = [geometry.vertices for geometry in scene.geometry.values()] + [CORNERS[:4] * [0, 1, 1] + [2, 0, 0]]
    labels = np.repeat(range(len(pieces)), list(map(len, pieces)))
    vertices = np.concatenate(pieces)
    boxes = boxes_of(vertices, labels, len(pieces))
    rest = rest_of(vertices, labels, boxes)
    assert np.abs(rest).max() <= 0.5 + 1e-9
    assert not rest[labels == len(pieces) - 1, 0].any()
    handles = BoxHandles(*map(torch.from_numpy, (labels, rest, boxes)))
    np.testing.assert_allclose(handles.offsets(handles.z0).numpy(), vertices, atol=1e-9)
    assert handles.dropped == (f"part_{len(pieces) - 1}.scale.x",)


def test_a_point_of_no_part_rests_at_nothing():
    assert not rest_of(np.ones((1, 3)), np.array([-1]), oriented(CORNERS)[None]).any()
