"""What may be taken for plausible around a shape: what a network learned, what is true, what handles' statistics say.

The last two move boxes: a change of the boxes' centres and edge lengths (P, 2, 3) a direction, for each family. They
need parts in correspondence, which the network is not told.
"""

from typing import NamedTuple

import torch
from jaxtyping import Float
from torch import Tensor

from ..handles import BoxHandles
from ..modes.local import NEARLY_ALL, disagreement, principal
from ..projection import Prior
from ..shapes import Shapes
from ..space import ActionSpace
from ..types import OtherPoints, Points
from .completing import Plausible
from .ratios import family

Slopes = dict[str, Float[Tensor, "P 2 3 r"]]  # of each family: how boxes move, NaN rows where a part is not there


class Used(NamedTuple):
    """Directions that vectors of real pairs use: basis (k, r), and the share (k,) of the squared motion of each.

    noise is how far the dictionary is from itself along them (modes.disagreement).
    """

    basis: Float[Tensor, "k r"]
    share: Float[Tensor, " k"]
    noise: float

    @property
    def prior(self) -> Prior:
        """For EditProjector."""
        return Prior(self.basis, self.noise)


def used_directions(space: ActionSpace, x: Points, y: OtherPoints) -> Used:
    """The principal directions of the motion of pairs x -> y that together make all but 0.01 % of it.

    No label and no parameter is read. A network with more columns than shapes have freedom learns nothing about the
    rest: there any vector would be taken for plausible.
    """
    W, share = principal(space, x, y)
    r = int((share.cumsum(0) < NEARLY_ALL).sum()) + 1
    return Used(W[:, :r], share, disagreement(space, x, y, W[:, :r]))


def learned(space: ActionSpace, basis: Float[Tensor, "k r"] | None = None) -> Plausible:
    """The dictionary of a space, or what of it the basis spans."""

    def plausible(one: Shapes) -> Tensor:
        with torch.no_grad():
            A = space.dictionary(one.like(space).points)
        return A if basis is None else A @ basis.to(A)

    return plausible


def moved_by_boxes(slopes: Slopes) -> Plausible:
    """A = B dz for the directions dz in which boxes of a family move; where a family has none, A is 0."""

    def plausible(one: Shapes) -> Tensor:
        handles = BoxHandles.of(one)
        known = slopes.get(family(one, 0))
        if known is None:
            return handles.B.double().new_zeros(1, *handles.B.shape[:2], 1)
        return (handles.B.double() @ known.to(handles.B.device)[handles.kept])[None]

    return plausible


def box_slopes(shapes: Shapes) -> Slopes:
    """How boxes follow the parameters, of each family: least squares, exact where boxes are linear in them."""
    return {name: _slopes(own) for name, own in _families(shapes).items()}


def handle_components(shapes: Shapes, r: int) -> Slopes:
    """The r principal components of the boxes' values of each family: PCA of handles; fewer where shapes vary less."""
    return {name: _components(own, r) for name, own in _families(shapes).items() if len(own) > 1}


def _families(shapes: Shapes) -> dict[str, Shapes]:
    return {name: shapes.of_family(name) for name in shapes.family_names}


def _values(shapes: Shapes) -> Float[Tensor, "N v"]:
    """Centres along the boxes' axes and edge lengths, of all parts; 0 for parts that are not there."""
    boxes = shapes.boxes.double().nan_to_num()
    centre = (boxes[..., None, :3] @ boxes[..., 3:12].unflatten(-1, (3, 3)))[..., 0, :]
    return torch.stack([centre, boxes[..., 12:]], dim=2).flatten(1)


def _slopes(shapes: Shapes) -> Float[Tensor, "P 2 3 p"]:
    parameters, values = shapes.parameters.double(), _values(shapes)
    own = parameters[:, parameters.isfinite().all(0)]
    found = torch.linalg.lstsq(own - own.mean(0), values - values.mean(0), driver="gelsd").solution
    return found.mT.unflatten(0, (-1, 2, 3))


def _components(shapes: Shapes, r: int) -> Float[Tensor, "P 2 3 r"]:
    values = _values(shapes)
    _, s, axes = torch.linalg.svd(values - values.mean(0), full_matrices=False)
    kept = int((s[:r] > 1e-6 * s[0]).sum())  # files hold single precision
    return (axes[:kept] * s[:kept, None]).mT.unflatten(0, (-1, 2, 3))
