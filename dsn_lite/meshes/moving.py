"""A trained space acts on meshes: codes from sampled points, offsets at the vertices, results in the file's unit."""

from collections.abc import Callable, Sequence

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor
from tqdm.auto import tqdm

from ..dictionary import offsets
from ..space import ActionSpace, DeformSyncNet
from .bringing import Shape, brought, frame_of, opened, opened_mesh, split_edges, weights_like
from .carrying import moved
from .similarity import Similarity
from .surface import Mesh

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
    source = opened(source)
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
    frame = frame_of(space, where)
    x, y = (opened(shape) for shape in shapes[:2])
    z = opened_mesh(shapes[2], where)
    ups = _ups(up, where)
    placed = [brought(frame, shape, axis, seed, where) for shape, axis in zip((x, y, z), ups, strict=True)]
    px, py, _ = (weights_like(space, cloud) for _, cloud in placed)
    v = space.vector(px, py)
    return moved(split_edges(z, subdivide, where), field(space, *placed[2], v))


def field(
    space: DeformSyncNet, there: Similarity, cloud: Float[np.ndarray, "n 3"], v: Float[Tensor, " k"]
) -> Callable[[Float[np.ndarray, "q 3"]], Float[np.ndarray, "q 3"]]:
    """The offsets A v of a shape, read from its points (n, 3) in the training box, at any places in its file."""

    @torch.no_grad()
    def change(vertices: Float[np.ndarray, "q 3"]) -> Float[np.ndarray, "q 3"]:
        # each place once: vertices that a seam doubles must stay together to the last bit
        at, index = np.unique(there.apply(vertices).astype(np.float32), axis=0, return_inverse=True)
        x, w = weights_like(space, cloud), weights_like(space, v)
        pieces = tqdm(weights_like(space, at).split(AT_ONCE), desc="vertices", leave=False, delay=2)
        u = torch.cat([offsets(space.dictionary(x, at=piece), w) for piece in pieces])
        return there.undo_offsets(u.double().cpu().numpy()[index.reshape(-1)])

    return change


def _ups(up: str | Sequence[str], where: str) -> tuple[str, str, str]:
    ups = tuple([up] * 3 if isinstance(up, str) else up)
    if len(ups) != 3 or not set(ups) <= {"auto", "y", "z"}:
        raise ValueError(f'{where}: up must be "auto", "y" or "z", once or once a shape, got {up!r}; try "auto"')
    return ups
