"""THE contract: one sample file, the only place where shapes made here and their readers meet.

An .npz archive, or a folder of .npy files (`shards.py`). Only `points` is required.
N shapes, n points, P parts, p parameters, J joints:

| key             | shape           | meaning                                                                     |
|-----------------|-----------------|-----------------------------------------------------------------------------|
| points          | (N, n, 3) f4    | clouds, in [-0.5, 0.5] on each axis unless `about` says else                 |
| labels          | (N, n) i2       | index of the point's part, or -1; (n,) where all shapes share it            |
| rest            | (N, n, 3) f4    | the point in its part's unit box; (n, 3) where all shapes share it          |
| faces           | (N, n) i2       | triangle of the family's mesh; (n,) where all shapes share it               |
| weights         | (N, n, 2) f4    | weights of its 2nd and 3rd corner; (n, 2) where all shapes share them       |
| boxes           | (N, P, 15) f4   | centre 3, rotation 9 by rows, edge lengths 3; NaN rows for parts not there  |
| parameters      | (N, p) f4       | what the shape was made from; NaN where its family has no such parameter    |
| parameter_names | (p,) text       |                                                                             |
| part_names      | (P,) text       |                                                                             |
| names           | (N,) text       | one a shape                                                                 |
| joints          | (N, J, 8) f4    | axis 3, pivot 3, value, 0 hinge or 1 slide; NaN rows for joints not there   |
| families        | (N,) i2         | index into the families of `about`, where it names several                  |
| about           | text            | JSON: family or families, seed, axes, sampling, and each family's truth     |

Part names that end in _1, _2, ..., or in _left, _right, _front, _rear, _back, _top, _bottom, are parts of one kind:
leg_1 and leg_2 are legs, wing_left and wing_right wings (NUMBERED in `colours.py`). A joint's axis and pivot are where
they stand in the shape; `about` says what parts it moves, `on` which part it hangs, and which joint carries it (-1:
none). Its `contacts` list flush faces only: parts that are set into each other touch too, but are not listed. It may
also say `split`, rows {"train": [start, stop], "validation": [...], "test": [...]}; `fixed`, parameters that do not
vary; `normalised`, where each cloud has a cube of its own; `noise` and `view`, where clouds were degraded.
"""

import json
from dataclasses import dataclass, field, fields, replace

import numpy as np

from data_gen.checks import REALS, WHOLE
from data_gen.points import Samples

VERSION = 1
"""Of this contract, not of the package."""
MOST = np.iinfo(np.int16).max
STORED = dict.fromkeys(REALS, "<f4") | dict.fromkeys(WHOLE, "<i2")
NAMES = ("parameter_names", "part_names", "names")


@dataclass(frozen=True)
class Collection:
    """The contents of a sample file; what a file leaves out is None. Shapes as in the table above."""

    points: np.ndarray
    labels: np.ndarray | None = None
    rest: np.ndarray | None = None
    faces: np.ndarray | None = None
    weights: np.ndarray | None = None
    boxes: np.ndarray | None = None
    parameters: np.ndarray | None = None
    parameter_names: tuple[str, ...] | None = None
    part_names: tuple[str, ...] | None = None
    names: tuple[str, ...] | None = None
    joints: np.ndarray | None = None
    families: np.ndarray | None = None
    about: dict = field(default_factory=dict)

    def __len__(self):
        return len(self.points)

    def __getitem__(self, rows):
        """The shapes with these indices, or of a slice, in this order; one index gives a collection of one."""
        kept = rows if isinstance(rows, slice) else np.arange(len(self))[rows].reshape(-1)
        taken = {
            "about": self.about | ({"split": None} if "split" in self.about else {})
        }  # its rows are those of the whole
        for key in PER_SHAPE:
            value = getattr(self, key)
            if value is not None and np.ndim(value) != AXES_IF_SHARED.get(key):
                taken[key] = tuple(np.array(value, object)[kept]) if key == "names" else value[kept]
        return replace(self, **taken)

    @property
    def family_names(self):
        """Names of the families in it, empty if it does not say."""
        return tuple(self.about.get("families", [self.about["family"]] if "family" in self.about else []))

    @property
    def families_known(self):
        """Whether every shape says its family."""
        return bool(self.family_names) and (len(self.family_names) == 1 or self.families is not None)

    def family(self, i):
        """Name of the family of one shape."""
        return self.family_names[0 if self.families is None else int(self.families[i])]

    def samples(self, i):
        """The samples (n,) of one shape."""
        return Samples(self.faces, self.weights).row(i)


KEYS = tuple(key.name for key in fields(Collection))
PER_SHAPE = tuple(key for key in KEYS if key not in ("parameter_names", "part_names", "about"))
SAMPLED = {"points": (3,), "labels": (), "rest": (3,), "faces": (), "weights": (2,)}
"""What there is of each point, and of what shape."""
AXES_IF_SHARED = {"labels": 1, "rest": 2, "faces": 1, "weights": 2}
"""Numbers of axes of what all shapes may share."""


def stored(key, value):
    """What a file holds of a key: an array of the type that the contract says. Raises ValueError if it has no room."""
    if key in WHOLE and not -MOST - 1 <= value.min() <= value.max() <= MOST:
        raise ValueError(f"save: {key} must be {MOST} at most, got {value.max()}; that is all a file has room for")
    return np.asarray(value, STORED.get(key, "U"), order="C")


def parsed(text, where):
    """What `about` says. Raises ValueError, beginning with `where`, if that is no JSON object, or lists no `arrays`."""
    try:
        about = json.loads(text)
    except (ValueError, RecursionError):
        about = None
    if not isinstance(about, dict):
        raise ValueError(f"{where} must hold a JSON object in about, got {text[:40]!r}; write it with data_gen")
    arrays = about.get("arrays", [])
    if not isinstance(arrays, list) or not all(isinstance(key, str) for key in arrays):
        raise ValueError(f"{where} must list the names of its arrays in about, got {arrays!r}; write it with data_gen")
    return about


def as_collection(found, about, where):
    """A collection of the arrays found in a file; what the contract does not know is left out.

    Raises ValueError, beginning with `where`, if points are missing or something is of another kind.
    """
    if "points" not in found:
        held = ", ".join(sorted(found)) or "nothing we know"
        raise ValueError(f"{where} must hold an array called points, got {held}; name the clouds so")
    known = {key: _taken(key, found[key], where) for key in KEYS if key in found and key != "about"}
    return Collection(**known, about=about)


def _taken(key, value, where):
    """What others may write in another type, as it is used here: names as a tuple, whole coordinates as floats."""
    if not isinstance(value, np.ndarray):
        raise ValueError(f"{where}: {key} must be an array, got an archive of arrays; write it with data_gen")
    if key in NAMES and (value.ndim != 1 or value.dtype.kind != "U"):
        raise ValueError(
            f"{where}: {key} must be a list of text, got {value.shape} {value.dtype}; write it with data_gen"
        )
    if key in NAMES:
        return tuple(value.tolist())
    real = key in REALS and value.dtype.kind in "iu"
    return value.astype(np.float32) if real else value.astype(np.int64) if value.dtype.kind == "u" else value
