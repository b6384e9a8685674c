"""The command line: python -m data_gen list | generate | resample | show | mesh."""

import itertools
import sys
import webbrowser
from pathlib import Path
from typing import Annotated, Literal

import tyro
from tyro.conf import Positional, UseAppendAction, arg

import data_gen
from data_gen.gallery import show as write_page
from data_gen.meshes import save_mesh

Family = Annotated[Positional[str], arg(metavar="FAMILY")]
SET = arg(name="set", metavar="NAME=VALUE ...")


def list_families() -> None:
    """Print every family with its parts, its parameters and their ranges."""
    for name in data_gen.families():
        rig = data_gen.family(name)
        print(f"{name}  parts ({len(rig.part_names)}): {', '.join(rig.part_names)}")
        for parameter in rig.parameters:
            print(f"    {parameter.name:<16} {parameter.low:>5g} to {parameter.high:<5g} {parameter.meaning}")


def generate(
    family: Family,
    /,
    *,
    count: int,
    points: int,
    out: Path,
    seed: int = 0,
    sampling: Literal["fresh", "shared"] = "fresh",
) -> None:
    """Make random shapes of a family and write a sample file.

    Args:
        family: Name of the family, as `list` prints it.
        count: Number of shapes.
        points: Points on each shape.
        out: The sample file to write (.npz).
        seed: The same seed gives the same file.
        sampling: fresh draws new samples for each shape; shared draws them once, so that points correspond.
    """
    data_gen.save(data_gen.generate(family, count=count, points=points, seed=seed, sampling=sampling), out)
    print(f"{out}: {count} shapes of {points} points")


def resample(file: Annotated[Positional[Path], arg(metavar="FILE")], /, *, seed: int, out: Path) -> None:
    """Write the shapes of a sample file again with new, independent samples.

    Args:
        file: A sample file written by `generate`.
        seed: Seed of the new samples.
        out: The sample file to write (.npz).
    """
    data_gen.save(data_gen.resample(data_gen.load(file), seed), out)
    print(f"{out}: the shapes of {file} with new samples")


def show(family: Family, /, *, out: Path | None = None, seed: int = 0, open: bool = True) -> None:
    """Write a page with twelve random shapes, and open it in the browser.

    Args:
        family: Name of the family, as `list` prints it.
        out: The page to write (.html); by default the family's name in this folder.
        seed: Seed of the shapes.
        open: Whether to open the page.
    """
    out = Path(f"{family.replace('/', '_')}.html") if out is None else out
    write_page(family, out, seed)
    print(out)
    if open:
        webbrowser.open(out.resolve().as_uri())


def mesh(
    family: Family, /, *, out: Path, values: Annotated[UseAppendAction[tuple[tuple[str, ...], ...]], SET] = ()
) -> None:
    """Write one shape as a mesh with a colour for each part.

    Args:
        family: Name of the family, as `list` prints it.
        out: The mesh to write (.glb, .obj or .ply).
        values: Parameters as name=value; the others stay in the middle of their ranges.
    """
    rig = data_gen.family(family)
    parameters = dict(zip(rig.parameter_names, rig.middle[0], strict=True))
    for value in itertools.chain(*values):
        parameters.update([_assignment(rig, value)])
    save_mesh(data_gen.mesh(family, list(parameters.values())), out)
    print(out)


def _assignment(rig, text):
    name, _, value = text.partition("=")
    if name not in rig.parameter_names:
        names = ", ".join(rig.parameter_names)
        raise ValueError(f"mesh: --set must name a parameter of {rig.name}, one of {names}, got {name!r}; see list")
    try:
        return name, float(value)
    except ValueError:
        raise ValueError(f"mesh: --set {name} must be a number, got {value!r}; write {name}=0.5") from None


COMMANDS = {"list": list_families, "generate": generate, "resample": resample, "show": show, "mesh": mesh}


def main(args=None):
    """Run a command; a ValueError or an OSError becomes one sentence on stderr, and 2 is returned."""
    try:
        tyro.extras.subcommand_cli_from_dict(
            COMMANDS, prog="python -m data_gen", description="Procedural shapes of which the truth is known.", args=args
        )
    except (ValueError, OSError) as trouble:
        print(trouble, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
