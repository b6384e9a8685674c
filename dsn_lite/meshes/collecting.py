"""A folder of meshes as shapes to train on."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import torch
from jaxtyping import Float
from tqdm.auto import tqdm

from ..data import Shapes
from .files import READ, Y_UP, load_mesh
from .similarity import UPRIGHT, up_axis
from .surface import sample, triangles

FLOOR = -0.5  # where shapes stand, as those of data_gen do
UNLIKE = 20.0  # longest edges that differ more than this are in different units


def collect(paths: Iterable[str | Path], points: int = 512, *, up: str = "auto", seed: int = 0) -> Shapes:
    """Meshes as shapes (N, points, 3): sampled by area, upright, on one floor, centred, at one scale in [-0.5, 0.5].

    One scale for all keeps their sizes relative to each other. `up` is "y", "z" or "auto", which goes by the format and
    then by form. Raises ValueError where there is no file, or where sizes differ so much that units must.
    """
    files = [Path(path) for path in paths]
    if not files:
        raise ValueError(f"collect: at least one mesh file is needed, got none; files end in .{', .'.join(READ)}")
    if points < 2:
        raise ValueError(f"collect: points must be at least 2, got {points}; 512 is a good start")
    if up not in ("auto", *UPRIGHT):
        raise ValueError(f'collect: up must be "auto", "y" or "z", got {up!r}; try "auto"')
    boxes, clouds = zip(*_standing_all(files, points, up, seed), strict=True)
    sizes = np.array([np.ptp(box, axis=0).max() for box in boxes])
    if sizes.max() > UNLIKE * sizes.min():
        large, small = files[sizes.argmax()].name, files[sizes.argmin()].name
        raise ValueError(
            f"collect: files must be in one unit, {large} is {sizes.max() / sizes.min():.0f} times {small}; "
            "scale them alike, or leave one out"
        )
    scaled = [cloud / sizes.max() + np.array([0, FLOOR, 0]) for cloud in clouds]
    names = tuple(path.stem for path in files)
    about = {"up": "y", "sampling": "fresh"}
    return Shapes(torch.tensor(np.array(scaled), dtype=torch.float32), names=names, about=about)


def folder(path: str | Path) -> list[Path]:
    """The mesh files in a folder and below, in the order of their names. Raises ValueError where it is no folder."""
    path = Path(path)
    if not path.is_dir():
        raise ValueError(f"collect: {path} must be a folder of meshes, it is none; check its name")
    return sorted(file for file in path.rglob("*") if file.suffix.lower().lstrip(".") in READ)


def _standing_all(files: list[Path], n: int, up: str, seed: int) -> list[tuple]:
    """What `_standing` gives for each file; the files that cannot be used are all named at once."""
    found, problems = [], []
    for i, path in enumerate(tqdm(files, unit="mesh")):
        try:
            found.append(_standing(path, n, up, seed + i))
        except (ValueError, OSError) as problem:
            problems.append(f"  {problem}")
    if problems:
        listed = "\n".join(problems)
        raise ValueError(
            f"collect: every file must be a mesh, {len(problems)} of {len(files)} are none; "
            f"mend them or move them away:\n{listed}"
        )
    return found


def _standing(path: Path, n: int, up: str, seed: int) -> tuple[Float[np.ndarray, "2 3"], Float[np.ndarray, "n 3"]]:
    """The box of a mesh and samples of it, upright, on the floor y = 0 and centred in x and z."""
    mesh = load_mesh(path)
    cloud = sample(mesh, n, seed)
    if up == "auto":
        up = "y" if path.suffix.lower().lstrip(".") in Y_UP else up_axis(sample(mesh, 2048, seed))
    corners = triangles(mesh, f"collect: {path}").reshape(-1, 3) @ UPRIGHT[up].T
    box = np.array([corners.min(0), corners.max(0)])
    foot = np.array([box[:, 0].mean(), box[0, 1], box[:, 2].mean()])
    return box, cloud @ UPRIGHT[up].T - foot
