"""Whether a collection keeps the contract of `sample.py`: its shapes and types, and its numbers."""

import numpy as np

REALS = ("points", "rest", "weights", "boxes", "parameters", "joints")
WHOLE = ("labels", "faces", "families")


def check(collection, where):
    """Raise ValueError, beginning with `where`, unless it is a collection that keeps the contract."""
    check_kind(collection, where)
    check_shapes(collection, where)
    _check_finite(collection, where)
    _check_labels(collection, where)
    _check_families(collection, where)


def check_kind(collection, where):
    """Raise ValueError, beginning with `where`, unless this is a Collection: shapes of other packages are not."""
    if not hasattr(type(collection), "families_known"):
        raise ValueError(
            f"{where}: shapes must be a Collection of data_gen, got {type(collection).__name__}; take what generate or "
            "load gives, or make a Collection of points"
        )


def check_shapes(collection, where):
    """The same as `check` for shapes and types alone: nothing of the arrays is read."""
    for key in (*REALS, *WHOLE):
        value, (kinds, word) = getattr(collection, key), ("fiu", "real") if key in REALS else ("iu", "whole")
        if not isinstance(value, np.ndarray) and (value is not None or key == "points"):
            raise ValueError(f"{where}: {key} must be an array, got {type(value).__name__}; wrap it in numpy.asarray")
        if value is not None and value.dtype.kind not in kinds:
            raise ValueError(f"{where}: {key} must be {word} numbers, got {value.dtype}; write the file with save")
    _check_points(collection.points, where)
    _check_about(collection.about, where)
    for key, shapes in _shapes(collection).items():
        value = getattr(collection, key)
        if value is not None and np.shape(value) not in shapes:
            wanted = " or ".join(str(shape) for shape in shapes)
            raise ValueError(f"{where}: {key} must be {wanted}, got {np.shape(value)}; it has to fit the points")


def _check_points(points, where):
    if points.ndim != 3 or points.shape[-1] != 3:
        raise ValueError(f"{where}: points must be (N, n, 3), got {points.shape}; stack the clouds")
    if points.shape[0] < 1 or points.shape[1] < 2:
        raise ValueError(f"{where}: points must hold a shape of two points or more, got {points.shape}; sample more")


def _check_about(about, where):
    if not isinstance(about, dict):
        raise ValueError(f"{where}: about must be a dict, got {type(about).__name__}; take that of the collection")
    families = about.get("families", [])
    if not _are_texts(families) or not isinstance(about.get("family", ""), str):
        said = families if "families" in about else about["family"]
        raise ValueError(
            f"{where}: about must name its family, or list its families, as text, got {said!r}; write it with save"
        )


def _are_texts(value):
    return isinstance(value, (list, tuple)) and all(isinstance(one, str) for one in value)


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
