"""Handles and samples in, points out, for all shapes at once: p = c + s * u, the product x = B z without its zeros."""

import numpy as np


def place(z, labels, rest, dtype):
    """Points (N, n, 3) for handles (N, P, 2, 3), labels (n,) and rest (n, 3) shared by all, or (N, n), (N, n, 3)."""
    centres, extents = np.moveaxis(z.astype(dtype), 2, 0)
    points = np.zeros((len(z), *rest.shape[-2:]), dtype)
    for rows in blocks(*points.shape[:2]):
        own = ... if labels.ndim == 1 else rows
        points[rows] = _spread(extents[rows], labels[own])
        points[rows] *= rest[own]
        points[rows] += _spread(centres[rows], labels[own])
    return points


def blocks(shapes, points):
    """Slices over `shapes` clouds of `points` points, so few at a time that what is made on the way stays in cache."""
    step = max(1, 2**15 // points)
    return [slice(start, min(start + step, shapes)) for start in range(0, shapes, step)]


def _spread(values, labels):
    """Values (N, P, 3) of parts given to their points (N, n, 3)."""
    shapes, parts, _ = values.shape
    if labels.ndim == 1:
        columns = (3 * labels.astype(np.intp)[:, None] + np.arange(3)).ravel()
        return values.reshape(shapes, -1).take(columns, axis=1).reshape(shapes, -1, 3)
    return values.reshape(-1, 3).take(labels + parts * np.arange(shapes)[:, None], axis=0)
