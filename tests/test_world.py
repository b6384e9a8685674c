"""Several processes take the steps that one takes: real processes, joined by gloo, as torchrun starts them."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
import torch
from worlds import TINY, shapes_of, unchecked

from dsn_lite.driving import train
from dsn_lite.files import save_shapes
from dsn_lite.runs import finished, load_run
from dsn_lite.world import World

ROOT = Path(__file__).resolve().parent.parent
TOLD = "--k 3 --batch 5 --steps 4 --features 8 16 32 --head 16 --points 40 --sparsity 0.1 --symmetry 1"


def test_two_processes_take_the_steps_of_one(tmp_path):
    """torchrun, as the README says it: the losses agree to 1e-5, so do the spaces, and one process writes the run.

    Over a few small steps: Adam divides by the size of a gradient; where that is nearly 0 round-off grows into a step.
    """
    shapes = shapes_of("table/four_legs", 20, 48)
    save_shapes(shapes, tmp_path / "shapes.npz")
    alone = train(
        shapes,
        replace(TINY, batch=5, steps=4, points=40, sparsity=0.1, symmetry=1.0, learning_rate=1e-4),
        out=tmp_path / "alone",
    )
    command = [sys.executable, "-m", "torch.distributed.run", "--standalone", "--nproc-per-node", "2", "-m", "dsn_lite"]
    command += [
        "train",
        str(tmp_path / "shapes.npz"),
        "--out",
        str(tmp_path / "two"),
        *TOLD.split(),
        "--learning-rate",
        "1e-4",
    ]
    threads = {"OMP_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, env=os.environ | threads, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr[-2000:]
    histories = [
        [json.loads(line) for line in (tmp_path / run / "history.jsonl").read_text().splitlines()]
        for run in ("alone", "two")
    ]
    assert [record["step"] for record in histories[0]] == [record["step"] for record in histories[1]]
    for one, other in zip(*histories, strict=True):
        assert other["loss"] == pytest.approx(one["loss"], rel=1e-5)
        assert other["validation_cd"] == pytest.approx(one["validation_cd"], rel=1e-5)
    assert finished(tmp_path / "two")
    x, y = shapes.points[:2]
    torch.testing.assert_close(load_run(tmp_path / "two").deform(x, y), alone.deform(x, y), atol=1e-5, rtol=0)
    assert "step=4" in done.stdout


def test_alone_nothing_is_added():
    numbers = torch.rand(3)
    before = numbers.clone()
    World().add([numbers])
    assert torch.equal(numbers, before)


def test_each_process_takes_the_gpu_of_its_rank(monkeypatch):
    monkeypatch.setenv("LOCAL_RANK", "1")
    assert World(1, 2).device("cuda") == "cuda:1"
    assert World(1, 2).device("cpu") == "cpu"
    assert World().device("cuda") == "cuda"


def test_a_rank_outside_the_world_is_refused():
    with pytest.raises(ValueError, match=r"World: rank must be 0 to 1, got 2; start it with torchrun"):
        unchecked(World)(2, 2)
