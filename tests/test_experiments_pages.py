"""What the experiments measure, the pages made of it, and that RESULTS.md is what the stored figures give."""

import json
import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest
import torch
from worlds import shapes_of

import data_gen
from dsn_lite import Config, as_shapes, zoo
from dsn_lite.config import network
from dsn_lite.experiments import (
    EXPERIMENTS,
    axioms,
    projection,
    projection_page,
    report,
    running,
    silence,
    sparsity,
    synchronization,
    transfer,
)
from dsn_lite.experiments.kinds import Scale, Trained, Transfers
from dsn_lite.experiments.results import Results
from dsn_lite.experiments.transfers import plausible

LITE, FULL = Scale("lite"), Scale("full")
LITTLE = {"edits": 12, "pairs": 6, "targets": 2, "sources": 4, "references": 5, "points": 16}


@pytest.fixture(scope="module")
def collections():
    """Small collections of each family that an experiment asks for, sampled twice."""
    made = {}
    for name in ("chair", "sofa", "airplane", "car", "lamp", "table", "table/four_legs"):
        shapes = data_gen.generate(name, count=48, points=32, seed=0)
        made[name] = as_shapes(shapes), as_shapes(data_gen.resample(shapes, 1))
    return made


def trained(run, collections):
    """The space of a run as it is before training, and a few shapes."""
    shapes, again = drawn(run.data) if isinstance(run.data, Transfers) else collections[run.data.family]
    space = network(replace(run.config, k=4, features=(8, 16), head=(8,)))
    looks = [{"step": step} | axioms.laws(space, shapes) for step in (5, 10)] if run.watch else []
    return Trained(space, run.config, shapes[:8], shapes, again, looks)


def drawn(data):
    """A few triplets, as an experiment asks for them, in the place of shapes and of shapes sampled again."""
    made = data_gen.transfers(data.family, count=20, points=32, across=data.across, single=data.single)
    return (as_shapes(made),) * 2


@pytest.fixture(scope="module")
def stored(collections, tmp_path_factory):
    """Results of all experiments, in which every run of an arm measured the same, but for a touch a seed."""
    folder = tmp_path_factory.mktemp("stored")
    for experiment in EXPERIMENTS.values():
        results, figures = Results(experiment, LITE, folder / report.RESULTS), {}
        for run in results.runs:
            if run.arm not in figures:
                how = {name: LITTLE[name] if name in LITTLE else value for name, value in run.how.items()}
                figures[run.arm] = run.measure(trained(run, collections), **how)
            touched = {
                name: touch(value, run.config.seed) for name, value in figures[run.arm].items() if name != "step"
            }
            touched |= {"step": figures[run.arm]["step"]} if "step" in figures[run.arm] else {}
            results.add(run, {"steps": 10, "seconds": 1.0, "figures": touched})
    return folder


def touch(value, seed):
    """A little more for every seed."""
    return [touch(each, seed) for each in value] if isinstance(value, list) else value * (1 + seed / 100)


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_a_page_has_every_arm_and_no_gap(name, stored):
    experiment = EXPERIMENTS[name]
    results = Results(experiment, LITE, stored / report.RESULTS)
    page = experiment.section(results)
    assert not re.search(r"nan|inf\b|None", page)
    assert "±" in page or name in ("axioms", "transfer")
    assert len(results.entries) == len(results.runs)


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_a_page_can_be_made_of_any_runs(name, stored, tmp_path):
    experiment = EXPERIMENTS[name]
    full = Results(experiment, LITE, stored / report.RESULTS)
    for arm in full.arms:
        some = Results(experiment, LITE, tmp_path / arm)
        run = next(run for run in full.runs if run.arm == arm)
        some.add(run, {name: value for name, value in full.entries[run.key].items() if name != "settings"})
        assert experiment.section(some)
        assert all(chart.svg for chart in experiment.charts(some))


def test_figures_are_found_by_the_name_of_their_experiment(stored):
    found = report.stored("silence", stored)
    assert found.entries == Results(EXPERIMENTS["silence"], LITE, stored / report.RESULTS).entries
    assert len(found.entries) == len(found.runs)


