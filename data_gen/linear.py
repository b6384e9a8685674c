"""A family in the rest pose: what is linear in its parameters.

The vertices of all parts are linear in the parameters, V = V(middle) + (p - middle) dV/dp, and so are the pivots and
the values of joints. So a family is evaluated once at the ends of each range; all shapes are one matrix product away.
"""

from functools import cached_property
from types import SimpleNamespace

import numpy as np

from data_gen.areas import Areas
from data_gen.joint import HINGE, Joint
from data_gen.part import Part

ROUNDING = 1e-6
"""How far outside its range a parameter may stand, since float32 rounds the ends of ranges."""
SAME = 1e-9
"""Two numbers of one size that differ by less are the same."""


class Linear:
    """Named parameters in ranges, and the parts and joints in the rest pose that `build` makes of them."""

    @cached_property
    def category(self):
        """The part of the name before the slash."""
        return self.name.split("/")[0]

    @cached_property
    def parameter_names(self):
        """Names of the parameters, in the order of the columns."""
        return tuple(parameter.name for parameter in self.parameters)

    @cached_property
    def part_names(self):
        """Names of the parts; a point's label is an index into them."""
        return tuple(part.name for part in self._parts)

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

    @cached_property
    def in_the_middle(self):
        """What `build` makes of the parameters in the middle of their ranges."""
        return self.build(self.named(self.middle))

    @cached_property
    def joint_list(self):
        """The joints, each after the one that carries it."""
        return tuple(one for one in self.in_the_middle if isinstance(one, Joint))

    @cached_property
    def joint_of(self):
        """The joint (P,) that moves each part directly, or -1."""
        found = np.full(len(self.part_names), -1)
        for j, joint in enumerate(self.joint_list):
            found[[self.part_names.index(part) for part in joint.parts]] = j
        return found

    @cached_property
    def triangles(self):
        """Triangles (F, 3) of all parts, one part after the other."""
        starts = np.cumsum([0, *(part.vertices.shape[1] for part in self._parts)])
        return np.concatenate([part.triangles + start for part, start in zip(self._parts, starts, strict=False)])

    @cached_property
    def triangle_part(self):
        """The part (F,) of each triangle."""
        return np.repeat(np.arange(len(self._parts)), [len(part.triangles) for part in self._parts]).astype(np.int16)

    @cached_property
    def vertex_part(self):
        """The part (V,) of each vertex."""
        return np.repeat(np.arange(len(self._parts)), [part.vertices.shape[1] for part in self._parts])

    @cached_property
    def uv(self):
        """The UV (V, 2) of each vertex."""
        return np.concatenate([part.uv for part in self._parts])

    def draw(self, count, generator):
        """Parameters (count, p), uniform and independent in their ranges: float64 that a float32 file holds exactly."""
        uniform = generator.random((count, len(self.parameters)))
        return (self.low + (self.high - self.low) * uniform).astype(np.float32).astype(np.float64)

    def check(self, parameters, where, first=0):
        """Parameters (N, p) as float64. Raises ValueError, beginning with `where`, if misshapen or out of range.

        `first` is what the first row is called in the message.
        """
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
                f"in row {first + row}; keep it inside its range"
            )
        return parameters

    def named(self, parameters):
        """Parameters (N, p) as `build` takes them: a namespace of (N,) arrays."""
        return SimpleNamespace(**dict(zip(self.parameter_names, parameters.T, strict=True)))

    def built(self, parameters):
        """What `build` says, asked directly: rest vertices (N, V, 3), pivots (N, J, 3) and values (N, J) of joints."""
        return _arrays(self.build(self.named(parameters)), len(parameters))

    @cached_property
    def slopes(self):
        """Derivatives by the parameters of rest vertices (p, V, 3), pivots (p, J, 3) and values (p, J) of joints.

        They are differences over the whole range, which is exact because all of it is linear.
        """
        reach = np.diag(self.high - self.low) / 2
        ends = zip(self.built(self.middle + reach), self.built(self.middle - reach), strict=True)
        return tuple(((high - low).T / (self.high - self.low)).T for high, low in ends)

    @cached_property
    def turning(self):
        """Which parameters (p,) turn hinges; while they stay as they are, all is linear in the others."""
        return (self.slopes[2][:, [joint.kind == HINGE for joint in self.joint_list]] != 0).any(axis=1)

    def between(self, parameters, generator):
        """Parameters (N, p) with all that turns hinges drawn anew: turning parts reach farthest between the corners."""
        return np.where(self.turning, self.draw(len(parameters), generator), parameters)

    def rest_vertices(self, parameters):
        """Vertices (N, V, 3) in the rest pose, all joints at 0, at parameters (N, p), in or out of their ranges."""
        return self._at(parameters, 0)

    def rest_pivots(self, parameters):
        """Points (N, J, 3) on the axes of the joints in the rest pose."""
        return self._at(parameters, 1)

    def joint_values(self, parameters):
        """Angles and distances (N, J) of the joints."""
        return self._at(parameters, 2)

    def rest_boxes(self, parameters):
        """Centres and edge lengths (2, N, P, 3) of the parts in the rest pose, at parameters in their ranges."""
        outermost, starts = self._outermost
        change, slopes = parameters - self.middle, self.slopes[0][:, outermost]
        vertices = self._at_middle[0][:, outermost] + np.tensordot(change, slopes, axes=1)
        low, high = (ends.reduceat(vertices, starts, axis=1) for ends in (np.minimum, np.maximum))
        return np.stack([(low + high) / 2, high - low])

    @cached_property
    def areas(self):
        """What gives the doubled areas (N, F) of triangles for changes (N, p) of the parameters from their middle."""
        return Areas(self._at_middle[0][0], self.slopes[0], self.triangles)

    @cached_property
    def fixed_rest(self):
        """Whether every point keeps its place in its part's box, as those of boxes, cylinders and balls do."""
        parameters = self.draw(4, np.random.default_rng(0))
        tried = self.in_boxes(self.rest_vertices(parameters), self.rest_boxes(parameters))
        return bool(np.abs(tried - tried[:1]).max() < SAME)

    @cached_property
    def _parts(self):
        return [one for one in self.in_the_middle if isinstance(one, Part)]

    @cached_property
    def _at_middle(self):
        return _arrays(self.in_the_middle, 1)

    def _at(self, parameters, which):
        return self._at_middle[which] + np.tensordot(parameters - self.middle, self.slopes[which], axes=1)

    def in_boxes(self, vertices, boxes):
        """Rest vertices (N, V, 3) in the unit boxes of their parts, from centres and edge lengths (2, N, P, 3)."""
        centres, extents = boxes[:, :, self.vertex_part]
        return (vertices - centres) / extents

    @cached_property
    def _outermost(self):
        """Vertices, part after part, that may bound their part's box somewhere in the ranges; where each part starts.

        A vertex is out if it stays inside of the one that is outermost in the middle, which boxes of curved parts owe
        most of their speed to.
        """
        middle, half = self._at_middle[0][0], (self.high - self.low) / 2
        kept = np.zeros(len(middle), bool)
        for own in (np.flatnonzero(self.vertex_part == part) for part in range(len(self._parts))):
            for side in (1, -1):
                outer = own[(side * middle[own]).argmax(axis=0)], np.arange(3)
                ahead = side * (middle[own] - middle[outer])
                swing = np.tensordot(half, np.abs(self.slopes[0][:, own] - self.slopes[0][:, *outer][:, None]), axes=1)
                kept[own[(ahead + swing > 0).any(axis=1)]] = True
                kept[outer[0]] = True
        found = np.flatnonzero(kept)
        return found, np.searchsorted(self.vertex_part[found], np.arange(len(self._parts)))


def _arrays(built, N):
    """Vertices (N, V, 3), pivots (N, J, 3) and values (N, J) of the parts and joints of N shapes."""
    parts, joints = ([one for one in built if isinstance(one, kind)] for kind in (Part, Joint))
    vertices = [np.broadcast_to(part.vertices, (N, *part.vertices.shape[1:])) for part in parts]
    columns = [np.broadcast_to(value, N) for joint in joints for value in (*joint.pivot, joint.value)]
    hung = np.stack([*columns, np.zeros(N)], axis=1)[:, :-1].reshape(N, len(joints), 4)
    return np.concatenate(vertices, axis=1), hung[:, :, :3], hung[:, :, 3]
