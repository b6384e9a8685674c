"""Shapes as meshes: one watertight mesh a part, outward normals, UVs and a colour, kept in GLB, OBJ and PLY."""

from pathlib import Path

import numpy as np
import trimesh
from trimesh.visual import ColorVisuals, TextureVisuals
from trimesh.visual.material import PBRMaterial

from data_gen.families import family as rig_of
from data_gen.files import beside
from data_gen.part import Box

PALETTE = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442")
"""Colours of parts by index, over again after seven: Okabe and Ito's, which colour-blind people tell apart."""


def mesh(family, parameters):
    """A trimesh.Scene of the shape with parameters (p,), its parts by name. Raises ValueError for one out of range."""
    rig = rig_of(family)
    parameters = rig.check(np.asarray(parameters)[None], "mesh")
    scene = trimesh.Scene()
    for i, box in enumerate(rig.boxes(parameters)[0]):
        name = rig.part_names[i]
        scene.add_geometry(_part(name, box, PALETTE[i % len(PALETTE)]), node_name=name, geom_name=name)
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


def _part(name, box, colour):
    vertices, triangles, uv = Box.unit_mesh()
    material = PBRMaterial(name=name, baseColorFactor=_rgba(colour), metallicFactor=0.0, roughnessFactor=0.8)
    return trimesh.Trimesh(
        vertices * box[12:] + box[:3], triangles, visual=TextureVisuals(uv=uv, material=material), process=False
    )


def _rgba(colour):
    return [*bytes.fromhex(colour[1:]), 255]


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
