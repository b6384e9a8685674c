"""Least squares within bounds, by active sets (Stark and Parker 1995); the shortest answer where there are several."""

import numpy as np
from jaxtyping import Float
from scipy.optimize import lsq_linear

SHORTEST = 1e-8  # weight of |x| beside |P x - c|: of all answers as good as the best, the shortest


def shortest_within(
    P: Float[np.ndarray, "r f"],
    c: Float[np.ndarray, " r"],
    lower: Float[np.ndarray, " f"],
    upper: Float[np.ndarray, " f"],
    noise: float = 0.0,
) -> Float[np.ndarray, " f"]:
    """The shortest x with lower <= x <= upper of those nearest to P x = c, where |P| is about 1, known to `noise`."""
    width = P.shape[1]
    if not width:
        return np.zeros(0)
    # the search ends at a gradient of `tol`, so the numbers must be about 1; it never goes uphill
    unit = max(np.abs(c).max(initial=0), np.abs(np.clip(0, lower, upper)).max()) or 1.0
    # an error e of P seems to gain e |c| |x|, and is followed without end unless |x| costs as much
    weight = max(SHORTEST, noise**0.5)
    matrix, wanted = np.concatenate([P, weight * np.eye(width)]), np.concatenate([c / unit, np.zeros(width)])
    told = {"bounds": (lower / unit, upper / unit), "tol": 1e-13, "max_iter": 20 * width}
    answer = lsq_linear(matrix, wanted, method="bvls", lsq_solver="exact", **told)
    return np.where(answer.active_mask < 0, lower, np.where(answer.active_mask > 0, upper, answer.x * unit))
