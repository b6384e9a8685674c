"""What every lesson needs: a fixed seed, the versions at hand, and small budgets when lessons are only being tested."""

import os
import platform
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

import torch

SMOKE = "DSN_LITE_SMOKE"  # set while the notebooks are tested: everything runs, nothing runs long


def begin(seed: int = 0) -> None:
    """Seeds torch and prints what runs where, which is the first thing to look at when two machines disagree."""
    torch.manual_seed(seed)
    packages = ", ".join(f"{name} {version(name)}" for name in ("torch", "numpy", "plotly", "jupyterlab"))
    where = f"Python {platform.python_version()} on {platform.system()}"
    print(f"{where}, {packages}; {torch.get_num_threads()} threads, seed {seed}")


def error_of(attempt: Callable[[], Any]) -> None:
    """Tries what must fail and prints the sentence of the error."""
    try:
        attempt()
    except (TypeError, ValueError) as error:
        print(f"{type(error).__name__}: {error}")


def seconds(full: float) -> float:
    """The budget of a live training: `full`, or one second while the lessons are being tested."""
    return 1.0 if os.environ.get(SMOKE) else full


def steps(full: int) -> int:
    """The budget of a training that is counted in steps: `full`, or five while the lessons are being tested."""
    return 5 if os.environ.get(SMOKE) else full
