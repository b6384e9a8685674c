"""What the tests of co-editing share: small spaces with sources and others, and comparison bit by bit."""

from dataclasses import fields
from functools import cache

import torch
from torch import Tensor
from worlds import deform_sync_net, randn, shapes_of

from dsn_lite.editing import CoEdit, CoEditor, Followed, History
from dsn_lite.projection import Snapped

LEG, TOP = "leg_1.scale.y", "top.translation.y"


@cache
def table(seed=0, count=1):
    """Tables with four legs, in float64."""
    return shapes_of("table/four_legs", count, 64, seed=seed).like(deform_sync_net())


@cache
def shelf(count=1):
    """Tables with a shelf, in float64."""
    return shapes_of("table/shelf", count, 48, seed=7).like(deform_sync_net())


def others():
    """Two tables with shelves, whose parts are known, and two bare clouds of other sizes."""
    return [shelf(2), randn(7, 5, 3), randn(8, 33, 3)]


def editor(seed=0, **told):
    """Of a table, with others, in an untrained space of this seed."""
    return CoEditor(deform_sync_net(seed), table(), others(), **told)


def history(seed=0, **told):
    """Of a table, with others, in an untrained space of this seed."""
    return History(deform_sync_net(seed), table(), others(), **told)


def bits(found):
    """All that a state holds, nothing rounded: tensors as bytes, so that -0 differs from 0."""
    if isinstance(found, Tensor):
        return found.numpy().tobytes()
    if isinstance(found, CoEdit | Followed | Snapped):
        return tuple(bits(getattr(found, field.name)) for field in fields(found))
    return tuple(map(bits, found)) if isinstance(found, tuple) else found


def same(a, b):
    """Whether two states agree in every bit."""
    return bits(a) == bits(b)


def clouds(state):
    """The points of source and others, one below the other."""
    return torch.cat([state.source.points, *(one.points for one in state.others)])
