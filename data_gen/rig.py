"""A rig: named parameters in, the box of every part out, and from that the true answer of every question.

The handles z of a shape are the centre and the edge lengths of each of its parts, 6 numbers a part. Points are linear
in the handles, x = B z, and the handles of a rig are linear in its parameters, z = z(0) + J p. So two shapes of one
family differ on the same rest samples by exactly B J (p_y - p_x), and what that difference makes of a third shape is
known: the true transfer. Lengths are in the unit of the file: shapes lie in [-0.5, 0.5] on each axis.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from data_gen.part import Box
from data_gen.points import place

FLOOR = -0.5
"""The y all families stand on."""
ROUNDING = 1e-6
"""How far outside its range a parameter may stand, since float32 rounds the ends of ranges."""
SIDES = ("face_x", "face_y", "face_z")


class Parameter(NamedTuple):
    """A number a family is steered by, uniform in [low, high]. The same name means the same thing in every family."""

    name: str
    low: float
    high: float
    meaning: str
    unit: str = "length"


class Contact(NamedTuple):
    """Two parts that touch. `face_y`: the upper y face of the first lies on the lower y face of the second."""

    first: str
    second: str
    kind: str


@dataclass(frozen=True)
class Rig:
    """One family. `build` maps a namespace of parameters, each an (N,) array, to the parts of all N shapes at once.

    `symmetric` pairs each part with its mirror image across x = 0, a part in the middle with itself.
    """

    name: str
    parameters: tuple[Parameter, ...]
    build: Callable[[SimpleNamespace], tuple[Box, ...]]
    symmetric: tuple[tuple[str, str], ...]
    contacts: tuple[Contact, ...] = ()

    @cached_property
    def parameter_names(self):
        """Names of the parameters, in the order of the columns."""
        return tuple(parameter.name for parameter in self.parameters)

    @cached_property
    def part_names(self):
        """Names of the parts; a point's label is an index into them."""
        return tuple(part.name for part in self._parts(self.middle))

    @cached_property
    def low(self):
        """The lower end (p,) of every range."""
        return np.array([parameter.low for parameter in self.parameters])

    @cached_property
    def high(self):
        """The upper end (p,) of every range."""
        return np.array([parameter.high for parameter in self.parameters])

    @cached_property
    def middle(self):
        """The parameters (1, p) in the middle of their ranges."""
        return (self.low + self.high)[None] / 2

    def draw(self, count, generator):
        """Parameters (count, p), uniform and independent in their ranges: float64 that a float32 file holds exactly."""
        uniform = generator.random((count, len(self.parameters)))
        return (self.low + (self.high - self.low) * uniform).astype(np.float32).astype(np.float64)

    def check(self, parameters, where):
        """Parameters (N, p) as float64. Raises ValueError, beginning with `where`, if misshapen or out of range."""
        parameters = np.asarray(parameters, np.float64)
        if parameters.ndim != 2 or parameters.shape[1] != len(self.parameters):
            wanted = f"(N, {len(self.parameters)}), {', '.join(self.parameter_names)}"
            raise ValueError(f"{where}: {self.name} takes parameters {wanted}, got {parameters.shape}; give it rows")
        inside = (parameters >= self.low - ROUNDING) & (parameters <= self.high + ROUNDING)
        if not inside.all():
            row, column = np.argwhere(~inside)[0]
            name, low, high = self.parameters[column][:3]
            raise ValueError(
                f"{where}: {name} of {self.name} must be in [{low:g}, {high:g}], got {parameters[row, column]:g} "
                f"in row {row}; keep it inside its range"
            )
        return parameters

    def handles(self, parameters):
        """z (N, 6P): centre and edge lengths of part after part at parameters (N, p), in or out of their ranges."""
        columns = [value for part in self._parts(parameters) for value in (*part.centre, *part.extents)]
        return np.stack(np.broadcast_arrays(*columns, parameters[:, 0])[:-1], axis=1)

    @cached_property
    def jacobian(self):
        """J = dz/dp (6P, p), by evaluation, which is exact because the rig is linear."""
        z = self.handles(np.vstack([np.zeros(len(self.parameters)), np.eye(len(self.parameters))]))
        return (z[1:] - z[0]).T

    def boxes(self, parameters):
        """Boxes (N, P, 15) at parameters (N, p): centre 3, rotation 9 by rows, edge lengths 3."""
        z = self._by_part(self.check(parameters, "boxes"))
        turn = np.broadcast_to(np.eye(3).ravel(), (*z.shape[:2], 9))
        return np.concatenate([z[:, :, 0], turn, z[:, :, 1]], axis=2)

    def handle_matrix(self, labels, rest):
        """B (n, 3, 6P), with x = B z, for samples with labels (n,) and rest coordinates (n, 3)."""
        B = np.zeros((len(labels), 3, len(self.part_names), 2, 3))
        for axis in range(3):
            B[np.arange(len(labels)), axis, labels, 0, axis] = 1
            B[np.arange(len(labels)), axis, labels, 1, axis] = rest[:, axis]
        return B.reshape(len(labels), 3, -1)

    def place(self, labels, rest, parameters, dtype=np.float64):
        """Points (N, n, 3) at parameters (N, p) of samples (n,), (n, 3) shared by all shapes, or (N, n), (N, n, 3).

        Raises ValueError for parameters out of range, and for labels that are no part.
        """
        parameters, labels = self.check(parameters, "place"), np.asarray(labels)
        if labels.min() < 0 or labels.max() >= len(self.part_names):
            raise ValueError(
                f"place: labels of {self.name} must be 0 to {len(self.part_names) - 1}, got {labels.min()} to "
                f"{labels.max()}; drop the points that belong to no part"
            )
        return place(self._by_part(parameters), labels, rest, dtype)

    def true_transfer(self, labels, rest, p_z, p_x, p_y, clip=False):
        """What turned x into y, done to the samples of z: points (N, n, 3) at p_z + p_y - p_x, each (N, p).

        Raises ValueError if that leaves a range; with `clip` the end of the range is taken instead.
        """
        p_new = np.asarray(p_z, np.float64) + np.asarray(p_y, np.float64) - np.asarray(p_x, np.float64)
        p_new = np.clip(p_new, self.low, self.high) if clip else self.check(p_new, "true_transfer")
        return self.place(labels, rest, p_new)

    def gaps(self, parameters):
        """Signed distance (N, C) between the two faces of each contact, negative where the parts overlap."""
        centres, extents = np.moveaxis(self._by_part(parameters), 2, 0)
        first, second = ([self.part_names.index(contact[i]) for contact in self.contacts] for i in (0, 1))
        axis = [SIDES.index(contact.kind) for contact in self.contacts]
        return (centres - extents / 2)[:, second, axis] - (centres + extents / 2)[:, first, axis]

    def asymmetries(self, parameters):
        """Largest difference (N, S) in any coordinate between a part and the mirror image of its partner."""
        z = self._by_part(parameters)
        one, other = ([self.part_names.index(pair[i]) for pair in self.symmetric] for i in (0, 1))
        mirror = np.array([[-1, 1, 1], [1, 1, 1]])
        return np.abs(z[:, one] - z[:, other] * mirror).max((-1, -2))

    def _by_part(self, parameters):
        return self.handles(parameters).reshape(len(parameters), -1, 2, 3)

    def _parts(self, parameters):
        return self.build(SimpleNamespace(**dict(zip(self.parameter_names, parameters.T, strict=True))))
