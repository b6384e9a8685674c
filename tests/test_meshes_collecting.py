import numpy as np
import pytest
import trimesh

import data_gen
from dsn_lite import as_shapes, meshes
from dsn_lite.chamfer import chamfer


@pytest.fixture
def tables(tmp_path):
    """Three tables as meshes, in files of three formats, and their parameters."""
    parameters = data_gen.generate("table/four_legs", count=3, points=16, seed=4).parameters
    for i, (row, kind) in enumerate(zip(parameters, ("glb", "obj", "ply"), strict=True)):
        data_gen.save_mesh(data_gen.mesh("table/four_legs", row), tmp_path / f"table_{i}.{kind}")
    return tmp_path, parameters


def test_collected_meshes_are_the_shapes_they_were_made_from(tables):
    folder, parameters = tables
    found = meshes.collect(meshes.folder(folder), 2000)
    assert found.names == ("table_0", "table_1", "table_2")
    scale = max(parameters[:, :3].max(), 1e-9)  # one for all: the longest edge of the largest table becomes 1
    truth = data_gen.generate("table/four_legs", count=3, points=2000, seed=4).points
    expected = (truth + np.array([0, 0.5, 0])) / scale - np.array([0, 0.5, 0])
    distance = chamfer(found.points, as_shapes(expected.astype(np.float32)).points)
    assert distance.max() < 3e-3
    assert found.points.abs().max() <= 0.5 + 1e-5


def test_sizes_relative_to_each_other_are_kept_and_all_stand_on_the_floor(tmp_path):
    for name, size in (("large", 4.0), ("small", 1.0)):
        trimesh.creation.box((size, size / 2, size)).apply_translation([9, 9, 9]).export(tmp_path / f"{name}.ply")
    large, small = meshes.collect(meshes.folder(tmp_path), 500, up="y").points
    assert np.ptp(large[:, 0].numpy()) == pytest.approx(1, abs=0.02)
    assert np.ptp(small[:, 0].numpy()) == pytest.approx(0.25, abs=0.01)
    assert large[:, 1].min().item() == pytest.approx(-0.5, abs=1e-6)
    assert small[:, 1].min().item() == pytest.approx(-0.5, abs=1e-6)


def test_z_up_is_turned(tmp_path):
    trimesh.creation.box((1, 1, 3)).export(tmp_path / "tower.stl")
    points = meshes.collect(meshes.folder(tmp_path), 400, up="z").points[0]
    assert points[:, 1].max().item() == pytest.approx(0.5, abs=1e-6)
    assert points[:, 2].abs().max().item() == pytest.approx(1 / 6, abs=1e-6)


def test_the_same_seed_gives_the_same_points(tables):
    files = meshes.folder(tables[0])
    assert (meshes.collect(files, 50).points == meshes.collect(files, 50).points).all()
    assert (meshes.collect(files, 50).points != meshes.collect(files, 50, seed=9).points).any()


def test_refusals(tmp_path):
    with pytest.raises(ValueError, match=r"collect: at least one mesh file is needed, got none; files end in \.glb"):
        meshes.collect(meshes.folder(tmp_path))
    with pytest.raises(ValueError, match=r"collect: .*nowhere must be a folder of meshes, it is none"):
        meshes.folder(tmp_path / "nowhere")
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "metres.ply")
    with pytest.raises(ValueError, match=r'collect: up must be "auto", "y" or "z", got \'x\''):
        meshes.collect(meshes.folder(tmp_path), up="x")
    trimesh.creation.box((1000, 1000, 1000)).export(tmp_path / "millimetres.ply")
    with pytest.raises(ValueError, match=r"files must be in one unit, millimetres.ply is 1000 times metres.ply"):
        meshes.collect(meshes.folder(tmp_path))


def test_all_files_that_cannot_be_used_are_named_at_once(tables):
    folder, _ = tables
    (folder / "broken.glb").write_bytes(b"no mesh")
    (folder / "empty.obj").write_text("", encoding="utf-8")
    with pytest.raises(ValueError, match=r"collect: every file must be a mesh, 2 of 5 are none") as caught:
        meshes.collect(meshes.folder(folder))
    assert "broken.glb" in str(caught.value)
    assert "empty.obj" in str(caught.value)
