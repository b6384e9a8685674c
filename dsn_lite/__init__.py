"""dsn_lite: synchronized shape deformation spaces, after DeformSyncNet (Sung, Jiang et al., ACM TOG 39(6), 2020)."""

from importlib import import_module
from typing import Any

from . import axioms, metrics, modes
from .chamfer import chamfer
from .config import Config
from .data import Shapes
from .driving import train
from .editing import CoEditor, History, co_edit
from .files import as_shapes, load_shapes, save_shapes
from .handles import BoxHandles, DenseHandles
from .projection import EditProjector, Prior
from .runs import load_run, save_run
from .space import ActionSpace, AutoencoderSpace, DeformSyncNet, DoNothing, LinearSpace
from .training import Training
from .zoo import load

__all__ = [
    "ActionSpace",
    "AutoencoderSpace",
    "BoxHandles",
    "CoEditor",
    "Config",
    "DeformSyncNet",
    "DenseHandles",
    "DoNothing",
    "EditProjector",
    "History",
    "LinearSpace",
    "Prior",
    "Shapes",
    "Training",
    "as_shapes",
    "axioms",
    "chamfer",
    "co_edit",
    "load",
    "load_run",
    "load_shapes",
    "metrics",
    "modes",
    "save_run",
    "save_shapes",
    "train",
]

LATER = ("checks", "meshes", "plots", "widgets")  # they need trimesh, plotly or ipywidgets, which import slowly


def __getattr__(name: str) -> Any:
    if name in LATER:
        return import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
