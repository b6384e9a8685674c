"""True answers about collections: what a deformation, a transfer and the space of valid deformations really are.

They hold for every family, linear or not, and for transfers between families of one category: a change of parameters
is carried over by name, and a parameter that the third shape lacks changes nothing in it.
"""

import numpy as np

from data_gen.checks import check_kind
from data_gen.families import family as rig_of
from data_gen.joint import HINGE, parents, turns
from data_gen.points import Samples, blend, edges_of


def true_deformation(x, y):
    """Where the samples of x lie once x has become y: points (N, n, 3) float64.

    x and y are collections of N shapes, each pair of one family. Raises ValueError where a pair is not.
    """
    _check((x, y), "true_deformation")
    for i in range(len(x.points)):
        if x.family(i) != y.family(i):
            raise ValueError(
                f"true_deformation: the two shapes of a pair must be of one family, got {x.family(i)} and "
                f"{y.family(i)} in row {i}; use true_transfer, which goes by the parameters' names"
            )
    return np.concatenate([_placed(x, i, _values(y, i)) for i in range(len(x.points))])


def true_transfer(x, y, z, clip=False):
    """What turned x into y, done to z: the samples of z, points (N, n, 3) float64.

    x, y and z are collections of N shapes, each triplet of one category. Raises ValueError where a triplet is not, and
    if a parameter of z leaves its range, with its name, row and range; with `clip` it stops at the end of its range.
    """
    _check((x, y, z), "true_transfer")
    _check_categories((x, y, z))
    wanted = [_changed(x, y, z, i, clip) for i in range(len(z.points))]
    return np.concatenate([_placed(z, i, row) for i, row in enumerate(wanted)])


def valid_space(x):
    """The true deformation dictionary A (N, n, 3, p) of shapes: how their points move by each parameter, float64.

    The Jacobian of the rig at the shape's parameters: exact where the rig is linear, tangent to the true motion where
    hinges turn. Columns of parameters that a shape's family lacks are 0.
    """
    _check((x,), "valid_space")
    found = np.zeros((*x.points.shape, len(x.parameter_names)))
    for i in range(len(x.points)):
        rig, samples = rig_of(x.family(i)), x.samples(i)
        columns = [x.parameter_names.index(name) for name in rig.parameter_names]
        found[i][..., columns] = jacobian(rig, samples, _values(x, i))
    return found


def jacobian(rig, samples, parameters):
    """Derivatives (n, 3, p) of the samples of one shape by its parameters (1, p).

    In the rest pose all is linear. From the part outwards, each joint then takes point q and derivative dq on:
    a hinge to q' = R (q - o) + o and dq' = R (dq - do) + do + (axis x (q' - o)) dv,
    a slide to q' = q + axis v and dq' = dq + axis dv.
    """
    dv, do, dvalue = rig.slopes
    q = blend(edges_of(rig.rest_vertices(parameters)[0], rig.triangles), samples)
    dq = np.stack([blend(edges, samples) for edges in edges_of(dv, rig.triangles)], axis=-1)
    joint, above = rig.joint_of[rig.triangle_part[samples.faces]], np.array([*parents(rig.joint_list), -1])
    pivots, values = rig.rest_pivots(parameters)[0], rig.joint_values(parameters)[0]
    while (joint >= 0).any():
        for j in np.unique(joint[joint >= 0]):
            own = joint == j
            step = _turned if rig.joint_list[j].kind == HINGE else _shifted
            q[own], dq[own] = step(
                rig.joint_list[j].axis, values[j], pivots[j], do[:, j].T, dvalue[:, j], q[own], dq[own]
            )
        joint = above[joint]
    return dq


def _turned(axis, angle, pivot, dpivot, dangle, q, dq):
    turn = turns(axis, np.array([angle]))[0]
    arm = (q - pivot) @ turn.T
    return arm + pivot, turn @ (dq - dpivot) + dpivot + np.cross(axis, arm)[..., None] * dangle


def _shifted(axis, distance, pivot, dpivot, ddistance, q, dq):
    return q + distance * np.array(axis), dq + np.array(axis)[:, None] * ddistance


def _changed(x, y, z, i, clip):
    rig = rig_of(z.family(i))
    by_name = [dict(zip(one.parameter_names, one.parameters[i].astype(np.float64), strict=True)) for one in (x, y)]
    change = [by_name[1].get(name, np.nan) - by_name[0].get(name, np.nan) for name in rig.parameter_names]
    wanted = _values(z, i) + np.nan_to_num(change)
    if clip:
        return np.clip(wanted, rig.low, rig.high)
    return rig.check(wanted, "true_transfer", first=i)


def _values(collection, i):
    """The parameters (1, p) of one shape, of its own family."""
    names = rig_of(collection.family(i)).parameter_names
    return collection.parameters[i, [collection.parameter_names.index(name) for name in names]][None].astype(np.float64)


def _placed(collection, i, parameters):
    rig, samples = rig_of(collection.family(i)), collection.samples(i)
    return rig.place(Samples(samples.faces[None], samples.weights[None]), parameters)


def _check_categories(collections):
    for i in range(len(collections[0])):
        named = [one.family(i) for one in collections]
        if len({rig_of(name).category for name in named}) > 1:
            raise ValueError(
                f"true_transfer: x, y and z must be of one category, got {', '.join(named)} in row {i}; take families "
                "whose names begin alike"
            )


def _check(collections, where):
    for one in collections:
        check_kind(one, where)
    if len({len(one.points) for one in collections}) > 1:
        sizes = ", ".join(str(len(one.points)) for one in collections)
        raise ValueError(f"{where}: the collections must hold equally many shapes, got {sizes}; take rows of them")
    for one in collections:
        if one.faces is None or one.parameters is None or not one.families_known:
            raise ValueError(
                f"{where}: shapes must say their family, parameters and samples, got a collection that does not; "
                "make it with generate"
            )
