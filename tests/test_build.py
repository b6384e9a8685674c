"""What students get from a lesson's source: no solutions, no outputs, always the same bytes."""

import json

import nbformat
import pytest

from dsn_lite import build

SOURCE = """\
# %% [markdown]
# # 00 A lesson
# With a symbol: ⊕

# %%
total = 1
total

# %% [markdown] tags=["solution"]
# The answer in words.

# %%
# **given**
base = 2
# solution
_hidden = 3
answer = base + _hidden

# %%
assert answer
"""


@pytest.fixture
def root(tmp_path):
    folder = tmp_path / "notebooks" / "source"
    folder.mkdir(parents=True)
    (folder / "00_lesson.py").write_text(SOURCE, encoding="utf-8")
    return tmp_path


def cells(text):
    return [(cell["cell_type"], "".join(cell["source"])) for cell in json.loads(text)["cells"]]


def test_students_get_stubs_and_instructors_everything(root):
    source = root / "notebooks" / "source" / "00_lesson.py"
    assert cells(build.student(source)) == [
        ("markdown", "# 00 A lesson\nWith a symbol: ⊕"),
        ("code", "total = 1\ntotal"),
        ("code", "# **given**\nbase = 2\nanswer = ...  # your code here"),
        ("code", "assert answer"),
    ]
    assert "_hidden = 3" in build.instructor(source)
    assert "The answer in words." in build.instructor(source)


@pytest.mark.parametrize("make", [build.student, build.instructor])
def test_notebooks_are_valid_and_hold_no_outputs(root, make):
    notebook = nbformat.reads(make(root / "notebooks" / "source" / "00_lesson.py"), 4)
    nbformat.validate(notebook)
    assert all(cell.outputs == [] and cell.execution_count is None for cell in notebook.cells if "outputs" in cell)


@pytest.mark.parametrize(
    ("solution", "stub"),
    [
        ("v = y - x", "v = ...  # your code here"),
        ("a, (b, c) = f()", "a = ...  # your code here\nb = ...  # your code here\nc = ...  # your code here"),
        ("v = 1\nv = 2", "v = ...  # your code here"),
        ("print(1)", "...  # your code here"),
        ("def f(x):\n    return x", "def f(x):\n    return ...  # your code here"),
        (
            'def f(\n    x,\n):\n    """The sum."""\n    return x',
            'def f(\n    x,\n):\n    """The sum."""\n    return ...  # your code here',
        ),
    ],
)
def test_stub(solution, stub):
    assert build.stub(solution) == stub


def test_only_what_differs_is_written(root):
    target = root / "notebooks" / "00_lesson.ipynb"
    assert build.build_student(root) == [target]
    assert build.outdated(root) == []
    assert build.build_student(root) == []
    target.write_text(target.read_text(encoding="utf-8").replace("total", "sum"), encoding="utf-8")
    assert build.outdated(root) == [target]
    assert {path.name for path in target.parent.iterdir()} == {"source", "00_lesson.ipynb"}, "a .part is left"


def test_the_same_source_gives_the_same_bytes(root):
    source = root / "notebooks" / "source" / "00_lesson.py"
    first = build.student(source)
    source.write_text(SOURCE, encoding="utf-8", newline="\r\n")  # as an editor on Windows may save it
    assert build.student(source) == first


def test_a_folder_without_lessons_is_named(tmp_path):
    with pytest.raises(ValueError, match=r"build: .* must hold notebooks/source/\*\.py, none found; run it in"):
        build.build_student(tmp_path)
