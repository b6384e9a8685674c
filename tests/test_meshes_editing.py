"""Edits of meshes: what handles say, what moves with the snap, what stays, and the command."""

from copy import deepcopy

import numpy as np
import pytest
import torch
import trimesh
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial
from worlds import linear_space

import data_gen
from dsn_lite import meshes
from dsn_lite.config import Config, network
from dsn_lite.data import Frame
from dsn_lite.dictionary import offsets
from dsn_lite.handles import BoxHandles
from dsn_lite.meshes.surface import parts, places
from dsn_lite.projection import EditProjector

FRAME = Frame(1024, 0.9, (0.5, 0.0, 0.5), (0.0, -0.5, 0.0))
SPACE = network(Config(k=4, features=(8, 16), head=(8,)), FRAME)
TURN = trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0])  # y up to z up


def table(family="table/four_legs", seed=0):
    return data_gen.mesh(family, data_gen.generate(family, count=1, points=16, seed=seed).parameters[0])


def scene():
    """A top with UVs, and four legs that share one geometry; one of them is stretched by the scene."""
    scene = trimesh.Scene()
    top = trimesh.creation.box((2, 0.2, 1))
    top.visual = TextureVisuals(top.vertices[:, :2], PBRMaterial(name="oak", baseColorFactor=[200, 120, 40, 255]))
    scene.add_geometry(top, node_name="top", geom_name="top")
    scene.geometry["leg"] = trimesh.creation.box((0.1, 1, 0.1))
    for i, (x, z) in enumerate([(-0.9, -0.4), (0.9, -0.4), (-0.9, 0.4), (0.9, 0.4)], 1):
        place = trimesh.transformations.translation_matrix([x, -0.6, z]) @ np.diag([1, 1, 1 + (i == 4), 1])
        scene.graph.update(f"leg_{i}", matrix=place, geometry="leg")
    return scene


def test_values_are_those_of_the_file():
    values = meshes.EditableMesh(SPACE, scene()).values
    assert len(values) == 30
    assert values["top.scale.x"] == pytest.approx(2)
    assert values["leg_4.scale.z"] == pytest.approx(0.2)
    assert values["leg_3.translation.x"] == pytest.approx(-0.9)
    assert values["leg_3.translation.y"] == pytest.approx(-0.6)


@pytest.mark.parametrize("family", ["table/four_legs", "sofa/two_seater"])
def test_values_of_a_procedural_mesh_are_those_of_its_rig(family):
    """data_gen's boxes and ours are the same where both are upright."""
    shape = data_gen.generate(family, count=1, points=512, seed=1)
    mesh = meshes.EditableMesh(SPACE, data_gen.mesh(family, shape.parameters[0]))
    truth = BoxHandles(
        *(torch.as_tensor(a) for a in (shape.labels[0], shape.rest[0], shape.boxes[0])), shape.part_names
    )
    shared = [(mesh.values[name], value) for name, value in zip(truth.names, truth.z0.tolist(), strict=True)]
    same = [abs(ours - theirs) < 1e-4 for ours, theirs in shared]
    assert np.mean(same) > 0.75


def test_an_edit_is_the_projection_of_the_kernel_at_the_vertices():
    """The obvious twin: everything in the training box, one part after the other."""
    mesh, there = table(), meshes.Similarity.into(FRAME, places(table()))
    parted = meshes.split(mesh)
    points, chosen = meshes.surface.drawn(meshes.surface.triangles(mesh, ""), FRAME.n, 0)
    x, labels = torch.tensor(there.apply(points), dtype=torch.float32), parted.faces[chosen]
    boxes, rest, vertices = [], np.zeros((FRAME.n, 3)), there.apply(places(mesh))
    for part in range(5):
        own = vertices[parted.vertices == part]
        middle, size = (own.min(0) + own.max(0)) / 2, np.ptp(own, axis=0)
        boxes.append([*middle, *np.eye(3).reshape(-1), *size])
        rest[labels == part] = (x[labels == part].numpy() - middle) / size
    handles = BoxHandles(torch.tensor(labels), torch.tensor(rest), torch.tensor(np.array(boxes)), parted.names)
    with torch.no_grad():
        snapped = EditProjector(SPACE.dictionary(x).double(), handles)({"leg_1.scale.y": 0.3 * there.scale})
        at = torch.tensor(vertices, dtype=torch.float32)
        u = offsets(SPACE.dictionary(x, at=at), snapped.v.float()).double()
    edited = meshes.edit(SPACE, mesh, {"leg_1.scale.y": 0.3})
    np.testing.assert_allclose(edited.snapped.v, snapped.v, atol=1e-4)
    np.testing.assert_allclose(places(edited.mesh), there.undo(vertices + u.numpy()), atol=1e-5)
    assert edited.snapped["leg_1.scale.y"] == pytest.approx(0.3)
    assert edited.snapped.distance == pytest.approx(snapped.distance / there.scale, rel=1e-3)
    assert np.abs(places(edited.mesh) - places(mesh)).max() > 1e-3


