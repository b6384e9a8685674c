"""python -m data_gen: what each command writes and says, and that errors are one sentence."""

import subprocess
import sys

import numpy as np
import pytest
import trimesh

import data_gen
from data_gen.__main__ import main
from data_gen.gallery import figure


def test_list_names_every_family_with_its_parameters(capsys):
    assert main(["list"]) == 0
    printed = capsys.readouterr().out
    for name in data_gen.families():
        assert name in printed
        assert all(parameter in printed for parameter in data_gen.family(name).parameter_names)
    assert "parts (5): top, leg_1" in printed


def test_generate_writes_what_the_function_gives(tmp_path):
    out = tmp_path / "a.npz"
    given = ["--count", "4", "--points", "32", "--seed", "3", "--sampling", "shared", "--out", str(out)]
    assert main(["generate", "chair/four_legs", *given]) == 0
    expected = data_gen.generate("chair/four_legs", count=4, points=32, seed=3, sampling="shared")
    read = data_gen.load(out)
    np.testing.assert_array_equal(read.points, expected.points)
    assert read.about == expected.about


def test_the_same_command_writes_the_same_bytes_in_another_process(tmp_path):
    given = ["generate", "box/one", "--count", "3", "--points", "20", "--out"]
    assert main([*given, str(tmp_path / "a.npz")]) == 0
    subprocess.run([sys.executable, "-m", "data_gen", *given, str(tmp_path / "b.npz")], check=True)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_resample_keeps_shapes(tmp_path):
    one, two = tmp_path / "one.npz", tmp_path / "two.npz"
    data_gen.save(data_gen.generate("box/one", count=3, points=20), one)
    assert main(["resample", str(one), "--seed", "5", "--out", str(two)]) == 0
    np.testing.assert_array_equal(data_gen.load(one).parameters, data_gen.load(two).parameters)
    assert (data_gen.load(one).points != data_gen.load(two).points).any()


def test_mesh_takes_parameters_by_name_and_the_middle_for_the_rest(tmp_path):
    given = ["--set", "width=0.6", "height=0.8", "--set", "leg_width=0.05", "--out", str(tmp_path / "a.glb")]
    assert main(["mesh", "table/four_legs", *given]) == 0
    read = trimesh.load_scene(tmp_path / "a.glb")
    np.testing.assert_allclose(read.extents, [0.6, 0.8, 0.7], atol=1e-6)
    np.testing.assert_allclose(read.geometry["leg_3"].extents[0], 0.05, atol=1e-6)


def test_show_writes_a_page_that_needs_no_network(tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    out = tmp_path / "a.html"
    assert main(["show", "table/shelf", "--out", str(out), "--no-open"]) == 0
    page = out.read_text(encoding="utf-8")
    assert not opened
    assert len(page) > 3_000_000, "plotly itself is inside"
    assert 'src="http' not in page
    assert "12 random shapes of the family table/shelf" in page
    assert main(["show", "table/shelf", "--out", str(out)]) == 0
    assert opened == [out.resolve().as_uri()]


def test_the_gallery_draws_twelve_shapes_upright_with_equal_axes():
    rig = data_gen.family("table/four_legs")
    drawing = figure(rig)
    meshes = [trace for trace in drawing.data if trace.type == "mesh3d" and trace.legendgroup]
    assert [mesh.legendgroup for mesh in meshes] == list(rig.part_names)
    assert all(len(mesh.x) == 12 * 8 and len(mesh.i) == 12 * 12 for mesh in meshes)
    assert min(min(mesh.z) for mesh in meshes) == -0.5
    scene = drawing.layout.scene
    units = {
        axis: (scene[f"{axis}axis"].range[1] - scene[f"{axis}axis"].range[0]) / scene.aspectratio[axis]
        for axis in "xyz"
    }
    np.testing.assert_allclose(list(units.values()), units["x"])
    for mesh in meshes:
        for axis in "xyz":
            low, high = scene[f"{axis}axis"].range
            assert low <= min(mesh[axis])
            assert max(mesh[axis]) <= high


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        ("generate nothing --count 1 --points 9 --out a.npz", "family: a family must be one of table/four_legs"),
        ("generate box/one --count 1 --points 1 --out a.npz", "generate: count must be whole and >= 1, points >= 2"),
        ("resample a.npz --seed 0 --out b.npz", "load: a.npz must be a sample file, got no file of that name"),
        ("mesh box/one --set width=2 --out a.glb", "mesh: width of box/one must be in [0.3, 1], got 2"),
        ("mesh box/one --set size=1 --out a.glb", "mesh: --set must name a parameter of box/one, one of width, height"),
        (
            "mesh box/one --set width=wide --out a.glb",
            "mesh: --set width must be a number, got 'wide'; write width=0.5",
        ),
        ("mesh box/one --out a.stl", "save_mesh: a mesh file must end in"),
        ("show box --no-open", "family: a family must be one of"),
        ("generate box/one --count 1 --points 9 --out no/a.npz", "a.npz: its folder must exist, got no; make the"),
    ],
)
def test_errors_are_one_sentence_and_write_nothing(tmp_path, monkeypatch, capsys, command, sentence):
    monkeypatch.chdir(tmp_path)
    assert main(command.split()) == 2
    printed = capsys.readouterr()
    assert printed.err.startswith(sentence)
    assert printed.err.count("\n") == 1
    assert not printed.out
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("command", ["", "generate box/one", "mesh"])
def test_an_incomplete_command_ends_with_2(command, capsys):
    with pytest.raises(SystemExit) as end:
        main(command.split())
    assert end.value.code == 2
    assert "required" in (said := capsys.readouterr().err.lower()) or "missing" in said


@pytest.mark.parametrize("command", ["list", "generate", "resample", "show", "mesh"])
def test_every_command_explains_itself(command, capsys):
    with pytest.raises(SystemExit) as end:
        main([command, "--help"])
    assert end.value.code == 0
    assert f"data_gen {command}" in capsys.readouterr().out


def test_the_package_loads_neither_torch_nor_plotly():
    loaded = "import sys, data_gen; print([m for m in ('torch', 'dsn_lite', 'plotly', 'tyro') if m in sys.modules])"
    found = subprocess.run([sys.executable, "-c", loaded], check=True, capture_output=True, text=True)
    assert found.stdout.strip() == "[]"
