"""Mesh files: what each format keeps, what is said where it cannot, and that no half file is left."""

import numpy as np
import pytest
import trimesh
from test_meshes import parts, places, scene, seamed
from trimesh.visual import ColorVisuals, TextureVisuals
from trimesh.visual.material import SimpleMaterial

from dsn_lite.meshes import load_mesh, save_mesh


def painted():
    """A box with a colour at each vertex."""
    box = trimesh.creation.box((2.0, 0.5, 1.0))
    box.visual = ColorVisuals(vertex_colors=np.arange(32).reshape(8, 4) | [0, 0, 0, 255])
    return box


def test_glb_keeps_everything(tmp_path):
    save_mesh(scene(), tmp_path / "a.glb")
    read, before = load_mesh(tmp_path / "a.glb"), scene()
    assert set(parts(read)) == {"left", "right", "top"}
    for name, (old, matrix) in parts(before).items():
        new, same = parts(read)[name]
        np.testing.assert_allclose(matrix, same, atol=1e-6)
        np.testing.assert_allclose(new.vertices, old.vertices, atol=1e-6)
        np.testing.assert_allclose(new.vertex_normals, old.vertex_normals, atol=1e-6)
        np.testing.assert_allclose(new.visual.uv, old.visual.uv, atol=1e-6)
        assert np.array_equal(new.faces, old.faces)
        assert np.array_equal(new.visual.vertex_attributes["color"], old.visual.vertex_attributes["color"])
        assert np.array_equal(new.visual.material.baseColorFactor, old.visual.material.baseColorFactor)
        assert new.visual.material.name == old.visual.material.name


def test_obj_keeps_faces_uvs_and_materials(tmp_path):
    save_mesh(scene(), tmp_path / "my table.obj")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["my table.obj", "my_table.mtl"]
    read = load_mesh(tmp_path / "my table.obj")
    np.testing.assert_allclose(np.unique(read.triangles.reshape(-1, 3), axis=0), unique_places(scene()), atol=1e-6)
    uvs = np.concatenate([geometry.visual.uv for geometry in read.geometry.values()])
    expected = np.concatenate([geometry.visual.uv for geometry, _ in parts(scene()).values()])
    np.testing.assert_allclose(np.unique(uvs, axis=0), np.unique(expected, axis=0), atol=1e-6)
    colours = {tuple(geometry.visual.material.main_color): len(geometry.faces) for geometry in read.geometry.values()}
    assert colours == {(200, 120, 40, 255): 24, (10, 120, 40, 255): 12}


def unique_places(mesh):
    return np.unique(places(mesh).round(8), axis=0)


def test_obj_counts_uvs_rightly_where_some_parts_have_none(tmp_path):
    mixed = trimesh.Scene([painted(), seamed()])
    save_mesh(mixed, tmp_path / "a.obj")
    read = load_mesh(tmp_path / "a.obj")
    named = {geometry.visual.material.name: geometry for geometry in read.geometry.values()}
    assert {name: len(geometry.faces) for name, geometry in named.items()} == {"oak": 12, "plain": 12}
    uv = named["oak"].visual.uv
    np.testing.assert_allclose(np.unique(uv, axis=0), np.unique(seamed().visual.uv, axis=0), atol=1e-6)


def test_obj_keeps_colours_at_vertices(tmp_path):
    save_mesh(painted(), tmp_path / "a.obj")
    read = load_mesh(tmp_path / "a.obj")
    assert np.array_equal(read.visual.vertex_colors[:, :3], painted().visual.vertex_colors[:, :3])


class Picture:
    """Enough of an image for an exporter."""

    format = "PNG"

    def save(self, fp, format):
        fp.write(b"picture")

    def tobytes(self):
        return b"picture"


