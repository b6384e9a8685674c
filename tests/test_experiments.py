"""Experiments: runs are made once, go on where they stopped, and are made again where they were told other things."""

import json
import re
from dataclasses import replace

import pytest
import torch
from worlds import TINY

from dsn_lite import experiments
from dsn_lite.__main__ import main
from dsn_lite.config import network
from dsn_lite.experiments import report, running
from dsn_lite.experiments.kinds import Data, Experiment, Run, Scale
from dsn_lite.experiments.results import Results
from dsn_lite.experiments.synchronization import freeze_codes

DATA = Data("box/one", 24, 16)
ONE = Scale("lite", 1)


class Lab:
    """An experiment of small runs, which can be told other things, and what was measured so far."""

    def __init__(self, folder):
        self.place = running.Workplace(folder, folder / report.RESULTS)
        self.told, self.hooks, self.how, self.measured = {}, {}, {}, []
        self.experiment = Experiment("tiny", "Tiny", "nothing", "Does it run?", self.runs, self.section)

    def runs(self, scale):
        """Two arms."""
        config = lambda seed, k: replace(TINY, **{"steps": 6, "seed": seed, "k": k} | self.told)
        return [
            Run(f"k-{k}", DATA, config(seed, k), self.measure, self.how, **self.hooks)
            for k in (2, 3)
            for seed in range(scale.seeds)
        ]

    def measure(self, trained, **how):
        """Numbers that tell one space from another."""
        self.measured.append(trained)
        weights = torch.cat([weights.flatten() for weights in trained.space.parameters()])
        return {"size": weights.square().sum().item(), "steps": [look["step"] for look in trained.looks]}

    def section(self, results):
        """The figures, bare."""
        return " ".join(f"{arm} {results.cell(arm, 'size')}" for arm in results.arms)

    def reproduce(self, only=None, scale=ONE):
        """Makes the runs and returns what is stored."""
        runs = running.selected([self.experiment], scale, only)["tiny"]
        running.reproduce(self.experiment, runs, scale, self.place)
        return self.stored(scale)

    def stored(self, scale=ONE):
        """The results as the file has them."""
        return Results(self.experiment, scale, self.place.results)

    @property
    def trainings(self):
        """The run folders."""
        return sorted(path.name for path in (self.place.cache / "trainings").iterdir())


@pytest.fixture(scope="module")
def shapes(tmp_path_factory):
    """The sample files, generated once."""
    place = running.Workplace(tmp_path_factory.mktemp("data"), tmp_path_factory.mktemp("results"))
    place.shapes(DATA)
    return place.cache / "data"


@pytest.fixture
def lab(tmp_path, shapes):
    (tmp_path / "data").mkdir()
    for file in shapes.iterdir():
        (tmp_path / "data" / file.name).write_bytes(file.read_bytes())
    return Lab(tmp_path)


def test_what_is_done_is_not_done_again(lab):
    first = lab.reproduce()
    assert list(first.entries) == ["k-2-seed0", "k-3-seed0"]
    assert len(lab.measured) == 2
    assert lab.reproduce().entries == first.entries
    assert len(lab.measured) == 2


def test_a_run_is_written_before_the_next_one_begins(lab):
    lab.reproduce("k-2")
    assert list(lab.stored().entries) == ["k-2-seed0"]
    entry = json.loads((lab.place.results / "tiny.json").read_text(encoding="utf-8"))["runs"]["k-2-seed0"]
    assert entry["steps"] == 6
    assert entry["seconds"] > 0
    assert entry["settings"]["data"] == {"family": "box/one", "count": 24, "points": 16, "seed": 0}


def test_a_run_that_is_told_other_things_is_made_again(lab):
    before = lab.reproduce("k-2")
    lab.told = {"learning_rate": 1e-3}
    assert not lab.stored().entries
    after = lab.reproduce("k-2")
    assert len(lab.trainings) == 2
    assert after.values("k-2", "size") != before.values("k-2", "size")


def test_another_way_to_measure_does_not_train_again(lab):
    lab.reproduce("k-2")
    lab.how = {"pairs": 3}
    assert not lab.stored().entries
    lab.reproduce("k-2")
    assert len(lab.measured) == 2
    assert len(lab.trainings) == 1


def test_a_field_that_a_config_has_got_since_counts_with_its_default(lab):
    lab.reproduce("k-2")
    path = lab.place.results / "tiny.json"
    told = json.loads(path.read_text(encoding="utf-8"))
    del told["runs"]["k-2-seed0"]["settings"]["config"]["clip"]
    path.write_text(json.dumps(told), encoding="utf-8")
    assert list(lab.stored().entries) == ["k-2-seed0"]


def test_more_seeds_are_more_runs_and_stay_known(lab):
    lab.reproduce("k-2", Scale("lite", 2))
    assert list(lab.stored().by_seed("k-2", "size")) == [0, 1]
    assert len(lab.stored().runs) == 4


