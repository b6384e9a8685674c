"""Meshes in, meshes out: a trained space deforms a mesh from a file and keeps its faces, colours, materials and UVs.

Code and dictionary are read from points sampled on the surface; then the dictionary is evaluated at the vertices. This
package is the only place that imports trimesh.
"""

from .collecting import collect, folder
from .files import load_mesh, save_mesh
from .moving import deform, transfer
from .similarity import Similarity, up_axis
from .surface import sample

__all__ = ["Similarity", "collect", "deform", "folder", "load_mesh", "sample", "save_mesh", "transfer", "up_axis"]
