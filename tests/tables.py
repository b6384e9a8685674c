"""What the tests of collections share: a few tables, and how two collections differ."""

import numpy as np

import data_gen
from data_gen.sample import KEYS, NAMES


def tables(**options):
    """A few small tables."""
    return data_gen.generate("table/four_legs", **{"count": 3, "points": 16, **options})


def arrays_differ(one, two):
    """The keys, other than `about`, in which two collections are not the same, bit for bit."""
    return [
        key for key in KEYS if key != "about" and not _equal(getattr(one, key), getattr(two, key), key not in NAMES)
    ]


def _equal(one, two, numbers):
    return one is two if one is None or two is None else np.array_equal(one, two, equal_nan=numbers)


def bytes_of(collection):
    """How many bytes its arrays take."""
    return sum(value.nbytes for value in vars(collection).values() if isinstance(value, np.ndarray))
