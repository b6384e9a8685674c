"""The family that CONTRIBUTING.md shows is a family as it stands: short, lawful, drawn and generated like any other."""

import inspect
import re
from pathlib import Path

import numpy as np
import pytest
import test_families

import data_gen
from data_gen.families import RIGS
from data_gen.faults import faults

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
SHOWN = re.search(r"^## Adding a family$.*?^```python\n(.*?)^```$", PAGE, re.M | re.S)[1]
LAWS = [law for name, law in vars(test_families).items() if name.startswith("test_")]


def written(text):
    """The one rig of a file's text."""
    module = {}
    exec(compile(text, "CONTRIBUTING.md", "exec"), module)
    (rig,) = module["FAMILIES"]
    return rig


@pytest.fixture
def shown(monkeypatch):
    rig = written(SHOWN)
    monkeypatch.setitem(RIGS, rig.name, rig)
    return rig


def run(law, name):
    law(name=name) if "name" in inspect.signature(law).parameters else law()


def test_it_is_under_thirty_lines():
    assert len(SHOWN.splitlines()) < 30
    assert max(map(len, SHOWN.splitlines())) <= 120


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_it_keeps_the_laws_of_all_families(law, shown):
    run(law, shown.name)


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("FLOOR + p.disc_width / 2", "FLOOR + p.disc_width"),
        ("(p.grip_length + p.disc_thickness) / 2", "(p.grip_length + p.disc_thickness) / 2 + 0.01"),
        ("p.grip_width, p.grip_width)", "p.grip_width, p.grip_width * p.grip_length)"),
        ("0.15, 0.5,", "0.15, 1.5,"),
        ("face_x", "face_y"),
    ],
)
def test_broken_it_fails_and_is_told_why(right, wrong, monkeypatch):
    assert right in SHOWN
    rig = written(SHOWN.replace(right, wrong))
    monkeypatch.setitem(RIGS, rig.name, rig)
    assert faults(rig)

    def fails(law):
        try:
            run(law, rig.name)
        except AssertionError:
            return True

    assert any(map(fails, LAWS))


def test_it_has_no_faults_and_can_be_generated_with_its_truth(shown):
    assert faults(shown) == []
    shapes = data_gen.generate("dumbbell", count=3, points=50, sampling="shared", dtype="float64")
    moved = data_gen.true_deformation(shapes[:1], shapes[1:2])
    np.testing.assert_allclose(moved[0], shapes.points[1], atol=1e-12)
    assert tuple(data_gen.mesh(shown.name, shown.middle[0]).geometry) == shown.part_names


def test_the_page_names_files_and_commands_that_are_there(shown):
    paths = set(re.findall(r"`((?:data_gen|tests)/[\w/]+\.py)", PAGE)) - {f"data_gen/families/{shown.category}.py"}
    assert {"data_gen/families/__init__.py", "data_gen/part.py"} <= paths
    assert [path for path in paths if not (ROOT / path).exists()] == []
    assert f"`python -m pytest tests/test_families.py -k {shown.category}`" in PAGE
    assert f"`python -m data_gen show {shown.name}`" in PAGE
