"""Editing one shape while others follow: the vector of a snapped edit acts on every shape (Sections 3.1 and 3.2)."""

from .blending import CoEdit
from .coeditor import CoEditor, co_edit
from .followers import Followed
from .history import History
from .steps import Step

__all__ = ["CoEdit", "CoEditor", "Followed", "History", "Step", "co_edit"]
