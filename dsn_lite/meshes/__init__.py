"""Meshes in, meshes out: a trained space deforms a mesh from a file and keeps its faces, colours, materials and UVs.

A person moves a handle of a part, `edit`, or gives the shape to come near to, `deform` and `transfer`. Code and
dictionary are read from points sampled on the surface; then the dictionary is evaluated at the vertices. This
package is the only place that imports trimesh.
"""

from .collecting import collect, folder
from .editing import EditableMesh, Edited, edit
from .files import load_mesh, save_mesh
from .moving import deform, transfer
from .parts import Parts, split
from .similarity import Similarity, up_axis
from .surface import sample

__all__ = [
    "EditableMesh",
    "Edited",
    "Parts",
    "Similarity",
    "collect",
    "deform",
    "edit",
    "folder",
    "load_mesh",
    "sample",
    "save_mesh",
    "split",
    "transfer",
    "up_axis",
]
