"""What several experiments measure alike, and how they say it."""

from ..metrics import Evaluation, evaluate
from .kinds import Trained
from .results import Results

MILLI = 1e-3  # the paper gives Chamfer distances in thousandths


def fitting(trained: Trained, pairs: int) -> tuple[dict[str, float], Evaluation]:
    """Fitting CD on the shapes held out, with what the floor, no training and doing nothing score; and all the rest."""
    result = evaluate(trained.space, trained.shapes, again=trained.again, pairs=pairs)
    untrained = evaluate(trained.space.untrained(trained.config.seed), trained.shapes, pairs=pairs)
    figures = {"fitting_cd": result.fitting_cd, "floor": result.floor, "do_nothing_cd": result.do_nothing_cd}
    return figures | {"untrained_cd": untrained.fitting_cd}, result


def baselines(results: Results, arm: str) -> dict[str, str]:
    """The rows that every table of fitting CDs has: what an arm's shapes score without training and at best."""
    rows = {"untrained": "untrained_cd", "doing nothing": "do_nothing_cd", "sampling floor": "floor"}
    return {name: results.cell(arm, figure, MILLI) for name, figure in rows.items()}
