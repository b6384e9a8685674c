"""What the experiments measure, the pages made of it, and that RESULTS.md is what the stored figures give."""

import json
import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from worlds import shapes_of

import data_gen
from dsn_lite import Config, as_shapes
from dsn_lite.config import network
from dsn_lite.experiments import EXPERIMENTS, axioms, projection, report, silence, sparsity, synchronization
from dsn_lite.experiments.kinds import Scale, Trained
from dsn_lite.experiments.results import Results
from dsn_lite.experiments.transfers import plausible

LITE, FULL = Scale("lite"), Scale("full")
LITTLE = {"pairs": 6, "targets": 2, "sources": 4, "references": 5, "points": 16}


@pytest.fixture(scope="module")
def collections():
    """Small collections of each family that an experiment asks for, sampled twice."""
    made = {}
    for name in ("chair", "sofa", "table", "table/four_legs"):
        shapes = data_gen.generate(name, count=48, points=32, seed=0)
        made[name] = as_shapes(shapes), as_shapes(data_gen.resample(shapes, 1))
    return made


def trained(run, collections):
    """The space of a run as it is before training, and a few shapes."""
    shapes, again = collections[run.data.family]
    space = network(replace(run.config, k=4, features=(8, 16), head=(8,)))
    looks = [{"step": step} | axioms.laws(space, shapes) for step in (5, 10)] if run.watch else []
    return Trained(space, run.config, shapes[:8], shapes, again, looks)


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
    assert "±" in page or name == "axioms"
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
    for run in runs:
        assert run.config.steps == 20_000 if scale.full else run.config.steps < 10_000
        assert run.config.k <= 3 * run.config.points
        assert json.loads(json.dumps(run.settings)) == run.settings
    if scale.full:
        assert {run.config.head for run in runs} == {(512, 256, 128)}
        assert {run.data.points for run in runs} == {2048}
    largest = max(runs, key=lambda run: run.config.k).config
    assert network(largest).dictionary.k == largest.k


def test_table_3_is_told_as_printed():
    better = {
        (f, c) for (f, c), (without, projected) in projection.PAPER.items() if f != "coverage" and projected < without
    }
    assert better == {("fitting", "chair"), ("fitting", "sofa"), ("fitting", "table"), ("mmd", "sofa")}


def test_the_order_is_the_papers_where_it_is(stored, tmp_path):
    run = {run.arm: run for run in projection.EXPERIMENT.runs(Scale("lite", 1))}
    results = Results(projection.EXPERIMENT, Scale("lite", 1), tmp_path)
    figures = {name: 1.0 for figure in projection.FIGURES for name in (figure, f"free_{figure}", f"idle_{figure}")}
    results.add(run["chair-without"], {"seconds": 1.0, "figures": figures})
    results.add(run["chair-with"], {"seconds": 1.0, "figures": figures | {"fitting": 0.5, "mmd": 0.5, "coverage": 0.5}})
    said = projection.section(results)
    rows = [line for line in said.splitlines() if line.startswith("| fitting") and "5.93" in line]
    assert rows[0].endswith("| yes |")
    assert "In MMD-CD the order is the paper's for none of chair." in said
    assert "In Cov-CD the order is the paper's for chair of chair." in said


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
    results.add(
        runs["l21-0-seed0"], {"figures": {"fitting_cd": 1.0, "quiet": 5.0, "scaled": 5.0, "varimax_quiet": 4.0}}
    )
    results.add(runs["l21-3-seed0"], {"figures": {"fitting_cd": cd, "quiet": quiet, "scaled": quiet}})
    page = sparsity.section(results)
    assert said in page
    assert "makes 4 % small, no more than w = 0" in page


def test_concat_is_compared_with_the_paper():
    mine, printed = (
        synchronization.PAPER["fitting CD, Table 1", "concat"],
        synchronization.PAPER["fitting CD, Table 1", "joint"],
    )
    assert all(a < b for a, b in zip(mine, printed, strict=True))
