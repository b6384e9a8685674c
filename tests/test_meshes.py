"""Meshes deformed by a space: what moves, by how much, and that everything else stays."""

from copy import deepcopy

import numpy as np
import pytest
import torch
import trimesh
from trimesh.visual import ColorVisuals, TextureVisuals
from trimesh.visual.material import PBRMaterial
from worlds import linear_space

from dsn_lite import meshes
from dsn_lite.config import Config, network
from dsn_lite.data import Frame
from dsn_lite.dictionary import offsets
from dsn_lite.meshes.surface import parts, placed

FRAME = Frame(64, 0.9, (0.5, 0.0, 0.5), (0.0, -0.5, 0.0))
SPACE = network(Config(k=4, features=(8, 16), head=(8,)), FRAME)
LONG = trimesh.creation.box((2.0, 0.5, 1.0))
TALL = trimesh.creation.box((1.0, 3.0, 1.0))


def seamed(name="oak", size=(2.0, 0.5, 1.0), red=200):
    """A box whose sides share no vertex, with normals, UVs, a material, colours at vertices and numbers at faces."""
    box = trimesh.creation.box(size)
    box.unmerge_vertices()
    rng = np.random.default_rng(0)
    visual = TextureVisuals(rng.random((36, 2)), PBRMaterial(name=name, baseColorFactor=[red, 120, 40, 255]))
    visual.vertex_attributes["color"] = rng.integers(0, 255, (36, 4), dtype=np.uint8)
    normals = np.repeat(box.face_normals, 3, axis=0)
    box = trimesh.Trimesh(box.vertices, box.faces, visual=visual, vertex_normals=normals, process=False)
    box.vertex_attributes["_heat"] = rng.random(36)
    box.face_attributes["part"] = np.arange(12)
    return box


def scene():
    """Two nodes share one geometry, one of them under a parent that turns and stretches it; a third has its own."""
    scene, turn = trimesh.Scene(), trimesh.transformations.rotation_matrix(0.7, [0, 1, 0], [1, 0, 2])
    scene.add_geometry(seamed(), node_name="left", geom_name="leg", transform=turn)
    stretch = np.diag([1.0, 2.0, 0.5, 1.0])
    scene.graph.update("right", "left", matrix=stretch, geometry="leg", metadata={"note": "kept"})
    scene.add_geometry(seamed("glass", (1, 1, 3), red=10), node_name="top", geom_name="top")
    return scene


def places(mesh):
    return np.concatenate([placed(geometry.vertices, matrix) for geometry, matrix in parts(mesh).values()])


def by_hand(x, y, z):
    """The obvious twin: one vertex at a time, each shape by its own similarity."""
    similarity = [meshes.Similarity.into(FRAME, places(mesh)) for mesh in (x, y, z)]
    clouds = [s.apply(meshes.sample(mesh, 64, 0)) for s, mesh in zip(similarity, (x, y, z), strict=True)]
    x, y, sampled = (torch.tensor(cloud, dtype=torch.float32) for cloud in clouds)
    v, there = SPACE.vector(x, y), similarity[2]
    rows = []
    for vertex in places(z):
        at = torch.tensor(there.apply(vertex[None]), dtype=torch.float32)
        moved = at + offsets(SPACE.dictionary(sampled, at=at), v).detach()
        rows.append(there.undo(moved.double().numpy()))
    return np.concatenate(rows)


@pytest.mark.parametrize("mesh", [LONG, scene()], ids=["mesh", "scene"])
def test_deform_is_the_action_at_the_vertices(mesh):
    deformed = meshes.deform(SPACE, mesh, TALL, up="y")
    np.testing.assert_allclose(places(deformed), by_hand(mesh, TALL, mesh), atol=1e-5)
    assert np.abs(places(deformed) - places(mesh)).max() > 1e-3


def test_transfer_is_the_action_at_the_vertices():
    z = seamed(size=(1.0, 5.0, 3.0))
    moved = meshes.transfer(SPACE, LONG, TALL, z, up="y")
    np.testing.assert_allclose(places(moved), by_hand(LONG, TALL, z), atol=1e-5)
    assert np.abs(places(moved) - places(z)).max() > 1e-3


def test_the_result_follows_the_unit_and_place_of_the_source():
    large = LONG.copy().apply_scale(1000).apply_translation([5e3, -7e3, 2e3])
    expected = 1000 * meshes.deform(SPACE, LONG, TALL).vertices + [5e3, -7e3, 2e3]
    np.testing.assert_allclose(meshes.deform(SPACE, large, TALL).vertices, expected, atol=1e-1)


def test_a_mesh_deformed_into_itself_keeps_its_bits():
    assert np.array_equal(places(meshes.deform(SPACE, scene(), scene())), places(scene()))


