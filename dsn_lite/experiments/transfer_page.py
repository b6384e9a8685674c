"""What RESULTS.md says of transfers, of parts that are not there, and of the way back."""

from .results import Results
from .tables import listed, table

CATEGORIES = ("chair", "table", "sofa", "lamp", "airplane", "car")
KINDS = {  # what of x may change, and the goal
    "same": ("another shape of the same family", "all parameters", 0.2),
    "across": ("a shape of another family", "all parameters that both have", 0.5),
    "single": ("a shape of another family", "one parameter that both have", 0.5),
}
PART = {  # a part that some families lack, and an edit of it, in the unit of the file
    "chair": ("arm", {"translation.y": 0.05}),
    "table": ("shelf", {"translation.y": 0.05}),
    "sofa": ("arm", {"translation.y": 0.05}),
    "lamp": ("shade", {"scale.x": 0.05, "scale.z": 0.05}),
    "airplane": ("engine", {"scale.z": 0.05}),
    "car": ("spoiler", {"translation.y": 0.03}),
}
SILENT = 0.05
POINTS, READ = 512, 2048  # of z; of x and y


def section(results: Results) -> str:
    """The truth, the parts that are not there, the way back; and for each whether its goal is reached."""
    return "\n\n".join([WHAT, *_truth(results), PARTS, *_parts(results), BACK, *_back(results)])


WHAT = (
    "x, y and z are all new to the spaces. The error is the mean squared distance of z ⊕ xy to the true transfer of "
    "the same samples of z, as a share of leaving z alone, and the median over the families that z is of. Truths go by "
    "the parameters that shapes were made from; where z is of another family, x and y differ only in parameters that "
    f"it has too. {READ} points of x and y are read, {POINTS} of z moved."
)
PARTS = (
    "**A part that is not there.** A handle of a part is edited on shapes that have it: *snapped* as EditProjector "
    "does with all else free, *kept* with all other parts held, or *read*: E(x′) − E(x) of the shape x′ that the "
    "handles then make. The vector goes to all shapes; the figure is how far (rms) those without the part move, as a "
    "share of those that have it, plainly and after what is moved was brought to the handles of each shape."
)
BACK = (
    "**There and back.** Round trip: x ⊕ v ⊕ −v against x, squared, as a share of x ⊕ v against x. The paper's two-way "
    "error: d(x → y) − x plus d(y → x) − y for corresponding x and y, squared, as a share of what both move. "
    "An untrained dictionary hardly depends on the shape, so it comes back best: neither says that a deformation is "
    "right."
)


def _arms(results: Results, kind: str) -> dict[str, str]:
    """The arms of a kind that are done, by category."""
    return {name: arm for name in CATEGORIES if (arm := f"{name}-{kind}") in results.arms}


def _truth(results: Results) -> list[str]:
    head, rows, said = ["z is, xy changes", "", *CATEGORIES, "goal"], [], []
    for kind, (z, changing, goal) in KINDS.items():
        arms = _arms(results, kind)
        for figure, name in {
            "error": "z ⊕ xy",
            "held_error": "to the handles of z",
            "blank_error": "untrained",
        }.items():
            cells = [results.cell(f"{each}-{kind}", figure) for each in CATEGORIES]
            what, aim = (f"{z}, {changing}", f"≤ {goal:g}") if figure == "error" else ("", "")
            rows.append([what, name, *cells, aim])
        rows.append(
            [
                "",
                "families that reach the goal",
                *(_reaching(results, f"{each}-{kind}", goal) for each in CATEGORIES),
                "",
            ]
        )
        said.append(f"{z.capitalize()}, {changing}: {_account(results, arms, 'error', goal)}")
    return [table(head, rows), " ".join(said)]


def _reaching(results: Results, arm: str, goal: float) -> str:
    shares = results.curve(arm, "families")
    return f"{sum(share <= goal for share in shares)} of {len(shares)}" if shares else "–"


def _account(results: Results, arms: dict[str, str], figure: str, goal: float) -> str:
    """Where a goal is reached and where not."""
    if not arms:
        return "not measured yet."
    met = [name for name, arm in arms.items() if results.mean(arm, figure) <= goal]
    missed = [f"{name} ({results.mean(arm, figure):.2f})" for name, arm in arms.items() if name not in met]
    said = [f"{goal:g} is reached for {listed(met)}" if met else f"{goal:g} is reached nowhere"]
    return ", ".join(said + ([f"missed for {listed(missed)}"] if missed else [])) + "."


WAYS = {"snapped": "snapped (Eq. 4)", "kept": "other parts held", "read": "read by E"}


def _parts(results: Results) -> list[str]:
    head = ["", "", *(f"{name}: {PART[name][0]}" for name in CATEGORIES)]
    rows = []
    for how, name in WAYS.items():
        for suffix, said in {"": "plain", "_held": "to their handles"}.items():
            cells = [_pair(results, f"{each}-part", how + suffix) for each in CATEGORIES]
            rows.append(["" if suffix else name, said, *cells])
    if not (arms := _arms(results, "part")):
        return []
    least = {}
    for name, arm in arms.items():
        least[name] = min(results.mean(arm, how + suffix) for how in WAYS for suffix in ("", "_held"))
    silent = [name for name, value in least.items() if value <= SILENT]
    told = listed([f"{value:.2f} ({name})" for name, value in least.items()])
    reached = f"reached for {listed(silent)}" if silent else "reached nowhere"
    return [
        table(head, rows),
        f"Trained, in brackets untrained. The goal is {SILENT:g}: {reached}. At best {told} is left.",
    ]


def _pair(results: Results, arm: str, figure: str) -> str:
    return f"{results.cell(arm, figure)} ({results.cell(arm, f'blank_{figure}')})"


def _back(results: Results) -> list[str]:
    names = {"round_trip": "round trip", "two_way": "the paper's two-way error"}
    rows = [[said, *(_pair(results, f"{each}-same", name) for each in CATEGORIES)] for name, said in names.items()]
    return [table(["trained (untrained)", *CATEGORIES], rows)]