def test_a_written_page_shows_the_charts_that_are_written_beside_it(stored):
    page = report.write(stored).read_text(encoding="utf-8")
    assert page == report.text(stored)
    shown = re.findall(r"!\[(.+)\]\((.+\.svg)\)", page)
    assert {file for _, file in shown} == {f"{report.RESULTS}/{name}" for name in report.charts(stored)}
    for said, file in shown:
        root = ElementTree.fromstring((stored / file).read_text(encoding="utf-8"))
        assert root.find("{*}title").text == said


def test_results_md_is_what_the_stored_figures_give():
    assert (report.HERE / "RESULTS.md").read_text(encoding="utf-8") == report.text()
    stored = {path.name: path.read_text(encoding="utf-8") for path in (report.HERE / report.RESULTS).glob("*.svg")}
    assert stored == report.charts()


def test_stored_figures_are_those_of_the_runs_as_they_are_now():
    known = {}
    for experiment in EXPERIMENTS.values():
        for scale in (LITE, FULL):
            results = Results(experiment, scale, report.HERE / report.RESULTS)
            known[results.path.name] = set(results.entries)
    for path in (report.HERE / report.RESULTS).glob("*.json"):
        assert set(json.loads(path.read_text(encoding="utf-8"))["runs"]) == known[path.name]


@pytest.mark.parametrize("scale", [LITE, FULL], ids=lambda scale: scale.name)
@pytest.mark.parametrize("name", EXPERIMENTS)
def test_every_run_can_be_begun(name, scale):
    runs = EXPERIMENTS[name].runs(scale)
    assert len({run.key for run in runs}) == len(runs)
    assert {run.data.family for run in runs} <= {*data_gen.families(), *data_gen.categories()}
    runs = [run for run in runs if not run.ready]
    for run in runs:
        assert run.config.steps == 20_000 if scale.full else run.config.steps <= 12_000
        assert run.config.k <= 3 * run.config.points
        assert json.loads(json.dumps(run.settings)) == run.settings
    if scale.full and runs:
        assert {run.config.head for run in runs} == {(512, 256, 128)}
        assert {run.data.points for run in runs} == {2048}
    for largest in sorted((run.config for run in runs), key=lambda config: config.k)[-1:]:
        assert network(largest).dictionary.k == largest.k


def test_a_run_of_a_ready_made_space_knows_its_weights(monkeypatch):
    run = transfer.runs(LITE)[0]
    before = run.settings
    assert before["weights"] == zoo.digest("chair")
    monkeypatch.setattr(zoo, "digest", lambda name: "others")
    assert run.settings != before


def test_transfers_are_told_to_data_gen_as_they_are_named():
    data = Transfers("chair", 20, 32, across=True, single=True)
    assert data.name == "chair-20x32-seed0-transfers-across-single"
    assert data.told == ("transfers", "chair", "--count", "20", "--points", "32", "--seed", "0", "--across", "--single")


def test_a_ready_made_space_is_measured_on_all_shapes(tmp_path):
    measured = []
    run = replace(transfer.runs(LITE)[0], data=Transfers("chair", 15, 32), measure=lambda trained, **how: keep(trained))
    keep = lambda trained: measured.append(trained) or {"points": len(trained.shapes)}
    only = replace(transfer.EXPERIMENT, name="one", runs=lambda scale: [run])
    running.reproduce(only, [run], LITE, running.Workplace(tmp_path, tmp_path / report.RESULTS))
    assert Results(only, LITE, tmp_path / report.RESULTS).values("chair-same", "points") == [60]
    torch.testing.assert_close(measured[0].space.state_dict(), zoo.load("chair").state_dict())
    assert [path.name for path in (tmp_path / "data").iterdir()] == ["chair-15x32-seed0-transfers.npz"]


def test_table_3_is_told_as_printed():
    better = {
        (f, c)
        for (f, c), (without, projected) in projection_page.PAPER.items()
        if f != "coverage" and projected < without
    }
    assert better == {("fitting", "chair"), ("fitting", "sofa"), ("fitting", "table"), ("mmd", "sofa")}


