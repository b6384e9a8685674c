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