def test_by_boxes_every_part_keeps_its_form_and_gets_its_values():
    edited = meshes.edit(SPACE, scene(), {"leg_1.scale.y": 1.5, "top.translation.y": 0.5}, by_boxes=True)
    after = meshes.EditableMesh(SPACE, edited.mesh)
    found = [after.values[name] for name in edited.snapped.names]
    np.testing.assert_allclose(found, edited.snapped.z_hat, atol=1e-6)
    assert after.values["leg_1.scale.y"] == pytest.approx(1.5)
    assert after.values["top.translation.y"] == pytest.approx(0.5)
    assert all(len(np.unique(geometry.vertices.round(6)[:, 1])) == 2 for geometry, _ in parts(edited.mesh).values())


def test_unit_place_and_axes_of_the_file_do_not_matter():
    small, large = scene(), scene()
    large.apply_transform(np.diag([1000, 1000, 1000, 1.0]) @ TURN)
    large.apply_transform(trimesh.transformations.translation_matrix([500, -300, 200]))
    here = meshes.edit(SPACE, small, {"leg_1.scale.y": 1.5}, bounds={"top.scale.x": (1.9, 2.1)}, up="y")
    bounds = {"top.scale.x": (1900.0, 2100.0)}
    there = meshes.edit(SPACE, large, {"leg_1.scale.y": 1500.0}, bounds=bounds, up="z")
    back = (places(there.mesh) - [500, -300, 200]) @ TURN[:3, :3] / 1000
    np.testing.assert_allclose(back, places(here.mesh), atol=1e-4)
    np.testing.assert_allclose(there.snapped["leg_2.scale.y"], 1000 * here.snapped["leg_2.scale.y"], rtol=1e-3)
    assert there.snapped.distance == pytest.approx(1000 * here.snapped.distance, rel=1e-3)
    assert meshes.EditableMesh(SPACE, large, up="z").values["leg_1.translation.y"] == pytest.approx(-600 + 200)


def test_changes_patterns_and_bounds():
    mesh = meshes.EditableMesh(SPACE, scene())
    same, by_change = (
        mesh.edit({"leg_*.scale.y": 1.2}).snapped,
        mesh.edit({"leg_*.scale.y": 0.2}, change=True).snapped,
    )
    np.testing.assert_allclose(same.z_hat, by_change.z_hat, atol=1e-9)
    assert len(same.pinned) == 4
    free = mesh.edit({"leg_1.scale.y": 2.0}).snapped["top.translation.y"]
    low, high = sorted([0.0, free / 2])
    held = mesh.edit({"leg_1.scale.y": 2.0}, bounds={"top.translation.y": (low, high)}).snapped
    assert held.at_bounds == ("top.translation.y",)
    assert held["top.translation.y"] == pytest.approx(free / 2)


def test_everything_but_the_vertices_stays():
    before, edited = scene(), meshes.edit(SPACE, scene(), {"leg_1.scale.y": 1.5})
    assert set(parts(edited.mesh)) == set(parts(before)) == {"top", "leg_1", "leg_2", "leg_3", "leg_4"}
    for name, (old, matrix) in parts(before).items():
        new, same = parts(edited.mesh)[name]
        assert np.array_equal(old.faces, new.faces)
        assert np.array_equal(matrix, same)
    (old, _), (new, _) = parts(before)["top"], parts(edited.mesh)["top"]
    assert np.array_equal(old.visual.uv, new.visual.uv)
    assert new.visual.material.name == "oak"


def test_the_mesh_itself_is_not_touched_and_edits_start_from_it():
    source = scene()
    mesh = meshes.EditableMesh(SPACE, source)
    first = mesh.edit({"leg_1.scale.y": 1.5})
    mesh.edit({"leg_2.scale.x": 0.4})
    again = mesh.edit({"leg_1.scale.y": 1.5})
    assert np.array_equal(places(first.mesh), places(again.mesh))
    assert np.array_equal(places(source), places(scene()))
    assert len(source.geometry) == 2


def test_others_get_the_same_vector():
    others = [table("table/shelf", 3), trimesh.creation.box((1, 2, 1))]
    edited = meshes.edit(SPACE, scene(), {"leg_1.scale.y": 1.5}, others=others, up="y")
    for other, moved in zip(others, edited.others, strict=True):
        there, cloud = meshes.bringing.brought(FRAME, other, "y", 0, "")
        x, at = (torch.tensor(p, dtype=torch.float32) for p in (cloud, there.apply(places(other))))
        with torch.no_grad():
            u = offsets(SPACE.dictionary(x, at=at), edited.snapped.v.float()).double().numpy()
        np.testing.assert_allclose(places(moved), there.undo(there.apply(places(other)) + u), atol=1e-5)
        assert np.abs(places(moved) - places(other)).max() > 1e-3


