"""What is wrong with a rig, in sentences for its author: the family laws, tried on one rig, each fault by name."""

import numpy as np

from data_gen import fits
from data_gen.form import misformed
from data_gen.part import volumes
from data_gen.rig import FLOOR

TRIED, BETWEEN = 64, 256
EXACT = 1e-9
THINNEST = 0.004
"""No edge of a part is shorter, so that no part is flat."""


def faults(rig, seed=0):
    """Sentences, none where the rig is sound; it is tried at 64 random shapes and at 64 corners of its ranges.

    Where parts turn, also at 256 corners of the lengths with random angles between.
    """
    if found := misformed(rig):
        return found
    generator = np.random.default_rng(seed)
    corners = _corners(rig, TRIED, generator)
    parameters = np.concatenate([rig.draw(TRIED, generator), corners, rig.low[None], rig.high[None]])
    if found := list(_bent(rig, parameters)):
        return found  # what follows counts on the linear map
    if not rig.linear:
        parameters = np.concatenate([parameters, rig.between(_corners(rig, BETWEEN, generator), generator)])
    laws = (_idle, _outside, _thin, _turned_out, _off_the_floor, _apart, _beside, _uneven, _unhinged)
    return [fault for law in laws for fault in law(rig, parameters)]


def _corners(rig, count, generator):
    return np.where(generator.random((count, len(rig.parameters))) < 0.5, rig.low, rig.high)


def _bent(rig, parameters):
    if fits.nonlinearity(rig, parameters) > EXACT:
        off = np.abs(rig.built(parameters)[0] - rig.rest_vertices(parameters)).max(axis=(0, 2))
        what = f"part {rig.part_names[rig.vertex_part[off.argmax()]]}" if off.max() > EXACT else "a joint"
        yield f"{what} is not linear in the parameters; only add them up and multiply them by constants"


def _idle(rig, parameters):
    columns = np.concatenate([slope.reshape(len(rig.parameters), -1) for slope in rig.slopes], axis=1)
    idle = [name for name, column in zip(rig.parameter_names, columns, strict=True) if np.abs(column).max() < EXACT]
    yield from (f"parameter {name} changes nothing" for name in idle)
    if not idle and np.linalg.matrix_rank(columns, tol=1e-6) < len(columns):
        yield "two parameters do the same thing: a change of one can be undone by others; leave one out"


def _outside(rig, parameters):
    vertices = rig.vertices(parameters)
    for i, name in enumerate(rig.part_names):
        reach = vertices[:, rig.vertex_part == i].transpose(2, 0, 1).reshape(3, -1)
        axis, at = divmod(int(np.abs(reach).argmax()), reach.shape[1])
        if abs(reach[axis, at]) > 0.5 + EXACT:
            yield f"part {name} reaches {'xyz'[axis]} = {reach[axis, at]:.6g}, outside [-0.5, 0.5]; narrow a range"


def _thin(rig, parameters):
    edges = rig.rest_boxes(parameters)[1].min(axis=0)
    for name, edge in zip(rig.part_names, edges, strict=True):
        if edge.min() < THINNEST - EXACT:
            yield f"part {name} can get {edge.min():.3g} thin along {'xyz'[edge.argmin()]}; keep it above {THINNEST}"


def _turned_out(rig, parameters):
    vertices = rig.rest_vertices(parameters)
    for i, name in enumerate(rig.part_names):
        if volumes(vertices, rig.triangles[rig.triangle_part == i]).min() <= 0:
            yield f"part {name} can turn inside out: one of its lengths becomes negative"


def _off_the_floor(rig, parameters):
    heights = rig.rest_vertices(parameters)[:, :, 1]
    low, high = heights.min(axis=1), heights.max(axis=1)
    stands, hangs = (np.abs(one - level).max() < EXACT for one, level in ((low, FLOOR), (high, -FLOOR)))
    swings = not rig.linear and np.ptp(low) < EXACT  # what swings through may need room below
    if not (stands or hangs or swings or rig.category == "airplane"):
        yield f"it must stand on y = {FLOOR}, always, but its lowest point is at {low.min():.3g} to {low.max():.3g}"


def _apart(rig, parameters):
    for contact, gap in zip(rig.contacts, fits.gaps(rig, parameters).T, strict=True):
        worst = gap[np.abs(gap).argmax()]
        if abs(worst) > EXACT:
            what = f"are {worst:.3g} apart" if worst > 0 else f"run {-worst:.3g} into each other"
            yield f"{contact.first} and {contact.second} {what} where they should touch ({contact.kind})"


def _beside(rig, parameters):
    centres, extents = rig.rest_boxes(parameters)
    for contact in rig.contacts:
        one, other = (rig.part_names.index(name) for name in contact[:2])
        over = (extents[:, one] + extents[:, other]) / 2 - np.abs(centres[:, one] - centres[:, other])
        for axis in set(range(3)) - {fits.SIDES.index(contact.kind)}:
            if over[:, axis].min() <= 0:
                pair = f"{contact.first} and {contact.second}"
                yield f"{pair} lie beside each other along {'xyz'[axis]}, so they do not touch"


def _uneven(rig, parameters):
    for pair, off in zip(rig.symmetric, fits.asymmetries(rig, parameters).max(axis=0), strict=True):
        if off > EXACT:
            whose = pair[0] if pair[0] == pair[1] else " and ".join(pair)
            yield f"{whose} should mirror across x = 0, off by {off:.3g}"


def _unhinged(rig, parameters):
    for joint, off in zip(rig.joint_list, fits.loose_hinges(rig, parameters).max(axis=0), strict=True):
        if off > EXACT:
            yield f"{joint.kind} {joint.name} lies {off:.3g} beside {joint.on} or beside what it moves"
