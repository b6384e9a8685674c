"""Whether it is joint training that synchronizes the dictionaries: E left random, and vectors read of both shapes."""

from math import nan
from statistics import fmean
from typing import Any

import torch

from .. import modes
from ..training import Training
from .kinds import Experiment, Run, Scale, Trained
from .measures import MILLI, fitting
from .results import Results
from .scales import config, data, pairs
from .tables import listed, table

STEPS = 1000
ARMS = {
    "joint": "E and F trained together",
    "frozen": "E left random, F trained",
    "concat": "Concat: a network reads x and y together",
}
FIGURES = {
    "fitting_cd": ("fitting CD, 10⁻³", MILLI),
    "parallelogram_cd": ("parallelogram CD, 10⁻³", MILLI),
    "share_moved": ("share moved by a transfer", 1),
    "transfer_error": ("transfer error, %", 1e-2),
    "identity": ("d(x → x) − x, rms", 1),
    "consistency": ("consistency of modes", 1),
    "untrained_consistency": ("the same, untrained", 1),
    "shuffled": ("the same, modes shuffled", 1),
}
CATEGORIES = ("Airplane", "Car", "Chair", "Lamp", "Table")
PAPER = {  # in 10⁻³
    ("fitting CD, Table 1", "joint"): (1.95, 4.21, 5.90, 13.28, 8.05),
    ("fitting CD, Table 1", "concat"): (1.65, 3.98, 4.91, 9.87, 6.48),
    ("parallelogram CD, Table 2", "joint"): (2.28, 4.28, 8.07, 22.69, 14.33),
    ("parallelogram CD, Table 2", "concat"): (16.70, 7.98, 69.58, 103.80, 122.50),
}


def runs(scale: Scale) -> list[Run]:
    """Each way to come by vectors, on the family of which every true transfer is known."""
    told = {"joint": {}, "frozen": {"prepare": freeze_codes}, "concat": {}}
    return [
        Run(
            arm,
            data(scale, "table/four_legs"),
            config(scale, seed, lite_steps=STEPS, k=32, vector="concat" if arm == "concat" else "difference"),
            measure,
            {"pairs": pairs(scale)},
            **hooks,
        )
        for arm, hooks in told.items()
        for seed in range(scale.seeds)
    ]


def freeze_codes(training: Training) -> None:
    """Leaves E as it was drawn: its gradients become 0, so that Adam, and a checkpoint of it, see nothing unusual."""
    for weights in training.space.encode.parameters():
        weights.register_hook(torch.zeros_like)


def measure(trained: Trained, pairs: int) -> dict[str, Any]:
    """Fitting, what needs synchronized dictionaries, transfers against the truth, modes against part names."""
    found, result = fitting(trained, pairs)
    names = ("parallelogram_cd", "share_moved", "transfer_error", "identity")
    reading = modes.read(trained.space, trained.shapes)
    found |= {name: getattr(result, name) for name in names}
    blank = modes.read(trained.space.untrained(trained.config.seed), trained.shapes)
    found |= {"consistency": modes.consistency(reading).mean().item(), "shuffled": modes.shuffled(reading)}
    return found | {"untrained_consistency": modes.consistency(blank).mean().item()}


def section(results: Results) -> str:
    """Ours, the paper's, and the account of both."""
    head = ["", *(ARMS[arm] for arm in results.arms)]
    rows = [
        [name, *(results.cell(arm, figure, unit) for arm in results.arms)] for figure, (name, unit) in FIGURES.items()
    ]
    idle = {name: results.cell(results.arms[0], figure, MILLI) for name, figure in IDLE.items()}
    said = f"For comparison, CD in 10⁻³: {', '.join(f'{name} {cd}' for name, cd in idle.items())}."
    printed = [
        [f"paper: {name}", "DSN" if arm == "joint" else "Concat", *(f"{value:g}" for value in values)]
        for (name, arm), values in PAPER.items()
    ]
    return "\n\n".join([table(head, rows), said, table(["", "", *CATEGORIES], printed), *_account(results)])


IDLE = {"sampling floor": "floor", "untrained": "untrained_cd", "doing nothing": "do_nothing_cd"}


def _account(results: Results) -> list[str]:
    """Each ablation beside joint training."""
    if "joint" not in results.arms:
        return []
    said = []
    for arm in [arm for arm in results.arms if arm != "joint"]:
        times = {name: fmean(results.ratio(arm, "joint", figure) or [nan]) for figure, name in COMPARED.items()}
        told = listed([f"{name} {value:.2g}" for name, value in times.items()])
        alike = (
            f"modes agree {results.mean(arm, 'consistency'):.2f} instead of {results.mean('joint', 'consistency'):.2f}"
        )
        said.append(f"{ARMS[arm]}: {told} times that of joint training; {alike}.")
    if "concat" in results.arms:
        said.append(_as_printed(results))
    return [" ".join(said)]


COMPARED = {"fitting_cd": "fitting CD", "parallelogram_cd": "parallelogram CD", "transfer_error": "transfer error"}


def _as_printed(results: Results) -> str:
    """Whether Concat compares as in the paper."""
    said = []
    for (name, arm), values in PAPER.items():
        figure = "fitting_cd" if name.startswith("fitting") else "parallelogram_cd"
        if arm == "concat":
            higher = sum(mine > theirs for mine, theirs in zip(values, PAPER[name, "joint"], strict=True))
            ours = "higher" if results.mean("concat", figure) > results.mean("joint", figure) else "lower"
            said.append(
                f"its {name.split(',')[0]} is {ours} here, in the paper higher in {higher} of {len(values)} categories"
            )
    return f"Concat: {'; '.join(said)}."


EXPERIMENT = Experiment(
    "synchronization",
    "What synchronizes the dictionaries",
    "the Concat rows of Tables 1 and 2, and an ablation that the paper does not have",
    "Is it training E and F together that makes a vector mean the same on every shape?",
    runs,
    section,
)
