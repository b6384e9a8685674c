"""How far a rig is from what it declares, as numbers that should be 0: contacts, mirror images, hinges, linearity."""

import numpy as np

SIDES = ("face_x", "face_y", "face_z")
MIRROR = np.array([-1, 1, 1])


def gaps(rig, parameters):
    """Signed distance (N, C) between the two faces of each contact in the rest pose, negative where boxes overlap."""
    centres, extents = rig.rest_boxes(parameters)
    first, second = ([rig.part_names.index(contact[i]) for contact in rig.contacts] for i in (0, 1))
    axis = [SIDES.index(contact.kind) for contact in rig.contacts]
    return (centres - extents / 2)[:, second, axis] - (centres + extents / 2)[:, first, axis]


def asymmetries(rig, parameters):
    """Largest distance (N, S), in the rest pose, of a part's vertices from the mirror image of its partner's.

    All is linear, so who mirrors whom at one shape at random does so at all; each vertex looks there for its partner.
    """
    vertices, tried = rig.rest_vertices(parameters), rig.rest_vertices(rig.draw(1, np.random.default_rng(0)))[0]
    found = np.zeros((len(parameters), len(rig.symmetric)))
    for i, (one, other) in enumerate(rig.symmetric):
        own, image = (np.flatnonzero(rig.vertex_part == rig.part_names.index(name)) for name in (one, other))
        apart = sum(abs(tried[own, None, axis] - MIRROR[axis] * tried[image, axis]) for axis in range(3))
        pairs = [(own, image[apart.argmin(axis=1)]), (own[apart.argmin(axis=0)], image)]
        for here, there in pairs[: 1 if one == other else 2]:
            off = np.abs(vertices[:, here] - vertices[:, there] * MIRROR).max(axis=(1, 2))
            found[:, i] = np.maximum(found[:, i], off)
    return found


def loose_hinges(rig, parameters):
    """How far (N, J) the pivot of each joint lies outside the box of the part it hangs on, or of all parts it moves."""
    centres, extents = rig.rest_boxes(parameters)
    outside = np.abs(rig.rest_pivots(parameters)[:, :, None] - centres[:, None]) - extents[:, None] / 2
    outside = outside.max(axis=-1).clip(0)
    found = np.zeros(outside.shape[:2])
    for j, joint in enumerate(rig.joint_list):
        moved = [rig.part_names.index(part) for part in joint.parts]
        found[:, j] = np.maximum(outside[:, j, rig.part_names.index(joint.on)], outside[:, j, moved].min(axis=-1))
    return found


def nonlinearity(rig, parameters):
    """Largest difference between what `build` says at parameters (N, p) and what the rig's linear map says."""
    found = (rig.rest_vertices(parameters), rig.rest_pivots(parameters), rig.joint_values(parameters))
    return max(np.abs(one - other).max(initial=0.0) for one, other in zip(rig.built(parameters), found, strict=True))
