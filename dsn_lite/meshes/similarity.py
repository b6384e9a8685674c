"""The similarity that brings a foreign shape into the training box, and the axis that points up."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

from ..data import Frame

CLEAR = 2.0  # how many times less symmetric up must be than front to back before it is believed
UPRIGHT = {"y": np.eye(3), "z": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])}  # z up, front -y


@dataclass(frozen=True)
class Similarity:
    """q = scale R p + translation: p in the unit of a file, q in the training box; R turns by 0 or 90 degrees."""

    scale: float
    rotation: Float[np.ndarray, "3 3"]
    translation: Float[np.ndarray, " 3"]

    @classmethod
    def into(cls, frame: Frame, points: Float[np.ndarray, "n 3"], up: str = "y") -> "Similarity":
        """Brings these points into a frame: upright, the longest edge of their box as long, anchored at the same place.

        `up` is "y" or "z". Raises ValueError where all the points are one point.
        """
        turned = np.asarray(points, dtype=np.float64) @ UPRIGHT[up].T
        low, high = turned.min(0), turned.max(0)
        if not (high - low).max() > 0:
            raise ValueError("Similarity.into: points must have an extent, all of them are one point; check the file")
        scale = frame.size / (high - low).max()
        held = low + np.asarray(frame.share) * (high - low)
        return cls(float(scale), UPRIGHT[up], np.asarray(frame.anchor) - scale * held)

    def apply(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
        """From the file into the training box."""
        return self.scale * (np.asarray(points, dtype=np.float64) @ self.rotation.T) + self.translation

    def undo(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
        """From the training box back to the file."""
        return self.undo_offsets(np.asarray(points, dtype=np.float64) - self.translation)

    def undo_offsets(self, offsets: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
        """Offsets measured in the training box, in the unit and axes of the file."""
        return np.asarray(offsets, dtype=np.float64) @ self.rotation / self.scale


def up_axis(points: Float[np.ndarray, "n 3"]) -> str:
    """The axis that points up, "y" or "z", judged by form: "z" only where it is clear, else "y".

    Things that stand are mirror images of themselves left to right and often front to back, but not bottom to top. So
    up is the axis across which a shape is least like its mirror image; a chair, unlike its own across two axes, stays
    undecided.
    """
    return "z" if asymmetry(points, 2) > CLEAR * asymmetry(points, 1) else "y"


def asymmetry(points: Float[np.ndarray, "n 3"], axis: int) -> float:
    """Root mean square distance from the points, mirrored across the middle of their box, to the nearest points."""
    points = np.asarray(points, dtype=np.float64)
    mirrored = points.copy()
    mirrored[:, axis] = points[:, axis].min() + points[:, axis].max() - points[:, axis]
    distance, _ = cKDTree(points).query(mirrored)
    return float(np.sqrt(np.square(distance).mean()))
