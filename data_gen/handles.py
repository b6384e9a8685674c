"""The handles of a shape, x = B z0: of each part where its box stands, along its own axes, and its edge lengths."""

import numpy as np

from data_gen.checks import check_kind


def handles(collection, i):
    """Handle matrix B (n, 3, 6P) and handles z0 (6P,) of one shape: for part after part centre 3, edge lengths 3.

    A point is R (c + diag(s) u) with u its rest coordinates and R the fixed rotation of its part's box. Columns of
    parts that the shape does not have are 0, and so are their handles; points of no part (label -1) have rows of 0, so
    that B z0 leaves them at the origin. Raises ValueError for shapes without parts, and for a row that is not there.
    """
    check_kind(collection, "handles")
    if not -len(collection) <= i < len(collection):
        raise ValueError(f"handles: i must be the row of one of {len(collection)} shapes, got {i}; count from 0")
    if any(value is None for value in (collection.labels, collection.rest, collection.boxes)):
        raise ValueError(
            "handles: shapes must have labels, rest coordinates and boxes, got none; make them with generate"
        )
    labels = collection.labels if collection.labels.ndim == 1 else collection.labels[i]
    rest = collection.rest if collection.rest.ndim == 2 else collection.rest[i]
    boxes = np.nan_to_num(collection.boxes[i].astype(np.float64))
    turn = boxes[:, 3:12].reshape(-1, 3, 3)
    B = np.zeros((len(labels), 3, len(boxes), 2, 3))
    held = np.flatnonzero(labels >= 0)
    own = labels[held]
    B[held, :, own, 0] = turn[own]
    B[held, :, own, 1] = turn[own] * rest[held, None]
    z0 = np.stack([np.einsum("pij,pi->pj", turn, boxes[:, :3]), boxes[:, 12:]], axis=1)
    return B.reshape(len(labels), 3, -1), z0.ravel()
