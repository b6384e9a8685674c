"""The networks of a sweep: one for each family of each file, or for each file, and what `train` is told for it."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path

from ..config import Config
from ..files import load_shapes
from ..runs import read_config


@dataclass(frozen=True)
class Network:
    """One network of a sweep: its run folder, and the file it learns from, all of it or one family."""

    run: Path
    file: Path
    family: str | None = None

    def command(self, config: Config, *, resume: bool) -> list[str]:
        """What trains it, in a process of its own."""
        told = ["train", str(self.file), "--out", str(self.run), *words(config)]
        told += [] if self.family is None else ["--family", self.family]
        return [sys.executable, "-m", "dsn_lite", *told, *(["--resume"] if resume else [])]


def words(config: Config) -> list[str]:
    """The options of the command line that say what a Config says, where it is not the default."""
    said = []
    for field in fields(config):
        value, name = getattr(config, field.name), field.name.replace("_", "-")
        if isinstance(value, bool) and value != field.default:
            said += [f"--{name}" if value else f"--no-{name}"]
        elif value != field.default:
            said += [f"--{name}", *map(str, value if isinstance(value, tuple) else (value,))]
    return said


def networks(files: Sequence[Path], out: Path, *, whole: bool = False) -> list[Network]:
    """The networks of these files, in folders of `out`: a file's name, or a family's where a file holds several.

    whole: never divide a file. Raises ValueError where there is none, or two would have one folder, and what
    `load_shapes` raises.
    """
    found = [network for file in files for network in _of_file(Path(file).resolve(), out, whole)]
    if not found:
        raise ValueError("sweep: there must be a file to train on, got none; make one with python -m data_gen generate")
    taken: dict[str, Network] = {}
    for network in found:
        other = taken.setdefault(network.run.name.casefold(), network)  # some disks do not tell A from a
        if other is not network:
            raise ValueError(
                f"sweep: each network must have a name of its own, {other.file} and {network.file} both give "
                f"{network.run.name}; rename a file, or sweep them into two folders"
            )
    return found


def _of_file(file: Path, out: Path, whole: bool) -> list[Network]:
    families = load_shapes(file).family_names
    if whole or len(families) < 2:
        return [Network(out / (file.name if file.is_dir() else file.stem), file)]
    return [Network(out / family.replace("/", "_"), file, family) for family in families]


def check_run(run: Path, config: Config) -> None:
    """Raises ValueError where a folder holds a run that was told something else: it would pass for one of these."""
    if not (run / "config.json").is_file():
        return
    before = read_config(run)[0]
    for field in fields(config):
        old, new = getattr(before, field.name), getattr(config, field.name)
        if old != new:
            raise ValueError(
                f"sweep: {run} must hold a run of the same Config, its {field.name} is {old} instead of {new}; "
                "sweep into another folder"
            )
