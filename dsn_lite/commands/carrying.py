"""collect, deform and transfer: meshes in and out."""

import sys
import warnings
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from tyro.conf import OmitArgPrefixes, Positional, arg

from ..files import save_shapes
from .runs import Out, Run, space_of


@dataclass(frozen=True)
class Carrying:
    """How meshes are brought into the training box and deformed there."""

    up: tuple[Literal["auto", "y", "z"], ...] = ("auto",)
    """The axis that points up, for all meshes or for each in turn; auto goes by the format, then by the form."""
    subdivide: float | None = None
    """Split edges longer than this share of the longest extent first; 0.05 is a good start."""
    seed: int = 0
    """Seed of the points sampled on the meshes."""

    def told(self) -> dict[str, Any]:
        """As meshes.deform and meshes.transfer take it."""
        return asdict(self) | {"up": self.up[0] if len(self.up) == 1 else self.up}


CARRYING = Carrying()


def collect(
    folder: Positional[Annotated[Path, arg(metavar="FOLDER")]],
    /,
    *,
    out: Out,
    points: int = 512,
    up: Literal["auto", "y", "z"] = "auto",
    seed: int = 0,
) -> None:
    """Make a sample file to train on from a folder of meshes: sampled, upright, on one floor, at one scale.

    Args:
        folder: Its .glb, .gltf, .obj, .ply, .stl and .off files are taken, those of folders in it too.
        out: The sample file (.npz) to write.
        points: How many points are sampled on each mesh.
        up: The axis that points up in all files; auto goes by the format, then by the form.
        seed: Seed of the samples.
    """
    from .. import meshes

    shapes = meshes.collect(meshes.folder(folder), points, up=up, seed=seed)
    save_shapes(shapes, out)
    print(f"{out}: {len(shapes)} shapes of {points} points")


def deform(
    run: Run,
    source: Positional[Annotated[Path, arg(metavar="SOURCE")]],
    target: Positional[Annotated[Path, arg(metavar="TARGET")]],
    /,
    *,
    out: Out,
    how: OmitArgPrefixes[Carrying] = CARRYING,
) -> None:
    """Deform a mesh towards another one; its faces, colours, materials and UVs stay.

    Args:
        run: A run folder, or the name of a ready-made space.
        source: The mesh to deform (.glb, .gltf, .obj, .ply, .stl or .off).
        target: The mesh to come near to.
        out: The mesh to write (.glb, .obj, .ply or .stl).
        how: How meshes are brought into the training box.
    """
    from .. import meshes  # trimesh loads slowly, and the other commands do without

    save_mesh(meshes.deform(space_of(run), source, target, **how.told()), out)


def transfer(
    run: Run,
    x: Positional[Annotated[Path, arg(metavar="X")]],
    y: Positional[Annotated[Path, arg(metavar="Y")]],
    z: Positional[Annotated[Path, arg(metavar="Z")]],
    /,
    *,
    out: Out,
    how: OmitArgPrefixes[Carrying] = CARRYING,
) -> None:
    """Do to the mesh Z what turns the mesh X into the mesh Y.

    Args:
        run: A run folder, or the name of a ready-made space.
        x: The mesh before.
        y: The mesh after.
        z: The mesh to change.
        out: The mesh to write (.glb, .obj, .ply or .stl).
        how: How meshes are brought into the training box.
    """
    from .. import meshes

    save_mesh(meshes.transfer(space_of(run), x, y, z, **how.told()), out)


def save_mesh(mesh: object, out: Path) -> None:
    """Writes a mesh and prints where; what the format does not keep is said on stderr."""
    from .. import meshes

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        meshes.save_mesh(mesh, out)
    for warning in caught:
        print(warning.message, file=sys.stderr)
    print(out)
