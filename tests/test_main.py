"""python -m dsn_lite: what each command writes and says, and that trouble is one sentence."""

import json
import re
import shutil
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
import trimesh

import data_gen
from dsn_lite import Config, axioms, load_run, load_shapes, meshes, metrics, save_shapes, zoo
from dsn_lite.__main__ import main
from dsn_lite.commands import COMMANDS, runs
from dsn_lite.config import CHOICES
from dsn_lite.experiments import EXPERIMENTS

ROOT = Path(__file__).resolve().parent.parent
OTHERS = (
    r"held out: .*\.npz must hold the shapes that .*run was trained on, it holds others, and what was held out of them "
    r"nothing tells; give the file it was trained on \(and its --family, if it had one\), or --all if this file is new "
    r"to the space$"
)
LITTLE = "--k 4 --batch 4 --features 8 16 --head 8 --seed 2".split()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a sample file, the same shapes sampled again, a trained run and two meshes."""
    folder = tmp_path_factory.mktemp("main")
    shapes = data_gen.generate("table/four_legs", count=120, points=32, seed=0)
    data_gen.save(shapes, folder / "tables.npz")
    data_gen.save(data_gen.resample(shapes, 1), folder / "again.npz")
    given = [str(folder / "tables.npz"), "--out", str(folder / "run"), "--steps", "4", *LITTLE]
    assert main(["train", *given]) == 0
    meshes.save_mesh(trimesh.creation.box((2.0, 0.5, 1.0)), folder / "long.glb")
    meshes.save_mesh(trimesh.creation.box((1.0, 3.0, 1.0)), folder / "tall.ply")
    return folder


def run(folder, *words):
    """Runs a command in which `run`, and every word with the ending of a file, lies in the folder."""
    return main([str(folder / word) if word == "run" or word[-4:-3] == "." else word for word in words])


def test_train_writes_a_run_and_says_where_it_ended(folder, tmp_path, capsys):
    file, out = str(folder / "tables.npz"), str(tmp_path / "run")
    assert main(["train", file, "--out", out, "--steps", "3", *LITTLE]) == 0
    said = capsys.readouterr().out.splitlines()[-1]
    looks = [json.loads(line) for line in (tmp_path / "run" / "history.jsonl").read_text(encoding="utf-8").splitlines()]
    assert said.startswith(f"{out}: 3 steps in ")
    assert said.endswith(f"validation Chamfer distance {min(look['validation_cd'] for look in looks):.4g}")
    assert load_run(out).dictionary.k == 4


def test_train_resumes(folder, tmp_path, capsys):
    file, out = str(folder / "tables.npz"), str(tmp_path / "run")
    assert main(["train", file, "--out", out, "--steps", "2", *LITTLE]) == 0
    assert main(["train", file, "--out", out, "--steps", "5", "--resume", *LITTLE]) == 0
    assert f"{out}: 5 steps" in capsys.readouterr().out
    assert len((tmp_path / "run" / "history.jsonl").read_text(encoding="utf-8").splitlines()) == 5


def test_train_resumed_at_its_end_says_so(folder, tmp_path, capsys):
    given = ["train", str(folder / "tables.npz"), "--out", str(tmp_path / "run"), "--steps", "2", *LITTLE]
    assert main(given) == 0
    capsys.readouterr()
    assert main([*given, "--resume"]) == 0
    said = capsys.readouterr().out.splitlines()[-1]
    assert re.fullmatch(r".*run: had reached its end already, at step 2 after [\d.]+ s; nothing was trained", said)


def test_evaluate_measures_what_was_held_out(folder, capsys):
    assert run(folder, "evaluate", "run", "tables.npz", "--again", "again.npz", "--pairs", "5", "--seed", "3") == 0
    first, second = (load_shapes(folder / name).split(2)[2] for name in ("tables.npz", "again.npz"))
    expected = metrics.evaluate(load_run(folder / "run"), first, again=second, pairs=5, seed=3)
    assert capsys.readouterr().out == f"12 shapes of {folder / 'tables.npz'}\n{expected}\n"


def test_evaluate_measures_every_shape_of_another_file(folder, capsys):
    assert run(folder, "evaluate", "run", "tables.npz", "--all", "--pairs", "5") == 0
    expected = metrics.evaluate(load_run(folder / "run"), load_shapes(folder / "tables.npz"), pairs=5)
    assert capsys.readouterr().out == f"120 shapes of {folder / 'tables.npz'}\n{expected}\n"


@pytest.mark.parametrize("alone", [False, True])
def test_a_family_of_a_mixed_file_is_measured_on_what_the_run_did_not_see(tmp_path, capsys, alone):
    name, file, out = "table/four_legs", tmp_path / "mixed.npz", str(tmp_path / "run")
    data_gen.save(data_gen.generate(("box/one", name), count=120, points=16, seed=0), file)
    shapes = load_shapes(file)
    family = ["--family", name] if alone else []
    assert main(["train", str(file), "--out", out, "--steps", "1", *LITTLE, *family]) == 0
    held_out = shapes.of_family(name).split(2)[2] if alone else shapes.split(2)[2].of_family(name)
    capsys.readouterr()
    assert main(["evaluate", out, str(file), "--family", name, "--pairs", "5"]) == 0
    expected = metrics.evaluate(load_run(out), held_out, pairs=5)
    assert capsys.readouterr().out == f"{len(held_out)} shapes of {file}\n{expected}\n"
    assert main(["axioms", out, str(file), "--family", name]) == 0
    assert capsys.readouterr().out == f"{axioms.report(load_run(out), held_out)}\n"


def test_the_whole_of_a_file_of_which_a_run_has_seen_one_family_is_refused(tmp_path, capsys):
    file, out = tmp_path / "mixed.npz", str(tmp_path / "run")
    data_gen.save(data_gen.generate(("box/one", "table/four_legs"), count=120, points=16, seed=0), file)
    assert main(["train", str(file), "--out", out, "--steps", "1", *LITTLE, "--family", "box/one"]) == 0
    capsys.readouterr()
    for words in ([], ["--family", "table/four_legs"]):
        assert main(["evaluate", out, str(file), "--pairs", "5", *words]) == 2
        assert re.match(OTHERS, capsys.readouterr().err)


def test_the_same_shapes_in_shards_and_a_file_new_to_the_run_are_measured(folder, tmp_path):
    data_gen.save_shards([data_gen.generate("table/four_legs", count=120, points=32, seed=0)], tmp_path / "shards")
    assert run(folder, "evaluate", "run", str(tmp_path / "shards"), "--pairs", "5") == 0
    assert run(folder, "evaluate", "run", "again.npz", "--pairs", "5", "--all") == 0


def test_a_run_that_keeps_no_fingerprint_is_taken_as_it_is(folder, tmp_path, capsys):
    out = shutil.copytree(folder / "run", tmp_path / "older")
    about = json.loads((out / "config.json").read_text(encoding="utf-8"))
    del about["fingerprint"]
    (out / "config.json").write_text(json.dumps(about), encoding="utf-8")
    assert main(["evaluate", str(out), str(folder / "again.npz"), "--pairs", "5"]) == 0
    assert "12 shapes" in capsys.readouterr().out
    data_gen.save(data_gen.generate("table/four_legs", count=3, points=32, seed=0), tmp_path / "few.npz")
    assert main(["evaluate", str(out), str(tmp_path / "few.npz")]) == 2
    words = r"held out: at least 3 shapes are needed to measure, got 0: only what was held out of .*few.npz was taken; "
    words += "bring more shapes, or give --all for a file that the space was not trained on"
    assert re.match(words, capsys.readouterr().err)


def test_axioms_prints_the_report(folder, capsys):
    assert run(folder, "axioms", "run", "tables.npz", "--seed", "3") == 0
    held_out = load_shapes(folder / "tables.npz").split(2)[2]
    assert capsys.readouterr().out == f"{axioms.report(load_run(folder / 'run'), held_out, seed=3)}\n"


def test_deform_writes_what_the_function_gives(folder, tmp_path, capsys):
    out = tmp_path / "a.glb"
    given = ["-o", str(out), "--up", "y", "z", "--subdivide", "0.2", "--seed", "4"]
    assert run(folder, "deform", "run", "long.glb", "tall.ply", *given) == 0
    assert capsys.readouterr().out == f"{out}\n"
    pair, options = (folder / "long.glb", folder / "tall.ply"), {"up": ("y", "z"), "subdivide": 0.2, "seed": 4}
    expected = meshes.deform(load_run(folder / "run"), *pair, **options)
    np.testing.assert_allclose(meshes.load_mesh(out).bounds, expected.bounds, atol=1e-6)
    assert len(meshes.load_mesh(out).triangles) == len(expected.triangles) > 12


def test_transfer_writes_what_the_function_gives(folder, tmp_path, capsys):
    out = tmp_path / "a.stl"
    meshes.save_mesh(trimesh.Trimesh(**painted()), folder / "painted.glb")
    shapes = ["long.glb", "tall.ply", "painted.glb"]
    assert run(folder, "transfer", "run", *shapes, "--out", str(out), "--up", "y") == 0
    said = capsys.readouterr()
    assert said.out == f"{out}\n"
    assert "STL keeps no colours" in said.err
    expected = meshes.transfer(load_run(folder / "run"), *(folder / name for name in shapes), up="y")
    np.testing.assert_allclose(meshes.load_mesh(out).bounds, expected.bounds, atol=1e-6)


def painted():
    box = trimesh.creation.box()
    return {"vertices": box.vertices, "faces": box.faces, "vertex_colors": np.full((8, 4), 99, dtype=np.uint8)}


def test_zoo_lists_what_is_there(folder, capsys, monkeypatch):
    monkeypatch.setattr(zoo, "HERE", folder)
    assert main(["zoo"]) == 0
    weights = sum(tensor.numel() for tensor in load_run(folder / "run").parameters())
    assert capsys.readouterr().out == f"run  k = 4, 32 points, {weights} weights\n"


def test_a_name_of_the_zoo_is_a_run(folder, capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(zoo, "HERE", folder)
    monkeypatch.chdir(tmp_path)
    assert main(["axioms", "run", str(folder / "tables.npz")]) == 0
    assert "zero_acts_trivially" in capsys.readouterr().out


def test_build_checks_and_writes(tmp_path, capsys):
    pytest.importorskip("jupytext")
    source = tmp_path / "notebooks" / "source" / "00_a.py"
    source.parent.mkdir(parents=True)
    source.write_text("# %%\n1 + 1\n", encoding="utf-8")
    assert main(["build", "student", "--check", "--root", str(tmp_path)]) == 2
    assert "00_a.ipynb differ; run python -m dsn_lite build student" in capsys.readouterr().err
    assert main(["build", "student", "--root", str(tmp_path)]) == 0
    assert capsys.readouterr().out == "wrote 00_a.ipynb\n"
    assert main(["build", "student", "--check", "--root", str(tmp_path)]) == 0
    assert capsys.readouterr().out == "every notebook is what its source gives\n"


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["evaluate", "nowhere", "tables.npz"], "run: must be a run folder or a ready-made space"),
        (["evaluate", "run", "nowhere.npz"], "load_shapes: .*there is no such file"),
        (
            ["evaluate", "run", "tables.npz", "--again", "few.npz"],
            "evaluate: --again must hold the 120 shapes of .*, got 3",
        ),
        (["train", "tables.npz", "--out", "new.npz", "--k", "0"], "Config: k must be more than 0, got 0"),
        (["train", "tables.npz", "--out", "new.npz", "--k", "97"], "train: k must be at most 3n = 96"),
        (
            ["deform", "run", "long.glb", "nowhere.glb", "-o", "a.glb"],
            "load_mesh: .*nowhere.glb: there is no such file",
        ),
        (["deform", "run", "long.glb", "tall.ply", "-o", "a.fbx"], "save_mesh: .* must end in"),
        (["evaluate", "run", "few.npz"], OTHERS),
        (["evaluate", "run", "again.npz"], OTHERS),
        (["axioms", "run", "again.npz", "--family", "table/four_legs"], OTHERS),
        (["axioms", "run", "plain.npz", "--family", "x"], "of_family: .* got none; leave --family x out"),
        (["reproduce", "size", "--device", "foo"], "device: must be one that torch can use here, got 'foo'"),
        (["zoo", "--rebuild", "nothing"], "zoo: there is no recipe for 'nothing'"),
    ],
)
def test_trouble_is_one_sentence(folder, words, sentence, capsys):
    data_gen.save(data_gen.generate("table/four_legs", count=3, points=32, seed=0), folder / "few.npz")
    save_shapes(np.zeros((9, 32, 3)), folder / "plain.npz")
    assert run(folder, *words) == 2
    said = capsys.readouterr().err
    assert len(said.splitlines()) == 1
    assert re.match(sentence, said)


def test_ctrl_c_ends_without_a_traceback(folder, monkeypatch, capsys):
    def interrupted(path):
        raise KeyboardInterrupt

    monkeypatch.setattr(runs, "load_run", interrupted)
    assert run(folder, "axioms", "run", "tables.npz") == 130
    assert capsys.readouterr().err == "stopped\n"


def test_help_names_every_command():
    said = subprocess.run(
        [sys.executable, "-m", "dsn_lite", "--help"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    for name, function in COMMANDS.items():
        assert name in said.stdout
        assert function.__doc__.split()[0] in said.stdout


def help_of(command, capsys):
    """What --help says, in one line without its frame."""
    with pytest.raises(SystemExit):
        main([command, "--help"])
    return " ".join(re.sub(r"\x1b\[[\d;]*m|[│─╭╮╰╯]", " ", capsys.readouterr().out).split())


def test_help_explains_every_option_of_a_training(capsys):
    said = help_of("train", capsys)
    options = re.split(r" --(?!no-)(?=[a-z])", said[said.index(" --k ") :])[1:]
    told = {option.split()[0].rstrip(","): option.split("(default")[0].split() for option in options}
    for name in (field.name.replace("_", "-") for field in fields(Config)):
        assert len(told[name]) > 4, name
    for choices, _ in CHOICES.values():
        assert "{" + ",".join(choices) + "}" in said


@pytest.mark.parametrize(("command", "names"), [("reproduce", EXPERIMENTS), ("zoo", zoo.RECIPES)])
def test_help_lists_the_names_there_are(command, names, capsys):
    assert ", ".join(names) in help_of(command, capsys)


def test_a_wrong_word_is_refused_with_2(capsys):
    with pytest.raises(SystemExit) as caught:
        main(["deform"])
    assert caught.value.code == 2
    assert "required" in capsys.readouterr().err.lower()


def test_collect_makes_a_file_to_train_on(tmp_path, capsys):
    trimesh.creation.box((1, 2, 1)).export(tmp_path / "box.ply")
    assert main(["collect", str(tmp_path), "--points", "40", "--out", str(tmp_path / "mine.npz")]) == 0
    assert "1 shapes of 40 points" in capsys.readouterr().out
    assert load_shapes(tmp_path / "mine.npz").points.shape == (1, 40, 3)
