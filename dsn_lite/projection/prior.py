"""What is known of vectors before an edit is told."""

from typing import NamedTuple

from jaxtyping import Float
from torch import Tensor


class Prior(NamedTuple):
    """Which vectors are plausible, and how far a dictionary is to be trusted.

    basis (k, r): only vectors basis @ w are, for instance along the directions that shapes really use
    (structure.used_directions); w is what is shortest then, and shapes should vary by 1 in it. noise: how far the
    dictionary is off for each unit of w, rms over points (modes.disagreement measures it). What it makes of a long w is
    off as far, so that n noise^2 |w|^2 is added to what is minimised, and an edit that it only seems to follow is not
    followed.
    """

    basis: Float[Tensor, "k r"]
    noise: float = 0.0
