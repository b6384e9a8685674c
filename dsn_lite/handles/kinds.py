"""What every set of handles can do, however B is kept."""

from abc import ABC, abstractmethod

from jaxtyping import Bool, Float
from torch import Tensor


class Handles(ABC):
    """m named linear handles of one shape of n points: a change z of their values moves the points by B z.

    names; z0 (m,) their values as the shape stands; lower and upper (m,) the bounds that values keep unless told
    otherwise; held (n,) the points that handles move: what they do not hold, projections leave as it is.
    """

    names: tuple[str, ...]
    z0: Float[Tensor, " m"]
    lower: Float[Tensor, " m"]
    upper: Float[Tensor, " m"]
    held: Bool[Tensor, " n"]

    @property
    @abstractmethod
    def B(self) -> Float[Tensor, "n 3 m"]:
        """The dense matrix."""

    @abstractmethod
    def offsets(self, z: Float[Tensor, " m"]) -> Float[Tensor, "n 3"]:
        """B z; 0 at points that no handle holds."""

    @abstractmethod
    def coordinates(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "m *j"]:
        """B+u, for points, offsets (n, 3) or a whole dictionary (n, 3, k)."""

    @abstractmethod
    def project(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "n 3 *j"]:
        """BB+u (Eq. 8); points that no handle holds keep theirs."""
