"""Completing a person's edit: pin some handles, and find the rest so that the shape stays plausible (Eqs. 4-7)."""

from .factor import Factor
from .prior import Prior
from .projector import EditProjector
from .snapped import Snapped

__all__ = ["EditProjector", "Factor", "Prior", "Snapped"]
