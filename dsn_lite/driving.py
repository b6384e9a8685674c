"""Trainings driven to their end: train(), its bar of progress, and what Ctrl-C does."""

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tqdm.auto import tqdm

from .config import Config
from .files import as_shapes
from .runs import fingerprint, save_run
from .shapes import Shapes
from .space import DeformSyncNet
from .training import Record, Training
from .world import joined

BAR = "{l_bar}{bar}| {elapsed}<{remaining}{postfix}"


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
        with interrupts(training):
            for record in training:
                _show(bar, training, record)
                if watch:
                    watch(training, record)
        if writes and training.history and (dead := training.history[-1].dead):
            bar.write(f"{dead} of the {training.config.k} columns of the dictionary move nothing; a smaller k will do.")
    except KeyboardInterrupt:
        if writes:
            bar.write(f"Stopped at step {training.step}; the best weights so far are kept.")
    finally:  # also where a training went wrong: the run folder then holds the best weights before it did, if any
        bar.close()
        training.space.load_state_dict(training.best)
        if training.run and training.history and writes:
            probe, told = training.validation.points[:2], fingerprint(training.shapes)
            ended = training.progress >= 1
            save_run(training.space, training.config, training.run, probe, finished=ended, trained_on=told)


def _show(bar: tqdm, training: Training, record: Record) -> None:
    bar.update(min(100, round(100 * training.progress)) - bar.n)
    bar.set_postfix(step=record.step, loss=f"{record.loss:.2e}", validation=f"{record.validation_cd:.2e}")


@contextmanager
def interrupts(training: Training) -> Iterator[None]:
    """Ctrl-C waits for the end of a step: within one the weights are half of this step and half of the last."""

    def stop(signal_number: int, frame: Any) -> None:
        if training.stopping:  # asked twice
            raise KeyboardInterrupt
        training.stopping = True

    if threading.current_thread() is not threading.main_thread():  # where signals cannot be heard
        yield
        return
    before = signal.signal(signal.SIGINT, stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
