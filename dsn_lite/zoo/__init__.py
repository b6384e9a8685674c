"""Small trained runs that ship with the package, and the recipes that make them again from nothing."""

import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from ..checkpoints import load_history
from ..files import load_shapes
from ..metrics import Evaluation, evaluate
from ..runs import load_run
from ..space import DeformSyncNet

HERE = Path(__file__).parent
FILES = ("config.json", "model.safetensors", "probe.safetensors")


@dataclass(frozen=True)
class Recipe:
    """What data_gen generates, what dsn_lite train is told, and what the result should not be trusted with."""

    generate: str
    train: str
    bad_at: str


RECIPES = {
    "table_four_legs": Recipe(
        "table/four_legs --count 2000 --points 2048 --seed 0",
        "--k 32 --steps 12000 --seed 0",
        "Tables unlike its own: round tops, crossed or tapered legs, drawers, shelves. It has seen parts only as boxes "
        "parallel to the axes, so a leg that leans is moved as if it stood upright. Tables from other sources come "
        "only part of the way to their target: look at the result, and train on your own kind of thing.",
    ),
}


def load(name: str, device: str = "cpu") -> DeformSyncNet:
    """The ready-made space of this name. Raises ValueError, naming those there are, where there is none."""
    if name not in names():
        known = ", ".join(names())
        raise ValueError(f"load: there is no ready-made space {name!r}, there are {known}; load_run takes a folder")
    return load_run(HERE / name, device)


def names() -> list[str]:
    """The runs that are here."""
    return sorted(path.parent.name for path in HERE.glob("*/config.json"))


def rebuild(name: str) -> Path:
    """Makes a run again from nothing, by the commands that its card names, measures it and puts it in its place."""
    if name not in RECIPES:
        raise ValueError(f"zoo: there is no recipe for {name!r}, there are {', '.join(RECIPES)}; add it to RECIPES")
    recipe = RECIPES[name]
    with tempfile.TemporaryDirectory() as folder:
        file, again, run = Path(folder) / "shapes.npz", Path(folder) / "again.npz", Path(folder) / "run"
        _python("-m", "data_gen", "generate", *recipe.generate.split(), "--out", file)
        _python("-m", "data_gen", "resample", file, "--seed", 1, "--out", again)
        _python("-m", "dsn_lite", "train", file, "--out", run, *recipe.train.split())
        card = _card(name, recipe, run, file, again)
        (HERE / name).mkdir(exist_ok=True)
        for part in FILES:
            shutil.copy(run / part, HERE / name / part)
        (HERE / name / "card.md").write_text(card, encoding="utf-8")
    return HERE / name


def _card(name: str, recipe: Recipe, run: Path, file: Path, again: Path) -> str:
    """What a reader should know of a run before trusting it, with the figures as measured now."""
    held_out, second = (load_shapes(path).split()[2] for path in (file, again))
    result, last = evaluate(load_run(run), held_out, again=second), load_history(run)[-1]
    return f"""# {name}

Made by `python -m dsn_lite zoo --rebuild {name}`, which runs

    python -m data_gen generate {recipe.generate} --out shapes.npz
    python -m data_gen resample shapes.npz --seed 1 --out again.npz
    python -m dsn_lite train shapes.npz --out run {recipe.train}

{last["step"]} steps, {last["seconds"]:.0f} seconds on the machine that made it. On the {len(held_out)} shapes held out:

| what | this space | doing nothing |
|---|---|---|
{_figures(result)}

A Chamfer distance is in squared units of the file, in brackets in sampling floors ({result.floor:.2e}); the true
deformation scores {result.exact_cd / result.floor:.2f}. The transfer error is squared, as a share of leaving the
shape alone.

**Bad at.** {recipe.bad_at}
"""


def _figures(result: Evaluation) -> str:
    fitted, idle, closed = (
        f"{cd:.2e} ({cd / result.floor:.2f})"
        for cd in (result.fitting_cd, result.do_nothing_cd, result.parallelogram_cd)
    )
    rows = [("fitting CD", fitted, idle), ("parallelogram CD", closed, "not meaningful")]
    rows += [("share moved by a transfer", f"{result.share_moved:.2f}", "0")]
    rows += [("transfer error", f"{result.transfer_error:.2%}", "100%")]
    return "\n".join(f"| {what} | {here} | {nothing} |" for what, here, nothing in rows)


def _python(*arguments: object) -> None:
    subprocess.run([sys.executable, *map(str, arguments)], check=True)
