"""Collections put together from families' shapes: parts and parameters by name, NaN where a family has no such."""

import numpy as np

from data_gen.joint import parents
from data_gen.sample import AXES_IF_SHARED, SAMPLED, VERSION, Collection

AT_ONCE = 2**18
"""Numbers that are worked on at once: few enough to be small beside a collection, and enough to be fast."""


def assembled(sources, which, parameters, dtype):
    """The shapes of each source's parameters, a list of (N_i, p_i), in the order that `which` (N,) says."""
    made = None
    for i, source in enumerate(sources):
        rows, step = np.flatnonzero(which == i), _step(source)
        for start in range(0, len(rows), step):
            one = source.take(parameters[i][start : start + step], dtype)
            if made is None:
                made = _empty([source.rig for source in sources], which, one)
            _fill(made, one, rows[start : start + step] if len(sources) > 1 else slice(start, start + step))
    return made


def about(rigs):
    """What is known of families: which they are, how they stand, and the truth about each."""
    named = {"family": rigs[0].name} if len(rigs) == 1 else {"families": [rig.name for rig in rigs]}
    axes = {"up": "y", "front": "+z", "mirror": "x=0", "units": "the unit cube [-0.5, 0.5]^3"}
    return {**named, "rigs": {rig.name: _truth(rig) for rig in rigs}, "version": VERSION, "split": None, **axes}


def _step(source):
    return max(1, AT_ONCE // max(source.points, source.rig.rest_vertices(source.rig.middle).size))


def _empty(rigs, which, like):
    """A collection to fill, of the types of `like`; parts and joints that are not there stay NaN."""
    N, n = len(which), like.points.shape[1]
    part_names, parameter_names = (
        _union(getattr(rig, kind) for rig in rigs) for kind in ("part_names", "parameter_names")
    )
    wide = {"boxes": (len(part_names), 15), "parameters": (len(parameter_names),)}
    wide["joints"] = max(len(rig.joint_list) for rig in rigs), 8
    arrays = {key: np.full((N, *shape), np.nan, like.points.dtype) for key, shape in wide.items()}
    for key, shape in SAMPLED.items():
        value = getattr(like, key)
        keep = len(rigs) == 1 and value.ndim == AXES_IF_SHARED.get(key)
        arrays[key] = value if keep else np.zeros((N, n, *shape), value.dtype)
    families = which if len(rigs) > 1 else None
    return Collection(**arrays, parameter_names=parameter_names, part_names=part_names, families=families)


def _fill(made, one, rows):
    parts = np.array([made.part_names.index(name) for name in one.part_names], np.int16)
    columns = [made.parameter_names.index(name) for name in one.parameter_names]
    for key in SAMPLED:
        array, value = getattr(made, key), getattr(one, key)
        if array.ndim != AXES_IF_SHARED.get(key):
            array[rows] = parts.take(value) if key == "labels" else value
    places = {"boxes": parts, "parameters": columns, "joints": np.arange(one.joints.shape[1])}
    for key, own in places.items():
        array, value = getattr(made, key), getattr(one, key)
        wide = np.full((len(value), *array.shape[1:]), np.nan, array.dtype)
        wide[:, own] = value
        array[rows] = wide


def _union(names):
    return tuple(dict.fromkeys(name for own in names for name in own))


def _truth(rig):
    return {
        "linear": rig.linear,
        "by_boxes": rig.by_boxes,
        "parts": list(rig.part_names),
        "ranges": {parameter.name: [parameter.low, parameter.high] for parameter in rig.parameters},
        "units": {parameter.name: parameter.unit for parameter in rig.parameters},
        "symmetric_pairs": [list(pair) for pair in rig.symmetric],
        "contacts": [list(contact) for contact in rig.contacts],
        "joint_tree": [
            {"name": joint.name, "kind": joint.kind, "parent": parent, "on": joint.on, "parts": list(joint.parts)}
            for joint, parent in zip(rig.joint_list, parents(rig.joint_list), strict=True)
        ],
    }