def test_seams_stay_closed_to_the_last_bit():
    before = meshes.carrying.subdivided(seamed(), 0.07)
    after = meshes.deform(SPACE, before, TALL)
    _, together = np.unique(before.vertices, axis=0, return_inverse=True)
    pairs = np.unique(np.column_stack([together.reshape(-1), after.vertices]), axis=0)
    assert len(pairs) == together.max() + 1 < len(before.vertices)


def test_each_place_is_evaluated_once():
    space, seen = deepcopy(SPACE), []
    hook = lambda module, given, options, A: seen.append(options["at"].shape)
    space.dictionary.register_forward_hook(hook, with_kwargs=True)
    meshes.deform(space, seamed(), TALL)
    assert seen == [(8, 3)]


def test_everything_but_the_vertices_stays():
    before, after = scene(), meshes.deform(SPACE, scene(), TALL)
    assert set(after.graph.nodes) == set(before.graph.nodes)
    assert after.graph.transforms.edge_data["left", "right"]["metadata"] == {"note": "kept"}
    for name in ("left", "right", "top"):
        (old, matrix), (new, same) = parts(before)[name], parts(after)[name]
        assert np.array_equal(matrix, same)
        assert np.array_equal(old.faces, new.faces)
        assert np.array_equal(old.visual.uv, new.visual.uv)
        assert np.array_equal(old.visual.vertex_attributes["color"], new.visual.vertex_attributes["color"])
        assert old.visual.material.name == new.visual.material.name
        assert np.array_equal(old.vertex_attributes["_heat"], new.vertex_attributes["_heat"])
        assert np.array_equal(old.face_attributes["part"], new.face_attributes["part"])


def test_the_source_itself_is_not_touched():
    source = scene()
    meshes.deform(SPACE, source, TALL, subdivide=0.2)
    assert np.array_equal(places(source), places(scene()))
    assert len(source.geometry) == 2


def test_copies_of_one_geometry_deform_differently():
    after = meshes.deform(SPACE, scene(), TALL)
    assert len(after.geometry) == 3
    (left, _), (right, _) = parts(after)["left"], parts(after)["right"]
    assert np.abs(left.vertices - right.vertices).max() > 1e-4


def test_normals_are_computed_anew_and_smooth_where_they_were():
    sphere = trimesh.creation.icosphere(subdivisions=2)
    smooth = sphere.vertex_normals[sphere.faces.reshape(-1)]
    corners = sphere.vertices[sphere.faces.reshape(-1)]
    split = trimesh.Trimesh(corners, np.arange(len(corners)).reshape(-1, 3), vertex_normals=smooth, process=False)
    deformed = meshes.deform(SPACE, split, LONG)
    _, first, group = np.unique(deformed.vertices, axis=0, return_index=True, return_inverse=True)
    np.testing.assert_allclose(deformed.vertex_normals, deformed.vertex_normals[first][group.reshape(-1)], atol=1e-12)
    flat = meshes.deform(SPACE, seamed(), TALL)
    assert (np.einsum("fci,fi->fc", flat.vertex_normals[flat.faces], flat.face_normals) > 0.95).all()
    assert np.abs(flat.vertex_normals - seamed().vertex_normals).max() > 1e-5


def test_a_mesh_without_normals_gets_none():
    bare = trimesh.Trimesh(LONG.vertices, LONG.faces, process=False)
    assert "vertex_normals" not in meshes.deform(SPACE, bare, TALL)._cache


@pytest.mark.parametrize("kind", ["uv", "vertex", "face", "none"])
def test_subdividing_keeps_form_and_looks(kind):
    box = seamed()
    ramp = (255 * (box.vertices / box.extents + 0.5)).round()
    visuals = {
        "vertex": ColorVisuals(vertex_colors=ramp),
        "face": ColorVisuals(face_colors=np.arange(48).reshape(12, 4)),
    }
    if kind != "uv":
        box.visual = visuals.get(kind, ColorVisuals())
    else:
        box.visual.uv = box.vertices[:, :2]
    fine = meshes.carrying.subdivided(box, 0.3)
    assert fine.edges_unique_length.max() <= 0.3
    assert fine.area == pytest.approx(box.area)
    np.testing.assert_allclose(np.linalg.norm(fine.vertex_normals, axis=1), 1)
    origin = fine.face_attributes["part"]  # part of a face is its number before
    np.testing.assert_allclose(fine.face_normals, box.face_normals[origin], atol=1e-9)
    assert len(fine.vertex_attributes["_heat"]) == len(fine.vertices)
    if kind == "uv":
        np.testing.assert_allclose(fine.visual.uv, fine.vertices[:, :2], atol=1e-12)
        assert fine.visual.material.name == "oak"
        assert fine.visual.vertex_attributes["color"].shape == (len(fine.vertices), 4)
        assert fine.visual.vertex_attributes["color"].dtype == np.uint8
    elif kind == "vertex":
        expected = 255 * (fine.vertices / box.extents + 0.5)
        assert np.abs(fine.visual.vertex_colors[:, :3] - expected).max() <= 1
    elif kind == "face":
        assert np.array_equal(fine.visual.face_colors, box.visual.face_colors[origin])
    else:
        assert fine.visual.kind is None


