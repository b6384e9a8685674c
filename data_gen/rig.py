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
from data_gen.points import Samples, blend, blend_corners, blocks, edges_of, place

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

    def rest(self, samples, parameters, dtype=np.float64):
        """Rest coordinates of samples: (n, 3) where all shapes share them and parts keep their form, else (N, n, 3)."""
        if self.fixed_rest:
            return self._rest_of_fixed(samples, dtype)
        boxes = self.rest_boxes(parameters)
        labels, found = self.triangle_part[samples.faces], self.rest_points(samples, parameters, dtype)
        for i, (centres, extents) in enumerate(boxes.swapaxes(0, 1).astype(dtype)):
            own = labels if samples.shared else labels[i]
            found[i] -= centres.take(own, axis=0)
            found[i] /= extents.take(own, axis=0)
        return found

    def rest_points(self, samples, parameters, dtype=np.float64):
        """Where samples stand (N, n, 3) in the rest pose."""
        if samples.shared:
            slopes = self.slopes[0].swapaxes(1, 2)
            middle, *change = (
                blend_corners(one, self.triangles.T, samples) for one in (self._at_middle[0][0].T, *slopes)
            )
            return (middle + np.tensordot(parameters - self.middle, change, axes=1)).astype(dtype)
        found = np.zeros((*samples.faces.shape, 3), dtype)
        triangles = np.ascontiguousarray(self.triangles.T)
        for rows in blocks(len(parameters), 9 * len(self.triangles)):
            vertices = np.ascontiguousarray(self.rest_vertices(parameters[rows]).astype(dtype).swapaxes(1, 2))
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

    def place(self, samples, parameters, dtype=np.float64):
        """Points (N, n, 3) of samples at parameters (N, p). Raises ValueError for parameters out of range."""
        boxes = self.boxes(self.check(parameters, "place"))
        return place(boxes, self.triangle_part[samples.faces], self.rest(samples, parameters, dtype), dtype)

    def true_transfer(self, samples, p_z, p_x, p_y, clip=False):
        """What turned x into y, done to the samples of z: points (N, n, 3) at p_z + p_y - p_x, each (N, p).

        Raises ValueError if that leaves a range; with `clip` the end of the range is taken instead.
        """
        p_new = np.asarray(p_z, np.float64) + np.asarray(p_y, np.float64) - np.asarray(p_x, np.float64)
        return self.place(samples, np.clip(p_new, self.low, self.high) if clip else p_new)

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
