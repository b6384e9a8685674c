"""How sparse B+F(x) is: the paper's Figure on the sparsity loss (Section 4.1), a shape at a time, over real handles.

The paper does not say what its threshold of zero is relative to. Here it is the shape's own largest element or column.
"""

from collections.abc import Sequence

from torch import Tensor

from .reading import Reading


def quiet_share(reading: Reading, below: float = 0.01) -> float:
    """Share of the elements of B+F(x) below `below` times the shape's largest, mean over shapes, padding left out."""
    size = reading.handles.abs()
    quiet = (size < below * size.amax((1, 2), keepdim=True)) & reading.real.unsqueeze(-1)
    return (quiet.sum((1, 2)) / (reading.real.sum(1) * size.shape[-1])).mean().item()


def nonzero_elements(reading: Reading, thresholds: Sequence[float]) -> dict[float, float]:
    """Share of the elements at least a threshold times the shape's largest, by threshold: the paper's panel (b)."""
    return {threshold: 1 - quiet_share(reading, threshold) for threshold in thresholds}


def nonzero_columns(reading: Reading, thresholds: Sequence[float]) -> dict[float, float]:
    """Number of columns at least a threshold times as long as the shape's longest, mean over shapes: panel (c)."""
    length: Tensor = reading.handles.norm(dim=1)
    share = length / length.amax(1, keepdim=True)
    return {threshold: (share >= threshold).sum(1).double().mean().item() for threshold in thresholds}
