"""What a mesh or a scene is made of: triangles where the scene puts them, and points spread over their surface."""

import numpy as np
import trimesh
from jaxtyping import Float, Int

Mesh = trimesh.Trimesh | trimesh.Scene
GOLDEN = np.array([0.7548776662466927, 0.5698402909980532])  # of the plane: multiples of it fill a square evenly


def parts(mesh: Mesh) -> dict[str, tuple[trimesh.Trimesh, Float[np.ndarray, "4 4"]]]:
    """The triangle mesh of each node of a scene, and the matrix that places it."""
    if isinstance(mesh, trimesh.Trimesh):
        return {mesh.metadata.get("name", "mesh"): (mesh, np.eye(4))}
    nodes = {node: mesh.graph[node] for node in mesh.graph.nodes_geometry}
    found = {str(node): (mesh.geometry[name], matrix) for node, (matrix, name) in nodes.items()}
    return {node: pair for node, pair in found.items() if isinstance(pair[0], trimesh.Trimesh)}


def places(mesh: Mesh) -> Float[np.ndarray, "v 3"]:
    """All vertices where the scene puts them, node after node."""
    return np.concatenate([placed(geometry.vertices, matrix) for geometry, matrix in parts(mesh).values()])


def triangles(mesh: Mesh, where: str) -> Float[np.ndarray, "f 3 3"]:
    """All triangles where the scene puts them. Raises ValueError: no faces, vertices that are not finite, no area."""
    corners = [placed(geometry.vertices, matrix)[geometry.faces] for geometry, matrix in parts(mesh).values()]
    found = np.concatenate([np.zeros((0, 3, 3)), *corners])
    if not len(found):
        raise ValueError(f"{where}: a mesh needs faces, got none; a cloud of points goes in as an array (n, 3)")
    if not np.isfinite(found).all():
        raise ValueError(f"{where}: vertices must be finite, got NaN or infinity; export the mesh again")
    if not areas(found).sum() > 0:
        raise ValueError(f"{where}: a mesh needs an area, all its faces have none; export the mesh again")
    return found


def areas(corners: Float[np.ndarray, "f 3 3"]) -> Float[np.ndarray, " f"]:
    """The area of each triangle."""
    return np.linalg.norm(normals(corners), axis=1) / 2


def sample(mesh: Mesh, n: int, seed: int = 0) -> Float[np.ndarray, "n 3"]:
    """n points (n, 3), float32, spread over the surface by area, where the scene puts it.

    Raises ValueError where the mesh has no faces, no area, or vertices that are not finite, and where n < 1.
    """
    if n < 1:
        raise ValueError(f"sample: n must be at least 1, got {n}; ask for as many points as the space was trained with")
    return drawn(triangles(mesh, "sample"), n, seed)[0]


def drawn(
    corners: Float[np.ndarray, "f 3 3"], n: int, seed: int = 0
) -> tuple[Float[np.ndarray, "n 3"], Int[np.ndarray, " n"]]:
    """n points (n, 3), float32, spread over triangles by area, and which triangle each lies in."""
    rng = np.random.default_rng(seed)
    reached = np.cumsum(areas(corners))
    chosen = np.searchsorted(reached, rng.random(n) * reached[-1], side="right").clip(max=len(corners) - 1)
    return _inside(corners[chosen], *rng.random((2, n, 1))).astype(np.float32), chosen


def spread(
    corners: Float[np.ndarray, "f 3 3"], labels: Int[np.ndarray, " f"], count: int
) -> Float[np.ndarray, "P _ 3"]:
    """`count` points on each piece of a surface, evenly by area, always the same; labels 0, 1, ... tell the pieces."""
    order = np.argsort(labels, kind="stable")
    reached = np.concatenate([[0], np.cumsum(areas(corners)[order])])
    last = np.cumsum(np.bincount(labels))
    first = np.concatenate([[0], last[:-1]])
    shares = (np.arange(count) + 0.5) / count
    wanted = reached[first][:, None] * (1 - shares) + reached[last][:, None] * shares
    chosen = np.searchsorted(reached, wanted, side="right") - 1
    chosen = order[chosen.clip(first[:, None], last[:, None] - 1)]  # a piece without area has its own points too
    r, s = (np.arange(1, count + 1)[:, None] * GOLDEN % 1).T
    return _inside(corners[chosen], r[:, None], s[:, None])


def _inside(
    corners: Float[np.ndarray, "*b 3 3"], r: Float[np.ndarray, "..."], s: Float[np.ndarray, "..."]
) -> np.ndarray:
    a, b, c = np.moveaxis(corners, -2, 0)
    root = np.sqrt(r)  # without the root, points would crowd at a
    return (1 - root) * a + root * (1 - s) * b + root * s * c


def placed(points: Float[np.ndarray, "n 3"], matrix: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "n 3"]:
    return np.asarray(points, dtype=np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def normals(corners: Float[np.ndarray, "f 3 3"]) -> Float[np.ndarray, "f 3"]:
    """Normals twice as long as the triangle's area."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
