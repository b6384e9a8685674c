"""Clouds each in a cube of its own, as in section 4.2 of the paper."""

from dataclasses import replace

UNITS = "a cube of its own for each cloud, [-1, 1]^3"
IN_ONE_UNIT = ("rest", "faces", "weights", "boxes", "joints")
"""What tells the truth about shapes only where all are in one unit."""


def normalised(collection):
    """The same clouds, each with the middle of its bounding box at 0 and its longest edge 2.

    Sizes can no longer be compared, so boxes, joints and samples are left out; labels, families and parameters stay.
    Raises ValueError for clouds with noise: its deviation would be another in each cube.
    """
    if "noise" in collection.about:
        told = collection.about["noise"]
        raise ValueError(f"normalised: clouds must be without noise, got noise {told}; add it to normalised clouds")
    low, high = collection.points.min(axis=1, keepdims=True), collection.points.max(axis=1, keepdims=True)
    points = (collection.points - (low + high) / 2) * (2 / (high - low).max(axis=2, keepdims=True))
    about = {**collection.about, "normalised": True, "units": UNITS}
    return replace(collection, points=points, about=about, **dict.fromkeys(IN_ONE_UNIT))
