"""From a lesson's source, written with its solutions, to the notebook that students open.

A source is a percent script, `notebooks/source/NN_name.py`. In a code cell, what follows a line `# solution` is the
solution, up to the end of the cell; students get `name = ...  # your code here` for each name it assigns (but not for
`_name`, the solution's own), and a function with its head and docstring that returns `...`. A cell tagged "solution" is
left out. A cell's id is its lesson and its place, so the same source gives the same bytes.
"""

import ast
import json
from pathlib import Path

from .files import beside

SOLUTION = "# solution"
STUB = "...  # your code here"
METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def build_student(root: Path) -> list[Path]:
    """Write the student notebooks of all lessons under `root`; returns those that changed."""
    changed = outdated(root)
    for path in changed:
        text = student(source_of(path))
        beside(path, lambda part, text=text: part.write_text(text, encoding="utf-8", newline="\n"))
    return changed


def outdated(root: Path) -> list[Path]:
    """The student notebooks whose bytes are not what their source gives, or that do not exist yet."""
    targets = [path.parent.parent / f"{path.stem}.ipynb" for path in sources(root)]
    return [path for path in targets if not path.exists() or path.read_bytes() != student(source_of(path)).encode()]


def sources(root: Path) -> list[Path]:
    """The lessons' sources in their order.

    Raises:
        ValueError: there is none under `root`.
    """
    found = sorted((root / "notebooks" / "source").glob("*.py"))
    if not found:
        raise ValueError(f"build: {root} must hold notebooks/source/*.py, none found; run it in the repository")
    return found


def source_of(notebook: Path) -> Path:
    """The source that a notebook is made from."""
    return notebook.parent / "source" / f"{notebook.stem}.py"


def student(source: Path) -> str:
    """The student notebook of a lesson as text (nbformat 4.5, no outputs, no solutions)."""
    cells = _cells(source)
    kept = [cell | {"source": _without_solution(cell)} for cell in cells if "solution" not in _tags(cell)]
    return _notebook(kept)


def instructor(source: Path) -> str:
    """The same notebook with its solutions in place."""
    return _notebook(_cells(source))


def stub(solution: str) -> str:
    """What students find where the solution was."""
    lines = [line for node in ast.parse(solution).body for line in _stubs(node, solution.splitlines())]
    return "\n".join(dict.fromkeys(lines)) or STUB


def _cells(source: Path) -> list[dict]:
    import jupytext  # an author's tool: readers of the lessons do not need it

    cells = jupytext.read(source, fmt="py:percent").cells
    return [dict(cell) | {"id": f"{source.stem}-{number:03}"} for number, cell in enumerate(cells)]


def _tags(cell: dict) -> list[str]:
    return cell["metadata"].get("tags", [])


def _without_solution(cell: dict) -> str:
    lines = cell["source"].splitlines()
    if cell["cell_type"] != "code" or SOLUTION not in lines:
        return cell["source"]
    start = lines.index(SOLUTION)
    return "\n".join([*lines[:start], stub("\n".join(lines[start + 1 :]))])


def _stubs(node: ast.stmt, lines: list[str]) -> list[str]:
    if isinstance(node, ast.FunctionDef):
        head = node.body[0].end_lineno if ast.get_docstring(node) else node.body[0].lineno - 1
        return [*lines[node.lineno - 1 : head], f"    return {STUB}"]
    targets = node.targets if isinstance(node, ast.Assign) else []
    names = [name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)]
    return [f"{name} = {STUB}" for name in names if not name.startswith("_")]


def _notebook(cells: list[dict]) -> str:
    cells = [_cell(cell) for cell in cells]
    content = {"cells": cells, "metadata": METADATA, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(content, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def _cell(cell: dict) -> dict:
    bare = {key: cell[key] for key in ("cell_type", "id", "source")}
    tags = {"tags": _tags(cell)} if _tags(cell) else {}
    code = {"execution_count": None, "outputs": []} if cell["cell_type"] == "code" else {}
    return bare | {"metadata": tags, "source": bare["source"].splitlines(keepends=True)} | code
