"""The paper's tables and figures at a scale that two cores manage: python -m dsn_lite reproduce.

An experiment trains spaces, measures each and keeps the figures in results/NAME.json; RESULTS.md is made from those.
"""

from . import axioms, projection, silence, size, sparsity, structure, synchronization, transfer
from .kinds import Experiment

MODULES = (sparsity, projection, axioms, size, synchronization, silence, structure, transfer)
EXPERIMENTS: dict[str, Experiment] = {module.EXPERIMENT.name: module.EXPERIMENT for module in MODULES}


def chosen(name: str) -> list[Experiment]:
    """The experiment of this name, or all of them. Raises ValueError where there is no such."""
    if name not in (*EXPERIMENTS, "all"):
        raise ValueError(f"reproduce: NAME must be one of {', '.join(EXPERIMENTS)} or all, got {name!r}; choose one")
    return list(EXPERIMENTS.values()) if name == "all" else [EXPERIMENTS[name]]
