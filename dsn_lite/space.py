"""Affine action spaces: shapes x, vectors v, and an action x (+) v (Section 3.1 of the paper).

A space says how a vector acts on a shape and which vector leads from one shape to another; everything else follows.
"""

from abc import ABC, abstractmethod
from copy import deepcopy
from itertools import chain

import torch
from jaxtyping import Float
from torch import Tensor, nn

from .data import Frame
from .dictionary import matrix, offsets
from .networks import reset
from .types import Dictionary, OtherPoints, Points, Vector, check_clouds

ALWAYS = frozenset({"self_vector_is_zero", "reversal_negates", "triangle_closes"})  # of any E(y) - E(x)


class ActionSpace(nn.Module, ABC):
    """A set of shapes on which vectors act.

    `by_construction` names the laws of axioms.py that hold whatever was learned; `remarks` are printed with a report.
    """

    by_construction: frozenset[str] = ALWAYS
    remarks: tuple[str, ...] = ()

    @abstractmethod
    def act(self, x: Points, v: Vector) -> Points:
        """x (+) v: the shape x deformed by v."""

    @abstractmethod
    def vector(self, x: Points, y: OtherPoints) -> Vector:
        """xy: the vector that should lead from x to y."""

    def untrained(self, seed: int = 0) -> "ActionSpace":
        """The same space with random weights: what a law scores before anything was learned."""
        return reset(deepcopy(self), seed)

    def deform(self, x: Points, y: OtherPoints) -> Points:
        """d(x -> y) = x (+) xy (Eq. 3). Raises TypeError or ValueError where x or y is not a finite cloud."""
        check_clouds("deform", self._weight(), x=x, y=y)
        return self.act(x, self.vector(x, y))

    def transfer(self, x: Points, y: OtherPoints, z: Float[Tensor, "*#b q 3"]) -> Float[Tensor, "*#b q 3"]:
        """z (+) xy: do to z what turned x into y. Raises TypeError or ValueError where one is not a finite cloud."""
        check_clouds("transfer", self._weight(), x=x, y=y, z=z)
        return self.act(z, self.vector(x, y))

    def _weight(self) -> Tensor | None:
        return next(chain(self.parameters(), self.buffers()), None)


class DoNothing(ActionSpace):
    """The laziest space: no vector moves anything. It keeps five of the seven laws: a law kept is not yet a result."""

    by_construction = ALWAYS | {"zero_acts_trivially", "actions_add"}

    def act(self, x: Points, v: Vector) -> Points:
        return x

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        return x.new_zeros(*x.shape[:-2], 1)


class LinearSpace(ActionSpace):
    """x (+) v = A v + x with one A for all shapes (Eq. 1): needs points in correspondence."""

    by_construction = ALWAYS | {"zero_acts_trivially", "actions_add"}
    A: Dictionary

    def __init__(self, A: Dictionary):
        super().__init__()
        self.register_buffer("A", A)
        self.register_buffer("A_plus", torch.linalg.pinv(matrix(A)))

    @classmethod
    def fit(cls, points: Points, k: int) -> "LinearSpace":
        """The first k principal axes of corresponding shapes (N, n, 3), as columns of unit rms.

        Raises ValueError where the shapes are not (N, n, 3) or k is more than they can have.
        """
        if points.ndim != 3 or points.shape[-1] != 3:
            raise ValueError(f"LinearSpace.fit: points must be (N, n, 3), got {tuple(points.shape)}; stack the shapes")
        check_clouds("LinearSpace.fit", points=points)
        N, n, _ = points.shape
        if not 1 <= k <= min(N, 3 * n):
            raise ValueError(
                f"LinearSpace.fit: k must be between 1 and the smaller of N = {N} and 3n = {3 * n}, got {k}; "
                "lower k or bring more shapes"
            )
        axes = torch.linalg.svd((points - points.mean(0)).flatten(1), full_matrices=False).Vh[:k]
        return cls((n**0.5 * axes).mT.unflatten(0, (n, 3)))

    def act(self, x: Points, v: Vector) -> Points:
        self._check_corresponding("act", x=x)
        return x + offsets(self.A, v)

    def vector(self, x: Points, y: Points) -> Vector:
        self._check_corresponding("vector", x=x, y=y)
        return (y - x).flatten(-2) @ self.A_plus.mT

    def dictionary(self, x: Points) -> Dictionary:
        """The same A for every shape."""
        return self.A.expand(*x.shape[:-2], *self.A.shape)

    def _check_corresponding(self, where: str, **clouds: Tensor) -> None:
        check_clouds(where, self.A, **clouds)
        for name, cloud in clouds.items():
            if cloud.shape[-2] != self.A.shape[0]:
                raise ValueError(
                    f"{where}: {name} must have the {self.A.shape[0]} corresponding points of this LinearSpace, "
                    f"got {cloud.shape[-2]}; use shapes sampled as those it was fitted to"
                )

    def untrained(self, seed: int = 0) -> "LinearSpace":
        """A random dictionary of the same size, with columns of the same length."""
        generator = torch.Generator().manual_seed(seed)
        noise = torch.randn(matrix(self.A).shape, generator=generator, dtype=self.A.dtype)
        basis = torch.linalg.qr(noise).Q * self.A.shape[-3] ** 0.5
        return LinearSpace(basis.unflatten(0, self.A.shape[:2]))


