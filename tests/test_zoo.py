import json
import shutil
from pathlib import Path

import pytest
import torch
from worlds import randn

import data_gen
from dsn_lite import Config, load, load_run, load_shapes, train, zoo


def test_every_recipe_has_its_run_and_every_run_its_recipe():
    assert zoo.names() == sorted(zoo.RECIPES)


@pytest.mark.parametrize("name", sorted(zoo.RECIPES))
def test_a_ready_made_space_loads_gives_its_probe_again_and_works(name):
    space = load(name)
    x, y = randn(0, 2, 40, 3, dtype=torch.float32) / 4
    assert torch.equal(space.deform(x, x), x)
    assert (space.deform(x, y) - x).abs().max() > 1e-3
    assert space.frame is not None


@pytest.mark.parametrize("name", sorted(zoo.RECIPES))
def test_a_card_names_the_two_commands_that_make_the_run_again(name):
    card = (zoo.HERE / name / "card.md").read_text(encoding="utf-8")
    assert f"data_gen generate {zoo.RECIPES[name].generate}" in card
    assert zoo.RECIPES[name].train in card
    assert zoo.RECIPES[name].bad_at in card


def test_an_unknown_name():
    with pytest.raises(
        ValueError, match=r"load: there is no ready-made space 'spoon', there are .*; load_run takes a folder"
    ):
        load("spoon")


def test_an_unknown_recipe():
    with pytest.raises(ValueError, match=r"zoo: there is no recipe for 'spoon', there are .*table_four_legs"):
        zoo.rebuild("spoon")


def test_a_rebuilt_run_is_that_of_the_commands_on_its_card(tmp_path, monkeypatch):
    small = zoo.Recipe("table/four_legs --count 60 --points 48 --seed 0", "--k 4 --steps 3 --seed 0", "Everything.")
    monkeypatch.setitem(zoo.RECIPES, "small", small)
    monkeypatch.setattr(zoo, "HERE", tmp_path)
    made = zoo.rebuild("small")
    assert sorted(file.name for file in made.iterdir()) == sorted([*zoo.FILES, "card.md"])
    card = (made / "card.md").read_text(encoding="utf-8")
    assert all(part in card for part in (small.generate, small.train, small.bad_at, "3 steps", "sampling floors"))
    shapes, run = tmp_path / "shapes.npz", tmp_path / "run"
    data_gen.save(data_gen.generate("table/four_legs", count=60, points=48, seed=0), shapes)
    train(load_shapes(shapes), Config(k=4, steps=3), out=run)
    again, ours = load_run(run), load("small")
    assert all(torch.equal(ours.state_dict()[name], value) for name, value in again.state_dict().items())


def test_a_command_that_fails_is_one_sentence(monkeypatch):
    monkeypatch.setitem(zoo.RECIPES, "spoon", zoo.Recipe("spoon --count 9 --points 8", "", "Everything."))
    with pytest.raises(
        ValueError,
        match=r"zoo: python -m data_gen generate spoon --count 9 --points 8 --out .* must end well, got exit "
        r"code \d+; see what it said above, and repeat",
    ):
        zoo.rebuild("spoon")


def test_a_run_that_was_stopped_is_not_published(tmp_path, monkeypatch):
    monkeypatch.setattr(zoo, "HERE", tmp_path)
    shutil.copytree(Path(zoo.__file__).parent / "chair", tmp_path / "run")
    about = json.loads((tmp_path / "run" / "config.json").read_text(encoding="utf-8"))
    (tmp_path / "run" / "config.json").write_text(json.dumps(about | {"finished": False}), encoding="utf-8")
    with pytest.raises(ValueError, match=r"zoo: .*run must be a finished run, its training was stopped; resume it"):
        zoo.publish("chair", tmp_path / "run", tmp_path / "shapes.npz", tmp_path / "again.npz")
    assert not (tmp_path / "chair").exists()


def test_a_publication_that_breaks_off_leaves_the_old_files(tmp_path, monkeypatch):
    monkeypatch.setattr(zoo, "HERE", tmp_path)
    monkeypatch.setattr(zoo, "card", lambda *_: "new")
    monkeypatch.setattr(zoo, "finished", lambda _: True)
    (tmp_path / "chair").mkdir()
    (tmp_path / "chair" / "config.json").write_text("old", encoding="utf-8")
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "config.json").write_text("new", encoding="utf-8")

    def half(source, target):
        Path(target).write_text("ne", encoding="utf-8")
        raise OSError("no space left")

    monkeypatch.setattr(zoo.shutil, "copy", half)
    with pytest.raises(OSError, match="no space left"):
        zoo.publish("chair", tmp_path / "run", tmp_path / "shapes.npz", tmp_path / "again.npz")
    assert [path.name for path in (tmp_path / "chair").iterdir()] == ["config.json"]
    assert (tmp_path / "chair" / "config.json").read_text(encoding="utf-8") == "old"
