"""What the experiment on structure says: the four ratios beside the paper's, and the account of them."""

from .results import Results
from .tables import listed, table

FOUR_LEGS, MIXED = "four_legs", ("chair", "sofa", "airplane")
PAPER = {"x": 9.60e-3, "y": 6.94e-3, "z": 9.60e-3, "gap": 3.17e-2}  # means, Section 4.4
OURS = ("scale", "place", "gap")
METHODS = {
    "": "learned, the directions in use",
    "trusted_": "the same, as far as it agrees with itself",
    "all_": "learned, all columns",
    "exact_": "exact dictionary",
    "pca_": "PCA of handles",
    "none_": "no projection",
}
STATISTICS = {
    "mean": "Means over all trials",
    "median": "Medians",
    "free": "Means over the trials in which the exact dictionary meets no bound",
}
MILLI, ROUNDING = 1e-3, 1e-6


def section(results: Results) -> str:
    """The paper's tables, then the categories, and what both say."""
    parts = [RULE]
    if FOUR_LEGS in results.arms:
        parts += [_found(results), *_tables(results, FOUR_LEGS, tuple(PAPER), PAPER), COUNTS, _account(results)]
    mixed = [arm for arm in MIXED if arm in results.arms]
    if mixed:
        parts += [BEYOND]
        for arm in mixed:
            parts += [
                f"`{arm}`, {results.mean(arm, 'used'):.0f} directions in use:",
                _table(results, arm, OURS, "mean"),
            ]
        parts += [_mixed_account(results, mixed)]
    return "\n\n".join(parts)


RULE = (
    "A random handle of a random hold-out shape is moved (t to t ± 0.5 at most) or stretched (s to 0.5 to 1.5 s), and "
    "the edit is completed with edge lengths > 0. x, y, z: how much edge lengths of two legs differ on an axis, mean "
    "over the pairs of legs; gap: distance between the lower face of the top and the upper face of a leg, mean over "
    "legs. All in thousandths of the table's own width, height, depth and height."
)
COUNTS = (
    "An edit has failed where one of its ratios is more than 5 %. Ratios that an edit does not touch count as 0, so "
    "no projection has medians of 0, and its means are what random edits break: a mean tells little without that row."
)
BEYOND = (
    "Beyond the paper, categories of many families, each with one network that was told neither families nor parts "
    "(its sparsity loss reads parts' handles, without names). scale: how much edge lengths of mirrored pairs differ; "
    "place: how far one centre is from the mirror image of the other; gap: of faces that touch, over all pairs and all "
    "contacts of the family, in thousandths of the extent along that axis; means over all trials. The exact dictionary "
    "and PCA of handles are of the shape's own family, with its parts by name; across families neither can be stated. "
    "Where boxes are not linear in the parameters, exact means the best linear fit."
)


def _found(results: Results) -> str:
    """How many directions the rule found, and the spectrum it cut."""
    used, share = results.values(FOUR_LEGS, "used"), results.curve(FOUR_LEGS, "spectrum")
    counted = listed([f"{each:g}" for each in dict.fromkeys(used)])
    return (
        "Directions in use are those that make all but 0.01 % of the squared motion between training shapes: "
        f"{counted} of {results.told('k')[0]} columns (the family has 6 parameters, of which the rule knows nothing). "
        f"Their shares, and the next: {', '.join(f'{each:.1e}' for each in share)}. Along them F(x) and F(x ⊕ xy) are "
        f"each off by {results.cell(FOUR_LEGS, 'noise', MILLI)} thousandths a unit, as their difference tells without "
        "any truth; *as far as it agrees with itself* means that the projection pays for that (lesson 13)."
    )


def _tables(results: Results, arm: str, ratios: tuple[str, ...], paper: dict[str, float]) -> list[str]:
    found = []
    for statistic, title in STATISTICS.items():
        printed = ["paper", *(f"{value / MILLI:.3g}" for value in paper.values()), "–", "–"]
        found += [f"{title}:", _table(results, arm, ratios, statistic, [printed] if statistic == "mean" else [])]
    return found


def _table(
    results: Results, arm: str, ratios: tuple[str, ...], statistic: str, more: list[list[str]] | None = None
) -> str:
    head = [f"{arm.replace('_', ' ')}, 10⁻³", *ratios, "failed, %", "met a bound, %"]
    rows = [
        [
            title,
            *(_cell(results, arm, f"{method}{ratio}_{statistic}") for ratio in ratios),
            results.cell(arm, f"{method}failed"),
            results.cell(arm, f"{method}bounded"),
        ]
        for method, title in METHODS.items()
    ]
    return table(head, rows + (more or []))


def _cell(results: Results, arm: str, figure: str) -> str:
    """In thousandths; what is 0 but for rounding is written as 0."""
    return "0" if abs(results.mean(arm, figure)) < ROUNDING else results.cell(arm, figure, MILLI)


def _account(results: Results) -> str:
    """How our means stand to the paper's, and to doing nothing."""
    said = []
    for method, who in (("", "What was learned"), ("trusted_", "The same as far as it agrees with itself")):
        told = []
        for statistic, name in (("mean", "means"), ("median", "medians"), ("free", "means without bounds")):
            shares = [f"{results.mean(FOUR_LEGS, f'{method}{r}_{statistic}') / PAPER[r]:.2f} ({r})" for r in PAPER]
            told.append(f"{name} {listed(shares)}")
        said.append(f"{who}, over the paper's means: {'; '.join(told)}.")
    said.append("The goals are 0.5, 0.1 and 0.33.")
    less = [r for r in PAPER if _mean(results, FOUR_LEGS, "", r) < _mean(results, FOUR_LEGS, "none_", r)]
    said.append(
        f"No projection at all is worse than the learned one in {listed(less) or 'none'}"
        + (f", better in {listed([r for r in PAPER if r not in less])}" if len(less) < len(PAPER) else "")
        + ": an edit that breaks no symmetry of one kind leaves it alone if nothing else moves."
    )
    below = [r for r in PAPER if _mean(results, FOUR_LEGS, "none_", r) < PAPER[r]]
    said.append(f"It scores better than the paper's means in {listed(below)}." if below else "")
    return " ".join(filter(None, [*said, PCA]))


PCA = (
    "PCA of handles is as good as the exact dictionary, for this family is linear: whoever has parts by name and "
    "families apart needs no network. The network had neither."
)


def _mean(results: Results, arm: str, method: str, ratio: str) -> float:
    return results.mean(arm, f"{method}{ratio}_mean")


def _mixed_account(results: Results, arms: list[str]) -> str:
    said = []
    for arm in arms:
        shares = [f"{_mean(results, arm, '', r) / _mean(results, arm, 'none_', r):.2f} ({r})" for r in OURS]
        said.append(f"{arm.capitalize()}s: {listed(shares)}")
    return f"What is left of the broken structure, learned over no projection. {'; '.join(said)}."
