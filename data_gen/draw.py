"""Shapes and samples at random.

The parameters, the triangles of points, their order, and their two coordinates are five streams of random numbers, each
with its own seed. So the parameters depend neither on how points are sampled nor on how many, and the first shapes of a
large collection are those of a small one.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from data_gen.points import Samples, blocks
from data_gen.rig import Rig
from data_gen.sample import Collection

FRESH, SHARED = "fresh", "shared"


@dataclass(frozen=True)
class Source:
    """One family's streams of random numbers, from which shapes are taken piece by piece."""

    rig: Rig
    points: int
    sampling: str
    seeds: tuple

    @cached_property
    def streams(self):
        """A generator for parameters, and four for the triangles, their order, and two coordinates of a point."""
        shapes, samples = self.seeds
        return [np.random.default_rng(seed) for seed in (shapes, *samples.spawn(4))]

    @cached_property
    def common(self):
        """The samples of all shapes where they share them: area-weighted for the shape in the middle of the ranges."""
        faces, weights = fresh(self.rig, self.rig.middle, self.points, self.streams[1:])
        return Samples(faces[0], weights[0])

    def draw(self, count):
        """The next parameters (count, p)."""
        return self.rig.draw(count, self.streams[0])

    def take(self, parameters, dtype):
        """A collection of the shapes with these parameters (N, p), of which everything is known."""
        samples = self.common if self.sampling == SHARED else fresh(self.rig, parameters, self.points, self.streams[1:])
        return self.at(samples, parameters, dtype)

    def at(self, samples, parameters, dtype):
        """The same with given samples."""
        points, rest, boxes = self.rig.sampled(samples, parameters, dtype)
        return Collection(
            points=points,
            labels=self.rig.triangle_part[samples.faces],
            rest=rest,
            faces=samples.faces,
            weights=samples.weights,
            boxes=boxes.astype(dtype),
            parameters=parameters.astype(dtype),
            parameter_names=self.rig.parameter_names,
            part_names=self.rig.part_names,
            joints=self.rig.joints(parameters).astype(dtype),
        )


def fresh(rig, parameters, points, streams):
    """Samples (N, n), area-weighted for each shape, in random order, from four random generators.

    A point's triangle is the number of triangles whose cumulative share of the area its random number reaches. Sorted
    numbers find theirs several times as fast; what they found is shuffled, which leaves the points independent.
    """
    found = Samples(np.zeros((len(parameters), points), np.int16), np.zeros((len(parameters), points, 2), np.float32))
    which, order, *within = streams
    for rows in blocks(len(parameters), max(points, 9 * len(rig.triangles))):
        shape = found.faces[rows].shape
        wanted, shares = np.sort(which.random(shape, np.float32), axis=1), _shares(rig, parameters[rows])
        for i, row in enumerate(range(rows.start, rows.stop)):
            found.faces[row] = shares[i].searchsorted(wanted[i], side="right")
        order.permuted(found.faces[rows], axis=1, out=found.faces[rows])
        u, v = (stream.random(shape, np.float32) for stream in within)
        beyond = u + v > 1  # of the parallelogram over the triangle the other half is turned back
        for i, share in enumerate((u, v)):
            np.copyto(share, 1 - share, where=beyond)
            found.weights[rows, :, i] = share
    return found


def _shares(rig, parameters):
    """Cumulative shares of the area (N, F - 1) float32 of all triangles but the last."""
    areas = rig.areas(parameters - rig.middle).cumsum(axis=1)
    return (areas[:, :-1] / areas[:, -1:]).astype(np.float32)
