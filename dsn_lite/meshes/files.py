"""Mesh files: read with clear sentences, written beside and then renamed."""

import warnings
from pathlib import Path

import numpy as np
import trimesh
from trimesh.visual import ColorVisuals, TextureVisuals

from ..files import beside
from .surface import Mesh, parts, triangles

Y_UP = ("glb", "gltf")  # by specification; in other formats up is a habit
READ = (*Y_UP, "obj", "ply", "stl", "off")
WRITTEN = ("glb", "obj", "ply", "stl")


def load_mesh(path: str | Path) -> Mesh:
    """The mesh of a GLB, glTF, OBJ, PLY, STL or OFF file, a Scene where the file is one; vertices are left as they are.

    Of several scenes in a file it is the one that the file shows.

    Raises FileNotFoundError or ValueError in one sentence: missing, of another kind, unreadable, no faces, no area,
    vertices that are not finite.
    """
    path = Path(path)
    where = f"load_mesh: {path}"
    if _ending(path) not in READ:
        raise ValueError(f"{where}: must end in {_listed(READ)}, got {path.suffix or 'no ending'}; export it as .glb")
    if not path.is_file():
        raise FileNotFoundError(f"{where}: there is no such file; check the path")
    try:
        mesh = trimesh.load(path, process=False)
        mesh = mesh if isinstance(mesh, Mesh) else trimesh.Scene()  # points or curves: nothing that has faces
        triangles(mesh, where)
    except Exception as trouble:  # a damaged file raises whatever its reader stumbles over
        if str(trouble).startswith(where):
            raise
        raise ValueError(f"{where}: must be a whole mesh file, got {_short(trouble)}; export it again") from None
    return mesh


def save_mesh(mesh: Mesh, path: str | Path) -> None:
    """Writes GLB, which keeps everything, or a scene's parts in place: OBJ with its .mtl and images, PLY or STL.

    PLY gets the colour of materials and images at each vertex, STL no colour: what is lost is said in a warning.
    Raises ValueError where the ending is none of these.
    """
    path = Path(path)
    kind = _ending(path)
    if kind not in WRITTEN:
        raise ValueError(
            f"save_mesh: {path} must end in {_listed(WRITTEN)}, got {path.suffix or 'no ending'}; "
            "choose .glb, which keeps everything"
        )
    lost = _lost(mesh, kind)
    if lost:
        warnings.warn(f"save_mesh: {path}: {kind.upper()} keeps no {lost}; choose .glb, which keeps them", stacklevel=2)
    path.parent.mkdir(parents=True, exist_ok=True)
    for name, data in {"glb": _glb, "obj": _obj, "ply": _ply, "stl": _stl}[kind](mesh, path).items():
        beside(path.with_name(name), lambda part, data=data: part.write_bytes(data))


def _ending(path: Path) -> str:
    return path.suffix.lower().lstrip(".")


def _listed(endings: tuple[str, ...]) -> str:
    return ", ".join(f".{ending}" for ending in endings[:-1]) + f" or .{endings[-1]}"


def _short(trouble: Exception) -> str:
    return (str(trouble) or type(trouble).__name__).splitlines()[0][:80]


def _lost(mesh: Mesh, kind: str) -> str:
    pieces = [piece for piece, _ in parts(mesh).values()]
    if kind == "stl" and any(piece.visual.kind for piece in pieces):
        return "colours, materials or UVs"
    return "materials, images or UVs" if kind == "ply" and any(map(_has_material, pieces)) else ""


def _glb(mesh: Mesh, path: Path) -> dict[str, bytes]:
    return {path.name: mesh.export(file_type="glb")}


def _stl(mesh: Mesh, path: Path) -> dict[str, bytes]:
    return {path.name: _baked(mesh).export(file_type="stl")}


def _ply(mesh: Mesh, path: Path) -> dict[str, bytes]:
    return {path.name: _baked(mesh).export(file_type="ply")}


def _obj(mesh: Mesh, path: Path) -> dict[str, bytes]:
    """The .mtl and images are named after the file, so that two meshes in a folder do not share them."""
    mtl = f"{path.stem.replace(' ', '_')}.mtl"
    # UVs are counted like vertices and a material holds on until the next, so parts without them come last
    pieces = sorted(_standing(mesh), key=lambda piece: (not _has_uv(piece), not _has_material(piece)))
    normals = all("vertex_normals" in piece._cache for piece in pieces)
    text, others = trimesh.exchange.obj.export_obj(
        trimesh.Scene(pieces), include_normals=normals, return_texture=True, mtl_name=mtl, header=None
    )
    if mtl not in others:
        return {path.name: text.encode("utf-8")}
    lines, others = _renamed(others.pop(mtl).decode("utf-8").splitlines(), others, Path(mtl).stem)
    plain = next((piece.metadata["name"] for piece in pieces if not _has_material(piece)), None)
    if plain is not None:
        text = text.replace(f"\no {plain}\n", f"\no {plain}\nusemtl plain\n", 1)
        lines += ["", "newmtl plain", "Kd 1 1 1"]
    # what is referred to is written first, so that the new .obj never stands beside old images
    return others | {mtl: "\n".join([*lines, ""]).encode("utf-8"), path.name: text.encode("utf-8")}


def _renamed(lines: list[str], images: dict[str, bytes], stem: str) -> tuple[list[str], dict[str, bytes]]:
    """Images by names of ours, in the lines of the .mtl too: theirs come from the file and may point anywhere."""
    names = {name: f"{stem}_{i}{Path(name).suffix}" for i, name in enumerate(images)}
    lines = [f"map_Kd {names[line[7:]]}" if line.startswith("map_Kd ") else line for line in lines]
    return lines, {names[name]: data for name, data in images.items()}


def _has_uv(piece: trimesh.Trimesh) -> bool:
    return getattr(piece.visual, "uv", None) is not None


def _has_material(piece: trimesh.Trimesh) -> bool:
    return isinstance(piece.visual, TextureVisuals)


def _standing(mesh: Mesh) -> list[trimesh.Trimesh]:
    """Copies of the triangle meshes where the scene puts them, named after their nodes."""
    pieces = []
    for name, (geometry, matrix) in parts(mesh).items():
        piece = geometry.copy(include_cache=True)
        piece.apply_transform(matrix)
        piece.metadata["name"] = name
        pieces.append(piece)
    return pieces


def _baked(mesh: Mesh) -> trimesh.Trimesh:
    """One mesh of the whole scene, with a colour at each vertex in place of materials and UVs."""
    pieces = _standing(mesh)
    for piece in pieces:
        if _has_material(piece):
            piece.visual = _colors(piece)
    return pieces[0] if len(pieces) == 1 else trimesh.util.concatenate(pieces)


def _colors(piece: trimesh.Trimesh) -> ColorVisuals:
    found = piece.visual.material.to_color(piece.visual.uv)
    if found is None or len(np.shape(found)) == 1:
        found = np.tile(piece.visual.material.main_color, (len(piece.vertices), 1))
    return ColorVisuals(vertex_colors=found)
