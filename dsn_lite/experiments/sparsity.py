"""What the sparsity loss costs and what it buys: the counterpart of the paper's figure on it (Section 4.1)."""

from dataclasses import replace
from statistics import fmean
from typing import Any

from jaxtyping import Float
from torch import Tensor

from .. import modes
from .kinds import Experiment, Run, Scale, Trained
from .measures import MILLI, baselines, fitting
from .results import Results
from .scales import config, data, pairs
from .sparsity_charts import THRESHOLDS, WEIGHTS, WITHOUT, charts, label
from .tables import listed, mean_and_spread, table

QUIET, ENOUGH, DEARER = 0.01, 0.6, 1.3  # elements below this share of the largest, how many of them, and at what cost
SEEN = "seen"
READ = 200  # shapes that the rotation is found on


def runs(scale: Scale) -> list[Run]:
    """Each norm and weight on mixed chairs."""
    told = [(norm, w, seed) for norm, weights in WEIGHTS.items() for w in weights for seed in range(scale.seeds)]
    return [
        Run(
            f"{norm}-{w:g}",
            data(scale, "chair"),
            config(scale, seed, k=64, sparsity=w, norm=norm.removesuffix(SEEN), unit=SEEN if SEEN in norm else "whole"),
            measure,
            {"pairs": pairs(scale), "turned_on": READ},
        )
        for norm, w, seed in told
    ]


def measure(trained: Trained, pairs: int, turned_on: int) -> dict[str, Any]:
    """Fitting, and how sparse B+F is; without the loss also after the varimax rotation, and before any training."""
    reading = modes.read(trained.space, trained.shapes)
    found = fitting(trained, pairs)[0] | _read("", reading)
    if trained.config.sparsity:
        return found
    turned = modes.change_of_basis(trained.space, modes.varimax(modes.read(trained.space, trained.seen[:turned_on])))
    reading = modes.read(turned, trained.shapes)
    found |= _read("varimax_", _scaled(reading, reading.rms))
    return found | _read("untrained_", modes.read(trained.space.untrained(trained.config.seed), trained.shapes))


def _scaled(reading: modes.Reading, lengths: Float[Tensor, "N k"]) -> modes.Reading:
    """The same with columns that have these lengths made equally long: a strong one would make all others look small.

    By rms they are as a network's are; by what handles see of them, what hides from handles gains nothing.
    """
    return replace(reading, handles=reading.handles / lengths.clamp_min(1e-12).unsqueeze(1))


def _read(prefix: str, reading: modes.Reading) -> dict[str, Any]:
    quiet, left = modes.quiet_share(reading, QUIET), modes.nonzero_columns(reading, [QUIET])[QUIET]
    elements = [100 * share for share in modes.nonzero_elements(reading, THRESHOLDS).values()]
    columns = list(modes.nonzero_columns(reading, THRESHOLDS).values())
    scaled = modes.quiet_share(_scaled(reading, reading.rms * reading.inside.sqrt()), QUIET)
    found = {"quiet": 100 * quiet, "columns_left": left, "elements": elements, "columns": columns}
    found |= {"scaled": 100 * scaled, "inside": 100 * reading.inside.mean().item()}
    return {prefix + name: value for name, value in found.items()}


def section(results: Results) -> str:
    """The table and the account of it."""
    head = ["loss", "fitting CD, 10⁻³", "over w = 0", "seen by handles", "elements below 1 %", "of scaled columns"]
    head += ["columns above 1 %"]
    rows = [[label(arm), *_cost(results, arm), *_gain(results, arm)] for arm in results.arms]
    if WITHOUT in results.arms:
        idle = baselines(results, WITHOUT)
        rows.append(["w = 0, rotated by varimax", *_cost(results, WITHOUT), *_gain(results, WITHOUT, "varimax_")])
        rows.append(["untrained", idle.pop("untrained"), "", *_gain(results, WITHOUT, "untrained_")])
        rows += [[name, cd, "", "", "", "", ""] for name, cd in idle.items()]
    return "\n\n".join([table(head, rows), READING, *_account(results)])


