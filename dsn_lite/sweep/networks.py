"""The networks of a sweep: one for each family of each file, or for each file, and what `train` is told for it."""

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path

from ..checkpoints import FILE as CHECKPOINT
from ..config import Config
from ..files import beside, load_shapes
from ..runs import fingerprint, read_config, same_shapes

SOURCE = "source.json"  # in a run folder: what it was trained on


@dataclass(frozen=True)
class Network:
    """One network of a sweep: its run folder, and the file it learns from, all of it or one family."""

    run: Path
    file: Path
    family: str | None = None
    fingerprint: float = field(default=0.0, compare=False)  # of all shapes in the file

    def sign(self) -> None:
        """Writes into its run folder what it learns from; the file may lie elsewhere by the time it is read."""
        self.run.mkdir(parents=True, exist_ok=True)
        source = {"file": str(self.file), "family": self.family, "fingerprint": self.fingerprint}
        text = json.dumps(source, indent=2) + "\n"
        beside(self.run / SOURCE, lambda part: part.write_text(text, encoding="utf-8"))

    def command(self, config: Config, *, resume: bool) -> list[str]:
        """What trains it, in a process of its own."""
        told = ["train", str(self.file), "--out", str(self.run), *words(config)]
        told += [] if self.family is None else ["--family", self.family]
        return [sys.executable, "-m", "dsn_lite", *told, *(["--resume"] if resume else [])]


def words(config: Config) -> list[str]:
    """The options of the command line that say what a Config says, where it is not the default."""
    said = []
    for each in fields(config):
        value, name = getattr(config, each.name), each.name.replace("_", "-")
        if isinstance(value, bool) and value != each.default:
            said += [f"--{name}" if value else f"--no-{name}"]
        elif value != each.default:
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
    shapes = load_shapes(file)
    families, known = shapes.family_names, fingerprint(shapes)
    if whole or len(families) < 2:
        return [Network(out / (file.name if file.is_dir() else file.stem), file, fingerprint=known)]
    return [Network(out / family.replace("/", "_"), file, family, known) for family in families]


def check_run(network: Network, config: Config) -> None:
    """Raises ValueError where a folder holds a run of something else: it would pass for this network.

    A run of which nothing tells what it was trained on, as `train` leaves it, is taken for one of this file.
    """
    run = network.run
    if (run / SOURCE).is_file() and any((run / name).is_file() for name in ("config.json", CHECKPOINT)):
        _check_source(network)
    if not (run / "config.json").is_file():
        return
    before = read_config(run)[0]
    for each in fields(config):
        old, new = getattr(before, each.name), getattr(config, each.name)
        if old != new:
            raise ValueError(
                f"sweep: {run} must hold a run of the same Config, its {each.name} is {old} instead of {new}; "
                "sweep into another folder"
            )


def _check_source(network: Network) -> None:
    file, family, known = _told(network.run / SOURCE)
    if family != network.family or not same_shapes(known or network.fingerprint, network.fingerprint):
        raise ValueError(
            f"sweep: {network.run} must hold a run of the shapes that {network.file} holds now, it was trained on "
            f"others (of {file}); sweep into another folder, or take that run away"
        )


def _told(file: Path) -> tuple[str, str | None, float | None]:
    """The file, the family and the fingerprint that `Network.sign` wrote; files of older sweeps have no such one."""
    try:
        told = json.loads(file.read_text(encoding="utf-8"))
        return told["file"], told["family"], float(told["fingerprint"]) if "fingerprint" in told else None
    except (ValueError, TypeError, KeyError):
        raise ValueError(
            f"sweep: {file} must tell what a run was trained on, it is broken; take that run away, to train it again"
        ) from None
