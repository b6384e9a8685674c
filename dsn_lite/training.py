"""Training a DeformSyncNet: Config, train(), and the loop behind it.

A step draws a batch of shapes and pairs it within itself: every shape is encoded once and is a source as well as a
target, so 2 encodings and a dictionary a pair become one of each. A resumed training takes the same steps as an
uninterrupted one, and several processes the same steps as one.
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
from .batch_handles import BatchHandles
from .batches import Batches
from .chamfer import chamfer, plant
from .checkpoints import load_checkpoint, load_history, save_checkpoint, save_history
from .config import Config, network, some
from .data import Frame, Shapes
from .dictionary import offsets
from .files import as_shapes
from .modes import dead_columns
from .runs import save_run
from .space import DeformSyncNet
from .world import World, joined

VALIDATIONS = 20  # looks at the validation shapes over a whole training
VALIDATED = 48  # shapes looked at
BAR = "{l_bar}{bar}| {elapsed}<{remaining}{postfix}"
WARM_UP = 0.02  # share of the budget over which the learning rate rises


@dataclass(frozen=True)
class Record:
    """One look at the validation shapes; written as a line of history.jsonl."""

    step: int
    seconds: float
    loss: float  # mean of the training loss since the last record
    validation_cd: float
    learning_rate: float
    dead: int = 0  # columns of the dictionary that move nothing


class Training:
    """The loop, one Record at a time: `for record in Training(shapes, config): ...`; `best` holds the best weights."""

    def __init__(
        self,
        shapes: Shapes,
        config: Config,
        *,
        run: Path | None = None,
        resume: bool = False,
        world: World | None = None,
    ):
        self.shapes, self.config, self.run, self.world = shapes, config, run, world or World()
        rows, validation, self._test = shapes.rows(config.seed)
        self.rows = torch.arange(len(shapes))[rows]
        if config.batch > len(self.rows):
            raise ValueError(
                f"train: batch must be at most the {len(self.rows)} training shapes, got {config.batch}; lower batch"
            )
        self.seen, self.validation = some(shapes, rows), shapes[torch.arange(len(shapes))[validation][:VALIDATED]]
        self.device = self.world.device(config.device)
        self.space = network(config, Frame.of(self.seen)).to(self.device)
        self.optimizer = torch.optim.Adam(self.space.parameters(), lr=config.learning_rate)
        self.batches = Batches(shapes, self.rows, config, self.world)
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
            self.seconds = self._agreed(time.perf_counter() - start)
            if self.looks > looks:
                looks, record = self.looks, self._look(float(np.mean(losses_seen)))
                losses_seen, self.seconds = [], self._agreed(time.perf_counter() - start)
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

    @property
    def test(self) -> Shapes:
        """The hold-out shapes."""
        return self.shapes[self._test]

    def take_step(self) -> float:
        """One step of Adam on one batch; returns its loss. Raises FloatingPointError where numbers become NaN."""
        for group in self.optimizer.param_groups:
            group["lr"] = self.learning_rate
        self.optimizer.zero_grad()
        loss = self.loss()
        self._stay_finite(loss)
        loss.backward()
        loss = loss.detach()
        learned = [weights for weights in self.space.parameters() if weights.grad is not None]
        self.world.add([loss, *(weights.grad for weights in learned)])
        self._stay_finite(torch.nn.utils.clip_grad_norm_(learned, self.config.clip))
        self.optimizer.step()
        self.step += 1
        return loss.item()

    @torch.enable_grad()
    def loss(self) -> Tensor:
        """L = 100 (L_F + w_R L_R) + w_S L_S (Eqs. 9-13) on the batch of this step, of several processes its share."""
        config, batch = self.config, self.batches[self.step]
        x, codes = batch.x[batch.source], self.space.read(batch.x)
        v = self.space.between(codes[batch.source], codes[batch.target])
        fields, scales = self.space.dictionary.unscaled(x)
        deformed = x + offsets(fields, v / scales[..., 0, 0, :])
        if config.project:
            deformed = batch.handles.project(deformed)
        self._stay_finite(deformed)
        own = plant(deformed) if deformed.is_cpu else None
        loss = losses.fitting(deformed, batch.y, batch.trees, own)
        if config.symmetry:
            loss = loss + config.symmetry * losses.symmetry(deformed, config.mirror, own)
        loss = losses.FACTOR * loss
        if config.sparsity:
            loss = loss + config.sparsity * self._sparsity(fields, scales, batch.handles)
        return loss * (len(x) / config.batch)

    def _sparsity(self, fields: Tensor, scales: Tensor, handles: BatchHandles) -> Tensor:
        found = losses.handle_dictionary(fields, handles, self.config.columns)  # linear in A: scaled while it is small
        return losses.SPARSITY[self.config.norm](found / scales.flatten(1).unsqueeze(1))

    @torch.no_grad()
    def validate(self) -> tuple[float, int]:
        """Mean Ch(d(x -> y), y) over fixed pairs of validation shapes, and how many columns move nothing there."""
        x = self.validation.points.float().to(self.device)
        y = x.roll(1, 0)
        A, v = self.space.dictionary(x), self.space.vector(x, y)
        deformed = x + offsets(A, v)
        self._stay_finite(deformed)
        return chamfer(deformed, y).mean().item(), len(dead_columns(A, v))

    def _stay_finite(self, numbers: Tensor) -> None:
        if not numbers.isfinite().all():
            raise FloatingPointError(
                f"train: points, loss and gradient must stay finite, got NaN or infinity at step {self.step}; lower "
                f"learning_rate (now {self.config.learning_rate:g})"
                f"{f', the best weights are in {self.run}' if self.run and self.history else ''}"
            )

    def _agreed(self, seconds: float) -> float:
        """The clock of the first process, so that all take the same steps."""
        clock = torch.tensor([seconds if self.world.rank == 0 else 0.0], dtype=torch.float64, device=self.device)
        self.world.add([clock])
        return clock.item()

    def _look(self, loss: float) -> Record:
        cd, dead = self.validate()
        record = Record(self.step, self.seconds, loss, cd, self.learning_rate, dead)
        self.history.append(record)
        if record.validation_cd < self.best_cd:
            self.best, self.best_cd = deepcopy(self.space.state_dict()), record.validation_cd
        if self.run and self.world.writes:
            clock = {"step": self.step, "seconds": self.seconds, "best_cd": self.best_cd, **self._origin}
            save_checkpoint(self.run, self.space, self.best, self.optimizer, clock)
            save_history(self.run, map(asdict, self.history))
        return record

    @cached_property
    def _origin(self) -> dict[str, int | float]:
        """Numbers that tell whether two trainings see the same shapes in the same way."""
        sizes = self.seen.points.double().square().mean((1, 2)).cpu()
        place = torch.arange(1, len(sizes) + 1)  # of other shapes, or in another order, another number
        shapes = (sizes * place).mean().item()
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
    shapes = shapes if isinstance(shapes, Shapes) else as_shapes(shapes)  # which would read all of one in shards
    config.check(shapes)
    if run and not resume and (run / "config.json").exists():
        raise ValueError(f"train: {run} must not hold a run already, it does; resume it, or choose another folder")
    if resume and run is None:
        raise ValueError("train: resume needs the run folder to go on from, got no out; give out=FOLDER")
    with joined(config.device) as world:
        training = Training(shapes, config, run=run, resume=resume, world=world)
        drive(training, watch)
    return training.space.requires_grad_(False).eval()


def drive(training: Training, watch: Callable[[Training, Record], None] | None) -> None:
    """Trains to the end, or until Ctrl-C, with a bar of progress; the space then has the best weights."""
    writes = training.world.writes
    bar = tqdm(total=100, unit="%", bar_format=BAR, file=sys.stdout, disable=not writes)
    bar.update(round(100 * training.progress))
    try:
        for record in training:
            bar.update(min(100, round(100 * training.progress)) - bar.n)
            bar.set_postfix(step=record.step, loss=f"{record.loss:.2e}", validation=f"{record.validation_cd:.2e}")
            if watch:
                watch(training, record)
        if writes and training.history and (dead := training.history[-1].dead):
            bar.write(f"{dead} of the {training.config.k} columns of the dictionary move nothing; a smaller k will do.")
    except KeyboardInterrupt:
        bar.write(f"Stopped at step {training.step}; the best weights so far are kept.")
    finally:  # also where a training went wrong: the run folder then holds the best weights before it did, if any
        bar.close()
        training.space.load_state_dict(training.best)
        if training.run and training.history and writes:
            ended = training.progress >= 1
            save_run(training.space, training.config, training.run, training.validation.points[:2], finished=ended)
