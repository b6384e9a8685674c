"""Copies of a mesh whose vertices moved or whose edges were split, with everything else carried along."""

from collections.abc import Callable
from colorsys import hsv_to_rgb

import numpy as np
import trimesh
from jaxtyping import Float, Int
from trimesh.visual import ColorVisuals, TextureVisuals

from .surface import Mesh, normals, parts, placed


def separate(mesh: Mesh) -> Mesh:
    """A deep copy where each node of a scene has a geometry of its own: copies in two places deform differently."""
    if isinstance(mesh, trimesh.Trimesh):
        return _told(_copy(mesh), mesh)
    scene, taken = _told(mesh.copy(), mesh), set()
    scene.geometry.update({name: _copy(geometry) for name, geometry in mesh.geometry.items()})
    for node in scene.graph.nodes_geometry:
        name = scene.graph[node][1]
        if name in taken:
            parent = scene.graph.transforms.parents[node]
            own = trimesh.util.unique_name(name, scene.geometry)
            scene.geometry[own] = _copy(mesh.geometry[name])
            scene.graph.update(node, parent, **scene.graph.transforms.edge_data[parent, node] | {"geometry": own})
        taken.add(name)
    return scene


def moved(mesh: Mesh, offsets: Callable[[Float[np.ndarray, "n 3"]], Float[np.ndarray, "n 3"]]) -> Mesh:
    """A copy whose vertices have moved by `offsets` of their places in the scene; all else stays as it is."""
    mesh = separate(mesh)
    pieces = parts(mesh).values()
    places = [placed(geometry.vertices, matrix) for geometry, matrix in pieces]
    ends = np.cumsum([len(place) for place in places])[:-1]
    for (geometry, matrix), offset in zip(pieces, np.split(offsets(np.concatenate(places)), ends), strict=True):
        # offsets, not places, go back through the matrix: what does not move keeps its very bits
        _shift(geometry, offset @ np.linalg.pinv(matrix[:3, :3]).T)
    return mesh


def painted(mesh: Mesh, labels: Int[np.ndarray, " v"]) -> Mesh:
    """A copy with a colour for each label of its vertices, all different, in place of its looks; -1 is grey."""
    mesh, count = separate(mesh), max(int(labels.max()) + 1, 1)
    hues = np.arange(count) * 0.618 % 1  # neighbours in number are far apart in hue
    colours = [[*(255 * np.array(hsv_to_rgb(hue, 0.45 + 0.4 * (i % 2), 0.9))), 255] for i, hue in enumerate(hues)]
    table = np.array([*colours, [128, 128, 128, 255]]).astype(np.uint8)
    pieces = [geometry for geometry, _ in parts(mesh).values()]
    ends = np.cumsum([len(geometry.vertices) for geometry in pieces])[:-1]
    for geometry, own in zip(pieces, np.split(labels, ends), strict=True):
        geometry.visual = ColorVisuals(vertex_colors=table[own])
    return mesh


def subdivided(mesh: Mesh, max_edge: float) -> Mesh:
    """A copy in which no edge is longer than max_edge, in the unit of the scene; UVs, colours and normals go along."""
    mesh = separate(mesh)
    if isinstance(mesh, trimesh.Trimesh):
        return _told(_subdivided(mesh, np.eye(4), max_edge), mesh)
    for node in mesh.graph.nodes_geometry:
        matrix, name = mesh.graph[node]
        if isinstance(mesh.geometry[name], trimesh.Trimesh):
            mesh.geometry[name] = _subdivided(mesh.geometry[name], matrix, max_edge)
    return mesh


def _subdivided(geometry: trimesh.Trimesh, matrix: Float[np.ndarray, "4 4"], max_edge: float) -> trimesh.Trimesh:
    """Columns beside the placed vertices, by which edges are measured, are averaged as the vertices are."""
    carried = _carried(geometry)
    stack = np.hstack([placed(geometry.vertices, matrix), *carried.values()])
    stack, faces, origin = trimesh.remesh.subdivide_to_size(
        stack, geometry.faces, max_edge, max_iter=30, return_index=True
    )
    widths = np.cumsum([3, *(values.shape[1] for values in carried.values())])[:-1]
    carried = dict(zip(carried, np.split(stack, widths, axis=1)[1:], strict=True))
    visual = _visual(geometry, carried, origin)
    attributes = {name[1:]: values for name, values in carried.items() if name[0] == "_"}
    result = trimesh.Trimesh(carried["vertices"], faces, visual=visual, vertex_attributes=attributes, process=False)
    result.face_attributes.update({name: np.asarray(v)[origin] for name, v in geometry.face_attributes.items()})
    result.metadata.update(geometry.metadata)
    if "normals" in carried:
        result.vertex_normals = trimesh.util.unitize(carried["normals"])
    return result


