"""Run folders: config.json, model.safetensors, probe.safetensors, history.jsonl and, while training, a checkpoint.

A run tests itself: the probe holds x, y and d(x -> y), and `load_run` computes it again and refuses a mismatch.
Files are written beside and then renamed, so a machine that stops leaves the old file or the new one.
"""

import json
from dataclasses import asdict
from math import isclose
from pathlib import Path
from typing import Any

import numpy as np
import torch
from jaxtyping import Float
from safetensors import SafetensorError
from safetensors.torch import load_file, save
from torch import Tensor

from .config import Config, check_device, network, some
from .data import Frame
from .files import beside
from .shapes import Shapes
from .space import DeformSyncNet

PROBE_TOLERANCE = 1e-4  # sums of float32 differ in their last digits between machines
SAME = 1e-7  # relative: fingerprints made on two machines differ by less, those of two samplings by some 1e-4


def fingerprint(shapes: Shapes) -> float:
    """A number that tells shapes from others, from the same in another order and from the same sampled again.

    The mean of i times the mean square of x_i, of at most 1000 shapes, evenly spread; in squared units of the file.
    """
    sizes = some(shapes).points.double().square().mean((1, 2)).cpu()
    return (sizes * torch.arange(1, len(sizes) + 1)).mean().item()


def same_shapes(one: float, other: float) -> bool:
    """Whether two fingerprints are of the same shapes."""
    return isclose(one, other, rel_tol=SAME)


def save_run(
    space: DeformSyncNet,
    config: Config,
    run: str | Path,
    probe: Float[Tensor, "2 n 3"],
    *,
    finished: bool = True,
    trained_on: float | None = None,
) -> None:
    """Writes config, weights and the probe d(x -> y) of two shapes x, y into the folder `run`.

    trained_on: the fingerprint of the shapes, split and all, so that those held out can be told from those seen.
    """
    run, (x, y) = Path(run), probe.float().cpu()
    run.mkdir(parents=True, exist_ok=True)
    space = space.cpu()
    with torch.no_grad():
        save_tensors({"x": x, "y": y, "deformed": space.deform(x, y)}, run / "probe.safetensors")
    save_tensors(space.state_dict(), run / "model.safetensors")
    about = {"config": asdict(config), "frame": asdict(space.frame), "fingerprint": trained_on, "finished": finished}
    beside(run / "config.json", lambda path: path.write_text(json.dumps(about, indent=2) + "\n", encoding="utf-8"))
    space.to(config.device)


def load_run(run: str | Path, device: str = "cpu") -> DeformSyncNet:
    """The space of a run folder, in eval mode, after its probe was computed again.

    Raises FileNotFoundError or ValueError in one sentence: a file missing or truncated, weights of another k or of
    other widths, a probe that no longer comes out.
    """
    run = Path(run)
    check_device(device)
    config, frame = read_config(run)
    space = network(config, frame)
    _load_weights(space, load_tensors(run / "model.safetensors", run), config, run)
    _check_probe(space, load_tensors(run / "probe.safetensors", run), run)
    return space.requires_grad_(False).to(device).eval()


def finished(run: str | Path) -> bool:
    """Whether the training of this folder reached its end; False where there is none, or it was stopped."""
    try:
        return bool(json.loads((Path(run) / "config.json").read_text(encoding="utf-8"))["finished"])
    except (OSError, ValueError, KeyError, TypeError):
        return False


def _check_probe(space: DeformSyncNet, probe: dict[str, Tensor], run: Path) -> None:
    kinds = {name: (tensor.dtype, tensor.ndim, *tensor.shape[1:]) for name, tensor in probe.items()}
    if kinds != dict.fromkeys(("x", "y", "deformed"), (torch.float32, 2, 3)):
        raise ValueError(
            f"load_run: {run}: probe.safetensors must hold x, y and deformed, clouds (n, 3) in float32, "
            f"got {', '.join(probe)}; take the run from its source again"
        )
    with torch.no_grad():
        again = space.act(probe["x"], space.between(space.read(probe["x"]), space.read(probe["y"])))
        off = (again - probe["deformed"]).abs().max().item() if len(probe["x"]) == len(probe["deformed"]) else np.inf
    if not off <= PROBE_TOLERANCE:
        raise ValueError(
            f"load_run: {run} must give its probe again within {PROBE_TOLERANCE:g}, it is off by {off:.2g}; "
            "weights or probe were changed after training: take the run from its source again"
        )


def save_tensors(tensors: dict[str, Tensor], path: Path) -> None:
    """Writes tensors beside `path`, then renames."""
    whole = {name: tensor.detach().cpu().contiguous() for name, tensor in tensors.items()}
    beside(path, lambda part: part.write_bytes(save(whole)))  # save_file would let nobody else read it


def load_tensors(path: Path, run: Path) -> dict[str, Tensor]:
    """The tensors of one file of a run."""
    if not path.is_file():
        raise FileNotFoundError(f"load_run: {run} must hold {path.name}, it does not; is it a run folder?")
    try:
        return load_file(path)
    except (SafetensorError, OSError) as trouble:
        raise ValueError(f"load_run: {path} must be a whole safetensors file ({trouble}); copy the run again") from None


def read_config(run: Path) -> tuple[Config, Frame]:
    """What a run was told, and the frame of its shapes. Raises FileNotFoundError or ValueError in one sentence."""
    return _read(run)[:2]


def read_fingerprint(run: Path) -> float | None:
    """The fingerprint of what a run was trained on, None for runs that keep none. Raises as `read_config` does."""
    return _read(run)[2]


def _read(run: Path) -> tuple[Config, Frame, float | None]:
    path = run / "config.json"
    if not path.is_file():
        raise FileNotFoundError(f"load_run: {run} must hold config.json, it does not; is it a run folder?")
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
        config, known = Config.from_json(about["config"]), about.get("fingerprint")
        frame = Frame(**about["frame"] | _tuples(about["frame"]))
        return config, frame, None if known is None else float(known)
    except (ValueError, KeyError, TypeError, AttributeError) as trouble:
        raise ValueError(f"load_run: {path} must be the config of a run ({trouble!r}); copy the run again") from None


def _load_weights(space: DeformSyncNet, weights: dict[str, Tensor], config: Config, run: Path) -> None:
    expected = {name: tuple(value.shape) for name, value in space.state_dict().items()}
    found = {name: tuple(value.shape) for name, value in weights.items()}
    if expected == found:
        space.load_state_dict(weights)
        return
    last = "encode.head.2.weight"
    if found.get(last, (config.k,))[0] != config.k:
        raise ValueError(
            f"load_run: {run}: model.safetensors has k = {found[last][0]}, config.json says {config.k}; "
            "files of two runs are mixed"
        )
    other = next(name for name in sorted(expected | found) if expected.get(name) != found.get(name))
    raise ValueError(
        f"load_run: {run}: model.safetensors must fit config.json, {other} is {found.get(other)} instead of "
        f"{expected.get(other)}; files of two runs are mixed"
    )


def _tuples(values: dict[str, Any]) -> dict[str, tuple]:
    return {name: tuple(value) for name, value in values.items() if isinstance(value, list)}
