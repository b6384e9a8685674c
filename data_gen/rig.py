"""A rig: named parameters in, parts and joints out, and from them the true answer of every question.

Joints pose what `linear.py` says of the rest pose. A family without hinges is linear altogether: two of its shapes
differ on the same samples by exactly J (p_y - p_x), and what that makes of a third shape is known: the true transfer.
Lengths are in the unit of the file: shapes lie in [-0.5, 0.5] on each axis.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from data_gen.joint import HINGE, Joint, after, motion, parents
from data_gen.linear import Linear
from data_gen.part import Part
from data_gen.points import Samples, blend, blend_corners, blocks, combined, edges_of, place, relative

FLOOR = -0.5
"""The y that families stand on."""


class Parameter(NamedTuple):
    """A number a family is steered by, uniform in [low, high]: a length, or an angle in radians (unit "rad").

    The same name means the same thing in every family of a category, so that a change can go from one to another.
    """

    name: str
    low: float
    high: float
    meaning: str
    unit: str = "length"


class Contact(NamedTuple):
    """Two parts that touch. `face_y`: the upper y face of the first's box lies on the lower y face of the second's."""

    first: str
    second: str
    kind: str


@dataclass(frozen=True)
class Rig(Linear):
    """One family. `build` maps a namespace of parameters, each an (N,) array, to the parts and joints of N shapes.

    All of it must be linear in the parameters. `symmetric` pairs parts that mirror each other across x = 0 in the rest
    pose, a part in the middle with itself.
    """

    name: str
    parameters: tuple[Parameter, ...]
    build: Callable[[SimpleNamespace], tuple[Part | Joint, ...]]
    symmetric: tuple[tuple[str, str], ...] = ()
    contacts: tuple[Contact, ...] = ()

    @cached_property
    def linear(self):
        """Whether points are linear in the parameters: no hinges."""
        return all(joint.kind != HINGE for joint in self.joint_list)

    @cached_property
    def by_boxes(self):
        """Whether boxes tell all: a change of the parts' boxes is the whole change of the shape."""
        return self.linear and self.fixed_rest

    def vertices(self, parameters):
        """Vertices (N, V, 3) at parameters (N, p)."""
        vertices, (turn, shift) = self.rest_vertices(parameters), self._motions(parameters)
        for part in np.flatnonzero(self.joint_of >= 0):
            own = self.vertex_part == part
            vertices[:, own] = vertices[:, own] @ turn[:, part].swapaxes(1, 2) + shift[:, part, None]
        return vertices

    def boxes(self, parameters):
        """Boxes (N, P, 15) at parameters (N, p): centre 3, rotation 9 by rows, edge lengths 3."""
        parameters = self.check(parameters, "boxes")
        (centres, extents), (turn, shift) = self.rest_boxes(parameters), self._motions(parameters)
        centres = np.einsum("npij,npj->npi", turn, centres) + shift
        return np.concatenate([centres, turn.reshape(*turn.shape[:2], 9), extents], axis=2)

    def joints(self, parameters):
        """Joints (N, J, 8) as they stand at parameters (N, p): axis 3, pivot 3, value, 0 for a hinge, 1 for a slide."""
        pivots, values = self.rest_pivots(parameters), self.joint_values(parameters)
        turn, shift = self._motions(parameters)
        found = np.zeros((len(parameters), len(self.joint_list), 8))
        for j, joint in enumerate(self.joint_list):
            on = self.part_names.index(joint.on)
            found[:, j, :3] = turn[:, on] @ np.array(joint.axis)
            found[:, j, 3:6] = np.einsum("nij,nj->ni", turn[:, on], pivots[:, j]) + shift[:, on]
            found[:, j, 6], found[:, j, 7] = values[:, j], joint.kind != HINGE
        return found

    def sampled(self, samples, parameters, dtype=np.float64):
        """Points (N, n, 3) of samples, their rest coordinates, (n, 3) where all shapes share them, and `boxes`.

        Raises ValueError for parameters out of range.
        """
        parameters = self.check(parameters, "place")
        boxes, labels = self.boxes(parameters), self.triangle_part[samples.faces]
        if self.fixed_rest and not (self.linear and samples.shared):
            rest = self._rest_of_fixed(samples, dtype)
            return place(boxes, labels, rest, dtype), rest, boxes
        points = self._unturned_points(samples, parameters, dtype)
        if self.fixed_rest:
            return points, self._rest_of_fixed(samples, dtype), boxes
        rest = relative(points, boxes if self.linear else self._unturned(boxes, parameters), labels)
        return points if self.linear else place(boxes, labels, rest, dtype), rest, boxes

    def place(self, samples, parameters, dtype=np.float64):
        """Points (N, n, 3) of samples at parameters (N, p). Raises ValueError for parameters out of range."""
        return self.sampled(samples, parameters, dtype)[0]

    @cached_property
    def _unturned_map(self):
        """Vertices (1 + p, 3, V) in the middle of the ranges, and slopes: posed if only slides pose, else at rest."""
        if not self.linear:
            return np.concatenate([self._at_middle[0], self.slopes[0]]).swapaxes(1, 2)
        low, high = (self.vertices(self.middle + side * np.diag(self.high - self.low) / 2) for side in (-1, 1))
        slopes = (high - low) / (self.high - self.low)[:, None, None]
        return np.concatenate([self.vertices(self.middle), slopes]).swapaxes(1, 2)

    def _unturned(self, boxes, parameters):
        """The boxes (N, P, 15) as they are in the rest pose."""
        centres, extents = self.rest_boxes(parameters)
        return np.concatenate([centres, boxes[:, :, 3:12], extents], axis=2)

    def _unturned_points(self, samples, parameters, dtype):
        """Where samples stand (N, n, 3) by the linear map alone."""
        terms, triangles = self._unturned_map.astype(dtype), np.ascontiguousarray(self.triangles.T)
        change = np.concatenate([np.ones((len(parameters), 1)), parameters - self.middle], axis=1).astype(dtype)
        found = np.zeros((len(parameters), *samples.weights.shape[-2:-1], 3), dtype)
        if samples.shared:
            for own in blocks(len(samples.faces), 32):
                moves = [blend_corners(term, triangles, Samples(*(one[own] for one in samples))) for term in terms]
                found[:, own] = combined(change, np.stack(moves))
            return found
        for rows in blocks(len(parameters), 9 * len(self.triangles)):
            vertices = combined(change[rows], terms)
            for i in range(rows.start, rows.stop):
                found[i] = blend_corners(vertices[i - rows.start], triangles, samples.row(i))
        return found

    def _rest_of_fixed(self, samples, dtype):
        units = self.in_boxes(self.rest_vertices(self.middle), self.rest_boxes(self.middle))
        edges = edges_of(units[0].astype(dtype), self.triangles)
        if samples.shared:
            return blend(edges, samples)
        found = np.zeros((*samples.faces.shape, 3), dtype)
        for i, row in enumerate(zip(*samples, strict=True)):
            found[i] = blend(edges, Samples(*row))
        return found

    def _motions(self, parameters):
        """How each part has moved from the rest pose: turns (N, P, 3, 3) and shifts (N, P, 3)."""
        N, P = len(parameters), len(self.part_names)
        turn, shift = np.tile(np.eye(3), (N, P, 1, 1)), np.zeros((N, P, 3))
        if self.joint_list:
            pivots, values, done = self.rest_pivots(parameters), self.joint_values(parameters), []
            for j, (joint, parent) in enumerate(zip(self.joint_list, parents(self.joint_list), strict=True)):
                own = motion(joint, pivots[:, j], values[:, j])
                done.append(own if parent < 0 else after(done[parent], own))
            for part in np.flatnonzero(self.joint_of >= 0):
                turn[:, part], shift[:, part] = done[self.joint_of[part]]
        return turn, shift
