"""Laws every family passes, over random parameters and at the corners of its parameter box."""

import functools
import itertools
import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import data_gen
from data_gen import draw, fits
from data_gen.faults import faults
from data_gen.part import normals
from data_gen.rig import FLOOR
from data_gen.truth import jacobian

EXACT = 1e-12
SEEDS = st.integers(0, 2**32 - 1)
FAMILIES = pytest.mark.parametrize("name", data_gen.families())
FEW = settings(max_examples=4)


def parameters_of(name, seed, count=8):
    rig = data_gen.family(name)
    return rig, rig.draw(count, np.random.default_rng(seed))


@functools.cache
def extremes(rig):
    """The corners of the parameter box, 512 of them at random where there are more."""
    p = len(rig.parameters)
    if p <= 9:
        return np.array(list(itertools.product(*zip(rig.low, rig.high, strict=True))))
    high = np.random.default_rng(0).random((512, p)) < 0.5
    return np.where(high, rig.high, rig.low)


@functools.cache
def turned(rig):
    """512 corners of the lengths at random angles, where turning parts reach farthest; none where nothing turns."""
    if rig.linear:
        return np.zeros((0, len(rig.parameters)))
    corners = extremes(rig)
    return rig.between(np.tile(corners, (-(-512 // len(corners)), 1)), np.random.default_rng(0))


def anywhere(name, seed):
    """A rig, and parameters inside its ranges and at their corners."""
    rig, parameters = parameters_of(name, seed)
    return rig, np.concatenate([parameters, extremes(rig)])


def areas_and_volumes(rig, vertices):
    """The doubled areas (F, N) of all triangles, and the signed volumes (P, N) inside the parts."""
    points = np.ascontiguousarray(vertices.transpose(2, 1, 0))
    a, b, c = (points[:, rig.triangles[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a, axis=0)
    starts = np.searchsorted(rig.triangle_part, np.arange(len(rig.part_names)))
    return np.linalg.norm(normal, axis=0), np.add.reduceat((a * normal).sum(axis=0), starts) / 6


@FAMILIES
@FEW
@given(seed=SEEDS, sampling=st.sampled_from(["fresh", "shared"]))
def test_points_lie_on_the_mesh_of_the_part_they_are_labelled_with(name, seed, sampling):
    shapes = data_gen.generate(name, count=2, points=40, seed=seed, sampling=sampling, dtype="float64")
    rig = data_gen.family(name)
    for i, vertices in enumerate(rig.vertices(shapes.parameters)):
        samples = shapes.samples(i)
        labels = shapes.labels if shapes.labels.ndim == 1 else shapes.labels[i]
        a, b, c = vertices[rig.triangles[samples.faces]].swapaxes(0, 1)
        u, v = samples.weights.astype(np.float64).T[:, :, None]
        assert ((samples.weights >= 0) & (samples.weights.sum(1, keepdims=True) <= 1 + 1e-6)).all()
        np.testing.assert_allclose(shapes.points[i], (1 - u - v) * a + u * b + v * c, atol=EXACT)
        np.testing.assert_array_equal(
            rig.vertex_part[rig.triangles[samples.faces]], np.repeat(labels[:, None], 3, axis=1)
        )


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_points_lie_in_their_boxes_where_the_rest_coordinates_say(name, seed):
    shapes = data_gen.generate(name, count=2, points=40, seed=seed, dtype="float64")
    boxes = np.take_along_axis(shapes.boxes, shapes.labels[:, :, None].astype(int), axis=1)
    turn = boxes[:, :, 3:12].reshape(2, 40, 3, 3)
    there = boxes[:, :, :3] + np.einsum("npij,npj->npi", turn, boxes[:, :, 12:] * shapes.rest)
    np.testing.assert_allclose(shapes.points, there, atol=EXACT)
    np.testing.assert_allclose(turn @ turn.swapaxes(2, 3), np.broadcast_to(np.eye(3), turn.shape), atol=EXACT)
    assert np.abs(shapes.rest).max() <= 0.5 + EXACT


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_handle_matrix_times_handles_gives_the_points(name, seed):
    shapes = data_gen.generate(name, count=2, points=40, seed=seed, dtype="float64")
    B, z0 = data_gen.handles(shapes, 1)
    np.testing.assert_allclose(B @ z0, shapes.points[1], atol=EXACT)


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_all_that_is_built_is_linear_in_the_parameters(name, seed):
    rig, parameters = parameters_of(name, seed)
    assert fits.nonlinearity(rig, parameters) < EXACT


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_declared_contacts_have_no_gap(name, seed):
    rig, parameters = anywhere(name, seed)
    assert np.abs(fits.gaps(rig, parameters)).max(initial=0.0) < EXACT


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_parts_in_contact_reach_over_each_other(name, seed):
    rig, parameters = anywhere(name, seed)
    centres, extents = rig.rest_boxes(parameters)
    for contact in rig.contacts:
        one, two = (rig.part_names.index(contact[i]) for i in (0, 1))
        reach = (extents[:, one] + extents[:, two]) / 2 - np.abs(centres[:, one] - centres[:, two])
        across = [axis for axis in range(3) if contact.kind != f"face_{'xyz'[axis]}"]
        assert (reach[:, across] > 0.002).all(), contact


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_symmetric_pairs_mirror(name, seed):
    rig, parameters = parameters_of(name, seed)
    assert fits.asymmetries(rig, parameters).max(initial=0.0) < EXACT
    assert {part for pair in rig.symmetric for part in pair} <= set(rig.part_names)


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_joints_sit_where_the_parts_they_join_are(name, seed):
    rig, parameters = anywhere(name, seed)
    assert fits.loose_hinges(rig, parameters).max(initial=0.0) < EXACT
    for joint in rig.joint_list:
        assert {joint.on, *joint.parts} <= set(rig.part_names)
        assert joint.on not in joint.parts


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_parts_that_turn_keep_their_form(name, seed):
    rig, parameters = parameters_of(name, seed, count=2)
    rest, posed = rig.rest_vertices(parameters), rig.vertices(parameters)
    for part in range(len(rig.part_names)):
        one, other = (v[:, rig.vertex_part == part] for v in (rest, posed))
        distances = [np.linalg.norm(v[:, :1] - v, axis=-1) for v in (one, other)]
        np.testing.assert_allclose(*distances, atol=EXACT)
    (_, volumes), (_, before) = (areas_and_volumes(rig, vertices) for vertices in (posed, rest))
    np.testing.assert_allclose(volumes, before, atol=EXACT)


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_the_jacobian_is_what_differences_say(name, seed):
    rig, p = parameters_of(name, seed, count=1)
    samples = draw.fresh(rig, rig.middle, 30, [np.random.default_rng(seed + i) for i in range(4)]).row(0)
    stated, step = jacobian(rig, samples, p), 1e-6
    for j in range(p.shape[1]):
        ends = [
            rig.place(samples, np.clip(p + sign * step * np.eye(p.shape[1])[j], rig.low, rig.high))[0]
            for sign in (1, -1)
        ]
        reach = np.diff(np.clip(p[0, j] + step * np.array([-1, 1]), rig.low[j], rig.high[j]))[0]
        np.testing.assert_allclose(stated[:, :, j], (ends[0] - ends[1]) / reach, atol=1e-6)


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_linear_rigs_move_by_the_jacobian_exactly(name, seed):
    rig, p = parameters_of(name, seed, count=3)
    samples = draw.fresh(rig, rig.middle, 300, [np.random.default_rng(seed + i) for i in range(4)]).row(0)
    moved = np.diff(rig.place(samples, p), axis=0)
    told = np.einsum("nik,mk->mni", jacobian(rig, samples, p[:1]), np.diff(p, axis=0))
    assert np.abs(moved).max() > 1e-6
    assert (np.abs(moved - told).max() < EXACT) == rig.linear


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_areas_are_those_of_the_triangles(name, seed):
    rig, parameters = parameters_of(name, seed)
    slow = np.linalg.norm(normals(rig.vertices(parameters), rig.triangles), axis=-1)
    np.testing.assert_allclose(rig.areas(parameters - rig.middle), slow, atol=EXACT)


@FAMILIES
@FEW
@given(seed=SEEDS)
def test_boxes_reach_as_far_as_the_vertices(name, seed):
    rig = data_gen.family(name)
    parameters = np.concatenate([rig.draw(8, np.random.default_rng(seed)), extremes(rig)[:100]])
    vertices, boxes = rig.rest_vertices(parameters), rig.rest_boxes(parameters)
    for i in range(len(rig.part_names)):
        own = vertices[:, rig.vertex_part == i]
        np.testing.assert_allclose(boxes[1][:, i], np.ptp(own, axis=1), atol=EXACT)
        np.testing.assert_allclose(boxes[0][:, i], (own.min(axis=1) + own.max(axis=1)) / 2, atol=EXACT)


@FAMILIES
def test_shapes_are_sound_at_the_corners_of_the_parameter_box_and_inside(name):
    rig = data_gen.family(name)
    parameters = np.concatenate([extremes(rig), rig.draw(300, np.random.default_rng(0))])
    rest, extents = rig.rest_vertices(parameters), rig.rest_boxes(parameters)[1]
    assert np.isfinite(rest).all()
    assert extents.min() >= 0.004 - EXACT, "no part is flat"
    for rows in np.array_split(rest, len(rest) // 50):
        areas, volumes = areas_and_volumes(rig, rows)
        assert volumes.min() > 1e-8, "no part is inverted"
        assert areas.min() > 1e-9, "no triangle vanishes"


@FAMILIES
def test_shapes_stay_inside_the_bounds_also_while_they_turn(name):
    rig = data_gen.family(name)
    parameters = np.concatenate([extremes(rig), turned(rig), rig.draw(300, np.random.default_rng(0))])
    vertices = rig.vertices(parameters)
    assert np.isfinite(vertices).all()
    assert np.abs(vertices).max() <= 0.5 + EXACT


@FAMILIES
def test_authors_are_told_of_no_faults(name):
    assert faults(data_gen.family(name)) == []


@FAMILIES
def test_a_family_has_2_to_16_parts_and_few_enough_triangles(name):
    rig = data_gen.family(name)
    assert (1 if name == "box/one" else 2) <= len(rig.part_names) <= 16
    assert len(set(rig.part_names)) == len(rig.part_names)
    assert len(rig.triangles) < 2**15
    assert len(rig.parameters) == len(set(rig.parameter_names)) >= 3


@FAMILIES
def test_the_same_seed_gives_the_same_bytes(name):
    with tempfile.TemporaryDirectory() as folder:  # no fixture: the law also holds for families that are no test's
        for file, seed in (("one", 0), ("same", 0), ("other", 1)):
            data_gen.save(data_gen.generate(name, count=2, points=8, seed=seed), Path(folder) / f"{file}.npz")
        one, same, other = ((Path(folder) / f"{file}.npz").read_bytes() for file in ("one", "same", "other"))
    assert one == same != other


@FAMILIES
def test_a_parameter_out_of_range_is_refused_with_its_name_and_range(name):
    for one in data_gen.family(name).parameters:
        for value in (one.low - 0.01, one.high + 0.01):
            said = f"{one.name} of {name} must be in [{one.low:g}, {one.high:g}], got {value:g} "
            with pytest.raises(ValueError, match=re.escape(said)):
                data_gen.generate(name, count=1, points=2, fixed={one.name: value})


@FAMILIES
def test_parameters_are_independent_of_each_other(name):
    rig = data_gen.family(name)
    columns = np.concatenate([slope.reshape(len(rig.parameters), -1) for slope in rig.slopes], axis=1)
    assert np.linalg.matrix_rank(columns, tol=1e-6) == len(rig.parameters)


@FAMILIES
def test_shapes_stand_hang_or_fly_all_at_one_height(name):
    rig = data_gen.family(name)
    heights = rig.rest_vertices(extremes(rig))[:, :, 1]
    stands, hangs = np.abs(heights.min(axis=1) - FLOOR).max() < EXACT, np.abs(heights.max(axis=1) + FLOOR).max() < EXACT
    swings = not rig.linear and np.ptp(heights.min(axis=1)) < EXACT  # what swings through may need room below
    assert stands or hangs or swings or rig.category == "airplane"


@FAMILIES
def test_meshes_are_watertight_and_face_outwards(name):
    rig, parameters = parameters_of(name, 0, count=1)
    scene = data_gen.mesh(name, parameters[0])
    assert tuple(scene.geometry) == rig.part_names
    for part in scene.geometry.values():
        assert part.is_watertight
        assert part.is_winding_consistent
        assert all(body.volume > 0 for body in part.split(only_watertight=False)), "outward normals"
        assert part.visual.uv.shape == (len(part.vertices), 2)
        assert ((part.visual.uv >= 0) & (part.visual.uv <= 1)).all()


def test_the_same_name_means_the_same_thing_in_a_category():
    meanings = {}
    for rig in map(data_gen.family, data_gen.families()):
        for one in rig.parameters:
            said = (one.meaning, one.unit)
            assert meanings.setdefault((rig.category, one.name), said) == said, (rig.name, one.name)
