"""Collections: shapes of one family, or of several mixed at random, in memory or piece by piece."""

import zlib
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from data_gen.assemble import about, assembled
from data_gen.draw import FRESH, SHARED, Source
from data_gen.families import categories, families
from data_gen.families import family as rig_of
from data_gen.normalise import normalised

DTYPES = ("float32", "float64")
DEGRADED = ("noise", "view")
"""What `about` says of clouds that are not as they were sampled."""
CHOICE, SHAPES, AGAIN, NOISE, VIEW = range(5)
"""What random numbers are for: the first number of every `stream`'s key, so that no two of them are the same."""


def generate(family, *, count, points, seed=0, sampling="fresh", dtype="float32", fixed=None):
    """A collection of `count` shapes of `points` points, of which everything is known.

    `family` is the name of a family, of a category ("chair": all its families), or several names; where there is more
    than one family, that of each shape is drawn at random. `fresh` samples are independent from shape to shape and
    area-weighted for each; `shared` ones are drawn once a family, area-weighted for its middle shape, so that points
    correspond by index inside a family. `float64` keeps full precision in memory; files hold float32. `fixed` maps
    names of parameters to values that all shapes have; the others are drawn as without it. All faces of all parts are
    sampled, also those where parts touch. The shapes of two families are independent; those of one family are the same
    for equal seeds, whatever they are mixed with.
    Raises ValueError for an unknown family, sampling or parameter, no shapes, or fewer than two points.
    """
    options = {"seed": seed, "sampling": sampling, "dtype": dtype, "fixed": fixed}
    return next(pieces(family, count=count, points=points, size=count, **options))


def pieces(family, *, count, points, seed=0, sampling="fresh", dtype="float32", fixed=None, size=1000):
    """The same collection as `generate` makes, `size` shapes at a time: for collections that do not fit in memory."""
    rigs = [rig_of(name) for name in _names(family)]
    _check(count, points, sampling, dtype, size)
    seed, fixed = checked_seed(seed, "generate"), _checked_fixed(rigs, fixed)
    sources = [Source(rig, points, sampling, stream(seed, SHAPES, rig.name).spawn(2)) for rig in rigs]
    chosen = np.random.default_rng(stream(seed, CHOICE)).integers(len(rigs), size=count).astype(np.int16)
    said = {"seed": seed, "sampling": sampling, "corresponds": sampling == SHARED, "fixed": fixed}
    return _pieces(sources, chosen, size, fixed, {**about(rigs), **said}, dtype)


def resample(collection, seed, points=None):
    """The same shapes with new samples, clean and from all sides, independent of the old ones even for equal seeds.

    `points` is how many, as many as before by default. `about` lists the seeds of this and of earlier times under
    "resampled". Raises ValueError for a collection of no shapes, or that does not say what it was made from.
    """
    if not collection.families_known or collection.parameters is None:
        raise ValueError("resample: a collection must hold its family and parameters, got points only; use generate")
    check_some(collection, "resample")
    n, sampling = collection.points.shape[1] if points is None else points, collection.about.get("sampling", FRESH)
    if not _whole(n) or n < 2:
        raise ValueError(f"resample: points must be whole and >= 2, got {n}; ask for more")
    rigs = [rig_of(name) for name in collection.family_names]
    seeds = [*_seeds_before(collection), checked_seed(seed, "resample")]
    sources = [Source(rig, n, sampling, (None, stream(seeds[-1], AGAIN, rig.name, *seeds[:-1]))) for rig in rigs]
    which = np.zeros(len(collection), np.int16) if collection.families is None else collection.families
    given = [own_parameters(collection, rig)[which == i] for i, rig in enumerate(rigs)]
    said = {key: value for key, value in collection.about.items() if key not in DEGRADED}
    made = assembled(sources, which, given, collection.points.dtype)
    made = replace(made, names=collection.names, about={**said, "resampled": seeds})
    return normalised(made) if said.get("normalised") else made


def own_parameters(collection, rig):
    """The parameters (N, p) that a family has, float64."""
    columns = [collection.parameter_names.index(name) for name in rig.parameter_names]
    return collection.parameters[:, columns].astype(np.float64)


