"""Any linear handles that a person brings: a lattice, the weights of a cage, sliders of a rig."""

from collections.abc import Sequence

import torch
from jaxtyping import Float
from torch import Tensor

from .kinds import Handles


class DenseHandles(Handles):
    """Handles of a matrix B (n, 3, m): the change z of their values moves point i by B[i] z.

    z0 (m,) are the values as the shape stands, 0 unless told; lower and upper (m,) bound values, not changes. All n
    points are held. Raises ValueError where sizes do not agree, B is not finite or names repeat.
    """

    def __init__(
        self,
        B: Float[Tensor, "n 3 m"],
        z0: Float[Tensor, " m"] | None = None,
        names: Sequence[str] | None = None,
        *,
        lower: Float[Tensor, " m"] | None = None,
        upper: Float[Tensor, " m"] | None = None,
    ):
        if B.ndim != 3 or B.shape[1] != 3 or not B.isfinite().all():
            raise ValueError(f"DenseHandles: B must be (n, 3, m) of finite numbers, got {tuple(B.shape)}; look at it")
        m = B.shape[-1]
        self._B, self.names = B, tuple(names or (f"handle_{j}" for j in range(m)))
        self.z0 = B.new_zeros(m) if z0 is None else z0.to(B)
        self.lower = torch.full_like(self.z0, -torch.inf) if lower is None else lower.to(B)
        self.upper = torch.full_like(self.z0, torch.inf) if upper is None else upper.to(B)
        self.held = torch.ones(len(B), dtype=torch.bool, device=B.device)
        sizes = {len(self.names), *map(len, (self.z0, self.lower, self.upper))}
        if sizes != {m} or len(set(self.names)) < m:
            raise ValueError(
                f"DenseHandles: names, z0, lower and upper must be one for each of the m = {m} handles, names all "
                f"different, got {', '.join(map(str, sorted(sizes)))} and {len(set(self.names))} names; count again"
            )
        self._inverse = torch.linalg.pinv(B.flatten(0, 1))

    @property
    def B(self) -> Float[Tensor, "n 3 m"]:
        return self._B

    def offsets(self, z: Float[Tensor, " m"]) -> Float[Tensor, "n 3"]:
        return self._B @ z.to(self._B)

    def coordinates(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "m *j"]:
        return torch.tensordot(self._inverse, u.flatten(0, 1).to(self._B), dims=1)

    def project(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "n 3 *j"]:
        return torch.tensordot(self._B, self.coordinates(u), dims=1)
