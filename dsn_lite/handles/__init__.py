"""Deformation handles: linear controls of a shape, x = B z0, and what of a motion they can follow (Section 3.2)."""

from .batch import BatchHandles
from .boxes import BoxHandles
from .corners import corners
from .dense import DenseHandles
from .kinds import Handles

__all__ = ["BatchHandles", "BoxHandles", "DenseHandles", "Handles", "corners"]
