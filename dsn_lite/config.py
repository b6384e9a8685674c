"""What a training is told, and the network that follows from it."""

from dataclasses import dataclass, fields
from typing import Any

import torch
from torch import Tensor

from .data import Frame, Shapes
from .losses import AXES, SPARSITY
from .networks import DictionaryPredictor, Encoder, PairEncoder, reset
from .space import ConcatSpace, DeformSyncNet

CHOICES = {
    "mirror": (tuple(AXES), "data_gen mirrors at x = 0"),
    "norm": (tuple(SPARSITY), 'the paper trains with "l21"'),
    "unit": (("whole", "seen"), 'the paper\'s is "whole"'),
    "vector": (("difference", "concat"), 'keep "difference" unless you compare'),
    "columns": (("rms", "unit"), 'keep "rms" unless you compare'),
}
LOOKED_AT = 1000  # shapes of a collection that stand for all: it may be larger than memory
WAVES = 10  # frequencies: the last one's period is 0.004 units, shorter than the spacing of any sample
FARTHEST = 10.0  # coordinates beyond it were never brought to a common scale


@dataclass(frozen=True)
class Config:
    """What a training is told. The paper's values stand in the comments."""

    k: int = 32  # columns of the dictionary; paper: 64 and 512
    seconds: float = 120.0  # how long to train on this machine, where no steps are told
    steps: int | None = None  # how many steps to train instead: the same result again, on any machine of this kind
    batch: int = 8  # shapes of a step, each a source and a target once; paper: 16 or 32 pairs
    points: int = 512  # points of a source that a step reads, drawn anew from denser clouds; targets stay dense
    dense: float = 0.0  # share of the training, at its end, in which a step reads all points of its sources
    learning_rate: float = 4e-3  # highest step length of Adam; paper's code: 5e-4 and 1e-3
    symmetry: float = 0.0  # weight of the symmetry loss L_R; paper: 1
    mirror: str = "x"  # axis across which the symmetry loss mirrors shapes
    sparsity: float = 0.0  # weight of the sparsity loss L_S, for shapes with parts; paper: 10
    norm: str = "l21"  # norm in the sparsity loss: l21 as in the paper's training, or l1
    unit: str = "whole"  # unit length in the sparsity loss: of whole columns, as in the paper, or of what handles see
    project: bool = False  # train on shapes projected to what the handles of their parts can follow (Eq. 8)
    vector: str = "difference"  # difference of two codes, or concat, the ablation that reads both shapes together
    features: tuple[int, ...] = (32, 64, 128)  # widths of the point features of both networks; paper: 64 64 64 128 1024
    head: tuple[int, ...] = (128, 64)  # widths of the dictionary's last layers; paper: 512 256 128
    waves: int = 0  # frequencies at which the dictionary's network reads places too, so that it can bend at thin parts
    columns: str = "rms"  # columns have root mean square 1 over the points (rms), or length 1 as in the paper (unit)
    clip: float = 10.0  # longest gradient: a longer one is cut to it, so that no step goes farther
    seed: int = 0  # seed of the split, of the first weights and of the batches
    device: str = "cpu"  # what it is trained on: cpu, cuda, cuda:1, mps

    def __post_init__(self) -> None:
        for name in ("k", "batch", "points", "learning_rate", "clip"):
            self._positive(name, getattr(self, name))
        self._positive("seconds" if self.steps is None else "steps", self.seconds if self.steps is None else self.steps)
        if self.batch < 2:
            raise ValueError(
                f"Config: batch must be at least 2, since a batch is paired within itself, got {self.batch}"
            )
        for name, term in (("symmetry", "L_R"), ("sparsity", "L_S")):
            if not 0 <= getattr(self, name) < float("inf"):
                raise ValueError(
                    f"Config: {name} must be a weight, 0 or more, got {getattr(self, name)}; 0 leaves {term} out"
                )
        if not 0 <= self.dense <= 1:
            raise ValueError(
                f"Config: dense must be a share from 0 to 1, got {self.dense}; 0.5 reads all in the 2nd half"
            )
        if not 0 <= self.waves <= WAVES:
            raise ValueError(f"Config: waves must be from 0 to {WAVES}, got {self.waves}; 4 is good, 0 is as the paper")
        if self.seed < 0:
            raise ValueError(f"Config: seed must be 0 or more, got {self.seed}; any whole number will do")
        for name, (choices, cure) in CHOICES.items():
            if getattr(self, name) not in choices:
                known = " or ".join(f'"{choice}"' for choice in choices)
                raise ValueError(f"Config: {name} must be {known}, got {getattr(self, name)!r}; {cure}")
        if len(self.features) < 2 or not self.head or min(*self.features, *self.head) < 1:
            raise ValueError(
                f"Config: features needs at least two widths and head one, each 1 or more, got {self.features} and "
                f"{self.head}; keep the defaults"
            )

    def _positive(self, name: str, value: Any) -> None:
        if not value > 0:
            raise ValueError(f"Config: {name} must be more than 0, got {value}; leave it out for the default")

    def check(self, shapes: Shapes) -> None:
        """Raises ValueError where these shapes cannot be trained on with this configuration."""
        N, n = shapes.points.shape[0], min(self.points, shapes.points.shape[1])
        if self.k > 3 * n:
            raise ValueError(f"train: k must be at most 3n = {3 * n} for shapes of {n} points, got {self.k}; lower k")
        if self.sparsity or self.project:
            _check_parts(shapes)
        if N < 8:
            raise ValueError(
                f"train: at least 8 shapes are needed to train and to hold some out, got {N}; bring more shapes"
            )

        if (far := some(shapes).points.abs().max().item()) > FARTHEST:
            raise ValueError(
                f"train: points should lie in [-0.5, 0.5] and must not lie beyond {FARTHEST:g}, got {far:.3g}; "
                "scale all shapes alike"
            )
        check_device(self.device)

    @classmethod
    def from_json(cls, values: dict[str, Any]) -> "Config":
        """The Config that `asdict` wrote; lists become tuples again."""
        known = {field.name for field in fields(cls)}
        return cls(**{name: tuple(v) if isinstance(v, list) else v for name, v in values.items() if name in known})


def check_device(device: str) -> None:
    """Raises ValueError where torch knows no such device or there is none."""
    try:
        torch.zeros(1, device=device)
    except (RuntimeError, AssertionError):
        raise ValueError(f'device: must be one that torch can use here, got {device!r}; use "cpu"') from None


def some(shapes: Shapes, rows: slice | Tensor = slice(None)) -> Shapes:
    """The points of at most LOOKED_AT of these rows of a collection, evenly spread."""
    rows = torch.arange(len(shapes))[rows]
    return Shapes(points=shapes.points[rows[:: -(-len(rows) // LOOKED_AT)]])


def _check_parts(shapes: Shapes) -> None:
    if not shapes.has_parts:
        raise ValueError(
            "train: sparsity and project need shapes with labels, rest and boxes, these have no parts; leave both out"
        )


def network(config: Config, frame: Frame | None = None) -> DeformSyncNet:
    """An untrained DeformSyncNet of this configuration; with vector = "concat", its ablation."""
    encoder = Encoder if config.vector == "difference" else PairEncoder
    kind = DeformSyncNet if config.vector == "difference" else ConcatSpace
    widths = config.features[:1], config.features[1:], config.head
    predictor = DictionaryPredictor(config.k, *widths, config.columns, config.waves)
    read = encoder(config.k, config.features, (config.features[-2],))
    return reset(kind(read, predictor, frame), config.seed)
