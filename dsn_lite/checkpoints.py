"""What a training needs to go on where it stopped: weights, Adam's moments and the clock, and its history."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn

from .files import beside
from .runs import load_tensors, save_tensors

FILE, HISTORY = "checkpoint.safetensors", "history.jsonl"
MOMENTS = ("step", "exp_avg", "exp_avg_sq")


def save_checkpoint(
    run: Path,
    space: nn.Module,
    best: dict[str, Tensor],
    optimizer: torch.optim.Adam,
    clock: dict[str, int | float],
    told: str,
) -> None:
    """Weights, the best weights, Adam's moments, the clock and what was told in one file: they belong together."""
    run.mkdir(parents=True, exist_ok=True)
    tensors = {f"now.{name}": value for name, value in space.state_dict().items()}
    tensors |= {f"best.{name}": value for name, value in best.items()}
    for i, parameter in enumerate(space.parameters()):  # of frozen ones Adam has no moments
        tensors |= {f"adam.{i}.{name}": value for name, value in optimizer.state.get(parameter, {}).items()}
    tensors |= {f"at.{name}": torch.tensor(value, dtype=torch.float64) for name, value in clock.items()}
    tensors["told.config"] = torch.tensor(list(told.encode()), dtype=torch.uint8)
    save_tensors(tensors, run / FILE)


def load_checkpoint(
    run: Path, space: nn.Module, optimizer: torch.optim.Adam, told: str
) -> tuple[dict[str, Tensor], dict[str, float]]:
    """Puts weights and moments back and returns the best weights and the clock.

    Raises FileNotFoundError or ValueError in one sentence: no checkpoint, a damaged one, one that was told otherwise.
    """
    groups: dict[str, dict[str, Tensor]] = {"now": {}, "best": {}, "adam": {}, "at": {}, "told": {}}
    for name, value in load_tensors(run / FILE, run).items():
        group, rest = name.split(".", 1)
        groups[group][rest] = value
    before = json.loads(bytes(groups["told"]["config"].tolist()))
    if others := [name for name, value in json.loads(told).items() if before.get(name) != value]:
        name = others[0]
        raise ValueError(
            f"train: the checkpoint in {run} must fit this Config, its {name} is {before.get(name)} instead of "
            f"{json.loads(told)[name]}; resume with the Config it began with"
        )
    space.load_state_dict(groups["now"])
    for i, parameter in enumerate(space.parameters()):
        if f"{i}.step" not in groups["adam"]:
            continue
        state = {name: groups["adam"][f"{i}.{name}"] for name in MOMENTS}
        optimizer.state[parameter] = {n: v if n == "step" else v.to(parameter.device) for n, v in state.items()}
    return groups["best"], {name: value.item() for name, value in groups["at"].items()}


def save_history(run: Path, records: Iterable[dict[str, Any]]) -> None:
    """One JSON object a line."""
    lines = "".join(json.dumps(record) + "\n" for record in records)
    beside(run / HISTORY, lambda path: path.write_text(lines, encoding="utf-8"))


def load_history(run: Path) -> list[dict[str, Any]]:
    """The lines that `save_history` wrote."""
    return [json.loads(line) for line in (run / HISTORY).read_text(encoding="utf-8").splitlines()]
