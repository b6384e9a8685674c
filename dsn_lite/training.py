"""Training a DeformSyncNet: the loop, its losses, its looks at the validation shapes and its checkpoints.

A step draws a batch of shapes and pairs it within itself: every shape is encoded once and is a source as well as a
target, so 2 encodings and a dictionary a pair become one of each. A resumed training takes the same steps as an
uninterrupted one, and several processes the same steps as one.
"""

import json
import time
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import asdict, dataclass
from functools import cached_property
from math import cos, pi
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from . import losses
from .batches import Batches
from .chamfer import chamfer, plant
from .checkpoints import load_checkpoint, load_history, save_checkpoint, save_history
from .config import Config, network, some
from .data import Frame, Shapes
from .dictionary import column_rms, offsets
from .handles import BatchHandles
from .modes import moved_by_lengths, unused
from .runs import fingerprint, same_shapes
from .world import World

VALIDATIONS = 20  # looks at the validation shapes over a whole training
VALIDATED, AT_ONCE = 48, 8  # shapes looked at, and how many together
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
        if config.batch < self.world.size:
            raise ValueError(
                f"train: batch must have a pair for each of {self.world.size} processes, got {config.batch}; raise it"
            )
        self.seen, self.validation = some(shapes, rows), shapes[torch.arange(len(shapes))[validation][:VALIDATED]]
        self.device = self.world.device(config.device)
        self.space = network(config, Frame.of(self.seen)).to(self.device)
        self.optimizer = torch.optim.Adam(self.space.parameters(), lr=config.learning_rate)
        self.batches = Batches(shapes, self.rows, config, self.world)
        self.step, self.seconds, self.history, self.stopping = 0, 0.0, [], False
        self.best, self.best_cd = deepcopy(self.space.state_dict()), float("inf")
        if resume:
            self._resume()

    def __iter__(self) -> Iterator[Record]:
        start, losses_seen, looks = time.perf_counter() - self.seconds, [], self.looks
        while self.progress < 1:
            try:
                losses_seen.append(self.take_step())
                self.seconds = self._agreed(time.perf_counter() - start)
                if self.stopping:
                    raise KeyboardInterrupt
            except KeyboardInterrupt:  # stopped between two looks: what was learned since the last one counts too
                self._look(float(np.mean(losses_seen or [0.0])), due=self.looks > looks)
                raise
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
        loss = self._gradients()
        learned = [weights for weights in self.space.parameters() if weights.requires_grad]
        self.world.add([loss, *(weights.grad for weights in learned)])
        self._stay_finite(loss)
        self._stay_finite(torch.nn.utils.clip_grad_norm_(learned, self.config.clip))
        self.optimizer.step()
        self.step += 1
        return loss.item()

    def _gradients(self) -> Tensor:
        """The loss of this process's share, its gradients in the weights; NaN where one of several processes fails.

        All of them then learn of it and raise together: one alone would leave the others waiting, and nothing written.
        """
        self.optimizer.zero_grad()
        try:
            loss = self.loss()
            loss.backward()
            return loss.detach()
        except FloatingPointError:
            if self.world.size == 1:
                raise
            for weights in self.space.parameters():  # what this process adds to those of the others
                weights.grad = torch.zeros_like(weights) if weights.requires_grad else None
            return torch.tensor(float("nan"), device=self.device)

    @torch.enable_grad()
    def loss(self) -> Tensor:
        """L = 100 (L_F + w_R L_R) + w_S L_S (Eqs. 9-13) on the batch of this step, of several processes its share."""
        config, batch = self.config, self.batches.draw(self.step, dense=self.progress >= 1 - self.config.dense)
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
        if self.config.unit == "seen":
            found = losses.seen_dictionary(fields, handles)
        else:  # linear in A: scaled while it is small
            found = losses.handle_dictionary(fields, handles, self.config.columns) / scales.flatten(1).unsqueeze(1)
        return losses.SPARSITY[self.config.norm](found)

    @torch.no_grad()
    def validate(self) -> tuple[float, int]:
        """Mean Ch(d(x -> y), y) over fixed pairs of validation shapes, and how many columns move nothing there."""
        x = self.validation.points.float().to(self.device)
        cds, lengths, vectors = [], [], []
        for here, there in zip(x.split(AT_ONCE), x.roll(1, 0).split(AT_ONCE), strict=True):
            A, v = self.space.dictionary(here), self.space.vector(here, there)
            deformed = here + offsets(A, v)
            self._stay_finite(deformed)
            cds.append(chamfer(deformed, there))
            lengths.append(column_rms(A))
            vectors.append(v)
        return torch.cat(cds).mean().item(), len(unused(moved_by_lengths(torch.cat(lengths), torch.cat(vectors))))

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

    def _look(self, loss: float, *, due: bool = True) -> Record:
        """Validates, and writes the checkpoint; a look that was not due counts for the result, not for a resumption."""
        cd, dead = self.validate()
        self.history.append(Record(self.step, self.seconds, loss, cd, self.learning_rate, dead))
        before = self.best, self.best_cd
        if cd < self.best_cd:
            self.best, self.best_cd = deepcopy(self.space.state_dict()), cd
        if self.run and self.world.writes:
            best, best_cd = (self.best, self.best_cd) if due else before
            clock = {"step": self.step, "seconds": self.seconds, "best_cd": best_cd, "shapes": self._origin}
            clock["looks"] = len(self.history) if due else len(self.history) - 1
            self.run.mkdir(parents=True, exist_ok=True)
            save_history(self.run, map(asdict, self.history))
            save_checkpoint(self.run, self.space, best, self.optimizer, clock, self._told)
        return self.history[-1]

    @property
    def _told(self) -> str:
        """All that a resumed training must be told again: a longer budget is another schedule, but may be wanted."""
        told = asdict(self.config)
        return json.dumps({name: value for name, value in told.items() if name not in ("seconds", "steps", "device")})

    @cached_property
    def _origin(self) -> float:
        """A number that tells whether two trainings see the same shapes, split in the same way."""
        return fingerprint(self.seen)

    def _resume(self) -> None:
        self.best, clock = load_checkpoint(self.run, self.space, self.optimizer, self._told)
        if not same_shapes(clock["shapes"], self._origin):
            raise ValueError(
                f"train: the checkpoint in {self.run} must be of these shapes, it is of others; "
                "resume with the file it began with"
            )
        self.step, self.seconds, self.best_cd = int(clock["step"]), clock["seconds"], clock["best_cd"]
        self.history = [Record(**line) for line in load_history(self.run)][: int(clock["looks"])]
