"""Training a DeformSyncNet: Config, train(), and the loop behind it.

A step draws a batch of shapes and pairs it within itself: every shape is encoded once and is a source as well as a
target, so 2 encodings and a dictionary a pair become one of each. Every random choice comes from (seed, step), so a
resumed training takes the same steps as an uninterrupted one.
"""

import sys
import time
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import asdict, dataclass
from functools import cached_property
from math import cos, isclose, pi
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor
from tqdm.auto import tqdm

from . import losses
from .chamfer import chamfer, plant
from .checkpoints import load_checkpoint, load_history, save_checkpoint, save_history
from .config import Config, network
from .data import Frame, Shapes
from .dictionary import offsets
from .files import as_shapes
from .runs import save_run
from .space import DeformSyncNet
from .types import Points

VALIDATIONS = 20  # looks at the validation shapes over a whole training
WARM_UP = 0.02  # share of the budget over which the learning rate rises


@dataclass(frozen=True)
class Record:
    """One look at the validation shapes; written as a line of history.jsonl."""

    step: int
    seconds: float
    loss: float  # mean of the training loss since the last record
    validation_cd: float
    learning_rate: float


class Training:
    """The loop, one Record at a time: `for record in Training(shapes, config): ...`; `best` holds the best weights."""

    def __init__(self, shapes: Shapes, config: Config, *, run: Path | None = None, resume: bool = False):
        self.config, self.run = config, run
        self.train, self.validation, self.test = shapes.split(config.seed)
        if config.batch > len(self.train):
            raise ValueError(
                f"train: batch must be at most the {len(self.train)} training shapes, got {config.batch}; lower batch"
            )
        self.space = network(config, Frame.of(self.train)).to(config.device)
        self.optimizer = torch.optim.Adam(self.space.parameters(), lr=config.learning_rate)
        self.points = self.train.points.float().to(config.device)
        self.trees = plant(self.points) if self.points.is_cpu else None
        self.step, self.seconds, self.history = 0, 0.0, []
        self.best, self.best_cd = deepcopy(self.space.state_dict()), float("inf")
        if resume:
            self._resume()

    def __iter__(self) -> Iterator[Record]:
        start, losses_seen, looks = time.perf_counter() - self.seconds, [], self.looks
        while self.progress < 1:
            try:
                losses_seen.append(self.take_step())
            except KeyboardInterrupt:  # stopped between two looks: what was learned since the last one counts too
                self._look(float(np.mean(losses_seen or [0.0])))
                raise
            self.seconds = time.perf_counter() - start
            if self.looks > looks:
                looks, record = self.looks, self._look(float(np.mean(losses_seen)))
                losses_seen, self.seconds = [], time.perf_counter() - start
                yield record

    @property
    def progress(self) -> float:
        """Share of the budget that is spent."""
        if self.config.steps is not None:
            return self.step / self.config.steps
        return self.seconds / self.config.seconds

    @property
    def looks(self) -> int:
        """How many looks are due by now, from the progress alone: so a resumed training looks when it would have."""
        return int(min(1, self.progress) * VALIDATIONS)

    @property
    def learning_rate(self) -> float:
        """Rises over the warm-up, then falls along half a cosine to nothing."""
        rise, fall = self.progress / WARM_UP + 1e-3, (1 + cos(pi * min(1, self.progress))) / 2
        return self.config.learning_rate * min(1, rise) * fall

    def take_step(self) -> float:
        """One step of Adam on one batch; returns its loss. Raises FloatingPointError where points become NaN."""
        for group in self.optimizer.param_groups:
            group["lr"] = self.learning_rate
        loss = self.loss()
        self.optimizer.zero_grad()
        loss.backward()
        self.optimizer.step()
        self.step += 1
        return loss.item()

    @torch.enable_grad()
    def loss(self) -> Tensor:
        """L = L_F + w L_R (Eqs. 9, 10) on the batch of this step."""
        rng = np.random.default_rng((self.config.seed, self.step))
        i = rng.choice(len(self.points), self.config.batch, replace=False)
        j = np.roll(np.arange(len(i)), rng.integers(1, max(2, len(i))))  # nobody is paired with itself
        x = y = self.points[i]
        if self.config.points < x.shape[1]:
            x = x[:, rng.choice(x.shape[1], self.config.points, replace=False)]
        code = self.space.encode(x)
        deformed = x + offsets(self.space.dictionary(x), code[j] - code)
        kept = None if self.trees is None else [self.trees[index] for index in i[j]]
        self._stay_finite(deformed)
        loss = losses.fitting(deformed, y[j], kept)
        if self.config.symmetry:
            loss = loss + self.config.symmetry * losses.symmetry(deformed, self.config.mirror)
        return loss

    @torch.no_grad()
    def validation_cd(self) -> float:
        """Mean Ch(d(x -> y), y) over fixed pairs of validation shapes."""
        x = self.validation.points[:48].float().to(self.config.device)
        y = x.roll(1, 0)
        deformed = self.space.deform(x, y)
        self._stay_finite(deformed)
        return chamfer(deformed, y).mean().item()

    def _stay_finite(self, deformed: Points) -> None:
        if not deformed.isfinite().all():
            raise FloatingPointError(
                f"train: the deformed points must stay finite, got NaN or infinity at step {self.step}; lower "
                f"learning_rate (now {self.config.learning_rate:g})"
                f"{f', the best weights are in {self.run}' if self.run and self.history else ''}"
            )

    def _look(self, loss: float) -> Record:
        record = Record(self.step, self.seconds, loss, self.validation_cd(), self.learning_rate)
        self.history.append(record)
        if record.validation_cd < self.best_cd:
            self.best, self.best_cd = deepcopy(self.space.state_dict()), record.validation_cd
        if self.run:
            clock = {"step": self.step, "seconds": self.seconds, "best_cd": self.best_cd, **self._origin}
            save_checkpoint(self.run, self.space, self.best, self.optimizer, clock)
            save_history(self.run, map(asdict, self.history))
        return record

    @cached_property
    def _origin(self) -> dict[str, int | float]:
        """Numbers that tell whether two trainings see the same shapes in the same way."""
        sizes = self.points.double().square().mean((1, 2)).cpu()
        shapes = (
            (sizes * torch.arange(1, len(sizes) + 1)).mean().item()
        )  # of other shapes, or in another order, another
        return {"seed": self.config.seed, "rms": int(self.config.columns == "rms"), "shapes": shapes}

    def _resume(self) -> None:
        self.best, clock = load_checkpoint(self.run, self.space, self.optimizer)
        if not all(isclose(clock[name], value) for name, value in self._origin.items()):
            raise ValueError(
                f"train: the checkpoint in {self.run} must be of these shapes, with this seed, it is of others; "
                "resume with the file and the Config it began with"
            )
        self.step, self.seconds, self.best_cd = int(clock["step"]), clock["seconds"], clock["best_cd"]
        self.history = [Record(**line) for line in load_history(self.run)]


