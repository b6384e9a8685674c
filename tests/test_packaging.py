"""pyproject.toml, requirements.lock and environment.yml say the same; the files that describe the project agree."""

import re
import tomllib
from importlib import metadata
from pathlib import Path

import pytest
import yaml
from packaging.markers import Marker
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import start

ROOT = Path(__file__).resolve().parent.parent
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
LOCK = (ROOT / "requirements.lock").read_text(encoding="utf-8")
COURSE, TESTS = ([Requirement(line) for line in part] for part in start.sections(LOCK))
ASKED = {
    canonicalize_name(one.name): [Requirement(line) for line in one.requires or []] for one in metadata.distributions()
}
CONDA_NAMES = {"torch": "pytorch-cpu"}
SYSTEMS = {
    "Linux": {"sys_platform": "linux", "os_name": "posix", "platform_system": "Linux"},
    "macOS": {"sys_platform": "darwin", "os_name": "posix", "platform_system": "Darwin"},
    "Windows": {"sys_platform": "win32", "os_name": "nt", "platform_system": "Windows"},
}


def requirements(lines):
    return {canonicalize_name(found.name): found for found in map(Requirement, lines)}


def pins(lock, name):
    return [str(found.specifier).removeprefix("==") for found in lock if canonicalize_name(found.name) == name]


@pytest.mark.parametrize("extra", [None, "test"])
def test_lock_satisfies_the_ranges(extra):
    wanted = PROJECT["optional-dependencies"][extra] if extra else PROJECT["dependencies"]
    for name, requirement in requirements(wanted).items():
        found = pins(TESTS if extra else COURSE, name)
        assert len(found) == 1, f"{name} has {found} in requirements.lock"
        assert requirement.specifier.contains(found[0]), f"{name}=={found[0]} is not within {requirement}"


def test_lock_holds_what_the_package_is_built_with():
    for name, requirement in requirements(PYPROJECT["build-system"]["requires"]).items():
        assert requirement.specifier.contains(pins(COURSE, name)[0])


def test_lock_is_exact_and_for_every_machine():
    lines = [line for line in LOCK.splitlines() if line and line[0] != "#"]
    assert all(re.fullmatch(r"[a-z0-9-]+==[\w.]+( ; .+)?", line) for line in lines), "no +cpu, hashes, URLs or options"
    assert not [line for line in lines if re.match("nvidia|cuda|triton", line)]


@pytest.mark.parametrize(("system", "own"), [("Linux", "pexpect"), ("macOS", "appnope"), ("Windows", "pywinpty")])
@pytest.mark.parametrize("python", ["3.11", "3.12", "3.13"])
def test_lock_is_closed_on_every_system(system, own, python):
    here = {**SYSTEMS[system], "python_version": python, "python_full_version": f"{python}.1"}
    holds = lambda marker: marker is None or Marker(str(marker)).evaluate({**here, "extra": ""})
    names = {canonicalize_name(found.name) for found in COURSE + TESTS if holds(found.marker)}
    assert own in names
    for name in names:  # each distribution that is installed here also finds there what it asks for
        asked = ASKED.get(name, [])
        missing = {canonicalize_name(found.name) for found in asked if holds(found.marker)} - names
        assert not {lost for lost in missing if not re.match("nvidia|cuda|triton", lost)}, f"{name} asks for {missing}"


def conda():
    found = yaml.safe_load((ROOT / "environment.yml").read_text(encoding="utf-8"))["dependencies"]
    return [line for line in found if isinstance(line, str)], [line["pip"] for line in found if isinstance(line, dict)]


def test_conda_has_the_same_packages_and_ranges():
    packages, pip = conda()
    found = {canonicalize_name(one.name): one.specifier for one in map(Requirement, packages)}
    for name, requirement in requirements(PROJECT["dependencies"]).items():
        assert found.pop(CONDA_NAMES.get(name, name)) == requirement.specifier, name
    assert found.pop("python") == Requirement(f"python{PROJECT['requires-python']}").specifier
    assert set(found) == {"pip"}
    assert pip == [["-e ."]]


def test_conda_names_the_cpu_build_first_and_a_reason_for_each():
    assert conda()[0][0].startswith("pytorch-cpu")
    lines = (ROOT / "environment.yml").read_text(encoding="utf-8").split("dependencies:")[1].splitlines()
    assert not [line for line in lines if re.match(r"\s+- (?!pip:)", line) and "  # " not in line]


def test_python_versions_agree():
    allowed = Requirement(f"python{PROJECT['requires-python']}").specifier
    for version in ("3.10", "3.11", "3.12", "3.13", "3.14"):
        says = start.python_trouble([int(part) for part in version.split(".")])
        assert (says is None) == allowed.contains(version)


def test_version_is_told_once():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == PROJECT["version"]
    assert citation["license"] == PROJECT["license"]


def test_every_package_and_trained_run_is_packed():
    patterns = PYPROJECT["tool"]["setuptools"]["package-data"]["dsn_lite"]
    files = [path for path in (ROOT / "dsn_lite").rglob("*") if path.is_file() and "__pycache__" not in path.parts]
    data = {path for path in files if path.suffix != ".py"}
    assert data <= {path for pattern in patterns for path in (ROOT / "dsn_lite").glob(pattern)}
    for package in ("data_gen", "dsn_lite"):  # setuptools finds packages by their __init__.py
        folders = {path.parent for path in (ROOT / package).rglob("*.py")}
        assert not [folder for folder in folders if not (folder / "__init__.py").exists()]
