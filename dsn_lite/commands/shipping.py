"""zoo and build: what the repository ships."""

from pathlib import Path
from typing import Annotated, Literal

from tyro.conf import Positional, arg

from .. import build as building
from .. import zoo

REBUILD = f"The space to make again, by the recipe of its card: {', '.join(zoo.RECIPES)}."


def show_zoo(*, rebuild: Annotated[str | None, arg(metavar="NAME", help=REBUILD)] = None) -> None:
    """List the ready-made spaces, or train one again from nothing."""
    if rebuild is not None:
        print(zoo.rebuild(rebuild))
        return
    for name in zoo.names():
        space = zoo.load(name)
        count = sum(weights.numel() for weights in space.parameters())
        print(f"{name}  k = {space.dictionary.k}, {space.frame.n} points, {count} weights")


def build(what: Positional[Literal["student"]], /, *, check: bool = False, root: Path = Path(".")) -> None:
    """Make the students' notebooks from their sources in notebooks/source.

    Args:
        what: student: the notebooks without their solutions.
        check: Write nothing; fail where a notebook is not what its source gives.
        root: The repository.
    """
    changed = building.outdated(root) if check else building.build_student(root)
    names = ", ".join(path.name for path in changed)
    if check and changed:
        raise ValueError(
            f"build: notebooks must be what their sources give, {names} differ; run python -m dsn_lite build student"
        )
    print(f"wrote {names}" if changed else "every notebook is what its source gives")