def stream(seed, *key):
    """The seed of random numbers that no other key of whole numbers and texts has (numpy's SeedSequence)."""
    coded = (zlib.crc32(one.encode()) if isinstance(one, str) else one for one in key)
    return np.random.SeedSequence(seed, spawn_key=tuple(coded))


def checked_seed(seed, where):
    """A seed as files hold it. Raises ValueError, beginning with `where`, unless it is a whole number >= 0."""
    if not _whole(seed) or seed < 0:
        raise ValueError(f"{where}: seed must be a whole number >= 0, got {seed}; choose one")
    return int(seed)


def check_some(collection, where):
    """Raise ValueError, beginning with `where`, for a collection of no shapes."""
    if not len(collection):
        raise ValueError(f"{where}: a collection must hold a shape or more, got none; choose other rows")


def _names(family):
    """Names of families, from one name of a family or a category, or from several."""
    names = (family,) if isinstance(family, str) else tuple(family) if isinstance(family, Iterable) else ()
    found = [one for name in names for one in (families(name) if name in categories() else (rig_of(name).name,))]
    if not found:
        got = "none" if isinstance(family, Iterable) else family
        raise ValueError(f'generate: family must name a family or more, got {got}; say "table/four_legs" or "table"')
    return tuple(dict.fromkeys(found))


def _pieces(sources, chosen, size, fixed, said, dtype):
    for start in range(0, len(chosen), size):
        which = chosen[start : start + size]
        given = [_drawn(source, int((which == i).sum()), fixed) for i, source in enumerate(sources)]
        names = tuple(f"{sources[i].rig.name}/{start + row:05d}" for row, i in enumerate(which))
        yield replace(assembled(sources, which, given, dtype), names=names, about=said)


def _drawn(source, count, fixed):
    """The next parameters of a source, those that are fixed as a file holds them."""
    parameters = source.draw(count)
    for name in set(fixed) & set(source.rig.parameter_names):
        parameters[:, source.rig.parameter_names.index(name)] = np.float32(fixed[name])
    return parameters


def _check(count, points, sampling, dtype, size):
    if not _whole(count) or not _whole(points) or count < 1 or points < 2:
        raise ValueError(f"generate: count must be whole and >= 1, points >= 2, got {count} and {points}; ask for more")
    if not _whole(size) or size < 1:
        raise ValueError(f"pieces: size must be whole and >= 1, got {size}; a thousand shapes are a good piece")
    if sampling not in (FRESH, SHARED):
        raise ValueError(f"generate: sampling must be fresh or shared, got {sampling!r}; fresh is the default")
    if dtype not in DTYPES:
        raise ValueError(f"generate: dtype must be float32 or float64, got {dtype!r}; files hold float32")


def _checked_fixed(rigs, fixed):
    """Fixed parameters as files hold them: a dictionary of floats."""
    fixed = {} if fixed is None else fixed
    if not isinstance(fixed, Mapping) or not all(map(_real, fixed.values())):
        raise ValueError(f'generate: fixed must map names to numbers, got {fixed!r}; write {{"width": 0.5}}')
    known = {name for rig in rigs for name in rig.parameter_names}
    for name in fixed:
        if name not in known:
            raise ValueError(
                f"generate: fixed must name parameters, one of {', '.join(sorted(known))}, got {name!r}; see list"
            )
    for rig in rigs:
        given = zip(rig.parameter_names, rig.middle[0], strict=True)
        rig.check([[fixed.get(name, middle) for name, middle in given]], "generate")
    return {name: float(value) for name, value in fixed.items()}


def _seeds_before(collection):
    """The seeds of a collection's earlier new samples."""
    seeds = collection.about.get("resampled", [])
    if not isinstance(seeds, list):
        raise ValueError(f"resample: about must list seeds under resampled, got {seeds!r}; write it with data_gen")
    return [checked_seed(seed, "resample") for seed in seeds]


def _whole(value):
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def _real(value):
    return _whole(value) or isinstance(value, float | np.floating)