def test_obj_images_are_named_after_the_file(tmp_path):
    box, folder = seamed(), tmp_path / "deep" / "down"
    box.visual = TextureVisuals(box.visual.uv, SimpleMaterial(image=Picture(), name="../../oak"))
    save_mesh(box, folder / "a.obj")
    assert sorted(path.name for path in tmp_path.rglob("*.*")) == ["a.mtl", "a.obj", "a_0.png"]
    assert "map_Kd a_0.png" in (folder / "a.mtl").read_text(encoding="utf-8").splitlines()
    assert (folder / "a_0.png").read_bytes() == b"picture"


def test_ply_keeps_faces_and_colours(tmp_path):
    save_mesh(painted(), tmp_path / "a.ply")
    read = load_mesh(tmp_path / "a.ply")
    assert np.array_equal(read.faces, painted().faces)
    assert np.array_equal(read.visual.vertex_colors, painted().visual.vertex_colors)
    with pytest.warns(UserWarning, match=r"PLY keeps no materials, images or UVs; choose \.glb"):
        save_mesh(scene(), tmp_path / "b.ply")
    read = load_mesh(tmp_path / "b.ply")
    np.testing.assert_allclose(read.vertices, places(scene()), atol=1e-6)
    assert np.array_equal(read.visual.vertex_colors, [[200, 120, 40, 255]] * 72 + [[10, 120, 40, 255]] * 36)


def test_stl_keeps_the_form_and_says_what_it_loses(tmp_path):
    with pytest.warns(UserWarning, match="STL keeps no colours, materials or UVs"):
        save_mesh(scene(), tmp_path / "a.stl")
    assert load_mesh(tmp_path / "a.stl").area == pytest.approx(scene().area, rel=1e-5)
    bare = trimesh.creation.box((2.0, 0.5, 1.0))
    save_mesh(bare, tmp_path / "b.stl")  # a warning would be an error here: there is nothing to lose
    np.testing.assert_allclose(load_mesh(tmp_path / "b.stl").triangles, bare.triangles, atol=1e-6)


def test_off_is_read(tmp_path):
    path = tmp_path / "a.OFF"
    path.write_text(trimesh.creation.box().export(file_type="off"), encoding="utf-8")
    assert len(load_mesh(path).faces) == 12


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.fbx", "", r"must end in \.glb, \.gltf, \.obj, \.ply, \.stl or \.off, got \.fbx"),
        ("a", "", "got no ending"),
        ("empty.obj", "", "empty.obj: (a mesh needs faces, got none|must be a whole mesh file)"),
        ("a.glb", "glTF, it says", "a.glb: must be a whole mesh file, got .*; export it again"),
        ("a.off", "OFF\n4 4 0\n0 0 0", "a.off: must be a whole mesh file"),
        ("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "points.obj: a mesh needs faces"),
        ("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", "flat.off: a mesh needs an area"),
        ("nan.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", "nan.off: vertices must be finite"),
        ("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "index.off: must be a whole mesh file"),
    ],
)
def test_a_file_that_is_no_mesh_is_refused(tmp_path, name, content, words):
    (tmp_path / name).write_text(content, encoding="utf-8")
    with pytest.raises(ValueError, match=words) as caught:
        load_mesh(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError, match="there is no such file; check the path"):
        load_mesh(tmp_path / "a.glb")


def test_an_ending_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"save_mesh: .*a\.off must end in \.glb, \.obj, \.ply or \.stl, got \.off"):
        save_mesh(painted(), tmp_path / "a.off")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["a.glb", "a.obj", "a.ply", "a.stl"])
def test_a_write_that_fails_leaves_the_old_file(tmp_path, name, monkeypatch):
    bare = trimesh.creation.box()
    save_mesh(bare, tmp_path / name)
    before = (tmp_path / name).read_bytes()
    (tmp_path / f"{name}.part").mkdir()  # the file beside cannot be opened
    with pytest.raises(OSError, match=r"\.part"):
        save_mesh(trimesh.creation.icosphere(), tmp_path / name)
    assert (tmp_path / name).read_bytes() == before