NAMES = [name for figure in projection_page.FIGURES for name in (figure, f"free_{figure}", f"idle_{figure}")]


def projected(folder, without, projected):
    """Chairs of which every figure without projection in training, and with it, is that of each seed."""
    results = Results(projection.EXPERIMENT, LITE, folder)
    for run in results.runs:
        values = {"chair-without": without, "chair-with": projected}.get(run.arm, {})
        if run.config.seed in values:
            value = values[run.config.seed]
            figures = value if isinstance(value, dict) else dict.fromkeys(NAMES, value)
            results.add(run, {"seconds": 1.0, "figures": figures})
    return results


def rows(page, category="chair"):
    """The cells of our table, by figure."""
    lines = [line.strip("| ").split(" | ") for line in page.splitlines() if line.startswith("| ")]
    return {cells[0].split(",")[0]: cells[2:] for cells in lines if cells[1] == category and len(cells) == 8}


def test_the_order_is_the_papers_where_it_is(tmp_path):
    page = projection.section(projected(tmp_path, {0: 1.0, 1: 1.1}, {0: 0.5, 1: 0.7}))
    orders = {figure: cells[-1] for figure, cells in rows(page).items()}
    assert orders == {"fitting CD": "yes", "MMD-CD": "no", "Cov-CD": "yes"}
    assert (
        "Of 3 comparisons with the paper, 2 have the paper's order beyond the spread over the seeds (fitting CD" in page
    )
    assert "of chair and Cov-CD of chair); 1 have the other order beyond it (MMD-CD of chair)." in page


def test_a_difference_within_the_spread_is_no_order(tmp_path):
    page = projection.section(projected(tmp_path, {0: 1.0, 1: 1.0}, {0: 0.5, 1: 1.4}))
    assert rows(page)["fitting CD"][-1] == "yes, within the spread"
    assert "Of 3 comparisons with the paper, 3 have a difference within the spread, which tells no order (" in page


def test_rows_hold_the_seeds_that_both_trainings_have(tmp_path):
    page = projection.section(projected(tmp_path, {0: 1e-3, 1: 2e-3, 2: 9e-3}, {1: 1e-3}))
    assert rows(page)["fitting CD"] == ["2", "1", "-1", "6.82", "5.93", "yes, of one seed"]
    assert "3 have one seed, which has no spread (" in page
    assert "9 |" not in page


def test_trainings_without_a_seed_in_common_are_not_shown(tmp_path):
    results = projected(tmp_path, {0: 1.0}, {1: 1.0, 2: 2.0})
    assert projection.section(results) == "Of no category both trainings of one seed are done yet."


@pytest.mark.parametrize(
    ("mmd", "coverage", "said"),
    [
        (0.5, 2.0, ("better than each", "better than each")),
        (2.0, 0.5, ("no better than any", "no better than any")),
        (1.5, 1.5, ("better than some", "better than some")),
    ],
)
def test_doing_nothing_is_compared_by_the_figures(mmd, coverage, said, tmp_path):
    told = dict.fromkeys(NAMES, 1.0) | {"idle_mmd": mmd, "idle_coverage": coverage}
    with_it = told | {name: 2.0 - (mmd != 1.5) for name in ("mmd", "coverage")}
    page = projection.section(projected(tmp_path, {0: told}, {0: with_it}))
    for name, place in zip(("MMD-CD", "Cov-CD"), said, strict=True):
        assert f"In {name}, doing nothing scores {place} of the four kinds of transfers for chair." in page


def test_silence_is_told_of_each_weight_with_its_spread(tmp_path):
    results, echoes = (
        Results(silence.EXPERIMENT, LITE, tmp_path),
        {"chair-w0": (60, 80, 70), "chair-w10": (90, 120, 84)},
    )
    for run in results.runs:
        if run.arm in echoes:
            figures = {"untrained_echo": 100.0, "echo": echoes[run.arm][run.config.seed]}
            results.add(run, {"figures": figures})
    page = silence.section(results)
    assert "100 → 70 ± 10 % with w = 0 (quieter); 100 → 98 ± 19 % with w = 10 (quieter, within the spread)." in page


