"""Small trained runs that ship with the package, and the recipes that make them again from nothing."""

import shutil
import tempfile
from functools import partial
from hashlib import sha256
from pathlib import Path

from ..files import beside
from ..processes import python
from ..runs import finished, load_run
from ..space import DeformSyncNet
from .cards import card
from .recipes import RECIPES, Recipe

__all__ = ["FILES", "HERE", "RECIPES", "Recipe", "digest", "load", "names", "publish", "rebuild"]

HERE = Path(__file__).parent
FILES = ("config.json", "model.safetensors", "probe.safetensors")


def load(name: str, device: str = "cpu") -> DeformSyncNet:
    """The ready-made space of this name. Raises ValueError, naming those there are, where there is none."""
    if name not in names():
        known = ", ".join(names())
        raise ValueError(f"load: there is no ready-made space {name!r}, there are {known}; load_run takes a folder")
    return load_run(HERE / name, device)


def names() -> list[str]:
    """The runs that are here."""
    return sorted(path.parent.name for path in HERE.glob("*/config.json"))


def digest(name: str) -> str:
    """Twelve hexadecimal digits that tell the weights of a ready-made space from others."""
    return sha256((HERE / name / "model.safetensors").read_bytes()).hexdigest()[:12]


def rebuild(name: str) -> Path:
    """Makes a run again from nothing, by the commands that its card names, measures it and puts it in its place."""
    if name not in RECIPES:
        raise ValueError(f"zoo: there is no recipe for {name!r}, there are {', '.join(RECIPES)}; add it to RECIPES")
    recipe = RECIPES[name]
    with tempfile.TemporaryDirectory() as folder:
        file, again, run = Path(folder) / "shapes.npz", Path(folder) / "again.npz", Path(folder) / "run"
        python("zoo", "-m", "data_gen", "generate", *recipe.generate.split(), "--out", file)
        python("zoo", "-m", "data_gen", "resample", file, "--seed", 1, "--out", again)
        python("zoo", "-m", "dsn_lite", "train", file, "--out", run, *recipe.train.split())
        return publish(name, run, file, again)


def publish(name: str, run: Path, file: Path, again: Path) -> Path:
    """Measures a run that was trained by its recipe, writes its card and puts both in their place.

    Raises ValueError where the training did not reach its end.
    """
    if not finished(run):
        raise ValueError(f"zoo: {run} must be a finished run, its training was stopped; resume it to its end first")
    text, place = card(name, RECIPES[name], run, file, again), HERE / name
    place.mkdir(exist_ok=True)
    for part in FILES:
        beside(place / part, partial(shutil.copy, run / part))
    beside(place / "card.md", partial(Path.write_text, data=text, encoding="utf-8"))
    return place
