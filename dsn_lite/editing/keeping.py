"""Histories as JSON files: the edits as they were told, whose they are, and where they lead."""

import hashlib
import json
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from ..files import beside
from ..projection import Prior, Snapped
from ..shapes import Shapes
from ..space import ActionSpace
from .steps import Step

FORMAT = "dsn_lite edit history"
WITHIN = 1e-4  # of the largest handle value: machines differ in the last digits of a dictionary


def identity(space: ActionSpace, source: Shapes, prior: Prior | None) -> dict[str, str]:
    """Digests of the weights of a space, with the prior of edits if there is one, and of a source."""
    n, weights = source.points.shape[1], dict(space.state_dict())
    if prior is not None:
        weights |= {"prior basis": prior.basis, "prior noise": torch.tensor(prior.noise)}
    kind = {type(space).__name__: torch.zeros(0)}
    shared = {
        "points": source.points,
        "labels": source.labels.long().expand(1, n),
        "rest": source.rest.expand(1, n, 3),
        "boxes": source.boxes,
    }
    return {"space": _digest(kind | weights), "source": _digest(shared)}


def write(path: Path, whose: dict[str, str], steps: list[Step], cursor: int, end: Snapped) -> None:
    """Writes a history beside its place, then renames; `end` is where all steps lead, those undone included."""
    z_hat = dict(zip(end.names, end.z_hat.tolist(), strict=True))
    told = {"format": FORMAT, **whose, "steps": [step.to_json() for step in steps], "cursor": cursor, "z_hat": z_hat}
    text = json.dumps(told | {"digest": _seal(told)}, indent=2, allow_nan=False) + "\n"
    beside(path, lambda part: part.write_text(text, encoding="utf-8"))


def read(path: Path, whose: dict[str, str]) -> tuple[list[Step], int, dict[str, float]]:
    """Steps, cursor and where the steps lead. Raises FileNotFoundError or ValueError in one sentence."""
    where = f"History.load: {path}"
    if not path.is_file():
        raise FileNotFoundError(f"{where}: there is no such file; write one with History.save")
    told = _parsed(path, where)
    if told.pop("digest", None) != _seal(told):
        raise ValueError(
            f"{where} must be as History.save wrote it, it was changed since; take it from its source again"
        )
    for name, value in whose.items():
        if told[name] != value:
            raise ValueError(f"{where} must be a history of this {name}, it is of another; load it with its own {name}")
    return [Step.told(**step) for step in told["steps"]], told["cursor"], told["z_hat"]


def check_end(path: Path, z_hat: dict[str, float], end: Snapped) -> None:
    """Raises ValueError where the steps no longer lead to the handle values that the file tells."""
    known = torch.tensor([z_hat[name] for name in end.names], dtype=torch.float64)
    off = (known - end.z_hat).abs().max() / known.abs().max()
    if not off <= WITHIN:
        raise ValueError(
            f"History.load: {path} must lead to the handle values that it tells within {WITHIN:g}, it is off by "
            f"{off:.2g}; dsn_lite projects otherwise than the one that wrote it"
        )


def _parsed(path: Path, where: str) -> dict[str, Any]:
    try:
        told = json.loads(path.read_text(encoding="utf-8"), parse_constant=_refused)
    except (ValueError, RecursionError) as trouble:
        raise ValueError(f"{where} must be whole JSON, got ({trouble}); copy it again") from None
    if not isinstance(told, dict) or told.get("format") != FORMAT:
        known = told.get("format") if isinstance(told, dict) else told
        raise ValueError(f"{where} must be of the format {FORMAT!r}, got {str(known)[:40]!r}; is it an edit history?")
    return told


def _refused(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")


def _seal(told: dict[str, Any]) -> str:
    """Of all that a file tells, however it is laid out."""
    return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()


def _digest(tensors: dict[str, Tensor]) -> str:
    """Of names, types, sizes and bytes."""
    found = hashlib.sha256()
    for name, tensor in sorted(tensors.items()):
        found.update(f"{name} {tensor.dtype} {tuple(tensor.shape)}".encode())
        found.update(tensor.detach().cpu().reshape(-1).view(torch.uint8).numpy())
    return found.hexdigest()
