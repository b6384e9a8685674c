"""Procedural shapes of which the truth is known: parameters, parts, correspondences, handles and transfers.

shapes = data_gen.generate("table/four_legs", count=1000, points=1024, seed=0)
data_gen.save(shapes, "tables.npz")
"""

from data_gen.draw import generate, resample
from data_gen.families import families, family
from data_gen.meshes import mesh, save_mesh
from data_gen.sample import Collection, load, save

__all__ = ["Collection", "families", "family", "generate", "load", "mesh", "resample", "save", "save_mesh"]
