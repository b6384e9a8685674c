"""What a mesh or a scene is made of: triangles where the scene puts them, and points spread over their surface."""

import numpy as np
import trimesh
from jaxtyping import Float

Mesh = trimesh.Trimesh | trimesh.Scene


def parts(mesh: Mesh) -> dict[str, tuple[trimesh.Trimesh, Float[np.ndarray, "4 4"]]]:
    """The triangle mesh of each node of a scene, and the matrix that places it."""
    if isinstance(mesh, trimesh.Trimesh):
        return {mesh.metadata.get("name", "mesh"): (mesh, np.eye(4))}
    nodes = {node: mesh.graph[node] for node in mesh.graph.nodes_geometry}
    found = {str(node): (mesh.geometry[name], matrix) for node, (matrix, name) in nodes.items()}
    return {node: pair for node, pair in found.items() if isinstance(pair[0], trimesh.Trimesh)}


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
    corners, rng = triangles(mesh, "sample"), np.random.default_rng(seed)
    reached = np.cumsum(areas(corners))
    chosen = np.searchsorted(reached, rng.random(n) * reached[-1], side="right")
    a, b, c = corners[chosen.clip(max=len(corners) - 1)].swapaxes(0, 1)
    r, s = rng.random((2, n, 1))
    root = np.sqrt(r)  # without the root, points would crowd at a
    return ((1 - root) * a + root * (1 - s) * b + root * s * c).astype(np.float32)


def placed(points: Float[np.ndarray, "n 3"], matrix: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "n 3"]:
    return np.asarray(points, dtype=np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def normals(corners: Float[np.ndarray, "f 3 3"]) -> Float[np.ndarray, "f 3"]:
    """Normals twice as long as the triangle's area."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
