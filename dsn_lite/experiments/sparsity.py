"""What the sparsity loss costs and what it buys: the counterpart of the paper's figure on it (Section 4.1)."""

from dataclasses import replace
from statistics import fmean
from typing import Any

from .. import modes
from .kinds import Experiment, Run, Scale, Trained
from .measures import MILLI, baselines, fitting
from .results import Results
from .scales import config, data, pairs
from .sparsity_charts import THRESHOLDS, WEIGHTS, WITHOUT, charts, label
from .tables import listed, mean_and_spread, table

QUIET, ENOUGH, DEARER = 0.01, 0.6, 1.3  # elements below this share of the largest, how many of them, and at what cost
READ = 200  # shapes that the rotation is found on


def runs(scale: Scale) -> list[Run]:
    """Each norm and weight on mixed chairs."""
    told = [(norm, w, seed) for norm, weights in WEIGHTS.items() for w in weights for seed in range(scale.seeds)]
    return [
        Run(
            f"{norm}-{w:g}",
            data(scale, "chair"),
            config(scale, seed, k=64, sparsity=w, norm=norm),
            measure,
            {"pairs": pairs(scale)},
        )
        for norm, w, seed in told
    ]


def measure(trained: Trained, pairs: int) -> dict[str, Any]:
    """Fitting, and how sparse B+F is; without the loss also after the varimax rotation, and before any training."""
    reading = modes.read(trained.space, trained.shapes)
    found = fitting(trained, pairs)[0] | _read("", reading)
    if trained.config.sparsity:
        return found
    turned = modes.change_of_basis(trained.space, modes.varimax(modes.read(trained.space, trained.seen[:READ])))
    found |= _read("varimax_", _unit(modes.read(turned, trained.shapes)))
    return found | _read("untrained_", modes.read(trained.space.untrained(trained.config.seed), trained.shapes))


def _unit(reading: modes.Reading) -> modes.Reading:
    """The same with columns of unit rms, as a network's are: a strong column would make all others look small."""
    return replace(reading, handles=reading.handles / reading.rms.clamp_min(1e-12).unsqueeze(1))


def _read(prefix: str, reading: modes.Reading) -> dict[str, Any]:
    quiet, left = modes.quiet_share(reading, QUIET), modes.nonzero_columns(reading, [QUIET])[QUIET]
    elements = [100 * share for share in modes.nonzero_elements(reading, THRESHOLDS).values()]
    columns = list(modes.nonzero_columns(reading, THRESHOLDS).values())
    found = {"quiet": 100 * quiet, "columns_left": left, "elements": elements, "columns": columns}
    return {prefix + name: value for name, value in found.items()}


def section(results: Results) -> str:
    """The table and the account of it."""
    head = ["loss", "fitting CD, 10⁻³", "over w = 0", "elements below 1 %", "columns above 1 %"]
    rows = [[label(arm), *_cost(results, arm), *_gain(results, arm)] for arm in results.arms]
    if WITHOUT in results.arms:
        idle = baselines(results, WITHOUT)
        rows.append(["w = 0, rotated by varimax", *_cost(results, WITHOUT), *_gain(results, WITHOUT, "varimax_")])
        rows.append(["untrained", idle.pop("untrained"), "", *_gain(results, WITHOUT, "untrained_")])
        rows += [[name, cd, "", "", ""] for name, cd in idle.items()]
    return "\n\n".join([table(head, rows), READING, *_account(results)])


READING = (
    "Elements of B⁺F are counted shape by shape over the handles that the shape has, as shares of that shape's "
    "largest, and columns as shares of its longest. The paper does not say what its threshold of zero is relative to."
)


def _cost(results: Results, arm: str) -> list[str]:
    return [results.cell(arm, "fitting_cd", MILLI), mean_and_spread(results.ratio(arm, WITHOUT, "fitting_cd"))]


def _gain(results: Results, arm: str, prefix: str = "") -> list[str]:
    return [f"{results.cell(arm, f'{prefix}quiet')} %", results.cell(arm, f"{prefix}columns_left")]


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
        f"{_aim(results, arms, quiet)} Varimax, which turns the columns after training and changes no deformation, "
        f"makes {turned:.0f} % small, {than} than w = 0 as it was trained."
    ]


def _aim(results: Results, arms: list[str], quiet: dict[str, float]) -> str:
    """Which weights make enough elements small at little cost, or how far the others come."""
    aim = f"The aim is {ENOUGH:.0%} below {QUIET:.0%} of the largest for {DEARER:g} times the fitting CD of w = 0: "
    cheap = [arm for arm in arms if fmean(results.ratio(arm, WITHOUT, "fitting_cd")) <= DEARER]
    if there := [arm for arm in cheap if quiet[arm] >= 100 * ENOUGH]:
        return f"{aim}it is reached at {listed([label(arm) for arm in there])}."
    if not cheap:
        return f"{aim}every weight costs more. {CHART}"
    most = max(cheap, key=quiet.get)
    return f"{aim}no weight reaches it. At that cost {label(most)} comes nearest. {CHART}"


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
