"""Imports point upward only: a module uses those that stand above it here, and every module has its place."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
ORDER = {
    "data_gen": (
        "files growing points areas part joint linear rig fits form faults families colours checks sample shards "
        "archive draw assemble normalise make transfers visible degrade truth handles data_sheet paper_data meshes "
        "paint sheet gallery catalogue describe __init__ __main__"
    ).split(),
    "dsn_lite": (
        "types dictionary chamfer pooling networks shapes handles contract data files space projection metrics "
        "coverage losses modes transfers structure editing axioms config runs checkpoints world batches training "
        "driving processes sweep zoo __init__ byhand meshes plots widgets diagnosis judges checks lessons build "
        "experiments commands __main__"
    ).split(),
}
FOREIGN = {"data_gen": {"torch", "dsn_lite"}, "dsn_lite": {"data_gen"}}  # the two meet only in the sample file
SLOW = {"plotly", "ipywidgets", "anywidget", "trimesh", "data_gen"}  # not before they are needed


def name_of(path, package):
    """A file's module, or the folder it is in: data_gen/families/box.py is `families`."""
    inside = path.relative_to(package)
    return inside.parts[0] if len(inside.parts) > 1 else inside.stem


def imported(source, package, depth=0):
    """The dotted names that a source imports, `.x` written as `package.x`; depth: how deep below the package it is."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            inside = node.level == 0 or node.level > depth  # `from .` in a folder stays in that folder
            base = ".".join(part for part in [package if node.level else "", node.module or ""] if part)
            names = [f"{base}.{alias.name}" for alias in node.names] if base == package else [base]
            yield from names if inside else []


def faults(module, names, package, order):
    """The imports of one module that point downward, sideways out of the package, or to what has no place."""
    if module not in order:
        return [f"{package}.{module} has no place in tests/test_layers.py"]
    own = [name.split(".")[1] if "." in name else "__init__" for name in names if name.split(".")[0] == package]
    own = [name if name in order else "__init__" for name in own]  # `from package import function` is its door
    down = [name for name in own if name != module and order.index(name) > order.index(module)]
    foreign = [name for name in names if name.split(".")[0] in FOREIGN[package]]
    return [f"{package}.{module} must not import {name}" for name in down + foreign]


@pytest.mark.parametrize("package", ORDER)
def test_imports_point_upward(package):
    folder = ROOT / package
    found = []
    for path in sorted(folder.rglob("*.py")):
        depth = len(path.relative_to(folder).parts) - 1
        names = list(imported(path.read_text(encoding="utf-8"), package, depth))
        found += faults(name_of(path, folder), names, package, ORDER[package])
    assert not found, "\n".join(found)


@pytest.mark.parametrize("package", ORDER)
def test_every_place_is_taken(package):
    taken = {name_of(path, ROOT / package) for path in (ROOT / package).rglob("*.py")}
    assert taken == set(ORDER[package])


@pytest.mark.parametrize(
    ("module", "source", "depth"),
    [
        ("types", "from .space import ActionSpace", 0),
        ("types", "from . import space", 0),
        ("types", "import dsn_lite.space", 0),
        ("chamfer", "def later():\n    from dsn_lite.space import ActionSpace", 0),
        ("data", "from data_gen import generate", 0),
        ("data", "from dsn_lite import train", 0),
        ("zoo", "from ..plots import shapes", 1),
        ("helpers", "", 0),
    ],
)
def test_a_wrong_import_is_seen(module, source, depth):
    assert faults(module, list(imported(source, "dsn_lite", depth)), "dsn_lite", ORDER["dsn_lite"])


@pytest.mark.parametrize(
    ("module", "source", "depth"),
    [
        ("space", "from .types import Points", 0),
        ("meshes", "from .surface import sample", 1),
        ("data", "import os", 0),
    ],
)
def test_a_right_import_is_not(module, source, depth):
    assert not faults(module, list(imported(source, "dsn_lite", depth)), "dsn_lite", ORDER["dsn_lite"])


@pytest.mark.parametrize(("package", "unwanted"), [("dsn_lite", SLOW), ("data_gen", {"torch", "dsn_lite", "plotly"})])
def test_import_brings_nothing_it_does_not_need(package, unwanted):
    ask = f"import sys, {package}; print(*{{name.split('.')[0] for name in sys.modules}})"
    loaded = subprocess.run([sys.executable, "-c", ask], cwd=ROOT, capture_output=True, text=True, check=True)
    assert not unwanted & set(loaded.stdout.split())
