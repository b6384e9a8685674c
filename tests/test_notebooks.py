"""The lessons: student notebooks are what their sources give, every lesson keeps the frame, every solution is right."""

import ast
import itertools
import os
import re
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from dsn_lite import build

ROOT = Path(__file__).resolve().parent.parent
SOURCES = build.sources(ROOT)
OPENING = ["**Objectives.**", "**Time.**", "**Prerequisites.**", "**Paper.**"]
CLOSING = ["## Take-away", "## What the paper does not say"]
WIDGET = re.compile(r"\bwidgets\.[A-Z]")
each_lesson = pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)


def lesson(source):
    return [(cell.cell_type, cell.source) for cell in nbformat.reads(build.instructor(source), 4).cells]


def frame_faults(cells):
    """What a lesson lacks of the frame that all lessons share."""
    text = [source for kind, source in cells if kind == "markdown"]
    code = [source for kind, source in cells if kind == "code"]
    return [*_outline_faults(text), *_cell_faults(code), *_order_faults(cells)]


def _outline_faults(text):
    levels = [len(marks) for marks in re.findall(r"^(#+) ", "\n".join(text), re.M)]
    if levels.count(1) != 1 or levels[0] != 1:
        yield "one title, at the top"
    if any(below > above + 1 for above, below in itertools.pairwise(levels)):
        yield "a heading skips a level"
    yield from (f"the first cell lacks {part}" for part in OPENING if part not in text[0])
    end = "\n".join(text[-2:])
    places = [end.find(part) for part in CLOSING]
    if min(places) < 0 or places != sorted(places):
        yield f"the end lacks {' and '.join(CLOSING)}"


def _cell_faults(code):
    for source in code:
        lines = [line for line in source.splitlines() if line.strip() and line != build.SOLUTION]
        if len(lines) > 8:
            yield f"a cell of {len(lines)} lines: {lines[0]}"
        yield from (f"a line of {len(line)} characters: {line}" for line in lines if len(line) > 120)
        if any(isinstance(node, ast.ClassDef) for node in ast.walk(ast.parse(source))):
            yield f"a class: {lines[0]}"


def _order_faults(cells):
    solutions = [number for number, (_, source) in enumerate(cells) if build.SOLUTION in source.splitlines()]
    if not 3 <= len(solutions) <= 5:
        yield f"{len(solutions)} exercises, not 3 to 5"
    unchecked = [at for at in solutions if "checks." not in cells[at + 1][1]]
    yield from (f"no check after: {cells[at][1]}" for at in unchecked)
    for before, (kind, source) in itertools.pairwise(cells):
        if kind == "code" and WIDGET.search(source) and "**Predict first" not in before[1]:
            yield f"no **Predict first** right before: {source}"


@each_lesson
def test_student_notebook_is_what_its_source_gives(source):
    target = source.parent.parent / f"{source.stem}.ipynb"
    assert target.exists(), "run `python -m dsn_lite build student`"
    assert target.read_bytes() == build.student(source).encode(), "run `python -m dsn_lite build student`"


def test_no_notebook_is_without_its_source():
    assert {path.stem for path in (ROOT / "notebooks").glob("*.ipynb")} == {source.stem for source in SOURCES}


@each_lesson
def test_lesson_keeps_the_frame(source):
    faults = frame_faults(lesson(source))
    assert not faults, "\n".join(faults)
    assert lesson(source)[0][1].startswith(f"# {source.stem[:2]} ")


GOOD = [
    ("markdown", "# 00 Title\n" + "\n".join(OPENING)),
    ("markdown", "**Predict first.** Up or down?"),
    ("code", "widgets.Sliders(space)"),
    *[("code", "# solution\nv = 1"), ("code", "checks.number(v, 1)")] * 3,
    ("markdown", "\n\n".join(CLOSING)),
]


def test_frame_has_teeth():
    assert not frame_faults(GOOD)


@pytest.mark.parametrize(
    ("place", "cell", "fault"),
    [
        (0, ("markdown", "Text\n" + "\n".join(OPENING)), "one title"),
        (0, ("markdown", "# 00 Title\n### Deep\n" + "\n".join(OPENING)), "skips a level"),
        (0, ("markdown", "# 00 Title\n" + "\n".join(OPENING[1:])), r"lacks \*\*Objectives"),
        (1, ("markdown", "Drag it."), r"no \*\*Predict first"),
        (2, ("code", "x\n" * 9), "a cell of 9 lines"),
        (2, ("code", "x = '" + "x" * 120 + "'"), "a line of 126 characters"),
        (2, ("code", "class Space:\n    pass"), "a class"),
        (3, ("code", "v = 1"), "2 exercises"),
        (4, ("code", "v"), "no check after"),
        (-1, ("markdown", "## What the paper does not say\n## Take-away"), "the end lacks"),
    ],
)
def test_frame_sees(place, cell, fault):
    broken = list(GOOD)
    broken[place] = cell
    assert any(re.search(fault, found) for found in frame_faults(broken))


@each_lesson
def test_solutions_are_right(source, tmp_path, monkeypatch):
    monkeypatch.setenv("DSN_LITE_SMOKE", "1")
    monkeypatch.setenv("DSN_LITE_SOLUTIONS", "1")  # a wrong or missing answer raises instead of being explained
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")]))
    notebook = nbformat.reads(build.instructor(source), 4)
    place = {"metadata": {"path": str(tmp_path)}}
    NotebookClient(notebook, timeout=300, resources=place, shutdown_kernel="immediate").execute()