def train(
    shapes: Any,
    config: Config | None = None,
    *,
    out: str | Path | None = None,
    resume: bool = False,
    watch: Callable[[Training, Record], None] | None = None,
) -> DeformSyncNet:
    """A DeformSyncNet of these shapes: a collection, or an array of point clouds (N, n, 3).

    `out` is a run folder that is kept up to date and can be resumed; `watch` is called at every look at the validation
    shapes. Ctrl-C, or the stop button of a notebook, ends the training and keeps the best weights so far.
    """
    config, run = config or Config(), None if out is None else Path(out)
    shapes = as_shapes(shapes)
    config.check(shapes)
    if run and not resume and (run / "config.json").exists():
        raise ValueError(f"train: {run} must not hold a run already, it does; resume it, or choose another folder")
    if resume and run is None:
        raise ValueError("train: resume needs the run folder to go on from, got no out; give out=FOLDER")
    training = Training(shapes, config, run=run, resume=resume)
    bar = tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}{postfix}", file=sys.stdout)
    bar.update(round(100 * training.progress))
    try:
        for record in training:
            bar.update(min(100, round(100 * training.progress)) - bar.n)
            bar.set_postfix(step=record.step, loss=f"{record.loss:.2e}", validation=f"{record.validation_cd:.2e}")
            if watch:
                watch(training, record)
    except KeyboardInterrupt:
        bar.write(f"Stopped at step {training.step}; the best weights so far are kept.")
    finally:  # also where a training went wrong: the run folder then holds the best weights before it did, if any
        bar.close()
        training.space.load_state_dict(training.best)
        if run and training.history:
            save_run(training.space, config, run, training.validation.points[:2])
    return training.space.requires_grad_(False).eval()
