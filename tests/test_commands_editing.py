"""python -m dsn_lite edit: what it writes and says, and that trouble is one sentence."""

import numpy as np
import pytest
import trimesh

import data_gen
from dsn_lite import Config, as_shapes, load_run, meshes, train
from dsn_lite.__main__ import main
from dsn_lite.meshes.surface import parts


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a trained run and two tables of five parts, of which one has shelves."""
    folder = tmp_path_factory.mktemp("edit")
    shapes = data_gen.generate("table/four_legs", count=40, points=128, seed=0)
    train(as_shapes(shapes), Config(k=4, batch=4, features=(8, 16), head=(8,), steps=3), out=folder / "run")
    for name, family in {"a.glb": "table/four_legs", "b.glb": "table/shelf"}.items():
        parameters = data_gen.generate(family, count=1, points=16, seed=5).parameters[0]
        data_gen.save_mesh(data_gen.mesh(family, parameters), folder / name)
    trimesh.creation.box((1, 2, 1)).export(folder / "box.stl")
    return folder


def run(folder, *words):
    """Runs edit on the run, in which every word with the ending of a mesh lies in the folder."""
    files = [str(folder / word) if word.endswith((".glb", ".stl", ".ply")) else word for word in words]
    return main(["edit", str(folder / "run"), *files])


def test_it_writes_and_says_what_the_function_gives(folder, capsys):
    pins = ["--set", "leg_1.scale.y=0.3", "--set", "leg_2.scale.y=0.35", "--bounds", "top.translation.y=:0.2"]
    assert run(folder, "a.glb", *pins, "--to", "b.glb", "-o", "new.glb") == 0
    said = capsys.readouterr().out.splitlines()
    expected = meshes.edit(
        load_run(folder / "run"),
        folder / "a.glb",
        {"leg_1.scale.y": 0.3, "leg_2.scale.y": 0.35},
        bounds={"top.translation.y": (None, 0.2)},
        others=[folder / "b.glb"],
    )
    for name, mesh in {"new.glb": expected.mesh, "new_b.glb": expected.others[0]}.items():
        written = parts(meshes.load_mesh(folder / name))
        for node, (geometry, _) in parts(mesh).items():
            np.testing.assert_allclose(written[node][0].vertices, geometry.vertices, atol=1e-6)
    assert said[:2] == [str(folder / "new.glb"), str(folder / "new_b.glb")]
    assert said[2].startswith(f"the snap went {expected.snapped.distance:.4g} ")
    before = expected.snapped.z0[expected.snapped.names.index("leg_1.scale.y")]
    assert f"leg_1.scale.y: {before:.4g} -> 0.3" in said


def test_change_and_by_boxes_are_told(folder):
    words = ["--set", "leg_*.scale.y=0.1", "--change", "--by-boxes"]
    assert run(folder, "a.glb", *words, "-o", "new.glb") == 0
    expected = meshes.edit(
        load_run(folder / "run"), folder / "a.glb", {"leg_*.scale.y": 0.1}, change=True, by_boxes=True
    )
    np.testing.assert_allclose(meshes.load_mesh(folder / "new.glb").bounds, expected.mesh.bounds, atol=1e-6)


def test_what_is_held_at_a_bound_is_said(folder, capsys):
    mesh = meshes.EditableMesh(load_run(folder / "run"), folder / "a.glb")
    free = mesh.edit({"leg_1.scale.y": 0.6}).snapped["top.translation.y"]
    now = mesh.values["top.translation.y"]
    ends = sorted([now, (now + free) / 2])
    words = ["--set", "leg_1.scale.y=0.6", "--bounds", f"top.translation.y={ends[0]}:{ends[1]}"]
    assert run(folder, "a.glb", *words, "-o", "new.glb") == 0
    assert capsys.readouterr().err == "held at a bound: top.translation.y\n"


def test_list_prints_every_part_and_paints_it(folder, capsys):
    assert run(folder, "a.glb", "--list", "-o", "parts.glb") == 0
    head, *rows, out = capsys.readouterr().out.splitlines()
    assert out == str(folder / "parts.glb")
    assert head.split() == ["part", *(f"{kind}.{axis}" for kind in ("translation", "scale") for axis in "xyz")]
    values = meshes.EditableMesh(load_run(folder / "run"), folder / "a.glb").values
    assert {row.split()[0] for row in rows} == {"top", "leg_1", "leg_2", "leg_3", "leg_4"}
    for row in rows:
        part, *numbers = row.split()
        own = [value for name, value in values.items() if name.startswith(f"{part}.")]
        np.testing.assert_allclose(list(map(float, numbers)), own, rtol=1e-3, atol=1e-9)
    painted, plain = (parts(meshes.load_mesh(folder / name)) for name in ("parts.glb", "a.glb"))
    for name, (geometry, _) in painted.items():
        assert np.array_equal(geometry.vertices, plain[name][0].vertices)
    assert len({tuple(geometry.visual.vertex_colors[0]) for geometry, _ in painted.values()}) == 5


def test_others_of_one_name_are_written_apart(folder, capsys):
    assert run(folder, "a.glb", "--set", "top.scale.x=1", "--to", "b.glb", "--to", "b.glb", "-o", "new.ply") == 0
    assert capsys.readouterr().out.splitlines()[1:3] == [str(folder / f"new_b_{i}.ply") for i in (1, 2)]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["a.glb"], "edit: --set and -o must be given, or --list to see the handles; try --list first"),
        (["a.glb", "--set", "top.scale.x=1"], "edit: --set and -o must be given"),
        (["a.glb", "--set", "top.scale.x", "-o", "n.glb"], "--set: must be HANDLE=VALUE, got top.scale.x; see --list"),
        (["a.glb", "--set", "top.scale.x=wide", "-o", "n.glb"], "--set: must be HANDLE=VALUE, got top.scale.x=wide"),
        (
            ["a.glb", "--set", "top.scale.x=1", "--bounds", "top.scale.y=1", "-o", "n.glb"],
            "--bounds: must be HANDLE=LOW:HIGH, got top.scale.y=1; see --list",
        ),
        (["a.glb", "--set", "lid.scale.x=1", "-o", "n.glb"], "edit: there is no handle 'lid.scale.x'"),
        (["box.stl", "--list"], "split: a mesh must have 2 parts or more"),
        (["a.glb", "--set", "top.scale.x=1", "--to", "no.glb", "-o", "n.glb"], "there is no such file"),
    ],
)
def test_trouble_is_one_sentence(folder, words, sentence, capsys):
    assert run(folder, *words) == 2
    said = capsys.readouterr().err
    assert sentence in said
    assert len(said.splitlines()) == 1
    assert not (folder / "n.glb").exists()
