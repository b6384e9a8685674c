"""Clouds as scanners give them, for studies of robustness: with noise, or seen from one side only.

Parts and parameters stay those of the clean shapes, so that a space that was shown degraded clouds can be asked for
what is true of the clean ones. Fewer or more points are had from `resample(collection, seed, points=)`.
"""

from dataclasses import replace
from itertools import count

import numpy as np

from data_gen.draw import FRESH
from data_gen.families import family as rig_of
from data_gen.make import NOISE, VIEW, check_some, checked_seed, own_parameters, resample, stream
from data_gen.sample import SAMPLED
from data_gen.visible import visible

CANDIDATES = 4
"""So many samples are drawn at first for each that is to be seen; then twice as many, and so on."""


def noisy(collection, deviation, seed=0, *, first=0):
    """The same clouds with Gaussian noise on every coordinate, of a standard deviation in the unit that `about` says.

    A piece of a larger collection, of the rows from `first` on, gets the noise that it gets in the whole.
    Raises ValueError for a negative deviation.
    """
    if not 0 <= deviation < np.inf:
        raise ValueError(f"noisy: deviation must be finite and >= 0, got {deviation}; 0.005 is a good scanner's")
    points, seed = collection.points, checked_seed(seed, "noisy")
    noise = np.zeros(points.shape, points.dtype)
    for row, cloud in enumerate(noise, first):
        np.random.default_rng(stream(seed, NOISE, row)).standard_normal(dtype=points.dtype, out=cloud)
    noise *= deviation
    noise += points
    said = {"noise": {"deviation": float(deviation), "seed": seed}}
    return replace(collection, points=noise, about={**collection.about, **said})


def seen_from(collection, direction, seed=0, *, first=0):
    """The same shapes with as many new samples, all of them visible to an eye far away in a direction (3,).

    Visible are points on faces turned to the eye that no part of the shape hides, area-weighted. (0, 0, 1) sees the
    front, (0, 1, 0) what is up; a direction from which all is hidden does not exist. Noise comes after, not before.
    A piece of a larger collection, of the rows from `first` on, is seen as it is in the whole.
    Raises ValueError for a direction of no length, for no shapes, and for shapes that do not say what they were made
    from, or are not in the unit of their family.
    """
    direction, seed = _unit(direction), checked_seed(seed, "seen_from")
    if not collection.families_known or collection.parameters is None or collection.about.get("normalised"):
        raise ValueError(
            "seen_from: shapes must hold their family and parameters, in the family's unit, got points only or "
            "normalised ones; use what generate gives"
        )
    view = {"view": {"direction": direction.tolist(), "seed": seed}, "sampling": FRESH, "corresponds": False}
    about = {key: value for key, value in collection.about.items() if key != "noise"} | view
    check_some(collection, "seen_from")
    clean, own = replace(collection, about=about), stream(seed, VIEW).generate_state(first + len(collection), np.uint64)
    rows = [_seen(clean[i], direction, int(one)) for i, one in enumerate(own[first:])]
    return replace(clean, **{key: np.stack([row[key] for row in rows]) for key in SAMPLED})


def _seen(one, direction, seed):
    """Arrays (n, ...) of the visible samples of a collection of one shape."""
    rig, n = rig_of(one.family(0)), one.points.shape[1]
    vertices = rig.vertices(own_parameters(one, rig))[0]
    for doublings in count():
        many = resample(one, seed, points=CANDIDATES * n * 2**doublings)
        kept = np.flatnonzero(visible(vertices, rig.triangles, many.samples(0), direction))[:n]
        if len(kept) == n:
            return {key: getattr(many, key)[0, kept] for key in SAMPLED}


def _unit(direction):
    direction = np.asarray(direction, np.float64)
    if direction.shape != (3,) or not np.isfinite(direction).all() or not direction.any():
        given = direction.tolist()
        raise ValueError(f"seen_from: direction must be three numbers that are not all 0, got {given}; try (0, 0, 1)")
    return direction / np.linalg.norm(direction)
