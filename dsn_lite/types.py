"""Shapes of the arrays, one letter per axis: n points, k dictionary columns, m handles, `*b` any batch axes.

Shape types are documentation at run time and are checked in the tests (pytest --jaxtyping-packages).
`#` marks axes that may broadcast: one dictionary A may serve many vectors v.
"""

from typing import Any

from jaxtyping import Float, Int
from torch import Tensor

Points = Float[Tensor, "*#b n 3"]
OtherPoints = Float[Tensor, "*#b p 3"]
Vector = Float[Tensor, "*#b k"]
Dictionary = Float[Tensor, "*#b n 3 k"]
Partners = Int[Tensor, "*#b n"]


def check_clouds(where: str, like: Tensor | None = None, **clouds: Any) -> None:
    """What public doors ask of clouds: (..., n, 3), n > 0, finite, in the precision of `like`, a space's weights.

    Raises TypeError or ValueError in one sentence.
    """
    for name, cloud in clouds.items():
        if not isinstance(cloud, Tensor):
            raise TypeError(f"{where}: {name} must be a tensor, got {type(cloud).__name__}; use torch.as_tensor")
        if cloud.ndim < 2 or cloud.shape[-1] != 3 or cloud.shape[-2] == 0:
            raise ValueError(
                f"{where}: {name} must be (..., n, 3) points with n > 0, got {tuple(cloud.shape)}; transpose with .mT"
            )
        if like is not None and cloud.dtype != like.dtype:
            raise ValueError(f"{where}: {name} must be {like.dtype} as the weights, got {cloud.dtype}; use {name}.to")
        if not cloud.isfinite().all():
            raise ValueError(f"{where}: {name} must be finite, got NaN or infinity; clean the points first")