class AutoencoderSpace(ActionSpace):
    """x (+) v = D(E(x) + v): vectors act on codes, and the decoder draws a new shape. x (+) 0 is not x."""

    by_construction = ALWAYS | {"parallelogram_closes"}
    remarks = (
        "An autoencoder's parallelogram is trivially closed: z (+) xy = D(E(z) + E(y) - E(x)) does not change when y "
        "and z are swapped. Its identity law fails instead, because D(E(x)) is not x.",
    )

    def __init__(self, encode: nn.Module, decode: nn.Module):
        super().__init__()
        self.encode, self.decode = encode, decode

    def act(self, x: Points, v: Vector) -> Points:
        return self.decode(self.encode(x) + v)

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        return self.encode(y) - self.encode(x)


class DeformSyncNet(ActionSpace):
    """x (+) v = F(x) v + x and xy = E(y) - E(x) (Eqs. 2-3)."""

    by_construction = ALWAYS | {"zero_acts_trivially"}

    def __init__(self, encode: nn.Module, dictionary: nn.Module, frame: Frame | None = None):
        super().__init__()
        self.encode, self.dictionary = encode, dictionary
        self.frame = frame  # of the shapes it was trained on; None while untrained

    def act(self, x: Points, v: Vector) -> Points:
        check_clouds("act", self._weight(), x=x)
        A = self.dictionary(x)
        if v.shape[-1] != A.shape[-1]:
            raise ValueError(
                f"act: v must have the k = {A.shape[-1]} numbers of this space, got {v.shape[-1]}; see vector"
            )
        return x + offsets(A, v)

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        check_clouds("vector", self._weight(), x=x, y=y)
        return self.between(self.read(x), self.read(y))

    def read(self, x: Points) -> Float[Tensor, "*b c"]:
        """What the vectors from and to a shape need of it: its code E(x)."""
        return self.encode(x)

    def between(self, from_x: Float[Tensor, "*#b c"], from_y: Float[Tensor, "*#b c"]) -> Vector:
        """xy of what was read of x and of y."""
        return from_y - from_x


class ConcatSpace(DeformSyncNet):
    """The ablation of Section 4.2: xy is what a network makes of the features of x and y together.

    No law of vectors holds by construction any more: xx need not be 0, nor xy be -yx.
    """

    by_construction = frozenset({"zero_acts_trivially"})

    def read(self, x: Points) -> Float[Tensor, "*b c"]:
        """The feature g(x)."""
        return self.encode.features(x)

    def between(self, from_x: Float[Tensor, "*#b c"], from_y: Float[Tensor, "*#b c"]) -> Vector:
        """xy of [g(x); g(y)]."""
        return self.encode(from_x, from_y)