def test_a_part_that_samples_miss_has_handles_too():
    tiny = scene()
    tiny.add_geometry(trimesh.creation.box((0.01, 0.01, 0.01)), node_name="knob", geom_name="knob")
    mesh = meshes.EditableMesh(SPACE, tiny)
    assert mesh.values["knob.scale.y"] == pytest.approx(0.01)
    assert mesh.edit({"knob.scale.y": 0.02}).snapped["knob.scale.y"] == pytest.approx(0.02)


def test_a_flat_part_has_no_handle_across():
    flat = scene()
    flat.add_geometry(trimesh.creation.box((1, 0, 1)), node_name="cloth", geom_name="cloth")
    mesh = meshes.EditableMesh(SPACE, flat)
    assert "cloth.scale.x" in mesh.values
    assert "cloth.scale.y" not in mesh.values
    assert np.isfinite(places(mesh.edit({"cloth.scale.x": 2.0}, by_boxes=True).mesh)).all()


def test_subdivided_meshes_bend_in_more_places():
    edited = meshes.edit(SPACE, scene(), {"leg_1.scale.y": 1.5}, subdivide=0.1, others=[scene()])
    for mesh in (edited.mesh, *edited.others):
        assert len(places(mesh)) > 5 * len(places(scene()))


def test_the_space_may_be_in_double_precision():
    space = deepcopy(SPACE).double()
    here, there = (meshes.edit(s, scene(), {"leg_1.scale.y": 1.5}).mesh for s in (SPACE, space))
    np.testing.assert_allclose(places(here), places(there), atol=1e-3)


def test_parts_have_colours_of_their_own():
    coloured = meshes.EditableMesh(SPACE, scene()).coloured()
    found = [np.unique(geometry.visual.vertex_colors, axis=0) for geometry, _ in parts(coloured).values()]
    assert all(len(colours) == 1 for colours in found)
    assert len(np.unique(np.concatenate(found), axis=0)) == 5


@pytest.mark.parametrize("subdivide", [None, 0.2])
def test_up_is_y_in_a_glb_whatever_the_form(subdivide, tmp_path):
    lying = trimesh.Scene()
    lying.add_geometry(trimesh.creation.cone(1.0, 1.0), node_name="cone")
    lying.add_geometry(trimesh.creation.box((0.1, 0.1, 0.2)), node_name="knob")
    assert meshes.up_axis(meshes.sample(lying, 2048)) == "z"
    meshes.save_mesh(lying, tmp_path / "a.glb")
    found = meshes.EditableMesh(SPACE, tmp_path / "a.glb", subdivide=subdivide)
    assert np.array_equal(found.there.rotation, np.eye(3))
    assert not np.array_equal(meshes.EditableMesh(SPACE, lying).there.rotation, np.eye(3))
    again = meshes.EditableMesh(SPACE, found.edit({"knob.scale.x": 0.2}).mesh)
    assert np.array_equal(again.there.rotation, np.eye(3))


@pytest.mark.parametrize(
    ("edits", "options", "words"),
    [
        ({"leg_9.scale.y": 1.0}, {}, r"edit: there is no handle 'leg_9.scale.y'; did you mean leg_\d.scale.y"),
        (
            {"leg_1.scale.y": 1.0},
            {"bounds": {"leg_1.scale.y": (2.0, 3.0)}},
            "leg_1.scale.y between 2 and 3 and pinned at 1",
        ),
        ({}, {}, "edit: .*at least one, got {}"),
        (
            {"leg_1.scale.y": 1.0},
            {"up": "x"},
            'edit: up must be "auto", "y" or "z", once or once for each of the 1 meshes',
        ),
        ({"leg_1.scale.y": 1.0}, {"up": ("y", "z")}, "each of the 1 meshes, got"),
        ({"leg_1.scale.y": 1.0}, {"subdivide": 2.0}, "edit: subdivide must be between"),
        ({"leg_1.scale.y": 1.0}, {"most": 1}, "split: most must be between"),
    ],
)
def test_what_cannot_be_edited_is_refused(edits, options, words):
    with pytest.raises(ValueError, match=words):
        meshes.edit(SPACE, scene(), edits, **options)


@pytest.mark.parametrize(
    ("space", "source", "others", "words"),
    [
        (linear_space(), scene(), [], "edit: space must be a trained DeformSyncNet, got LinearSpace"),
        (SPACE, np.zeros((64, 3)), [], "edit: what moves must be a mesh or its path, got ndarray"),
        (SPACE, scene(), [np.zeros((64, 3))], "edit: what moves must be a mesh or its path, got ndarray"),
    ],
)
def test_what_is_of_another_type_is_refused(space, source, others, words):
    with pytest.raises(TypeError, match=words):
        meshes.edit(space, source, {"leg_1.scale.y": 1.0}, others=others)
