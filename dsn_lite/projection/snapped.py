"""What a projection found."""

from dataclasses import dataclass

from jaxtyping import Float
from torch import Tensor

from ..types import Points, Vector
from .bounds import chosen


@dataclass(frozen=True, repr=False)
class Snapped:
    """An edit, completed: all handle values, the vector, and the shapes before and after.

    z_hat (m,) are values, not changes, of the handles in `names`, and z0 those before. points = x + A v is the
    plausible shape, by_handles = x + B (z_hat - z0) the one that handles alone can make, edited the broken one, where
    the pinned handles moved and nothing else. distance is how far the snap went, the root mean square length of
    points - edited; residual that of points - by_handles, which Eq. 4 minimises over the n points that handles hold.
    """

    names: tuple[str, ...]
    pinned: tuple[str, ...]
    at_bounds: tuple[str, ...]  # handles that would go farther if they might
    z0: Float[Tensor, " m"]
    z_hat: Float[Tensor, " m"]
    v: Vector
    points: Points
    edited: Points
    by_handles: Points
    distance: float
    residual: float

    def __getitem__(self, name: str) -> float:
        """The value of a handle, the first that a pattern means. Raises ValueError, naming near ones, for none."""
        return self.z_hat[chosen(self.names, name, "snapped")[0]].item()

    def __repr__(self) -> str:
        bounds = f", held at a bound: {', '.join(self.at_bounds)}" if self.at_bounds else ""
        pins = ", ".join(f"{name} = {self[name]:.4g}" for name in self.pinned)
        return f"Snapped({pins}; the snap went {self.distance:.3g}, {self.residual:.2g} is left{bounds})"
