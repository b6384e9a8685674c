"""Laws every family passes, over random parameters and at the corners of its parameter box."""

import itertools

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

import data_gen
from data_gen.part import Box
from data_gen.rig import FLOOR

EXACT = 1e-12
SEEDS = st.integers(0, 2**32 - 1)
FAMILIES = pytest.mark.parametrize("name", data_gen.families())


def parameters_of(name, seed, count=8):
    rig = data_gen.family(name)
    return rig, rig.draw(count, np.random.default_rng(seed))


@FAMILIES
@given(seed=SEEDS, sampling=st.sampled_from(["fresh", "shared"]))
def test_points_lie_on_the_surface_of_the_part_they_are_labelled_with(name, seed, sampling):
    shapes = data_gen.generate(name, count=3, points=40, seed=seed, sampling=sampling, dtype="float64")
    labels = np.broadcast_to(shapes.labels, shapes.points.shape[:2])
    boxes = np.take_along_axis(shapes.boxes, labels[:, :, None].astype(int), axis=1)
    inside = np.abs(shapes.points - boxes[:, :, :3]) - boxes[:, :, 12:] / 2
    assert np.abs(inside.max(axis=-1)).max() < EXACT, "the face nearest to a point is at distance 0"


@FAMILIES
@given(seed=SEEDS)
def test_points_lie_on_the_mesh(name, seed):
    shapes = data_gen.generate(name, count=1, points=60, seed=seed, dtype="float64")
    scene = data_gen.mesh(name, shapes.parameters[0])
    for i, part in enumerate(shapes.part_names):
        own = shapes.points[0][shapes.labels[0] == i]
        if len(own):
            _, distance, _ = trimesh.proximity.closest_point_naive(scene.geometry[part], own)
            assert distance.max() < 1e-9


@FAMILIES
@given(seed=SEEDS)
def test_declared_contacts_have_no_gap(name, seed):
    rig, parameters = parameters_of(name, seed)
    assert np.abs(rig.gaps(parameters)).max(initial=0.0) < EXACT


@FAMILIES
@given(seed=SEEDS)
def test_parts_in_contact_share_a_face_of_some_area(name, seed):
    rig, parameters = parameters_of(name, seed)
    boxes = dict(zip(rig.part_names, rig.boxes(parameters).swapaxes(0, 1), strict=True))
    for contact in rig.contacts:
        one, two = boxes[contact.first], boxes[contact.second]
        reach = (one[:, 12:] + two[:, 12:]) / 2 - np.abs(one[:, :3] - two[:, :3])
        across = [axis for axis in range(3) if contact.kind != f"face_{'xyz'[axis]}"]
        assert (reach[:, across] > 0.01).all(), contact


@FAMILIES
@given(seed=SEEDS)
def test_symmetric_pairs_mirror(name, seed):
    rig, parameters = parameters_of(name, seed)
    assert rig.asymmetries(parameters).max() < EXACT
    assert {part for pair in rig.symmetric for part in pair} == set(rig.part_names)


@FAMILIES
def test_corners_of_the_parameter_box_give_sound_shapes(name):
    rig = data_gen.family(name)
    corners = np.array(list(itertools.product(*zip(rig.low, rig.high, strict=True))))
    boxes = rig.boxes(corners)
    low, high = boxes[:, :, :3] - boxes[:, :, 12:] / 2, boxes[:, :, :3] + boxes[:, :, 12:] / 2
    assert np.isfinite(boxes).all()
    assert (boxes[:, :, 12:] >= 0.02 - EXACT).all(), "no part is inverted or thinner than 0.02"
    assert low.min() >= -0.5 - EXACT
    assert high.max() <= 0.5 + EXACT
    np.testing.assert_allclose(low[:, :, 1].min(axis=1), FLOOR, atol=EXACT)


@FAMILIES
def test_corners_of_the_parameter_box_keep_parts_apart(name):
    rig = data_gen.family(name)
    corners = np.array(list(itertools.product(*zip(rig.low, rig.high, strict=True))))
    boxes = rig.boxes(corners)
    for one, two in itertools.combinations(boxes.swapaxes(0, 1), 2):
        overlap = (one[:, 12:] + two[:, 12:]) / 2 - np.abs(one[:, :3] - two[:, :3])
        assert overlap.min(axis=1).max() < EXACT, "two parts would share a volume"