def test_subdividing_measures_edges_where_the_scene_puts_them():
    fine = meshes.deform(SPACE, scene(), scene(), subdivide=0.1)
    longest = np.ptp(places(scene()), axis=0).max()
    for geometry, matrix in parts(fine).values():
        corners = placed(geometry.vertices, matrix)[geometry.faces]
        lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
        assert 0.04 * longest < lengths.max() <= 0.1 * longest


def test_a_subdivided_seam_has_no_crack():
    fine = meshes.deform(SPACE, seamed(), TALL, subdivide=0.1)
    fine.merge_vertices(merge_tex=True, merge_norm=True)
    assert fine.is_watertight


def test_points_are_a_target_too():
    cloud = meshes.sample(TALL, 64, 0)
    shuffled = meshes.deform(SPACE, LONG, torch.tensor(cloud), up="y")
    again = meshes.deform(SPACE, LONG, np.random.default_rng(5).permutation(cloud), up="y")
    np.testing.assert_allclose(shuffled.vertices, again.vertices, atol=1e-6)
    assert np.abs(shuffled.vertices - LONG.vertices).max() > 1e-3


def test_as_many_points_are_drawn_as_in_training():
    space, seen = deepcopy(SPACE), []
    space.encode.register_forward_hook(lambda module, given, code: seen.append(given[0].shape))
    meshes.deform(space, LONG, meshes.sample(TALL, 200, 0))
    assert seen == [(64, 3)] * 2


def test_up_is_y_in_a_glb_whatever_the_form(tmp_path):
    on_its_back = trimesh.creation.cone(1.0, 1.0)
    assert meshes.up_axis(meshes.sample(on_its_back, 2048)) == "z"
    meshes.save_mesh(on_its_back, tmp_path / "a.glb")
    meshes.save_mesh(on_its_back, tmp_path / "a.ply")
    moved = {kind: meshes.deform(SPACE, tmp_path / f"a.{kind}", TALL) for kind in ("glb", "ply")}
    for kind, up in {"glb": "y", "ply": "z"}.items():
        expected = meshes.deform(SPACE, on_its_back, TALL, up=(up, "y"))
        np.testing.assert_allclose(places(moved[kind]), expected.vertices, atol=1e-6)


def test_a_mesh_that_lies_on_its_back_deforms_the_same():
    turn = trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0])
    upright, lying = meshes.deform(SPACE, LONG, TALL), LONG.copy().apply_transform(turn)
    for target_up, target in {"y": TALL, "z": TALL.copy().apply_transform(turn)}.items():
        deformed = meshes.deform(SPACE, lying, target, up=("z", target_up))
        expected = upright.copy().apply_transform(turn).vertices
        assert np.abs(np.sort(deformed.extents) - np.sort(upright.extents)).max() < 0.1
        np.testing.assert_allclose(deformed.vertices, expected, atol=1e-5)


NAN = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]], [[0, 1, 2]], process=False)
FLAT = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]], process=False)


@pytest.mark.parametrize(
    ("target", "options", "words"),
    [
        (trimesh.Scene(), {}, "deform: a mesh needs faces, got none"),
        (NAN, {}, "deform: vertices must be finite"),
        (FLAT, {}, "deform: a mesh needs an area"),
        (np.zeros((2, 64, 3)), {}, r"points must be one cloud \(p, 3\), got \(2, 64, 3\)"),
        (np.zeros((63, 3)), {}, "the 64 points of training are needed, got 63"),
        (np.full((64, 3), np.inf), {}, "deform: points must be finite"),
        (np.ones((64, 3)), {}, "points must have an extent"),
        (TALL, {"up": "x"}, 'up must be "auto", "y" or "z"'),
        (TALL, {"up": ("y", "z", "y")}, "once or once a shape"),
        (TALL, {"subdivide": 1e-5}, "subdivide must be between 0.002 and 1, .* got 1e-05"),
    ],
)
def test_what_cannot_be_deformed_is_refused(target, options, words):
    with pytest.raises(ValueError, match=words):
        meshes.deform(SPACE, LONG, target, **options)


@pytest.mark.parametrize(
    ("space", "source", "words"),
    [
        (linear_space(), LONG, "space must be a trained DeformSyncNet, got LinearSpace"),
        (network(Config(k=2)), LONG, "got DeformSyncNet without a frame"),
        (SPACE, np.zeros((64, 3)), "what moves must be a mesh or its path, got ndarray"),
    ],
)
def test_what_is_of_another_type_is_refused(space, source, words):
    with pytest.raises(TypeError, match=words):
        meshes.deform(space, source, TALL)
