"""What an experiment is: runs, each of which trains one space on one set of shapes and measures it."""

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from .. import zoo
from ..config import Config
from ..shapes import Shapes
from ..space import DeformSyncNet
from ..training import Record, Training
from .chart import Chart, Picture

if TYPE_CHECKING:
    from .results import Results


@dataclass(frozen=True)
class Data:
    """What data_gen generate is told: families or a category, and how many shapes of how many points."""

    family: str
    count: int
    points: int
    seed: int = 0

    @property
    def name(self) -> str:
        """The name of its file, without the ending."""
        return f"{self.family.replace('/', '_')}-{self.count}x{self.points}-seed{self.seed}"

    @property
    def told(self) -> tuple[str, ...]:
        """The command of data_gen that makes it."""
        sizes = "--count", f"{self.count}", "--points", f"{self.points}", "--seed", f"{self.seed}"
        return "generate", self.family, *sizes


@dataclass(frozen=True)
class Transfers(Data):
    """What data_gen transfers is told instead: `count` triplets of a category, and their true transfers."""

    across: bool = False
    single: bool = False

    @property
    def name(self) -> str:
        """The name of its file, without the ending."""
        return "-".join([super().name, "transfers", *self._flags])

    @property
    def told(self) -> tuple[str, ...]:
        """The command of data_gen that makes it."""
        return "transfers", *super().told[1:], *(f"--{flag}" for flag in self._flags)

    @property
    def _flags(self) -> list[str]:
        return [flag for flag in ("across", "single") if getattr(self, flag)]


@dataclass(frozen=True)
class Trained:
    """What is measured: a space, the shapes it has seen, and those held out, sampled twice."""

    space: DeformSyncNet
    config: Config
    seen: Shapes
    shapes: Shapes
    again: Shapes
    looks: Sequence[dict[str, Any]]  # what Run.watch returned while it was trained, in order


@dataclass(frozen=True)
class Run:
    """One space to train and to measure; the seed is its Config's.

    `prepare` is called once before the first step, `watch` at every look at the validation shapes; `how` holds what
    `measure` is told besides, so that other numbers there mean another run. `ready` names a ready-made space, which is
    measured on all of the shapes, with nothing to train; `config` is what it was told.
    """

    arm: str
    data: Data
    config: Config
    measure: Callable[..., dict[str, Any]]
    how: dict[str, Any] = field(default_factory=dict)
    prepare: Callable[[Training], None] | None = None
    watch: Callable[[Training, Record], dict[str, Any]] | None = None
    ready: str | None = None

    @property
    def key(self) -> str:
        """Its name within the experiment."""
        return f"{self.arm}-seed{self.config.seed}"

    @property
    def training(self) -> dict[str, Any]:
        """All that a training is told, as JSON has it, but for the device. That code has changed is not noticed."""
        told = {"data": asdict(self.data), "config": asdict(self.config) | {"device": "cpu"}}
        hooks = {"prepare": self.prepare, "watch": self.watch}
        told |= {name: hook.__name__ for name, hook in hooks.items() if hook}
        told |= {"ready": self.ready, "weights": zoo.digest(self.ready)} if self.ready else {}
        return json.loads(json.dumps(told))

    @property
    def settings(self) -> dict[str, Any]:
        """All that training and measuring are told, as JSON has it. That code has changed since is not noticed."""
        return self.training | {"how": json.loads(json.dumps(self.how))}


@dataclass(frozen=True)
class Scale:
    """How large the runs are: lite fits two cores and minutes a run, full is the paper's."""

    name: str
    seeds: int = 3

    def __post_init__(self) -> None:
        if self.seeds < 1:
            raise ValueError(f"reproduce: --seeds must be 1 or more, got {self.seeds}; three show a spread")

    @property
    def full(self) -> bool:
        """Whether this is the paper's scale."""
        return self.name == "full"


@dataclass(frozen=True)
class Experiment:
    """One table or figure: its runs, and what RESULTS.md says of them."""

    name: str
    title: str
    paper: str  # the table or figure it stands beside
    question: str
    runs: Callable[[Scale], list[Run]]
    section: Callable[["Results"], str]  # Markdown: tables and the account of them
    charts: Callable[["Results"], list[Chart | Picture]] = lambda results: []
