"""Samples, and where they stand: p = c + R diag(s) u, the product x = B z without its zeros."""

from typing import NamedTuple

import numpy as np


class Samples(NamedTuple):
    """Points of a family's surface, whatever its parameters: triangles (n,) or (N, n), weights (n, 2) or (N, n, 2).

    The point is (1 - u - v) a + u b + v c on a triangle with corners a, b, c. With (n,) all shapes share the samples.
    """

    faces: np.ndarray
    weights: np.ndarray

    @property
    def shared(self):
        """Whether all shapes have the same samples."""
        return self.faces.ndim == 1

    def row(self, i):
        """The samples (n,) of one shape."""
        return self if self.shared else Samples(self.faces[i], self.weights[i])


def blend(edges, samples):
    """Points (n, 3) of one shape's samples, from the edges (3, 3, F) of its triangles."""
    origin, first, second = edges.reshape(9, -1).take(samples.faces, axis=1).reshape(3, 3, -1)
    u, v = samples.weights.T
    first *= u
    second *= v
    origin += first
    origin += second
    return origin.T


def blend_corners(vertices, triangles, samples):
    """The same from vertices (3, V) and triangles (3, F): faster where samples are fewer than triangles."""
    corners = vertices.take(triangles.take(samples.faces, axis=1), axis=1)
    origin, u, v = corners[:, 0], *samples.weights.T
    corners[:, 1:] -= origin[:, None]
    return (origin + u * corners[:, 1] + v * corners[:, 2]).T


def edges_of(vertices, triangles):
    """Edges (..., 3, 3, F) of triangles (F, 3): first corner and the two edges from it, x, y, z, triangle.

    The triangle comes last because numpy then takes many of them much faster.
    """
    corners = np.moveaxis(vertices[..., triangles, :], -3, -1).copy()
    corners[..., 1:, :, :] -= corners[..., :1, :, :]
    return corners


def place(boxes, labels, rest, dtype):
    """Points (N, n, 3) in boxes (N, P, 15) at labels (n,), rest (n, 3) shared by all shapes, or (N, n), (N, n, 3)."""
    points = np.zeros((len(boxes), *rest.shape[-2:]), dtype)
    turned = (boxes[:, :, 3:12] != np.eye(3).ravel()).any(axis=2)
    boxes = boxes.astype(dtype)
    for i, box in enumerate(boxes):
        own = labels if labels.ndim == 1 else labels[i]
        u = rest if rest.ndim == 2 else rest[i]
        np.multiply(box[:, 12:].take(own, axis=0), u, out=points[i])
        for part in np.flatnonzero(turned[i]):
            points[i, own == part] @= box[part, 3:12].reshape(3, 3).T
        points[i] += box[:, :3].take(own, axis=0)
    return points


def combined(shares, terms):
    """Sums (N, ...) of terms (p, ...) by shares (N, p). Last digits of `@` depend on N, those of this do not."""
    return np.einsum("np,pk->nk", shares, terms.reshape(len(terms), -1)).reshape(-1, *terms.shape[1:])


def relative(points, boxes, labels):
    """Where points (N, n, 3) lie in their parts' boxes (N, P, 15), if these are not turned."""
    found = points.copy()
    for i, box in enumerate(boxes.astype(points.dtype)):
        own = labels if labels.ndim == 1 else labels[i]
        found[i] -= box[:, :3].take(own, axis=0)
        found[i] /= box[:, 12:].take(own, axis=0)
    return found


def blocks(shapes, size):
    """Slices over `shapes` shapes of `size` numbers, so few at a time that what is made on the way stays small."""
    step = max(1, 2**16 // size)
    return [slice(start, min(start + step, shapes)) for start in range(0, shapes, step)]
