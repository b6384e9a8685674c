"""What a person gives, a mesh, a path or points, brought to where the shapes of training lay."""

from pathlib import Path

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor

from ..data import Frame
from ..space import ActionSpace, DeformSyncNet
from .carrying import subdivided
from .files import Y_UP, load_mesh
from .similarity import Similarity, up_axis
from .surface import Mesh, drawn, triangles

Shape = Mesh | str | Path | np.ndarray | Tensor
FINEST = 0.002  # share of the longest edge; below it a mesh has millions of faces
JUDGED = 2048  # samples from which a mesh's up axis is judged


def frame_of(space: ActionSpace, where: str) -> Frame:
    """Where its training shapes lay. Raises TypeError for a space that is not a trained DeformSyncNet."""
    if not isinstance(space, DeformSyncNet) or space.frame is None:
        got = type(space).__name__ + (" without a frame" if isinstance(space, DeformSyncNet) else "")
        raise TypeError(f"{where}: space must be a trained DeformSyncNet, got {got}; use train, load or load_run")
    return space.frame


def opened_mesh(shape: Shape, where: str) -> Mesh:
    """A mesh, or that of a path. Raises TypeError for points, which have no faces to keep."""
    mesh = opened(shape)
    if not isinstance(mesh, Mesh):
        got = type(mesh).__name__
        raise TypeError(f"{where}: what moves must be a mesh or its path, got {got}; points: space.deform")
    return mesh


def opened(shape: Shape) -> Mesh | np.ndarray:
    """A mesh, that of a path, or points."""
    if isinstance(shape, str | Path):
        return load_mesh(shape)
    if isinstance(shape, Tensor):
        return shape.detach().cpu().numpy()
    return shape


def weights_like(space: DeformSyncNet, values: np.ndarray | Tensor) -> Tensor:
    """Values in the precision and on the device of a space's weights."""
    return torch.as_tensor(values).to(next(space.parameters()))


def brought(frame: Frame, shape: Mesh | np.ndarray, up: str, seed: int, where: str) -> tuple[Similarity, np.ndarray]:
    """The similarity that brings a shape into the training box, and the points (n, 3) there that stand for it."""
    if isinstance(shape, Mesh):
        corners = triangles(shape, where)
        whole, points = corners.reshape(-1, 3), drawn(corners, frame.n, seed)[0]
        up = "y" if up == "auto" and shape.source.file_type in Y_UP else up
        judged = drawn(corners, JUDGED, seed)[0] if up == "auto" else points
    else:
        whole = judged = _cloud(shape, frame.n, where)
        points = whole[np.random.default_rng(seed).permutation(len(whole))[: frame.n]]
    similarity = Similarity.into(frame, whole, up_axis(judged) if up == "auto" else up)
    return similarity, similarity.apply(points)


def _cloud(points: np.ndarray, n: int, where: str) -> Float[np.ndarray, "p 3"]:
    points = np.asarray(points)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{where}: points must be one cloud (p, 3), got {points.shape}; pass one shape at a time")
    if len(points) < n:
        raise ValueError(f"{where}: the {n} points of training are needed, got {len(points)}; sample more densely")
    if not np.isfinite(points).all():
        raise ValueError(f"{where}: points must be finite, got NaN or infinity; clean the cloud")
    return points


def split_edges(mesh: Mesh, share: float | None, where: str) -> Mesh:
    """A copy without edges longer than this share of its longest extent, or the mesh itself where none is told."""
    return mesh if share is None else subdivided(mesh, _max_edge(mesh, share, where))


def _max_edge(mesh: Mesh, share: float, where: str) -> float:
    if not FINEST <= share <= 1:
        raise ValueError(
            f"{where}: subdivide must be between {FINEST} and 1, a share of the longest extent, got {share:g}; try 0.05"
        )
    corners = triangles(mesh, where).reshape(-1, 3)
    return float(share * np.ptp(corners, axis=0).max())
