"""Shapes as meshes: watertight parts, outward normals, UVs and a colour, kept in GLB, OBJ and PLY."""

from pathlib import Path

import numpy as np
import trimesh
from trimesh.visual import ColorVisuals, TextureVisuals
from trimesh.visual.material import PBRMaterial

from data_gen.colours import colours
from data_gen.families import family as rig_of
from data_gen.files import beside


def mesh(family, parameters):
    """A trimesh.Scene of the shape with parameters (p,), its parts by name.

    Raises ValueError for parameters that are no numbers or out of range.
    """
    rig = rig_of(family)
    parameters = rig.check(_numbers(parameters, rig)[None], "mesh")
    vertices, scene = rig.vertices(parameters)[0], trimesh.Scene()
    for i, (name, colour) in enumerate(zip(rig.part_names, colours(family), strict=True)):
        scene.add_geometry(_part(rig, i, vertices, colour), node_name=name, geom_name=name)
    return scene


def save_mesh(scene, path):
    """Write a scene from `mesh`; an .obj gets an .mtl beside it, a .ply colours by vertex instead of UVs.

    Raises ValueError for other endings.
    """
    path = Path(path)
    if path.suffix.lower() not in EXPORTS:
        raise ValueError(
            f"save_mesh: a mesh file must end in {', '.join(EXPORTS)}, got {path.name}; choose one of these"
        )
    for name, content in EXPORTS[path.suffix.lower()](scene, path).items():
        with beside(path.with_name(name)) as part:
            part.write_bytes(content)


def _numbers(parameters, rig):
    try:
        return np.asarray(parameters, np.float64)
    except (TypeError, ValueError):
        wanted = ", ".join(rig.parameter_names)
        raise ValueError(
            f"mesh: parameters must be numbers for {wanted}, got {str(parameters)[:40]}; give a list in this order"
        ) from None


def _part(rig, i, vertices, colour):
    own, triangles = rig.vertex_part == i, rig.triangles[rig.triangle_part == i]
    name = rig.part_names[i]
    material = PBRMaterial(name=name, baseColorFactor=[*colour.tolist(), 255], metallicFactor=0.0, roughnessFactor=0.8)
    visual = TextureVisuals(uv=rig.uv[own], material=material)
    return trimesh.Trimesh(vertices[own], triangles - triangles.min(), visual=visual, process=False)


def _glb(scene, path):
    return {path.name: scene.export(file_type="glb")}


def _obj(scene, path):
    materials = f"{path.stem}.mtl"
    text, others = trimesh.exchange.obj.export_obj(scene, return_texture=True, mtl_name=materials)
    return {**others, path.name: text.encode()}


def _ply(scene, path):
    parts = []
    for part in scene.dump():
        part.visual = ColorVisuals(
            part, vertex_colors=np.tile(part.visual.material.main_color, (len(part.vertices), 1))
        )
        parts.append(part)
    return {path.name: trimesh.util.concatenate(parts).export(file_type="ply")}


EXPORTS = {".glb": _glb, ".obj": _obj, ".ply": _ply}
