"""The areas of a family's triangles for many shapes at once.

Vertices are linear in the parameters, so the normal of a triangle, the product of two edges, is quadratic in them: a
sum over pairs of parameters, most of which are 0. All normals of all shapes are one matrix product.
"""

import numpy as np

SMALL = 1e-14


class Areas:
    """Doubled areas (N, F) of triangles for changes (N, p) of parameters, from vertices (V, 3) and slopes (p, V, 3)."""

    def __init__(self, vertices, slopes, triangles):
        terms = np.concatenate([vertices[None], slopes])
        origin, first, second = (terms[:, corner] for corner in triangles.T)
        first, second = first - origin, second - origin
        pairs = [(i, j) for i in range(len(terms)) for j in range(i, len(terms))]
        normals = [_normal(first, second, i, j) for i, j in pairs]
        kept = [k for k, normal in enumerate(normals) if np.abs(normal).max() > SMALL]
        self.pairs = np.array([pairs[k] for k in kept]).T
        self.normals = np.stack([normals[k].T.ravel() for k in kept])

    def __call__(self, change):
        terms = np.concatenate([np.ones((len(change), 1)), change], axis=1)
        products = np.prod([terms[:, which] for which in self.pairs], axis=0)
        normals = (products @ self.normals).reshape(len(change), 3, -1)
        normals *= normals
        return np.sqrt(normals.sum(axis=1))


def _normal(first, second, i, j):
    one = np.cross(first[i], second[j])
    return one if i == j else one + np.cross(first[j], second[i])
