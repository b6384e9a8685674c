"""python -m data_gen: what each command writes and says, and that errors are one sentence."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh
from tables import arrays_differ

import data_gen
from data_gen.__main__ import main

FEW = ["--count", "5", "--points", "32", "--seed", "3"]
MUGS = ", ".join(data_gen.families("mug"))


def test_list_names_every_family_in_a_line(capsys):
    assert main(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(data_gen.families())
    assert main(["list", "carton"]) == 0
    assert "carton/two_flaps" in capsys.readouterr().out.splitlines()[0]


def test_list_of_a_family_tells_all_there_is_to_know(capsys):
    assert main(["list", "carton/two_flaps"]) == 0
    printed, rig = capsys.readouterr().out, data_gen.family("carton/two_flaps")
    assert all(parameter.name in printed and parameter.meaning in printed for parameter in rig.parameters)
    assert f"parts: {', '.join(rig.part_names)}" in printed
    assert printed.count("\n  hinge ") == len(rig.joint_list)


def test_generate_writes_what_the_function_gives(tmp_path):
    out = tmp_path / "a.npz"
    assert main(["generate", "chair/four_legs", *FEW, "--sampling", "shared", "--out", str(out)]) == 0
    expected = data_gen.generate("chair/four_legs", count=5, points=32, seed=3, sampling="shared")
    read = data_gen.load(out)
    np.testing.assert_array_equal(read.points, expected.points)
    assert read.about == expected.about


def test_generate_mixes_categories_and_families(tmp_path):
    out = tmp_path / "a.npz"
    assert main(["generate", "mug", "box/one", *FEW, "--out", str(out)]) == 0
    expected = data_gen.generate(("mug", "box/one"), count=5, points=32, seed=3)
    assert data_gen.load(out).names == expected.names
    np.testing.assert_array_equal(data_gen.load(out).points, expected.points)


def test_generate_holds_parameters_adds_noise_and_looks_from_a_side(tmp_path):
    out, view = tmp_path / "a.npz", ["--seen-from", "0", "0", "1", "--noise", "0.01"]
    assert main(["generate", "box/one", *FEW, "--set", "width=0.5", *view, "--out", str(out)]) == 0
    expected = data_gen.generate("box/one", count=5, points=32, seed=3, fixed={"width": 0.5})
    expected = data_gen.noisy(data_gen.seen_from(expected, (0, 0, 1), 3), 0.01, 3)
    np.testing.assert_array_equal(data_gen.load(out).points, expected.points)


@pytest.mark.parametrize("degraded", [[], ["--noise", "0.01"], ["--seen-from", "0", "0", "1", "--noise", "0.01"]])
def test_shards_hold_the_same_shapes_as_a_file(tmp_path, monkeypatch, degraded):
    monkeypatch.setattr("data_gen.__main__.PIECE", 64)
    assert main(["generate", "mug", *FEW, *degraded, "--shards", str(tmp_path / "many")]) == 0
    assert main(["generate", "mug", *FEW, *degraded, "--out", str(tmp_path / "a.npz")]) == 0
    many, one = data_gen.load(tmp_path / "many"), data_gen.load(tmp_path / "a.npz")
    assert not arrays_differ(many, one)
    assert many.about == one.about
    assert len(many) == 5


def test_the_same_command_writes_the_same_bytes_in_another_process(tmp_path):
    given = ["generate", "box/one", "--count", "3", "--points", "20", "--out"]
    assert main([*given, str(tmp_path / "a.npz")]) == 0
    subprocess.run([sys.executable, "-m", "data_gen", *given, str(tmp_path / "b.npz")], check=True)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_resample_keeps_shapes(tmp_path):
    one, two = tmp_path / "one.npz", tmp_path / "two.npz"
    data_gen.save(data_gen.generate("box/one", count=3, points=20), one)
    assert main(["resample", str(one), "--seed", "5", "--points", "30", "--out", str(two)]) == 0
    np.testing.assert_array_equal(data_gen.load(one).parameters, data_gen.load(two).parameters)
    assert data_gen.load(two).points.shape == (3, 30, 3)


def test_mesh_takes_parameters_by_name_and_the_middle_for_the_rest(tmp_path):
    given = ["--set", "width=0.6", "height=0.8", "--set", "leg_width=0.05", "--out", str(tmp_path / "a.glb")]
    assert main(["mesh", "table/four_legs", *given]) == 0
    read = trimesh.load_scene(tmp_path / "a.glb")
    np.testing.assert_allclose(read.extents, [0.6, 0.8, 0.7], atol=1e-6)
    np.testing.assert_allclose(read.geometry["leg_3"].extents[0], 0.05, atol=1e-6)


def test_show_writes_a_page_and_a_picture_and_opens_the_page(tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    out = tmp_path / "a.html"
    assert main(["show", "table/shelf", "--out", str(out), "--no-open"]) == 0
    assert not opened
    assert out.is_file()
    assert out.with_suffix(".png").is_file()
    assert main(["show", "table/shelf", "--out", str(out)]) == 0
    assert opened == [out.resolve().as_uri()]


def test_sheet_writes_a_folder(tmp_path, capsys):
    assert main(["sheet", "box", "--out", str(tmp_path / "sheets")]) == 0
    assert (tmp_path / "sheets" / "index.html").is_file()
    assert capsys.readouterr().out.endswith("index.html: 1 family\n")


def test_sheets_of_several_families_are_counted(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("data_gen.catalogue.write_sheets", lambda *_: None)
    assert main(["sheet", "box", "mug", "--out", str(tmp_path)]) == 0
    assert capsys.readouterr().out.endswith(f"{1 + len(data_gen.families('mug'))} families\n")


def test_paper_writes_a_set_and_a_data_sheet(tmp_path):
    assert main(["paper", "--out", str(tmp_path / "paper"), "--only", "poses/carton", "--lite"]) == 0
    shapes = data_gen.load(tmp_path / "paper" / "poses" / "carton.npz")
    assert (tmp_path / "paper" / "README.md").is_file()
    assert len(shapes) == 10


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        ("list nothing", "families: a category must be one of table, chair"),
        (
            "generate nothing --count 1 --points 9 --out a.npz",
            "family: a family must be one of the families of table, ch",
        ),
        (
            "generate mug/blue --count 1 --points 9 --out a.npz",
            f"family: a family must be one of {MUGS}, got 'mug/blue'",
        ),
        (
            "generate box/one --count 1 --points 0 --shards s",
            "generate: count must be whole and >= 1, points >= 2, got",
        ),
        (
            "generate box/one --count 1 --points 9 --shards no/s",
            "save_shards: its folder must exist, got no; make the f",
        ),
        (
            "generate box/one --count 1 --points 9 --noise -1 --shards s",
            "noisy: deviation must be finite and >= 0, got",
        ),
        (
            "generate box/one --count 1 --points 9 --shards .",
            "save_shards: . must be new or an empty folder, got one th",
        ),
        (
            "generate box/one --count 1 --points 9 --out .",
            ".: must be a file, got a folder; name a file, such as one in",
        ),
        (
            "generate box/one --count 1 --points 9 --out /",
            f"{Path('/')}: must be a file, got a folder; name a file, such",
        ),
        ("show box/one --no-open --seed -1", "show: seed must be a whole number >= 0, got -1; choose one"),
        ("sheet box --seed -1 --out sheets", "sheet: seed must be a whole number >= 0, got -1; choose one"),
        ("generate box/one --count 1 --points 1 --out a.npz", "generate: count must be whole and >= 1, points >= 2"),
        ("generate box/one --count 1 --points 9", "generate: either --out or --shards must say where to write"),
        ("generate box/one --count 1 --points 9 --out a.npz --set width", "--set width must be a number, got ''; wr"),
        ("resample a.npz --seed 0 --out b.npz", "load: a.npz must be a sample file, got no file of that name"),
        ("mesh box/one --set width=2 --out a.glb", "mesh: width of box/one must be in [0.3, 1], got 2"),
        ("mesh box/one --set size=1 --out a.glb", "mesh: --set must name a parameter of box/one, one of width, height"),
        ("mesh box/one --set width=wide --out a.glb", "--set width must be a number, got 'wide'; write width=0.5"),
        ("mesh box/one --out a.stl", "save_mesh: a mesh file must end in"),
        ("show box --no-open", "family: a family must be one of"),
        ("show box/one --no-open --out a.pdf", "show: --out must end in .html, got a.pdf; the picture is written"),
        ("sheet spoon --out sheets", "family: a family must be one of"),
        ("paper --out paper --only spoons", "paper: only must name a data set, such as poses/carton, or one of"),
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


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        ("sheet box --out mine", "sheet: mine must be a folder, got a file; choose another name for the folder"),
        ("sheet box --out mine/sheets", "sheet: mine must be a folder, got a file; choose another name"),
        (
            "paper --only poses/carton --lite --out mine",
            "paper: mine must be a folder, got a file; choose another name",
        ),
        (
            "generate box --count 1 --points 9 --shards mine",
            "save_shards: mine must be new or an empty folder, got one",
        ),
        ("resample box.npz --seed 0 --points 1 --out b.npz", "resample: points must be whole and >= 2, got 1; ask for"),
        ("resample box.npz --seed -1 --out b.npz", "resample: seed must be a whole number >= 0, got -1; choose one"),
        ("resample box.npz --seed 0 --out folder", "folder: must be a file, got a folder; name a file, such as one in"),
        ("mesh box/one --out folder.glb", "folder.glb: must be a file, got a folder; name a file, such as one in that"),
    ],
)
def test_what_lies_there_is_left_alone(tmp_path, monkeypatch, capsys, command, sentence):
    monkeypatch.chdir(tmp_path)
    data_gen.save(data_gen.generate("box/one", count=1, points=9), "box.npz")
    Path("mine").write_text("mine", encoding="utf-8")
    Path("folder").mkdir()
    Path("folder.glb").mkdir()
    assert main(command.split()) == 2
    printed = capsys.readouterr()
    assert printed.err.startswith(sentence)
    assert printed.err.count("\n") == 1
    assert not printed.out
    assert {path.name for path in tmp_path.rglob("*")} == {"box.npz", "mine", "folder", "folder.glb"}
    assert Path("mine").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("command", ["", "resample", "mesh"])
def test_an_incomplete_command_ends_with_2(command, capsys):
    with pytest.raises(SystemExit) as end:
        main(command.split())
    assert end.value.code == 2
    assert "required" in (said := capsys.readouterr().err.lower()) or "missing" in said


@pytest.mark.parametrize("command", ["list", "generate", "resample", "show", "sheet", "mesh", "paper"])
def test_every_command_explains_itself(command, capsys):
    with pytest.raises(SystemExit) as end:
        main([command, "--help"])
    assert end.value.code == 0
    assert f"data_gen {command}" in capsys.readouterr().out


def test_the_package_loads_neither_torch_nor_plotly():
    loaded = "import sys, data_gen; print([m for m in ('torch', 'dsn_lite', 'plotly', 'tyro') if m in sys.modules])"
    found = subprocess.run([sys.executable, "-c", loaded], check=True, capture_output=True, text=True)
    assert found.stdout.strip() == "[]"
