"""A trained space acts on meshes: codes from sampled points, offsets at the vertices, results in the file's unit."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor

from ..data import Frame
from ..dictionary import offsets
from ..space import ActionSpace, DeformSyncNet
from .carrying import moved, subdivided
from .files import Y_UP, load_mesh
from .similarity import Similarity, up_axis
from .surface import Mesh, sample, triangles

Shape = Mesh | str | Path | np.ndarray | Tensor
FINEST = 0.002  # share of the longest edge; below it a mesh has millions of faces
JUDGED = 2048  # samples from which a mesh's up axis is judged
AT_ONCE = 65536  # vertices at which the dictionary is evaluated in one go, which bounds its memory


def deform(
    space: ActionSpace,
    source: Shape,
    target: Shape,
    *,
    up: str | Sequence[str] = "auto",
    subdivide: float | None = None,
    seed: int = 0,
) -> Mesh:
    """d(x -> y) for the mesh x = source and y = target: x (+) xy at the vertices of x (Eqs. 2-3).

    Arguments and errors are those of `transfer`; `up` is one word, or one for the source and one for the target.
    """
    source = _opened(source)
    up = up if isinstance(up, str) else [*up, *up[:1]]
    return _transfer(space, (source, target, source), up, subdivide, seed, "deform")


def transfer(
    space: ActionSpace,
    x: Shape,
    y: Shape,
    z: Shape,
    *,
    up: str | Sequence[str] = "auto",
    subdivide: float | None = None,
    seed: int = 0,
) -> Mesh:
    """z (+) xy: the mesh z with the same faces, names, colours, materials and UVs, its vertices moved.

    Shapes are meshes, scenes, paths of mesh files, or points (p, 3), of which as many are drawn as the space was
    trained with. Each is brought into the training box by a similarity of its own, and the result comes back through
    z's. `up` is "y", "z" or "auto", for all shapes or one for each: glTF is y up by its specification, other files and
    points are judged by form. `subdivide` first splits edges of z longer than this share of its longest extent, since
    eight vertices cannot bend a face; 0.05 is a good start. Nodes of a scene that share one geometry get one each,
    because they deform differently. Skins and animations are not kept.

    Raises:
        TypeError: the space is no trained DeformSyncNet, or z is no mesh.
        ValueError: a mesh without faces or area, values that are not finite, too few points, `up` or `subdivide` not
            among those above.
    """
    return _transfer(space, (x, y, z), up, subdivide, seed, "transfer")


@torch.no_grad()
def _transfer(space, shapes, up, subdivide, seed, where):
    frame = _frame(space, where)
    x, y, z = (_opened(shape) for shape in shapes)
    if not isinstance(z, Mesh):
        raise TypeError(f"{where}: what moves must be a mesh or its path, got {type(z).__name__}; points: space.deform")
    ups, weights = _ups(up, where), next(space.parameters())
    like = {"dtype": weights.dtype, "device": weights.device}
    placed = [_into(frame, shape, axis, seed, where) for shape, axis in zip((x, y, z), ups, strict=True)]
    px, py, pz = (torch.as_tensor(cloud, **like) for _, cloud in placed)
    there, v = placed[2][0], space.vector(px, py)
    if subdivide is not None:
        z = subdivided(z, _max_edge(z, subdivide, where))

    def change(vertices: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
        # each place once: vertices that a seam doubles must stay together to the last bit
        at, index = np.unique(there.apply(vertices).astype(np.float32), axis=0, return_inverse=True)
        pieces = torch.as_tensor(at, **like).split(AT_ONCE)
        u = torch.cat([offsets(space.dictionary(pz, at=piece), v) for piece in pieces])
        return there.undo_offsets(u.double().cpu().numpy()[index.reshape(-1)])

    return moved(z, change)


def _frame(space: ActionSpace, where: str) -> Frame:
    if not isinstance(space, DeformSyncNet) or space.frame is None:
        got = type(space).__name__ + (" without a frame" if isinstance(space, DeformSyncNet) else "")
        raise TypeError(f"{where}: space must be a trained DeformSyncNet, got {got}; use train, load or load_run")
    return space.frame


def _opened(shape: Shape) -> Mesh | np.ndarray:
    if isinstance(shape, str | Path):
        return load_mesh(shape)
    if isinstance(shape, Tensor):
        return shape.detach().cpu().numpy()
    return shape


def _ups(up: str | Sequence[str], where: str) -> tuple[str, str, str]:
    ups = tuple([up] * 3 if isinstance(up, str) else up)
    if len(ups) != 3 or not set(ups) <= {"auto", "y", "z"}:
        raise ValueError(f'{where}: up must be "auto", "y" or "z", once or once a shape, got {up!r}; try "auto"')
    return ups


def _into(frame: Frame, shape: Mesh | np.ndarray, up: str, seed: int, where: str) -> tuple[Similarity, np.ndarray]:
    """The similarity that brings a shape into the training box, and the points (n, 3) there that stand for it."""
    if isinstance(shape, Mesh):
        whole, points = triangles(shape, where).reshape(-1, 3), sample(shape, frame.n, seed)
        up = "y" if up == "auto" and shape.source.file_type in Y_UP else up
        judged = sample(shape, JUDGED, seed) if up == "auto" else points
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


def _max_edge(mesh: Mesh, share: float, where: str) -> float:
    if not FINEST <= share <= 1:
        raise ValueError(
            f"{where}: subdivide must be between {FINEST} and 1, a share of the longest extent, got {share:g}; try 0.05"
        )
    corners = triangles(mesh, where).reshape(-1, 3)
    return float(share * np.ptp(corners, axis=0).max())