def test_transfers_that_are_the_references_match_and_cover_them(collections):
    shapes, again = collections["chair"]
    given = Trained(network(Config(k=2)), Config(k=2), shapes[:8], shapes, again, [])
    how = {"targets": 2, "sources": 8, "references": 8, "points": 20}
    perfect = plausible(given, lambda x, y, z: shapes.points[:8], "our_", **how)
    assert perfect["our_mmd"] < 1e-7
    assert perfect["our_coverage"] == 1
    idle = plausible(given, lambda x, y, z: z.points, "", **how)
    assert idle["mmd"] > 1e-4
    assert idle["coverage"] < 1


def test_a_target_is_the_same_for_all_its_sources(collections):
    shapes, again = collections["chair"]
    given, seen = Trained(network(Config(k=2)), Config(k=2), shapes[:8], shapes, again, []), []

    def move(x, y, z):
        seen.append((len(x), len(z), len(y.unique(dim=0))))
        return z.points

    plausible(given, move, "", targets=3, sources=5, references=4, points=8)
    assert seen == [(5, 5, 1)] * 3


@pytest.mark.parametrize(("family", "kind"), [("chair/swivel", "column"), ("table/shelf", "shelf")])
def test_an_edit_moves_the_points_of_its_part_alone(family, kind):
    shapes = shapes_of(family, count=4)
    part = shapes.part_names.index(kind)
    moved = (silence.edited(shapes, kind).points - shapes.points).abs().amax(-1) > 1e-6
    own = (shapes.labels == part).expand(moved.shape)
    assert not moved[~own].any()
    assert moved[own].float().mean() > 0.9


def test_curves_of_laws_are_means_over_the_steps_that_all_seeds_have(tmp_path):
    results = Results(axioms.EXPERIMENT, LITE, tmp_path)
    first, second = [run for run in results.runs if run.arm == "chair"][:2]
    results.add(first, {"figures": {"step": [0, 5, 10], "moved": [1.0, 7.0, 3.0]}})
    results.add(second, {"figures": {"step": [0, 10], "moved": [3.0, 5.0]}})
    assert axioms.curve(results, "chair", "step") == [0, 10]
    assert axioms.curve(results, "chair", "moved") == [2, 4]


@pytest.mark.parametrize(
    ("quiet", "cd", "said"),
    [
        (65.0, 1.2, "it is reached at l2,1, w = 3."),
        (55.0, 1.2, "no weight reaches it. At that cost l2,1, w = 3 comes nearest"),
        (65.0, 1.4, "every weight costs more."),
    ],
)
def test_whether_modes_are_local_at_little_cost(quiet, cd, said, tmp_path):
    results = Results(sparsity.EXPERIMENT, LITE, tmp_path)
    runs = {run.key: run for run in results.runs}
    without = {
        "fitting_cd": 1.0,
        "quiet": 5.0,
        "scaled": 5.0,
        "inside": 90.0,
        "varimax_quiet": 4.0,
        "varimax_scaled": 7.0,
    }
    results.add(runs["l21-0-seed0"], {"figures": without})
    results.add(
        runs["l21-3-seed0"], {"figures": {"fitting_cd": cd, "quiet": quiet, "scaled": quiet - 50, "inside": 40.0}}
    )
    page = sparsity.section(results)
    assert said in page
    assert "makes 4 % small, no more than w = 0" in page
    assert (
        "handles see 90 % of the columns without the loss, and least, 40 %, at l2,1, w = 3; scaling takes 50.0" in page
    )
    assert ("Of scaled columns, no weight reaches it." in page) == (cd < 1.3)


def test_concat_is_compared_with_the_paper():
    mine, printed = (
        synchronization.PAPER["fitting CD, Table 1", "concat"],
        synchronization.PAPER["fitting CD, Table 1", "joint"],
    )
    assert all(a < b for a, b in zip(mine, printed, strict=True))
