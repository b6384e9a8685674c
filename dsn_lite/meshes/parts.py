"""The parts of a mesh, by name: what handles hold."""

import re
from collections import Counter
from dataclasses import dataclass

import numpy as np
import trimesh
from jaxtyping import Int

from . import surface
from .connecting import components, in_order
from .merging import MOST, OVERLAP, SMALL, merged
from .surface import Mesh, placed, triangles

UNNAMED = re.compile(r"(mesh|world|gltf|geometry|object|default|none)?[_\W]*\d*", re.IGNORECASE)  # by programs


@dataclass(frozen=True)
class Parts:
    """P parts of a mesh: their names, and the part of each vertex and of each triangle, or -1 for vertices of none.

    Vertices and triangles are counted through the nodes of the scene, in the order of surface.parts.
    """

    names: tuple[str, ...]
    vertices: Int[np.ndarray, " v"]
    faces: Int[np.ndarray, " f"]

    def __len__(self) -> int:
        return len(self.names)


def split(mesh: Mesh, *, by: str = "auto", most: int = 16) -> Parts:
    """The 2 to `most` parts of a mesh or scene (the paper takes models of 2 to 16).

    by="nodes": each node of the scene is a part. by="components": the connected components of each node, small ones
    merged to their closest neighbour and overlapping ones combined (see merging.merged; Section 4 of the paper, after
    Sung et al. 2017), symmetric ones not grouped. "auto" takes nodes where a scene has two or more that somebody made,
    and not a program from the materials of one mesh (GLB) or of a file (OBJ); else components. Names are those of the
    nodes or materials, else part_1, part_2, ... Raises ValueError where there is a single piece.
    """
    if by not in ("auto", "nodes", "components"):
        raise ValueError(f'split: by must be "auto", "nodes" or "components", got {by!r}; try "auto"')
    if not 2 <= most <= MOST:
        raise ValueError(f"split: most must be between 2 and {MOST} parts, got {most}; the paper has 16")
    corners = triangles(mesh, "split")
    pieces = [(name, geometry) for name, (geometry, _) in surface.parts(mesh).items()]
    node = np.repeat(np.arange(len(pieces)), [len(geometry.faces) for _, geometry in pieces])
    whole = by == "nodes" or (by == "auto" and _are_parts(mesh))
    piece = in_order(node) if whole else _components(mesh)
    if piece.max() == 0:
        raise ValueError(
            "split: a mesh must have 2 parts or more, this is one connected piece; separate its parts in a mesh editor "
            "and export it as .glb, or use deform and transfer, which need no parts"
        )
    limits = {"small": 0.0, "overlap": 1.0} if whole else {"small": SMALL, "overlap": OVERLAP}
    into = merged(corners, piece, most, **limits)
    largest, faces = np.unique(into[piece], return_inverse=True)
    nodes = node[np.unique(piece, return_index=True)[1][largest]]
    return Parts(
        unique_names([_name(*pieces[i]) for i in nodes]), _of_vertices(pieces, faces.reshape(-1)), faces.reshape(-1)
    )


def unique_names(names: list[str]) -> tuple[str, ...]:
    """Names to speak of handles by: letters, digits, _ and -, all different; repeated ones are counted from 1."""
    clean = [re.sub(r"[^\w-]+", "_", "" if UNNAMED.fullmatch(name) else name).strip("_") or "part" for name in names]
    count, taken, found = Counter(clean), set(clean), []
    for name in clean:
        numbered = (f"{name}_{i}" for i in range(1, len(clean) + len(taken) + 1))
        single = count[name] == 1 and name != "part"
        found.append(name if single else next(new for new in numbered if new not in taken))
        taken.add(found[-1])
    return tuple(found)


def _name(node: str, geometry: trimesh.Trimesh) -> str:
    """Of a piece that a program made from a material, the material's: its node has a random number in its name."""
    if not geometry.metadata.get("from_gltf_primitive"):
        return node
    return getattr(getattr(geometry.visual, "material", None), "name", None) or ""


def _are_parts(mesh: Mesh) -> bool:
    """Whether the nodes of a scene are parts that somebody made, two or more."""
    made = [not geometry.metadata.get("from_gltf_primitive") for geometry, _ in surface.parts(mesh).values()]
    return len(made) > 1 and all(made) and mesh.source.file_type != "obj"


def _components(mesh: Mesh) -> Int[np.ndarray, " f"]:
    """The component of every triangle; those of different nodes are different."""
    found, count = [], 0
    for geometry, matrix in surface.parts(mesh).values():
        if len(geometry.faces):
            found.append(count + components(placed(geometry.vertices, matrix), geometry.faces))
            count = found[-1].max() + 1
    return np.concatenate(found)


def _of_vertices(pieces: list, faces: Int[np.ndarray, " f"]) -> Int[np.ndarray, " v"]:
    """The part of each vertex is that of its faces, which are all of one part."""
    ends = np.cumsum([len(geometry.faces) for _, geometry in pieces])[:-1]
    found = [np.full(len(geometry.vertices), -1) for _, geometry in pieces]
    for own, (_, geometry), labels in zip(found, pieces, np.split(faces, ends), strict=True):
        own[geometry.faces] = labels[:, None]
    return np.concatenate(found)
