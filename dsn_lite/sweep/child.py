"""One network trained in a process of its own: whatever kills it, want of memory too, ends this network only."""

import os
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from joblib import cpu_count

from ..checkpoints import FILE, HISTORY, load_history
from ..config import Config
from ..runs import finished
from .networks import Network

POLL = 0.5  # seconds between two looks whether it should stop


@dataclass(frozen=True)
class Outcome:
    """What became of a network; steps, seconds and the best validation CD are None before its first look."""

    name: str
    state: Literal["done", "skipped", "stopped", "failed"]
    steps: int | None = None
    seconds: float | None = None
    validation_cd: float | None = None
    trouble: str = ""


def trained(network: Network, config: Config, jobs: int | None, stop: Path) -> Outcome:
    """Trains a network as far as its folder does not hold it yet, on 1/jobs of this machine's cores (None: one core).

    It is asked to stop once the file `stop` is there. Trouble is the last line that `train` said; nothing is raised for
    it, nor for a process that cannot start or files that cannot be written or read: joblib would end the whole sweep.
    """
    try:
        return _trained(network, config, jobs, stop)
    except ValueError as trouble:
        return Outcome(network.run.name, "failed", trouble=str(trouble))
    except OSError as trouble:
        sentence = (
            f"sweep: its process must start and its folder be written, that failed ({trouble}); train fewer at once"
        )
        return Outcome(network.run.name, "failed", trouble=sentence)


def _trained(network: Network, config: Config, jobs: int | None, stop: Path) -> Outcome:
    if finished(network.run):
        return outcome(network, "skipped")
    if stop.exists():
        return outcome(network, "stopped")
    cores = cpu_count()
    resume = (network.run / FILE).is_file()
    network.sign()
    code, said = run(network.command(config, resume=resume), max(1, cores // (jobs or cores)), stop)
    if code == 0 and finished(network.run):
        return outcome(network, "done")
    if code == 0 or stop.exists():
        return outcome(network, "stopped")
    return outcome(network, "failed", said or _silent(code))


def run(command: list[str], threads: int, stop: Path) -> tuple[int, str]:
    """Exit code and last line of stderr of a process that is interrupted once the file `stop` is there."""
    told = {"OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive", "PYTHONUTF8": "1"}
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,  # the bar: a training whose sweep was killed cannot write it, and ends
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="replace",
        env=os.environ | told,
        start_new_session=True,  # Ctrl-C comes from here alone: a second one would hit it while it saves
    )
    asked = False
    while True:
        try:
            lines = process.communicate(timeout=POLL)[1].strip().splitlines()
            return process.returncode, lines[-1] if lines else ""
        except subprocess.TimeoutExpired:
            if stop.exists() and not asked:
                asked = True
                _interrupt(process)


def outcome(network: Network, state: str, trouble: str = "") -> Outcome:
    """A state, and what the history of the run says. Raises ValueError where that is broken."""
    name, looks = network.run.name, _history(network.run)
    if not looks:
        return Outcome(name, state, trouble=trouble)
    best = min(look["validation_cd"] for look in looks)
    return Outcome(name, state, looks[-1]["step"], looks[-1]["seconds"], best, trouble)


def _history(run: Path) -> list[dict[str, Any]]:
    if not (run / HISTORY).is_file():
        return []
    try:
        return load_history(run)
    except ValueError:
        raise ValueError(
            f"sweep: {run / HISTORY} must be a JSON object a line, it is broken; take the folder away to train again"
        ) from None


def _interrupt(process: subprocess.Popen) -> None:
    if os.name == "posix":  # a Windows console tells all its processes itself
        process.send_signal(signal.SIGINT)


def _silent(code: int) -> str:
    if code < 0:
        return f"its process was killed by signal {-code}; if memory was short, train fewer at once"
    return f"its process ended with code {code} and said nothing"