def _carried(geometry: trimesh.Trimesh) -> dict[str, Float[np.ndarray, "n _"]]:
    """What is known at every vertex, as columns; attributes of the file have a name with _ before it."""
    visual, n = geometry.visual, len(geometry.vertices)
    known = {"vertices": geometry.vertices, "normals": _stored_normals(geometry)}
    if isinstance(visual, TextureVisuals):
        known |= {"uv": visual.uv, "color": visual.vertex_attributes.get("color")}
    elif visual.kind == "vertex":
        known["color"] = visual.vertex_colors
    known |= {f"_{name}": values for name, values in geometry.vertex_attributes.items()}
    return {
        name: np.asarray(values, dtype=np.float64).reshape(n, -1)
        for name, values in known.items()
        if values is not None and len(values) == n
    }


def _visual(
    geometry: trimesh.Trimesh, carried: dict[str, Float[np.ndarray, "n _"]], origin: Int[np.ndarray, " f"]
) -> ColorVisuals | TextureVisuals:
    """Colours, or material and UVs, of a mesh with more vertices, whose face i came from face origin[i]."""
    old = geometry.visual
    if not isinstance(old, TextureVisuals):
        faces = old.face_colors[origin] if old.kind == "face" else None
        colors = carried["color"].round().astype(np.uint8) if "color" in carried else None
        return ColorVisuals(face_colors=faces, vertex_colors=colors)
    of_faces = None if old.face_materials is None else np.asarray(old.face_materials)[origin]
    visual = TextureVisuals(carried.get("uv"), old.material.copy(), face_materials=of_faces)
    if "color" in carried:
        dtype = old.vertex_attributes["color"].dtype
        rounded = carried["color"].round() if np.issubdtype(dtype, np.integer) else carried["color"]
        visual.vertex_attributes["color"] = rounded.astype(dtype)
    return visual


def _shift(geometry: trimesh.Trimesh, offsets: Float[np.ndarray, "n 3"]) -> None:
    """Moves vertices; normals of the file are computed anew, smooth over a seam where they were smooth."""
    old, places = _stored_normals(geometry), geometry.vertices
    geometry.vertices = places + offsets
    if old is None:
        return
    _, group = np.unique(np.hstack([places, old.round(4)]), axis=0, return_inverse=True)
    group = group.reshape(-1)
    total = np.zeros((group.max() + 1, 3))
    for corner in geometry.faces.T:
        np.add.at(total, group[corner], normals(geometry.triangles))
    length = np.linalg.norm(total, axis=1, keepdims=True)[group]
    geometry.vertex_normals = np.where(length > 0, total[group] / np.where(length > 0, length, 1), old)


def _stored_normals(geometry: trimesh.Trimesh) -> Float[np.ndarray, "n 3"] | None:
    """The normals that the file had. trimesh keeps them in its cache, and its exporters look there too."""
    return np.array(geometry.vertex_normals) if "vertex_normals" in geometry._cache else None


def _told(copied: Mesh, mesh: Mesh) -> Mesh:
    """A copy that knows the format of its file, by which up and parts are judged; trimesh's copies forget it."""
    copied.source.file_type = mesh.source.file_type
    return copied


def _copy(geometry):
    if not isinstance(geometry, trimesh.Trimesh):
        return geometry.copy()
    copied = geometry.copy(include_cache=True)  # its normals are there
    if isinstance(geometry.visual, TextureVisuals):
        known = dict(geometry.visual.vertex_attributes.items())  # colours beside UVs, which trimesh's copy leaves out
        copied.visual.vertex_attributes.update(known)
    return copied