@pytest.mark.parametrize("hooks", [{}, {"prepare": freeze_codes}])
def test_an_interrupted_run_goes_on_where_it_was(lab, tmp_path, hooks):
    lab.hooks = {"watch": look_on} | hooks
    whole = lab.reproduce("k-2")
    again = Lab(tmp_path / "again")
    again.place = running.Workplace(lab.place.cache, tmp_path / "again")
    for folder in lab.trainings:
        (lab.place.cache / "trainings" / folder).rename(tmp_path / folder)
    again.hooks = {"watch": stopped_once(3)} | hooks
    with pytest.raises(KeyboardInterrupt):
        again.reproduce("k-2")
    assert not again.stored().entries
    assert again.reproduce("k-2").values("k-2", "size") == whole.values("k-2", "size")
    assert again.stored().values("k-2", "steps")[0] == sorted(set(again.stored().values("k-2", "steps")[0]))


def look_on(training, record):
    """A look that sees nothing."""
    return {}


def stopped_once(look):
    """A watch of the same name that presses Ctrl-C the first time it comes to a look."""
    pressed = []

    def look_on(training, record):
        if not pressed and len(training.history) == look:
            pressed.append(True)
            raise KeyboardInterrupt
        return {}

    return look_on


def test_a_frozen_encoder_stays_as_it_was_drawn(lab):
    lab.hooks = {"prepare": freeze_codes}
    lab.reproduce("k-3")
    trained, drawn = lab.measured[0].space, network(lab.measured[0].config)
    kept = [torch.equal(a, b) for a, b in zip(trained.encode.parameters(), drawn.encode.parameters(), strict=True)]
    assert all(kept)
    learned = zip(trained.dictionary.parameters(), drawn.dictionary.parameters(), strict=True)
    assert not any(torch.equal(a, b) for a, b in learned)


def test_it_is_measured_on_shapes_held_out(lab):
    lab.reproduce("k-2")
    trained = lab.measured[0]
    assert (len(trained.seen), len(trained.shapes), len(trained.again)) == (20, 2, 2)
    assert not torch.equal(trained.shapes.points, trained.again.points)
    torch.testing.assert_close(trained.shapes.parameters, trained.again.parameters)
    assert not (trained.seen.parameters == trained.shapes.parameters[:1]).all(1).any()


def test_shapes_that_cannot_be_made_are_one_sentence(lab):
    sentence = (
        r"reproduce: python -m data_gen generate box/none .* must end well, got exit code \d+; see what it said above, "
        "and repeat"
    )
    with pytest.raises(ValueError, match=sentence):
        lab.place.shapes(Data("box/none", 24, 16))


def test_broken_results_are_refused(lab):
    lab.place.results.mkdir()
    (lab.place.results / "tiny.json").write_text("{", encoding="utf-8")
    with pytest.raises(
        ValueError, match=r"reproduce: .*tiny\.json must be the results of earlier runs, it is broken; "
    ):
        lab.stored()


def test_the_command_makes_the_runs_and_the_page(lab, monkeypatch, capsys):
    monkeypatch.setattr(experiments, "EXPERIMENTS", {"tiny": lab.experiment})
    monkeypatch.setattr(report, "EXPERIMENTS", {"tiny": lab.experiment})
    out = ["--out", str(lab.place.cache)]
    assert main(["reproduce", "tiny", "--only", "k-2", "--seeds", "1", *out]) == 0
    assert "tiny, run 1 of 1: k-2-seed0" in capsys.readouterr().out
    page = lab.place.cache / "RESULTS.md"
    assert "1 of 6 runs done" in page.read_text(encoding="utf-8")
    assert main(["reproduce", *out]) == 0
    assert capsys.readouterr().out.split()[:3] == ["tiny", "lite", "1/6,"]
    page.unlink()
    assert main(["reproduce", "--write", *out]) == 0
    assert page.exists()


def test_the_page_is_written_after_ctrl_c_too(lab, monkeypatch, capsys):
    monkeypatch.setattr(experiments, "EXPERIMENTS", {"tiny": lab.experiment})
    monkeypatch.setattr(report, "EXPERIMENTS", {"tiny": lab.experiment})
    lab.reproduce("k-2")
    lab.hooks = {}
    monkeypatch.setattr(running, "drive", interrupted)
    assert main(["reproduce", "all", "--seeds", "1", "--out", str(lab.place.cache)]) == 130
    assert "1 of 6 runs done" in (lab.place.cache / "RESULTS.md").read_text(encoding="utf-8")


def interrupted(training, watch):
    """A training that is stopped before it begins."""


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (
            ["everything"],
            "reproduce: NAME must be one of sparsity, projection, .* or all, got 'everything'; choose one",
        ),
        (["all", "--seeds", "0"], "reproduce: --seeds must be 1 or more, got 0; three show a spread"),
        (
            ["sparsity", "--only", "l3"],
            "reproduce: --only must be in the name of a run, got 'l3'; of the first seed are l21",
        ),
    ],
)
def test_trouble_is_one_sentence(words, sentence, tmp_path, capsys):
    assert main(["reproduce", *words, "--out", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert len(said.splitlines()) == 1
    assert re.match(sentence, said)
    assert not list(tmp_path.iterdir())
