"""Co-editing: an edit of one shape is snapped, and the vector that the snap found deforms other shapes likewise."""

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import replace
from math import isfinite

import torch

from ..dictionary import rms
from ..handles import Handles
from ..modes.bases import check_dictionary
from ..projection import EditProjector, Prior, Snapped
from ..projection.bounds import Bounds
from ..shapes import Shapes
from ..space import ActionSpace
from ..types import Vector
from .blending import CoEdit, blended
from .followers import Follower, Others, each, moved


class CoEditor:
    """All that edits of a source need to know of it and of others, computed once: an edit is then a few small products.

    source: one shape with parts; others: Shapes, or a sequence of clouds (q, 3) and Shapes of any sizes. prior
    as of EditProjector. Raises ValueError where the space has no dictionary, or the source is not one shape with parts.
    """

    def __init__(self, space: ActionSpace, source: Shapes, others: Others = (), prior: Prior | None = None):
        check_dictionary("co_edit", space)
        if len(source) != 1:
            raise ValueError(f"co_edit: source must be one shape, got {len(source)}; take shapes[0]")
        self.projector = EditProjector.of(space, source, prior=prior)
        self.followers = tuple(Follower(space, one) for one in each(others))
        self.start = self._unmoved()

    @property
    def handles(self) -> Handles:
        """The handles of the source."""
        return self.projector.handles

    def __call__(
        self,
        edits: Mapping[str, float],
        *,
        change: bool = False,
        bounds: Bounds | None = None,
        strength: float = 1.0,
        after: CoEdit | None = None,
    ) -> CoEdit:
        """Pins handles of the source, snaps it, and moves the others by strength times what that took.

        after: the edits that came before, none unless told. Actions add up, x (+) v (+) w = x (+) (v + w), so the one
        dictionary of the source serves all edits: changes are counted from where the last edit ended, bounds hold for
        the totals. Pins and bounds of earlier edits let go; a pin that shall hold is named again, with change 0: then
        the edits together are the one edit with all their pins. Raises ValueError as EditProjector does, and where
        strength is not finite.
        """
        if not isfinite(strength):
            raise ValueError(f"co_edit: strength must be a finite number, got {strength}; 1 moves the others as far")
        before = after or self.start
        step = self._from(before.source)(edits, change=change, bounds=bounds)
        return self._at(step, before.source.v + step.v, before.v + strength * step.v)

    def blend(self, edits: Sequence[CoEdit], weights: Sequence[float]) -> CoEdit:
        """Several edits of this source at once, v = sum of w_i v_i: weights 1 and 0 give one of them exactly.

        Bounds that all of the edits keep hold as long as weights are at least 0 and their sum at most 1. Raises
        ValueError where weights are not one finite number an edit, or an edit is of another source.
        """
        return self._at(*blended(self.start, edits, weights))

    def _from(self, reached: Snapped) -> EditProjector:
        """The projector of the source where it stands now: A, B and their factor stay, values and points do not."""
        projector, handles = copy(self.projector), copy(self.handles)
        handles.z0, projector.x, projector.handles = reached.z_hat, reached.points, handles
        return projector

    def _at(self, step: Snapped, v: Vector, passed_on: Vector) -> CoEdit:
        """What an edit led to, counted from the unmoved source."""
        x, handles, z0 = self.projector.x, self.handles, self.start.source.z0
        points = moved(x, self.projector.A, v)
        by_handles = x if torch.equal(step.z_hat, z0) else x + handles.offsets(step.z_hat - z0).to(x)
        snapped = replace(
            step,
            z0=z0,
            v=v,
            points=points,
            by_handles=by_handles,
            distance=rms(points - step.edited),
            residual=rms((points - by_handles)[handles.held]),
        )
        return CoEdit(snapped, passed_on, tuple(one.by(passed_on) for one in self.followers), rms(points - x))

    def _unmoved(self) -> CoEdit:
        x, z0, v = self.projector.x, self.handles.z0.double().cpu(), torch.zeros(self.projector.A.shape[-1]).double()
        still = Snapped(
            names=self.handles.names,
            pinned=(),
            at_bounds=(),
            z0=z0,
            z_hat=z0,
            v=v,
            points=x,
            edited=x,
            by_handles=x,
            distance=0.0,
            residual=0.0,
        )
        return CoEdit(still, v, tuple(one.by(v) for one in self.followers), 0.0)


def co_edit(
    space: ActionSpace,
    source: Shapes,
    edits: Mapping[str, float],
    others: Others,
    *,
    change: bool = False,
    bounds: Bounds | None = None,
    strength: float = 1.0,
    prior: Prior | None = None,
) -> CoEdit:
    """One edit of a source, and what it makes of others; for many edits of the same shapes, keep a CoEditor.

    Arguments and errors are those of CoEditor and of its call.
    """
    return CoEditor(space, source, others, prior)(edits, change=change, bounds=bounds, strength=strength)
