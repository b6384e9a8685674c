"""The experiment on structure: its figures, its pictures, and that it trains what the ready-made spaces were."""

import re
from dataclasses import asdict, replace
from xml.etree import ElementTree

import pytest
import torch
from worlds import shapes_of

from dsn_lite.config import network
from dsn_lite.experiments import structure, structure_pictures
from dsn_lite.experiments.kinds import Scale, Trained
from dsn_lite.experiments.results import Results

LITE, FULL = Scale("lite"), Scale("full")
LEG = [0.0, 0.0, 0.0, 0.1, 1.0, 0.1]


@pytest.fixture(scope="module")
def figures():
    """What an untrained space scores on a few tables."""
    run, shapes = structure.runs(LITE)[0], shapes_of("table/four_legs", 24, 64)
    torch.set_grad_enabled(False)
    space = network(replace(run.config, k=4, features=(8, 16), head=(8,)))
    found = run.measure(Trained(space, run.config, shapes[:16], shapes[16:], shapes[16:], []), 15, 48, 6)
    torch.set_grad_enabled(True)
    return found


def test_runs_are_the_papers_tables_and_three_categories():
    told = {(run.arm, run.config.seed): run for run in structure.runs(LITE)}
    assert list(told) == [
        ("four_legs", 0),
        ("four_legs", 1),
        ("four_legs", 2),
        ("chair", 0),
        ("sofa", 0),
        ("airplane", 0),
    ]
    assert told["four_legs", 0].how["edits"] == 2000
    assert told["four_legs", 0].data.count == 5000
    assert told["four_legs", 0].config.symmetry == told["four_legs", 0].config.sparsity == 0
    assert told["chair", 0].config.norm == "l1"
    assert all(run.config.steps == 20_000 for run in structure.runs(FULL))


def test_the_exact_dictionary_is_better_than_an_untrained_space(figures):
    assert figures["exact_gap_free"] < 1e-5 < figures["gap_free"]
    assert figures["exact_failed"] <= figures["none_failed"]
    assert 1 <= figures["used"] <= 4


def test_the_worst_come_first_and_hold_the_edit(figures):
    worst = figures["worst"]
    assert len(worst) == structure.WORST
    for before, edited, after in worst:
        part, number = structure_pictures._pinned(before, edited)
        assert after[part][number] == pytest.approx(edited[part][number], abs=1e-6)
        changed = [
            a != pytest.approx(b, abs=1e-6)
            for x, y in zip(before, edited, strict=True)
            for a, b in zip(x, y, strict=True)
        ]
        assert sum(changed) <= 1


def test_pictures_are_well_formed_and_say_what_was_edited():
    moved = [*LEG[:4], 1.5, LEG[5]]
    svg = structure_pictures.edited_boxes("Said <so>", [[[LEG, LEG], [LEG, moved], [moved, moved]]] * 3)
    root = ElementTree.fromstring(svg)
    texts = [each.text for each in root.iter() if each.tag.endswith("text")]
    assert texts[0] == "1. leg_1.scale.y: 1.00 → 1.50"
    assert len([each for each in root.iter() if each.tag.endswith("path")]) == 3 * 3 * 2 * 3
    assert next(each.text for each in root.iter() if each.tag.endswith("title")) == "Said <so>"


def test_a_bar_is_as_long_as_its_power_of_ten():
    root = ElementTree.fromstring(structure_pictures.bars("said", ["x"], {"a": [1e-3], "b": [1e-2], "c": [1e-1]}))
    paths = [each.get("d") for each in root.iter() if each.tag.endswith("path") and "V" in each.get("d")]
    tops = [float(path.split("V")[1].split("h")[0]) for path in paths[:3]]
    assert tops[0] - tops[1] == pytest.approx(tops[1] - tops[2], abs=0.2)
    assert tops[0] > tops[2]


def test_a_full_run_has_the_papers_size():
    assert asdict(structure.runs(FULL)[0].data) == {
        "family": "table/four_legs",
        "count": 5000,
        "points": 2048,
        "seed": 271828,
    }


def test_the_page_tells_tables_and_categories(figures, tmp_path):
    results = Results(structure.EXPERIMENT, LITE, tmp_path)
    chairs = shapes_of("chair", 40, 48)
    space = network(replace(results.runs[0].config, k=4, features=(8, 16), head=(8,)))
    with torch.no_grad():
        mixed = structure.measure(
            Trained(space, results.runs[-1].config, chairs[:30], chairs[30:], chairs[30:], []), 8, 32, 6
        )
    for run in results.runs:
        results.add(run, {"steps": 1, "seconds": 1.0, "figures": figures if run.arm == "four_legs" else mixed})
    page = structure.EXPERIMENT.section(results)
    assert not re.search(r"nan|inf\b|None", page)
    assert "| paper | 9.6 | 6.94 | 9.6 | 31.7 |" in page
    assert all(f"`{arm}`" in page for arm in ("chair", "sofa", "airplane"))
    assert "worst" not in mixed
    assert [picture.name for picture in structure.EXPERIMENT.charts(results)] == ["ratios", "worst"]
    assert all(ElementTree.fromstring(picture.svg) is not None for picture in structure.EXPERIMENT.charts(results))


def test_there_is_no_picture_without_a_table(tmp_path):
    assert structure.EXPERIMENT.charts(Results(structure.EXPERIMENT, LITE, tmp_path)) == []
