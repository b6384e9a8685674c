"""Procedural shapes of which the truth is known: parameters, parts, correspondences, handles, joints and transfers.

shapes = data_gen.generate("table/four_legs", count=1000, points=1024, seed=0)
data_gen.save(shapes, "tables.npz")
"""

from data_gen.archive import load, save
from data_gen.degrade import noisy, seen_from
from data_gen.families import categories, families, family
from data_gen.handles import handles
from data_gen.make import generate, pieces, resample
from data_gen.meshes import mesh, save_mesh
from data_gen.normalise import normalised
from data_gen.paper_data import paper
from data_gen.sample import Collection
from data_gen.shards import save_shards
from data_gen.transfers import transfers
from data_gen.truth import true_deformation, true_transfer, valid_space

__all__ = [
    "Collection",
    "categories",
    "families",
    "family",
    "generate",
    "handles",
    "load",
    "mesh",
    "noisy",
    "normalised",
    "paper",
    "pieces",
    "resample",
    "save",
    "save_mesh",
    "save_shards",
    "seen_from",
    "transfers",
    "true_deformation",
    "true_transfer",
    "valid_space",
]
