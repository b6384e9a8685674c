"""How large runs are: what fits two cores and four minutes, and what the paper and its authors' code did."""

from typing import Any

from ..config import Config
from .kinds import Data, Scale

COUNT = {"airplane": 2390, "car": 1200, "chair": 1927, "sofa": 947, "table": 1857}  # shapes, Section 4.1 of the paper
PAPER = {
    "batch": 16,
    "learning_rate": 1e-3,
    "steps": 20_000,
    "points": 2048,
    "symmetry": 1.0,
    "features": (64, 64, 64, 128, 1024),
    "head": (512, 256, 128),
}
LITE = {"points": 512, "symmetry": 1.0, "steps": 1000}
"""The steps are one number so that experiments share trainings: the chairs with w = 10 are in three of them."""


def config(scale: Scale, seed: int, *, lite_steps: int | None = None, **told: Any) -> Config:
    """What a run is told: the scale's settings, but for what is `told`; `lite_steps` are other steps at lite scale."""
    own = {"steps": lite_steps} if lite_steps and not scale.full else {}
    return Config(seed=seed, **(PAPER if scale.full else LITE) | own | told)


def data(scale: Scale, family: str) -> Data:
    """The shapes of a category or a family."""
    return Data(family, COUNT.get(family, 5000), 2048) if scale.full else Data(family, 2000, 512)


def pairs(scale: Scale) -> int:
    """How many pairs and triplets of hold-out shapes are measured."""
    return 1000 if scale.full else 300
