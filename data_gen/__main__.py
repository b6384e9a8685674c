"""The command line: python -m data_gen list | show | sheet | generate | resample | transfers | mesh | paper."""

import itertools
import sys
import webbrowser
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

import tyro
from tqdm import tqdm
from tyro.conf import Positional, UseAppendAction, arg

import data_gen
from data_gen import catalogue, describe
from data_gen.gallery import write_page
from data_gen.make import checked_seed
from data_gen.meshes import save_mesh

Family = Annotated[Positional[str], arg(metavar="FAMILY")]
Families = Annotated[Positional[tuple[str, ...]], arg(metavar="FAMILY|CATEGORY ...")]
Values = Annotated[UseAppendAction[tuple[tuple[str, ...], ...]], arg(name="set", metavar="NAME=VALUE ...")]
PIECE = 2**21
"""Points made at a time where a collection is written in shards."""


def list_families(names: Families = (), /) -> None:
    """Print every family with its numbers of parts and parameters; of one family, all there is to know.

    Args:
        names: Families or categories; all if none is given.
    """
    for name in names or data_gen.categories():
        one = name in data_gen.families()
        print(describe.family(name) if one else "\n".join(map(describe.line, data_gen.families(name))))


def generate(
    families: Families,
    /,
    *,
    count: int,
    points: int,
    out: Path | None = None,
    shards: Path | None = None,
    seed: int = 0,
    sampling: Literal["fresh", "shared"] = "fresh",
    values: Values = (),
    noise: float = 0.0,
    seen_from: tuple[float, float, float] | None = None,
) -> None:
    """Make random shapes and write a sample file, or a folder of shards where they do not fit in memory.

    Args:
        families: Families, or categories for all their families; of several, each shape's is drawn at random.
        count: Number of shapes.
        points: Points on each shape.
        out: The sample file to write (.npz).
        shards: The folder to write instead, made piece by piece and read lazily.
        seed: The same seed gives the same file.
        sampling: fresh draws new samples for each shape; shared draws them once, so that points correspond.
        values: Parameters that all shapes share, as name=value; the others are random.
        noise: Standard deviation of Gaussian noise on the points, in units of the shape's cube.
        seen_from: Only points that are visible from this direction, as x y z: 0 0 1 looks at the front.
    """
    if (out is None) == (shards is None):
        raise ValueError("generate: either --out or --shards must say where to write, got neither or both; give one")
    fixed = {name: value for name, value in map(_assigned, itertools.chain(*values))}
    size = max(1, PIECE // max(1, points)) if shards else count
    made = data_gen.pieces(families, count=count, points=points, seed=seed, sampling=sampling, fixed=fixed, size=size)
    made = map(partial(_degraded, noise, seen_from, seed), made, itertools.count(0, size))
    if out is not None:
        data_gen.save(next(made), out)
    else:
        data_gen.save_shards(_watched(made, -(-count // size)), shards)
    print(f"{out or shards}: {count} shapes of {points} points")


def resample(
    file: Annotated[Positional[Path], arg(metavar="FILE")], /, *, seed: int, out: Path, points: int | None = None
) -> None:
    """Write the shapes of a sample file again with new, independent samples.

    Args:
        file: A sample file written by `generate`.
        seed: Seed of the new samples.
        out: The sample file to write (.npz).
        points: Points on each shape; as many as before by default.
    """
    data_gen.save(data_gen.resample(data_gen.load(file), seed, points), out)
    print(f"{out}: the shapes of {file} with new samples")


def transfers(
    family: Annotated[Positional[str], arg(metavar="FAMILY|CATEGORY")],
    /,
    *,
    count: int,
    points: int,
    out: Path,
    seed: int = 0,
    across: bool = False,
    single: bool = False,
) -> None:
    """Write triplets x, y, z and their true transfers: a sample file of all x, then all y, all z, and all truths.

    Args:
        family: A family, or a category for all its families.
        count: Number of triplets.
        points: Points on each shape; the truth has the samples of z.
        out: The sample file to write (.npz).
        seed: The same seed gives the same file.
        across: z is of another family than x and y, which differ in parameters that z has too.
        single: y differs from x in one parameter.
    """
    made = data_gen.transfers(family, count=count, points=points, seed=seed, across=across, single=single)
    data_gen.save(made, out)
    print(f"{out}: {count} transfers of shapes of {points} points")


def show(family: Family, /, *, out: Path | None = None, seed: int = 0, open: bool = True) -> None:
    """Write the contact sheet of a family, twelve random shapes and the sweep of each parameter, and open it.

    Args:
        family: Name of the family, as `list` prints it.
        out: The page to write (.html), and beside it the picture (.png); by default the family's name in this folder.
        seed: Seed of the shapes.
        open: Whether to open the page in the browser.
    """
    out = Path(f"{catalogue.file_name(family)}.html") if out is None else out
    if out.suffix != ".html":
        raise ValueError(f"show: --out must end in .html, got {out.name}; the picture is written beside it")
    seed = checked_seed(seed, "show")
    write_page(family, out, seed)
    catalogue.write_picture(family, out.with_suffix(".png"), seed)
    print(out)
    print(out.with_suffix(".png"))
    if open:
        webbrowser.open(out.resolve().as_uri())


def sheet(names: Families = (), /, *, out: Path, seed: int = 0) -> None:
    """Write the contact sheets of many families to a folder, with an index.html and one overview.png of them all.

    Args:
        names: Families or categories; all if none is given.
        out: The folder, made if it is missing.
        seed: Seed of the shapes.
    """
    names = catalogue.chosen(names)
    catalogue.write_sheets(names, out, seed)
    print(f"{out / 'index.html'}: {len(names)} {'family' if len(names) == 1 else 'families'}")


def mesh(family: Family, /, *, out: Path, values: Values = ()) -> None:
    """Write one shape as a mesh with a colour for each part.

    Args:
        family: Name of the family, as `list` prints it.
        out: The mesh to write (.glb, .obj or .ply).
        values: Parameters as name=value; the others stay in the middle of their ranges.
    """
    rig = data_gen.family(family)
    parameters = dict(zip(rig.parameter_names, rig.middle[0], strict=True))
    for name, value in map(_assigned, itertools.chain(*values)):
        if name not in parameters:
            names = ", ".join(parameters)
            raise ValueError(f"mesh: --set must name a parameter of {family}, one of {names}, got {name!r}; see list")
        parameters[name] = value
    save_mesh(data_gen.mesh(family, list(parameters.values())), out)
    print(out)


def paper(*, out: Path, only: str | None = None, lite: bool = False) -> None:
    """Write the counterparts of the paper's data sets, and a data sheet that says what each stands in for.

    Args:
        out: The folder, made if it is missing.
        only: One data set, such as poses/carton, or one group of them; all if none is given.
        lite: A hundredth of the shapes, to look around.
    """
    data_gen.paper(out, only=only, lite=lite, progress=lambda sets: tqdm(sets, unit="file"))
    print(f"{out / 'README.md'} says what is what")


def _degraded(noise, direction, seed, piece, first):
    piece = data_gen.seen_from(piece, direction, seed, first=first) if direction is not None else piece
    return data_gen.noisy(piece, noise, seed, first=first) if noise else piece


def _watched(pieces, count):
    """The pieces, with a bar of progress from the second on: what is refused shows none."""
    yield from tqdm(itertools.chain([next(pieces)], pieces), total=count, unit="piece")


def _assigned(text):
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        raise ValueError(f"--set {name} must be a number, got {value!r}; write {name}=0.5") from None


COMMANDS = {
    "list": list_families,
    "show": show,
    "sheet": sheet,
    "generate": generate,
    "resample": resample,
    "transfers": transfers,
    "mesh": mesh,
    "paper": paper,
}


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
