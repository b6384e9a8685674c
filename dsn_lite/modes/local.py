"""The basis of a space whose modes are most local: sparse modes without a sparsity loss, by rotation alone.

The columns of F(x) are one basis of many, and the vectors of real deformations fill few of its directions. Principal
directions of the motion tell how many; among bases of those, one rotation for all shapes makes B+F(x) sparsest. No
deformation changes by it. It is the honest rival of the sparsity losses (Eqs. 11, 12), and is factor analysis.
"""

from typing import NamedTuple

import torch
from jaxtyping import Float
from torch import Tensor

from ..shapes import Shapes
from ..space import ActionSpace
from ..types import OtherPoints, Points
from .bases import change_of_basis, check_dictionary
from .reading import AT_ONCE, Reading, read

ITERATIONS = 1000  # at most; a hundred are usual
NEARLY_ALL = 0.9999  # of the squared motion: thin parts are worth counting, rounding is not


class Local(NamedTuple):
    """A basis R for change_of_basis: its first `used` columns make all but 0.01 % of the squared motion."""

    R: Float[Tensor, "k k"]
    used: int
    share: Float[Tensor, " k"]  # of the squared motion, that each principal direction makes, largest first


@torch.no_grad()
def principal(space: ActionSpace, x: Points, y: OtherPoints) -> tuple[Float[Tensor, "k k"], Float[Tensor, " k"]]:
    """Directions W (k, k) of vectors in which x and y differ, and the share of the squared motion that each makes.

    Along W the vectors xy (N pairs) are uncorrelated with variance 1, and the columns A W are perpendicular, on average
    over shapes; the largest motion comes first. In double precision. Columns of W that make no motion are near 0.
    """
    v, A = space.vector(x, y).double(), 0.0
    for i in range(0, len(x), AT_ONCE):
        columns = space.dictionary(x[i : i + AT_ONCE]).double().flatten(0, -2)
        A = A + columns.mT @ columns / (len(x) * x.shape[-2])
    variance, axes = torch.linalg.eigh(v.mT @ v / len(v))
    root = axes * variance.clamp_min(0).sqrt()
    motion, turn = torch.linalg.eigh(root.mT @ A @ root)
    return root @ turn.flip(1), (motion / motion.sum()).flip(0).clamp_min(0)


@torch.no_grad()
def disagreement(space: ActionSpace, x: Points, y: OtherPoints, W: Float[Tensor, "k r"]) -> float:
    """How far a dictionary is from itself: rms over points of (F(x (+) xy) - F(x)) W / sqrt 2, a column of W each.

    Actions add if F is the same all along a deformation; where that is true of the shapes, each of the two is off by
    this much, independently. In the unit of the points, per unit of w. No label and no parameter is read.
    """
    squares = []
    for here, there in zip(x.split(AT_ONCE), y.split(AT_ONCE), strict=True):
        change = (space.dictionary(space.deform(here, there)) - space.dictionary(here)).double() @ W.double()
        squares.append(change.square().sum(-2).mean((1, 2)))
    return (torch.cat(squares).mean() / 2).sqrt().item()


def varimax(reading: Reading) -> Float[Tensor, "k k"]:
    """The rotation R that makes the columns of B+F R most local: one R for all shapes, strongest columns first.

    Kaiser's criterion (1958): the squared elements of each column have the greatest variance, here over the real
    handles of all shapes. Solved with one polar decomposition an iteration (ten Berge 1984). Where columns depend on
    each other it makes some that move little: these are small in every handle without being local, see local_basis.
    """
    rows = reading.handles[reading.real].double()
    R, reached = torch.eye(rows.shape[1]).to(rows), 0.0
    for _ in range(ITERATIONS):
        L = rows @ R
        U, S, Vh = torch.linalg.svd(rows.mT @ (L**3 - L * L.square().mean(0)))
        R, before, reached = U @ Vh, reached, S.sum().item()
        if reached <= before * (1 + 1e-9):
            break
    return R[:, (rows @ R).square().sum(0).argsort(descending=True)].to(reading.handles)


@torch.no_grad()
def local_basis(space: ActionSpace, x: Shapes, y: OtherPoints) -> Local:
    """The basis of a space in which its modes are most local, from pairs x -> y, as many of each.

    Columns A R have unit rms on average over shapes. Raises ValueError where x tells no parts or space no dictionary.
    """
    check_dictionary("local_basis", space)
    x = x.like(space)
    W, share = principal(space, x.points, y.to(x.points))
    used = int((share.cumsum(0) < NEARLY_ALL).sum()) + 1
    # vectors of real deformations have no part along what is perpendicular to these, the rest of the basis
    rest = torch.linalg.svd(W[:, :used]).U[:, used:]
    reading = read(change_of_basis(space, torch.cat([W[:, :used] / W[:, :used].norm(), rest], 1)), x)
    turned = W[:, :used] @ varimax(reading.only(slice(used))).double()
    R = torch.cat([turned / turned.norm(dim=0), rest], 1)
    length = read(change_of_basis(space, R), x).rms.double().square().mean(0).sqrt()
    return Local((R / length).to(x.points), used, share.to(x.points))
