"""What a reader should know of a run before trusting it, with the figures as measured when it was made."""

from pathlib import Path

from .. import modes
from ..checkpoints import load_history
from ..files import load_shapes
from ..metrics import Evaluation, evaluate
from ..runs import load_run, read_config
from ..shapes import Shapes
from ..space import DeformSyncNet
from .recipes import Recipe

PAIRS = 1000
READ = 100  # shapes whose dictionaries are read
WORST = 5  # families that are named


def card(name: str, recipe: Recipe, run: Path, file: Path, again: Path) -> str:
    """The text of a card."""
    seed, space = read_config(run)[0].seed, load_run(run)
    held_out, second = (shapes[shapes.rows(seed)[2]] for shapes in map(load_shapes, (file, again)))
    result, last = evaluate(space, held_out, again=second, pairs=PAIRS), load_history(run)[-1]
    ratio = f"{result.parallelogram_cd / result.fitting_cd:.2f} times that of fitting"
    size = f"{len(held_out)} shapes held out, of {held_out.points.shape[1]} points"
    return f"""# {name}

Made by `python -m dsn_lite zoo --rebuild {name}`, which runs

    python -m data_gen generate {recipe.generate} --out shapes.npz
    python -m data_gen resample shapes.npz --seed 1 --out again.npz
    python -m dsn_lite train shapes.npz --out run {recipe.train}

{last["step"]} steps, {last["seconds"]:.0f} seconds on the machine that made it. {PAIRS} pairs and triplets of the
{size}:

| what | this space | doing nothing |
|---|---|---|
{_figures(result)}

A Chamfer distance is in squared units of the file, in brackets in sampling floors ({result.floor:.2e}).
Left to fit: (CD - floor) / (doing nothing - floor); left to close: the same of the parallelogram, whose distance is
{ratio} (the paper's Tables 1 and 2: 1.0 to 1.8).{_truth(result)}

{_dictionary(space, held_out)}
{_families(space, held_out, second)}
**Bad at.** {recipe.bad_at}
"""


def _figures(result: Evaluation) -> str:
    fitted, idle, closed, open_ = (
        f"{cd:.2e} ({cd / result.floor:.2f})"
        for cd in (result.fitting_cd, result.do_nothing_cd, result.parallelogram_cd, result.parallelogram_idle_cd)
    )
    rows = [("fitting CD", fitted, idle), ("left to fit", f"{result.fitting_share:.3f}", "1")]
    rows += [("parallelogram CD", closed, open_), ("left to close", f"{result.parallelogram_share:.3f}", "1")]
    rows += [("share moved by a transfer", f"{result.share_moved:.2f}", "0")]
    if result.transfer_error is not None:
        rows += [("transfer error", f"{result.transfer_error:.2%}", "100%")]
    return "\n".join(f"| {what} | {here} | {nothing} |" for what, here, nothing in rows)


def _truth(result: Evaluation) -> str:
    if result.transfer_error is None:
        return ""
    return (
        f"\nThe true deformation scores {result.exact_cd / result.floor:.2f} floors. "
        "The transfer error is squared, as a share of leaving the shape alone."
    )


def _dictionary(space: DeformSyncNet, held_out: Shapes) -> str:
    few = held_out[: min(READ, len(held_out))]
    reading = modes.read(space, few)
    v = space.vector(few.points, few.points.roll(1, 0))
    dead = len(modes.unused(modes.moved_by_lengths(reading.rms, v)))
    untrained = modes.quiet_share(modes.read(space.untrained(), few))
    quiet = f"{modes.quiet_share(reading):.0%} are below 1 % of the shape's largest (untrained: {untrained:.0%})"
    seen = f"Handles see {reading.inside.mean():.0%} of the columns' squared length"
    hidden = "; the rest are ripples within parts, so turn the dictionary with `modes.local_basis` before you read it"
    return (
        f"Of the elements of B+F(x) {quiet}.\n{seen}{hidden if reading.inside.mean() < 0.5 else ''}.\n"
        f"{dead} of the k = {space.dictionary.k} columns move nothing.\n"
    )


def _families(space: DeformSyncNet, held_out: Shapes, second: Shapes) -> str:
    """The families that a mixed network fits worst, by what is left to fit when both shapes are of the family."""
    shares = {}
    for family in held_out.family_names if len(held_out.family_names) > 1 else ():
        own, again = held_out.of_family(family), second.of_family(family)
        if len(own) > 3:
            shares[family] = evaluate(space, own, again=again, pairs=100).fitting_share
    worst = sorted(shares, key=shares.get, reverse=True)[:WORST]
    named = ", ".join(f"{family} {shares[family]:.2f}" for family in worst)
    return f"Most is left to fit within {named}.\n" if worst else ""