@FAMILIES
def test_parameters_are_independent_of_each_other(name):
    rig = data_gen.family(name)
    assert np.linalg.matrix_rank(rig.jacobian) == len(rig.parameters)


@FAMILIES
@given(seed=SEEDS)
def test_meshes_are_watertight_and_face_outwards(name, seed):
    rig, parameters = parameters_of(name, seed, count=1)
    scene = data_gen.mesh(name, parameters[0])
    extents = rig.boxes(parameters)[0, :, 12:]
    assert tuple(scene.geometry) == rig.part_names
    for part, size in zip(scene.geometry.values(), extents, strict=True):
        assert part.is_watertight
        assert np.isclose(part.volume, size.prod()), "a negative volume would mean inward normals"
        assert part.visual.uv.shape == (len(part.vertices), 2)


@pytest.mark.parametrize("ending", ["glb", "obj", "ply"])
def test_written_meshes_keep_their_form_and_colours(tmp_path, ending):
    rig = data_gen.family("table/shelf")
    scene = data_gen.mesh(rig.name, rig.middle[0])
    data_gen.save_mesh(scene, tmp_path / f"one.{ending}")
    data_gen.save_mesh(data_gen.mesh("box/one", [0.5, 0.5, 0.5]), tmp_path / f"two.{ending}")
    read = trimesh.load_scene(tmp_path / f"one.{ending}").to_mesh()
    assert np.isclose(read.volume, scene.to_mesh().volume, rtol=1e-5)
    again = trimesh.load_scene(tmp_path / f"one.{ending}")
    assert _colours(again) == _colours(scene)
    assert not list(tmp_path.glob("*.part"))


def _colours(scene):
    """Every colour in use, with the low corner of the box around its points."""
    found = set()
    for part in scene.dump():
        if part.visual.kind == "texture":
            colours = np.tile(part.visual.material.main_color, (len(part.vertices), 1))
        else:
            colours = np.asarray(part.visual.vertex_colors)
        for colour in np.unique(colours, axis=0):
            lowest = part.vertices[(colours == colour).all(axis=1)].min(axis=0)
            found.add((*colour.tolist(), *lowest.round(4).tolist()))
    return found


def test_an_unknown_mesh_format_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"save_mesh: a mesh file must end in .glb, .obj, .ply, got a.stl; choose"):
        data_gen.save_mesh(data_gen.mesh("box/one", [0.5, 0.5, 0.5]), tmp_path / "a.stl")


def test_a_mesh_out_of_range_is_refused():
    with pytest.raises(ValueError, match=r"mesh: depth of box/one must be in \[0.3, 1\], got 2 in row 0"):
        data_gen.mesh("box/one", [0.5, 0.5, 2])


def test_the_papers_table_has_a_top_and_four_legs_at_its_corners():
    rig = data_gen.family("table/four_legs")
    top, *legs = rig.boxes(rig.middle)[0]
    signs = [(1, 1), (-1, 1), (1, -1), (-1, -1)]
    assert rig.part_names == ("top", "leg_1", "leg_2", "leg_3", "leg_4")
    for leg, sign in zip(legs, signs, strict=True):
        np.testing.assert_allclose(leg[[0, 2]] + sign * leg[[12, 14]] / 2, sign * top[[12, 14]] / 2, atol=EXACT)


def test_families_are_listed_by_category():
    assert data_gen.families("table") == ("table/four_legs", "table/shelf")
    assert set(data_gen.families("chair")) < set(data_gen.families())


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match=r"families: a category must be one of table, chair, box, got 'lamp'"):
        data_gen.families("lamp")
    with pytest.raises(ValueError, match=r"family: a family must be one of table/four_legs, .*, got 'table'; check"):
        data_gen.family("table")


def test_the_same_name_means_the_same_thing():
    meanings = {}
    for rig in map(data_gen.family, data_gen.families("table") + data_gen.families("chair")):
        for parameter in rig.parameters:
            assert meanings.setdefault(parameter.name, parameter) == parameter


def test_boxes_are_what_the_sampler_takes_parts_for():
    assert Box.PATCHES == len(Box.areas(np.ones(3)))
