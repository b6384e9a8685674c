"""Writes requirements.lock from pyproject.toml. Needs uv (https://docs.astral.sh/uv) and a network: python .ci/lock.py

One resolution holds for Linux, macOS and Windows and every Python the project names. The GPU libraries that torch asks
for on Linux are left out: start.py installs torch's CPU build, which needs none of them.
"""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LOCK = ROOT / "requirements.lock"
TORCH = "torch==2.13.0"  # the release that the numbers in the README and in zoo/ were made with
GPU = re.compile(r"(nvidia|cuda|triton)\b")
HEADER = """\
# Exact versions for Linux, macOS and Windows, Python 3.11 to 3.13. Made by: python .ci/lock.py
# start.py installs the first section for the course, and both for `start.py test`.
"""
UV = ["uv", "pip", "compile", "pyproject.toml", "-", "--universal", "--python-version", "3.11"]
UV += ["--fork-strategy", "fewest", "--no-header", "--no-annotate", "--quiet"]


def resolve(*options: str) -> list[str]:
    """The lines `name==version ; marker` that uv finds for pyproject.toml, what it is built with, and torch's pin."""
    build = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["build-system"]["requires"]
    wanted = "\n".join([*build, TORCH])
    found = subprocess.run([*UV, *options], cwd=ROOT, input=wanted, capture_output=True, text=True)
    if found.returncode:
        sys.exit(f"lock: uv found no set of versions\n{found.stderr}")
    return [line for line in found.stdout.splitlines() if line and not GPU.match(line)]


def main() -> None:
    """Resolve everything, then the course alone within that, so that the sections cannot disagree."""
    everything = resolve("--extra", "test")
    bounds = LOCK.with_suffix(".part")
    bounds.write_text("\n".join(everything), encoding="utf-8")
    course = resolve("--constraint", bounds.name)
    tests = [line for line in everything if line not in course]
    sections = [HEADER.rstrip(), "", "# --- the course", *course, "", "# --- for the tests only", *tests, ""]
    bounds.write_text("\n".join(sections), encoding="utf-8", newline="\n")
    bounds.replace(LOCK)


if __name__ == "__main__":
    main()
