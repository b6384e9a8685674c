"""Eq. 4 in small: |B z - A v|^2 over thousands of points is |R [-v; z]|^2 with a triangle R of k + m columns.

A thin QR in double precision, never the Gram matrix, which squares the condition. A may depend on itself (k too large,
columns alike): an SVD of its k x k corner tells which directions it really has, and v is the shortest. What A cannot
make of B is (I - AA+)B, here `P`, at most m rows of m columns, and z is found from it alone (Eqs. 5-7).
"""

import json
from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np
import torch
from jaxtyping import Bool, Float

from .bounded import shortest_within

EPS = np.finfo(np.float64).eps
FLOOR = 1000  # an SVD of a few numbers can be off by dozens of EPS


@dataclass(frozen=True, eq=False)
class Factor:
    """R (r, k + m), r <= k + m, upper triangular, with |R [v; z]| = |A v + B z| for all v and z, over 3n rows.

    Singular values below `noise` times the largest of A, and of B, are rounding: Eq. 7 taken literally divides by them.
    """

    R: Float[np.ndarray, "r km"]
    k: int
    rows: int  # 3n
    noise: float

    @classmethod
    def of(
        cls,
        A: Float[np.ndarray, "n 3 k"],
        B: Float[np.ndarray, "n 3 m"],
        eps: float = EPS,
        weight: float = 0.0,
    ) -> "Factor":
        """The factor of a dictionary and handles over the same n points, whose numbers are exact to eps.

        A weight adds |weight v|^2 to what is minimised: k rows more.
        """
        both = np.concatenate([A, B], axis=-1, dtype=np.float64).reshape(3 * len(A), -1)
        if weight:
            both = np.concatenate([both, weight * np.eye(A.shape[-1], both.shape[1])])
        R = torch.linalg.qr(torch.from_numpy(both), mode="r").R.numpy()  # scipy's would hold all 3n rows of it
        rows = len(both)
        # the arithmetic adds up errors of double precision; those of the numbers themselves are independent
        noise = float(max(rows * EPS, FLOOR * EPS, rows**0.5 * eps))
        return cls(R, A.shape[-1], rows, noise)

    @classmethod
    def from_json(cls, text: str) -> "Factor":
        """The factor in what to_json wrote, of a Factor or an EditProjector."""
        known = json.loads(text)
        return cls(np.array(known["R"]), known["k"], known["rows"], known["noise"])

    def to_json(self, **beside: object) -> str:
        """R, k, rows and noise, and what else is to stand beside them; numbers are read back exactly."""
        return json.dumps(beside | asdict(self) | {"R": self.R.tolist()}, allow_nan=False)

    @cached_property
    def _split(self) -> tuple[Float[np.ndarray, "k m"], Float[np.ndarray, "_ m"]]:
        """A+B, and what A cannot make of B: rows P with |P z| = |(I - AA+)B z|."""
        corner, beside, below = self.R[: self.k, : self.k], self.R[: self.k, self.k :], self.R[self.k :, self.k :]
        U, s, Vt = np.linalg.svd(corner)
        rank = int((s > self.noise * s.max(initial=0)).sum())
        seen = U.T @ beside
        _, left, rows = np.linalg.svd(np.concatenate([seen[rank:], below]), full_matrices=False)
        kept = left > self.noise * self.size
        return Vt[:rank].T @ (seen[:rank] / s[:rank, None]), left[kept, None] * rows[kept]

    @property
    def A_plus_B(self) -> Float[np.ndarray, "k m"]:
        """The shortest v for each handle: v = A+B z."""
        return self._split[0]

    @property
    def P(self) -> Float[np.ndarray, "_ m"]:
        """|P z| is how far B z is from all that A can make."""
        return self._split[1]

    @cached_property
    def size(self) -> float:
        """|B|, its largest singular value."""
        return float(np.linalg.norm(self.R[:, self.k :], 2))

    def gain(self, selected: Bool[np.ndarray, " m"]) -> Float[np.ndarray, "m s"]:
        """The changes z of all handles for a change 1 of each selected one: the shortest (Eqs. 5-7)."""
        U, s, Vt = np.linalg.svd(self.P[:, ~selected], full_matrices=False)
        kept = s > self.noise * self.size
        gain = np.eye(len(selected))[:, selected]
        gain[~selected] = -(Vt[kept].T / s[kept]) @ (U[:, kept].T @ self.P[:, selected])
        return gain

    def bounded(
        self,
        selected: Bool[np.ndarray, " m"],
        z: Float[np.ndarray, " s"],
        lower: Float[np.ndarray, " m"],
        upper: Float[np.ndarray, " m"],
    ) -> Float[np.ndarray, " m"]:
        """All changes for changes z of the selected handles, the others free within bounds of their change."""
        found = np.where(selected, 0, lower)
        found[selected] = z
        free = ~selected & (lower < upper)
        P = self.P / self.size
        found[free] = shortest_within(P[:, free], -P[:, ~free] @ found[~free], lower[free], upper[free], self.noise)
        return found
