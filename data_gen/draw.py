"""Shapes and samples at random.

The parameters, the patch of a point, and its two coordinates there are four streams of random numbers, each with its
own seed. So the parameters depend neither on how points are sampled nor on how many, and the first shapes of a large
collection are those of a small one.
"""

import numpy as np

from data_gen.families import family as rig_of
from data_gen.part import Box
from data_gen.points import blocks
from data_gen.sample import VERSION, Collection

SAMPLING = ("fresh", "shared")
DTYPES = ("float32", "float64")


def generate(family, *, count, points, seed=0, sampling="fresh", dtype="float32"):
    """A collection of `count` shapes of `points` points of one family, of which everything is known.

    `fresh` samples are independent from shape to shape and area-weighted for each; `shared` ones are drawn once,
    area-weighted for the family's middle shape, so that points correspond by index. `float64` keeps full precision in
    memory; files hold float32. All faces of all parts are sampled, also those where parts touch.
    Raises ValueError for an unknown family or sampling, no shapes, or fewer than two points.
    """
    rig = rig_of(family)
    _check(count, points, sampling, dtype)
    _check_seed(seed, "generate")
    for_shapes, for_samples = np.random.SeedSequence(seed).spawn(2)
    parameters = rig.draw(count, np.random.default_rng(for_shapes))
    about = {**_about(rig), "seed": seed, "sampling": sampling, "corresponds": sampling == "shared"}
    return _sampled(rig, parameters, points, for_samples, about, dtype)


def resample(collection, seed):
    """The same shapes with new samples, independent of the old ones even where the seeds are equal.

    Raises ValueError for a collection that does not say what it was made from.
    """
    if "family" not in collection.about or collection.parameters is None:
        raise ValueError("resample: a collection must hold its family and parameters, got points only; use generate")
    _check_seed(seed, "resample")
    rig = rig_of(collection.about["family"])
    for_samples = np.random.SeedSequence(seed, spawn_key=(2,))
    about = {**collection.about, "resampled": seed}
    parameters = collection.parameters.astype(np.float64)
    return _sampled(rig, parameters, collection.points.shape[1], for_samples, about, collection.points.dtype)


def fresh(rig, parameters, points, seed):
    """Labels (N, n) int16 and rest coordinates (N, n, 3) float32, area-weighted for each shape, in random order.

    A point's patch is the number of patches whose cumulative share of the area its first random number reaches.
    """
    streams = [np.random.default_rng(stream) for stream in seed.spawn(3)]
    shares = _shares(rig, parameters)
    labels = np.zeros((len(parameters), points), np.int16)
    rest = np.zeros((*labels.shape, 3), np.float32)
    for rows in blocks(*labels.shape):
        which, u, v = (stream.random(labels[rows].shape, np.float32) for stream in streams)
        chosen = np.zeros(which.shape, np.int16)
        for share in shares[rows].T:
            chosen += which >= share[:, None]
        labels[rows], patch = np.divmod(chosen, np.int16(Box.PATCHES))
        rest[rows] = Box.rest(patch.ravel(), u.ravel(), v.ravel()).reshape(*u.shape, 3)
    return labels, rest


def shared(rig, points, seed):
    """Labels (n,) and rest coordinates (n, 3), area-weighted for the shape in the middle of the parameter ranges."""
    labels, rest = fresh(rig, rig.middle, points, seed)
    return labels[0], rest[0]


def _shares(rig, parameters):
    """Cumulative shares of the area (N, K - 1) float32 of all patches of all parts but the last."""
    extents = rig.boxes(parameters)[:, :, 12:]
    areas = Box.areas(extents).reshape(len(parameters), -1).cumsum(axis=1)
    return (areas[:, :-1] / areas[:, -1:]).astype(np.float32)


def _sampled(rig, parameters, points, seed, about, dtype):
    if about["sampling"] == "fresh":
        labels, rest = fresh(rig, parameters, points, seed)
    else:
        labels, rest = shared(rig, points, seed)
    return Collection(
        points=rig.place(labels, rest, parameters, dtype),
        labels=labels,
        rest=rest,
        boxes=rig.boxes(parameters).astype(dtype),
        parameters=parameters.astype(dtype),
        parameter_names=rig.parameter_names,
        part_names=rig.part_names,
        names=tuple(f"{rig.name}/{i:05d}" for i in range(len(parameters))),
        joints=np.zeros((len(parameters), 0, 8), dtype),
        about=about,
    )


def _about(rig):
    truth = {
        "linear": True,
        "ranges": {parameter.name: [parameter.low, parameter.high] for parameter in rig.parameters},
        "symmetric_pairs": [list(pair) for pair in rig.symmetric],
        "contacts": [list(contact) for contact in rig.contacts],
        "joint_tree": [],
    }
    axes = {"up": "y", "front": "+z", "mirror": "x=0", "units": "the unit cube [-0.5, 0.5]^3"}
    return {"family": rig.name, "rigs": {rig.name: truth}, "version": VERSION, "split": None, **axes}


def _check(count, points, sampling, dtype):
    whole = isinstance(count, int | np.integer) and isinstance(points, int | np.integer)
    if not whole or count < 1 or points < 2:
        raise ValueError(f"generate: count must be whole and >= 1, points >= 2, got {count} and {points}; ask for more")
    if sampling not in SAMPLING:
        raise ValueError(f"generate: sampling must be fresh or shared, got {sampling!r}; fresh is the default")
    if dtype not in DTYPES:
        raise ValueError(f"generate: dtype must be float32 or float64, got {dtype!r}; files hold float32")


def _check_seed(seed, where):
    if not isinstance(seed, int | np.integer) or seed < 0:
        raise ValueError(f"{where}: seed must be a whole number >= 0, got {seed}; choose one")
