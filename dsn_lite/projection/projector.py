"""Snapping an edit of a few handles to the plausible shapes: fast enough for every frame of a drag."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
import torch
from jaxtyping import Bool, Float
from torch import Tensor

from ..dictionary import offsets, rms
from ..handles import BoxHandles, Handles
from ..shapes import Shapes
from ..space import ActionSpace
from ..types import Dictionary, Points
from .bounds import Bounds, limits, pins
from .factor import Factor
from .prior import Prior
from .snapped import Snapped

KEPT = 256  # selections whose answers are kept


class EditProjector:
    """For a dictionary A (n, 3, k) and handles of one shape: `edit({"leg_2.scale.y": 0.3})` snaps it (Eqs. 4-7).

    z_hat minimises |B (z - z0) - A v| over all z with the pinned values and some v; where that leaves a choice, first
    z_hat - z0 is the shortest, then v. Prepared once, in double precision; then an edit of the same handles is a
    product with a small matrix, as long as no bound is met.

    x (n, 3) is the shape; B z0, where handles tell it, unless given. A prior says which vectors are
    plausible, and how far A is to be trusted. Raises ValueError where sizes do not agree, numbers are not finite, or
    nothing tells x.
    """

    def __init__(
        self,
        A: Dictionary,
        handles: Handles,
        x: Points | None = None,
        prior: Prior | None = None,
    ):
        _check(A, handles, x)
        _check_prior(prior, A.shape[-1])
        self.A, self.handles, self.basis = A, handles, None if prior is None else _numpy(prior.basis)
        self.x = handles.offsets(handles.z0) if x is None else x
        held, B = handles.held, handles.B
        fields = _numpy(A[held.to(A.device)])
        eps = max(torch.finfo(given.dtype).eps for given in (A, B))
        fields, noise = (fields, 0.0) if prior is None else (fields @ self.basis, prior.noise)
        self.factor = Factor.of(fields, _numpy(B[held]), eps, noise * len(fields) ** 0.5)
        self._V = self.factor.A_plus_B if prior is None else self.basis @ self.factor.A_plus_B
        self._gain = lru_cache(KEPT)(self._solved)

    @classmethod
    def of(cls, space: ActionSpace, shapes: Shapes, i: int = 0, prior: Prior | None = None) -> "EditProjector":
        """For shape i of a collection with parts, by its box handles and the dictionary that a space has there.

        Raises ValueError where the space has no dictionary, or the collection tells no parts.
        """
        if not hasattr(space, "dictionary"):
            raise ValueError(
                f"EditProjector: the space must have a dictionary of offsets, {type(space).__name__} has none; "
                "take a DeformSyncNet or a LinearSpace"
            )
        with torch.no_grad():
            A = space.dictionary(shapes[i].like(space).points)[0]
        return cls(A, BoxHandles.of(shapes, i), shapes.points[i], prior)

    def __call__(self, edits: Mapping[str, float], *, change: bool = False, bounds: Bounds | None = None) -> Snapped:
        """Pins handles by name or pattern ("leg_*.scale.y") at values, or at changes of them, and finds the rest.

        bounds: lowest and highest values by name or pattern, None where open, beside those of the handles (edge lengths
        > 0). Raises ValueError where there is no such handle, a number is not finite, or nothing keeps the bounds, with
        all handles in conflict.
        """
        pinned, z = pins(self.handles, edits, change)
        lower, upper = limits(self.handles, bounds, pinned, z)
        dz, v = self.drag(pinned, z)
        meets = ~pinned & ((dz < lower) | (dz > upper))
        if meets.any():
            dz = self.factor.bounded(pinned, z, lower, upper)
            v, meets = self._V @ dz, ~pinned & ((dz <= lower) | (dz >= upper))
        return self._snapped(pinned, dz, v, meets)

    def drag(
        self, pinned: Bool[np.ndarray, " m"], z: Float[np.ndarray, " s"]
    ) -> tuple[Float[np.ndarray, " m"], Float[np.ndarray, " k"]]:
        """Changes of all handles, and v, for changes z of the pinned ones, without bounds: one small product."""
        found = self._gain(pinned.tobytes()) @ z
        return found[: len(pinned)], found[len(pinned) :]

    def to_json(self) -> str:
        """What a browser needs to solve any edit: names, z0, lower and upper of handles (null where open), the basis
        (k, r) or null, and the factor. `Factor.from_json` reads it too.
        """
        handles = self.handles
        return self.factor.to_json(
            names=handles.names,
            z0=_numpy(handles.z0).tolist(),
            lower=_ends(handles.lower),
            upper=_ends(handles.upper),
            basis=None if self.basis is None else self.basis.tolist(),
        )

    def _solved(self, pinned: bytes) -> Float[np.ndarray, "mk s"]:
        gain = self.factor.gain(np.frombuffer(pinned, dtype=bool))
        return np.concatenate([gain, self._V @ gain])

    def _snapped(self, pinned: np.ndarray, dz: np.ndarray, v: np.ndarray, meets: np.ndarray) -> Snapped:
        handles, x, change = self.handles, self.x, torch.from_numpy(dz).to(self.handles.z0)
        points = x + offsets(self.A, torch.from_numpy(v).to(self.A)).to(x)
        edited, moved = (x + handles.offsets(z).to(x) for z in (change * torch.from_numpy(pinned).to(change), change))
        z0 = handles.z0.detach().double().cpu()
        return Snapped(
            names=handles.names,
            pinned=_named(handles, pinned),
            at_bounds=_named(handles, meets),
            z0=z0,
            z_hat=z0 + torch.from_numpy(dz),
            v=torch.from_numpy(v),
            points=points,
            edited=edited,
            by_handles=moved,
            distance=rms(points - edited),
            residual=rms((points - moved)[handles.held.to(x.device)]),
        )


def _check(A: Tensor, handles: Handles, x: Tensor | None) -> None:
    n = len(handles.held)
    if A.ndim != 3 or A.shape[:2] != (n, 3) or not A.isfinite().all():
        raise ValueError(
            f"EditProjector: A must be (n, 3, k), finite, with the n = {n} points of the handles, "
            f"got {tuple(A.shape)}; take the dictionary and the handles of one shape"
        )
    if x is None and not (handles.held.all() and handles.z0.any()):
        raise ValueError("EditProjector: x must be given where handles alone do not place all points, got none; pass x")
    if x is not None and (x.shape != (n, 3) or not x.isfinite().all()):
        raise ValueError(f"EditProjector: x must be the {n} points (n, 3) of the handles, finite, got {tuple(x.shape)}")


def _check_prior(prior: Prior | None, k: int) -> None:
    if prior is None:
        return
    basis, noise = prior
    if basis.ndim != 2 or len(basis) != k or not basis.isfinite().all():
        raise ValueError(
            f"EditProjector: the prior's basis must be (k, r), finite, with the k = {k} numbers of a vector as rows, "
            f"got {tuple(basis.shape)}; transpose it"
        )
    if not 0 <= noise < float("inf"):
        raise ValueError(
            f"EditProjector: the prior's noise must be a length, 0 or more, got {noise}; modes.disagreement measures it"
        )


def _named(handles: Handles, which: Bool[np.ndarray, " m"]) -> tuple[str, ...]:
    return tuple(handles.names[j] for j in np.flatnonzero(which))


def _ends(values: Float[Tensor, " m"]) -> list[float | None]:
    return [end if np.isfinite(end) else None for end in _numpy(values).tolist()]


def _numpy(values: Tensor) -> np.ndarray:
    return values.detach().cpu().double().numpy()