READING = (
    "Elements of B⁺F are counted shape by shape over the handles that the shape has, as shares of that shape's "
    "largest, and columns as shares of its longest. The paper does not say what its threshold of zero is relative "
    "to.\n\n"
    "**A loophole.** Columns are normalised before they are projected, as the paper has it, so a column could become "
    "small in B⁺F without moving fewer parts: by putting its length where no handle sees it, into ripples within a "
    "part, while E makes up for it. *Seen by handles* is the share of a column's squared length that B⁺ sees. *Of "
    "scaled columns* counts the elements after each column was scaled to the same length as seen: what hides gains "
    "nothing there. *L1 of what is seen* is our own loss, on columns of unit length as seen (`--unit seen`)."
)


def _cost(results: Results, arm: str) -> list[str]:
    return [results.cell(arm, "fitting_cd", MILLI), mean_and_spread(results.ratio(arm, WITHOUT, "fitting_cd"))]


def _gain(results: Results, arm: str, prefix: str = "") -> list[str]:
    shares = [f"{results.cell(arm, prefix + figure)} %" for figure in ("inside", "quiet", "scaled")]
    return [*shares, results.cell(arm, f"{prefix}columns_left")]


def _account(results: Results) -> list[str]:
    """Whether a weight makes modes local while fitting costs hardly more, and what a rotation does for free."""
    arms = [arm for arm in results.arms if results.ratio(arm, WITHOUT, "fitting_cd") and arm != WITHOUT]
    if not arms:
        return []
    quiet = {arm: results.mean(arm, "quiet") for arm in results.arms}
    best, turned = max(arms, key=quiet.get), results.mean(WITHOUT, "varimax_quiet")
    than = "more" if turned > quiet[WITHOUT] else "no more"
    return [
        f"Small are {quiet[WITHOUT]:.0f} % of the elements without the loss and {quiet[best]:.0f} % at {label(best)}. "
        f"{_aim(results, arms)} {_hidden(results, arms)} Varimax, which turns the columns after training and changes "
        f"no deformation, makes {turned:.0f} % small, {than} than w = 0 as it was trained, and of scaled columns "
        f"{results.mean(WITHOUT, 'varimax_scaled'):.0f} %."
    ]


def _aim(results: Results, arms: list[str]) -> str:
    """Which weights make enough elements small at little cost, or how far the others come."""
    aim = f"The aim is {100 * ENOUGH:.0f} % below {100 * QUIET:g} % for {DEARER:g} times the fitting CD of w = 0: "
    cheap = [arm for arm in arms if fmean(results.ratio(arm, WITHOUT, "fitting_cd")) <= DEARER]
    if not cheap:
        return f"{aim}every weight costs more. {CHART}"
    said = [_reached(results, cheap, figure) for figure in ("quiet", "scaled")]
    return f"{aim}{said[0]} Of scaled columns, {said[1]} {CHART}"


def _reached(results: Results, cheap: list[str], figure: str) -> str:
    share = {arm: results.mean(arm, figure) for arm in cheap}
    if there := [arm for arm in cheap if share[arm] >= 100 * ENOUGH]:
        return f"it is reached at {listed([label(arm) for arm in there])}."
    most = max(cheap, key=share.get)
    return f"no weight reaches it. At that cost {label(most)} comes nearest, with {share[most]:.0f} %."


def _hidden(results: Results, arms: list[str]) -> str:
    """How far the loophole is used: what handles see of columns, and what scaling takes away."""
    seen = {arm: results.mean(arm, "inside") for arm in arms}
    lost = {arm: results.mean(arm, "quiet") - results.mean(arm, "scaled") for arm in arms}
    least, most = min(arms, key=seen.get), max(arms, key=lost.get)
    fewer = f"{lost[most]:.1f} points at most ({label(most)})" if lost[most] > 0 else "nothing"
    return (
        f"Of the loophole: handles see {results.mean(WITHOUT, 'inside'):.0f} % of the columns without the loss, and "
        f"least, {seen[least]:.0f} %, at {label(least)}; scaling takes {fewer} from what is small with it."
    )


CHART = "The last chart shows what is paid for what."


EXPERIMENT = Experiment(
    "sparsity",
    "The sparsity loss",
    'the figure "Effect of Sparsity Regularization Losses" of Section 4.1',
    "What does the weight w of the sparsity loss cost in fitting, and how few elements and columns does it leave?",
    runs,
    section,
    charts,
)
