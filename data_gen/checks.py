"""Whether a collection keeps the contract of `sample.py`: its shapes and types, and its numbers."""

import numpy as np

REALS = ("points", "rest", "weights", "boxes", "parameters", "joints")
WHOLE = ("labels", "faces", "families")


def check(collection, where):
    """Raise ValueError, beginning with `where`, unless the collection keeps the contract."""
    check_shapes(collection, where)
    _check_finite(collection, where)
    _check_labels(collection, where)
    _check_families(collection, where)


def check_shapes(collection, where):
    """The same for shapes and types alone: nothing of the arrays is read."""
    _check_points(collection.points, where)
    for key in (*REALS, *WHOLE):
        value, (kind, word) = getattr(collection, key), ("f", "floats") if key in REALS else ("i", "integers")
        if value is not None and value.dtype.kind != kind:
            raise ValueError(f"{where}: {key} must be {word}, got {value.dtype}; write the file with save")
    for key, shapes in _shapes(collection).items():
        value = getattr(collection, key)
        if value is not None and np.shape(value) not in shapes:
            wanted = " or ".join(str(shape) for shape in shapes)
            raise ValueError(f"{where}: {key} must be {wanted}, got {np.shape(value)}; it has to fit the points")


def _check_points(points, where):
    if points.ndim != 3 or points.shape[-1] != 3 or points.dtype.kind != "f":
        raise ValueError(
            f"{where}: points must be (N, n, 3) floats, got {points.shape} {points.dtype}; stack the clouds"
        )
    if points.shape[0] < 1 or points.shape[1] < 2:
        raise ValueError(f"{where}: points must hold a shape of two points or more, got {points.shape}; sample more")


def _shapes(collection):
    N, n, _ = collection.points.shape
    P = len(collection.part_names or ())
    J = 0 if collection.joints is None or collection.joints.ndim != 3 else collection.joints.shape[1]
    return {
        "labels": ((N, n), (n,)),
        "rest": ((N, n, 3), (n, 3)),
        "faces": ((N, n), (n,)),
        "weights": ((N, n, 2), (n, 2)),
        "families": ((N,),),
        "boxes": ((N, P, 15),),
        "parameters": ((N, len(collection.parameter_names or ())),),
        "names": ((N,),),
        "joints": ((N, J, 8),),
    }


def _check_finite(collection, where):
    mixed = collection.families is not None
    for key in ("points", "rest", "weights", *(() if mixed else ("parameters",))):
        value = getattr(collection, key)
        if value is not None and not np.isfinite(value).all():
            row = int(np.argwhere(~np.isfinite(value))[0][0])
            raise ValueError(f"{where}: {key} must be finite, got NaN or infinity in row {row}; leave that shape out")


def _check_labels(collection, where):
    labels, parts = collection.labels, len(collection.part_names or ())
    if labels is not None and (labels.min() < -1 or labels.max() >= parts):
        raise ValueError(
            f"{where}: labels must be from -1 to {parts - 1}, one a part, got {labels.min()} to {labels.max()}; "
            "number the parts as in part_names"
        )


def _check_families(collection, where):
    families, known = collection.families, len(collection.family_names)
    if families is not None and (families.min() < 0 or families.max() >= known):
        raise ValueError(
            f"{where}: families must be rows of the {known} in about, got {families.min()} to {families.max()}; "
            "name them there"
        )
