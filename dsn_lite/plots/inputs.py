"""What figures accept: tensors, arrays or lists, as arrays, or refused in one sentence."""

from typing import Any

import numpy as np
from torch import Tensor

from .row import Cloud


def array(values: Any) -> np.ndarray:
    """A tensor, on any device, or anything like an array, as a numpy array."""
    return values.detach().cpu().numpy() if isinstance(values, Tensor) else np.asarray(values)


def clouds_of(points: Any, where: str) -> list[Cloud]:
    """The clouds of (n, 3), (m, n, 3) or a list. Raises ValueError where they are not finite (n, 3)."""
    several = [array(each) for each in points] if isinstance(points, (list, tuple)) else array(points)
    if not len(several):
        raise ValueError(f"{where}: points must be at least one cloud (n, 3), got none; check the selection before it")
    clouds = list(several) if isinstance(several, list) or several.ndim == 3 else [several]
    clouds = [each if each.dtype.kind == "f" else each.astype(np.float64) for each in clouds]
    for index, each in enumerate(clouds):
        if each.ndim != 2 or each.shape[1] != 3 or not len(each):
            raise ValueError(
                f"{where}: a shape must be (n, 3) points, shape {index} is {each.shape}; "
                "give (n, 3), (m, n, 3) or a list of (n, 3)"
            )
        if not np.isfinite(each).all():
            raise ValueError(f"{where}: points must be finite, shape {index} holds NaN or infinity; clean or drop it")
    return clouds


def cloud_of(points: Any, where: str) -> Cloud:
    """The one cloud (n, 3). Raises ValueError where there are several."""
    clouds = clouds_of(points, where)
    if len(clouds) > 1:
        raise ValueError(f"{where}: one shape (n, 3) is drawn here, got {len(clouds)}; pick one, such as x[0]")
    return clouds[0]


def labels_of(labels: Any, clouds: list[Cloud], where: str) -> list[np.ndarray | None]:
    """Labels for each cloud: (n,) for all, or one array or None each. Raises ValueError where they do not fit."""
    marks = _each(labels, clouds, flat=1)
    for index, (mark, cloud) in enumerate(zip(marks, clouds, strict=False)):
        if mark is not None and mark.shape != (len(cloud),):
            raise ValueError(
                f"{where}: labels must be one part index for each of the {len(cloud)} points of shape {index}, "
                f"got {mark.shape}; take them from the same shape"
            )
    return _one_each(marks, len(clouds), where, "labels")


def faces_of(faces: Any, clouds: list[Cloud], where: str) -> list[np.ndarray | None]:
    """Faces for each shape: (f, 3) for all, or one array, or None, each. Raises ValueError where they do not fit."""
    grids = _each(faces, clouds, flat=2)
    for index, (grid, cloud) in enumerate(zip(grids, clouds, strict=False)):
        if grid is None:
            continue
        if grid.ndim != 2 or grid.shape[1] != 3 or not len(grid) or grid.min() < 0 or grid.max() >= len(cloud):
            raise ValueError(
                f"{where}: faces must be (f, 3) indices of the {len(cloud)} points of shape {index}, got {grid.shape}; "
                "take points and faces from the same mesh"
            )
    return _one_each(grids, len(clouds), where, "faces")


def boxes_of(boxes: Any, count: int, where: str) -> list[np.ndarray | None]:
    """Corners (p, 8, 3) of boxes, or None, for each of `count` shapes. Raises ValueError where they do not fit."""
    several = _one_each([None] * count if boxes is None else list(boxes), count, where, "boxes")
    corners = [None if each is None else array(each) for each in several]
    for index, each in enumerate(corners):
        if each is not None and (each.ndim != 3 or each.shape[1:] != (8, 3) or not np.isfinite(each).all()):
            raise ValueError(
                f"{where}: boxes must be (p, 8, 3) finite corners, those of shape {index} are {each.shape}; "
                "take them from handles.corners"
            )
    return corners


def titles_of(titles: Any, count: int, where: str) -> list[str]:
    """One title a shape, or none at all. Raises ValueError where their number differs."""
    names = [] if titles is None else [titles] if isinstance(titles, str) else [str(title) for title in titles]
    if names and len(names) != count:
        raise ValueError(
            f"{where}: titles must be one for each of the {count} shapes, got {len(names)}; leave them out or add"
        )
    return names


def _each(values: Any, clouds: list[Cloud], flat: int) -> list[np.ndarray | None]:
    if values is None:
        return [None] * len(clouds)
    if isinstance(values, (list, tuple)) and not np.isscalar(values[0]):
        return [None if value is None else array(value) for value in values]
    shared = array(values)
    return [shared] * len(clouds) if shared.ndim <= flat else list(shared)


def _one_each(values: list, count: int, where: str, what: str) -> list:
    if len(values) != count:
        raise ValueError(
            f"{where}: {what} must be one array for each of the {count} shapes, got {len(values)}; add them"
        )
    return values
