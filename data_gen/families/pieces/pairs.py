"""Pairs of parts that families declare: those that mirror each other, those that touch."""

from itertools import pairwise

from data_gen.rig import Contact


def itself(*parts):
    """Symmetric pairs of parts in the middle, each with itself."""
    return tuple((part, part) for part in parts)


def stack(*parts):
    """The contacts of parts that stand on each other, the lowest first."""
    return tuple(Contact(low, high, "face_y") for low, high in pairwise(parts))
