"""Triplets of shapes of which the true transfer is known, for those who cannot ask how shapes are made.

They are drawn as `generate` draws, given that the answer exists: parameter by parameter, x, y and z are uniform in
their ranges, and drawn again until z + (y - x) lies in the range of z.
"""

import itertools
from dataclasses import dataclass, replace

import numpy as np

from data_gen.assemble import about, assembled
from data_gen.draw import FRESH, Source
from data_gen.families import categories, families
from data_gen.families import family as rig_of
from data_gen.make import DTYPES, checked_seed, stream
from data_gen.points import Samples
from data_gen.rig import Rig
from data_gen.sample import PER_SHAPE

TRANSFERS = 5
"""What random numbers are for, after those of `make`."""
ROLES = ("x", "y", "z", "truth")


def transfers(family, *, count, points, seed=0, across=False, single=False, dtype="float32"):
    """`count` triplets and their true transfers as one collection: all x, then all y, all z, and all truths.

    x and y are of one family, and differ in all of its parameters; so is z. `across`: z is of another family of the
    category, and y differs from x only in parameters that z has too. `single`: y differs in one parameter. Samples of
    x, y and z are fresh, the truth has those of z. Families take turns, as z first. `about` says the number of
    triplets under "transfers". Raises ValueError for no family or category, and, across, where none shares a parameter.
    """
    rigs = [rig_of(name) for name in (families(family) if family in categories() else (rig_of(family).name,))]
    _check(count, points, dtype)
    rng = np.random.default_rng(stream(checked_seed(seed, "transfers"), TRANSFERS, family, int(across), int(single)))
    drawn = [_drawn(rigs, _pair(rigs, i % len(rigs), across, rng), single, rng) for i in range(count)]
    which = np.array([row for pairs, _ in drawn for row in pairs], np.int16).reshape(count, 4).T
    values = [[parameters[role] for _, parameters in drawn] for role in range(4)]
    sources = [Source(rig, points, FRESH, stream(seed, TRANSFERS, rig.name).spawn(2)) for rig in rigs]
    three = assembled(
        sources, which[:3].ravel(), _by_family(rigs, which[:3].ravel(), [*itertools.chain(*values[:3])]), dtype
    )
    kept = [_Kept(rig, points, _samples(three[2 * count :], which[2] == i)) for i, rig in enumerate(rigs)]
    made = _joined(three, assembled(kept, which[3], _by_family(rigs, which[3], values[3]), dtype))
    names = tuple(f"{role}/{i:05d}" for role in ROLES for i in range(count))
    said = {"seed": seed, "sampling": FRESH, "corresponds": False, "fixed": {}, "transfers": count}
    return replace(made, names=names, about={**about(rigs), **said})


@dataclass
class _Kept:
    """A source of shapes on samples that are there already, piece by piece."""

    rig: Rig
    points: int
    samples: Samples
    taken: int = 0

    def take(self, parameters, dtype):
        rows = slice(self.taken, self.taken + len(parameters))
        self.taken = rows.stop
        source = Source(self.rig, self.points, FRESH, ())
        return source.at(Samples(self.samples.faces[rows], self.samples.weights[rows]), parameters, dtype)


def _pair(rigs, last, across, rng):
    """The families of x and z, by index, and the parameters that may change."""
    names = set(rigs[last].parameter_names)
    others = [i for i, rig in enumerate(rigs) if i != last and names & set(rig.parameter_names)] if across else [last]
    if not others:
        raise ValueError(
            f"transfers: {rigs[last].name} must share a parameter with another family of its category, got none that "
            "it does; name a category of several, or leave across out"
        )
    first = int(rng.choice(others))
    return first, last, [name for name in rigs[first].parameter_names if name in names]


def _drawn(rigs, pair, single, rng):
    """The families (4,) and the parameters of x, y, z and the truth, as a file holds them."""
    first, last, names = pair
    changing = [names[rng.integers(len(names))]] if single else names
    x, z = (rigs[i].draw(1, rng)[0] for i in (first, last))
    y, truth = x.copy(), z.copy()
    for name in changing:
        a, b = (rigs[i].parameter_names.index(name) for i in (first, last))
        x[a], y[a], z[b] = _three(rigs[first].parameters[a], rigs[last].parameters[b], rng)
        truth[b] = z[b] + (y[a] - x[a])
    return (first, first, last, last), (x, y, z, truth)


def _three(first, last, rng):
    """Uniform values of x, y and z, as a file holds them, whose z + (y - x) is in its range."""
    while True:
        x, y = rng.uniform(first.low, first.high, 2).astype(np.float32).astype(np.float64)
        z = float(np.float32(rng.uniform(last.low, last.high)))
        if last.low <= z + (y - x) <= last.high:
            return x, y, z


def _by_family(rigs, which, values):
    """The parameters of each family's shapes, a list of (N_i, p_i)."""
    own = [[value for row, value in zip(which, values, strict=True) if row == i] for i in range(len(rigs))]
    return [np.array(some).reshape(len(some), len(rig.parameters)) for rig, some in zip(rigs, own, strict=True)]


def _samples(shapes, rows):
    return Samples(shapes.faces[rows], shapes.weights[rows])


def _joined(first, second):
    """Both collections, one after the other."""
    known = [key for key in PER_SHAPE if getattr(first, key) is not None]
    return replace(first, **{key: np.concatenate([getattr(one, key) for one in (first, second)]) for key in known})


def _check(count, points, dtype):
    for name, value, least in (("count", count, 1), ("points", points, 2)):
        if not isinstance(value, int | np.integer) or value < least:
            raise ValueError(f"transfers: {name} must be whole and >= {least}, got {value}; ask for more")
    if dtype not in DTYPES:
        raise ValueError(f"transfers: dtype must be float32 or float64, got {dtype!r}; files hold float32")
