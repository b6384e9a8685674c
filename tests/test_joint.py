"""Joints: turns, shifts, and how they add up along a chain."""

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from data_gen.joint import HINGE, SLIDE, after, hinge, motion, parents, slide, turns
from data_gen.part import box
from data_gen.rig import Parameter, Rig

ANGLES = st.floats(-3.1, 3.1)
AXIS = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda axis: np.linalg.norm(axis) > 0.1)


def arm(p):
    """Three bars of length 0.2, each hung on the end of the one before; the last slides."""
    bars = [box(f"bar_{i}", (0.2 * i + 0.1, 0, 0), (0.2, 0.02, 0.02)) for i in range(4)]
    return (
        *bars,
        hinge("shoulder", ["bar_1"], "bar_0", (0, 0, 1), (0.2, 0, 0), p.shoulder),
        hinge("elbow", ["bar_2"], "bar_1", (0, 1, 1), (0.4, 0, 0), p.elbow),
        slide("hand", ["bar_3"], "bar_2", (1, 0, 0), (0.6, 0, 0), p.hand),
    )


ARM = Rig("arm/three", tuple(Parameter(name, -3.2, 3.2, "", "rad") for name in ("shoulder", "elbow", "hand")), arm)


@given(AXIS, ANGLES)
def test_turns_are_those_of_trimesh(axis, angle):
    unit = hinge("h", [], "", axis, (0, 0, 0), 0).axis
    expected = trimesh.transformations.rotation_matrix(angle, axis)[:3, :3]
    np.testing.assert_allclose(turns(unit, np.array([angle]))[0], expected, atol=1e-12)


@given(AXIS, ANGLES)
def test_a_hinge_leaves_its_axis_where_it_is(axis, angle):
    joint, pivot = hinge("h", [], "", axis, (0, 0, 0), 0), np.array([[0.3, 0.2, 0.1]])
    turn, shift = motion(joint, pivot, np.array([angle]))
    for along in (-1.0, 0.0, 2.0):
        point = pivot[0] + along * np.array(joint.axis)
        np.testing.assert_allclose(turn[0] @ point + shift[0], point, atol=1e-12)


def test_a_slide_shifts_along_its_axis():
    turn, shift = motion(slide("s", [], "", (0, 0, 2), (0, 0, 0), 0), np.zeros((1, 3)), np.array([0.5]))
    np.testing.assert_array_equal(turn[0], np.eye(3))
    np.testing.assert_array_equal(shift[0], [0, 0, 0.5])


def test_a_quarter_turn_goes_counterclockwise_seen_against_the_axis():
    np.testing.assert_allclose(turns((0, 0, 1), np.array([np.pi / 2]))[0] @ [1, 0, 0], [0, 1, 0], atol=1e-15)


def test_a_child_is_carried_by_its_parent():
    assert parents(ARM.joint_list) == [-1, 0, 1]
    half = np.array([[np.pi, 0.0, 0.0]])
    ends = ARM.boxes(half)[0, :, 0]
    np.testing.assert_allclose(ends, [0.1, 0.1, -0.1, -0.3], atol=1e-12)


@given(ANGLES, ANGLES, ANGLES)
def test_motions_along_a_chain_are_one_after_the_other(shoulder, elbow, hand):
    p = np.clip(np.array([[shoulder, elbow, hand]]), -3, 3)
    vertices = ARM.rest_vertices(p)[0]
    move = trimesh.transformations
    own = [
        move.rotation_matrix(p[0, 0], [0, 0, 1], [0.2, 0, 0]),
        move.rotation_matrix(p[0, 1], [0, 1, 1], [0.4, 0, 0]),
        move.translation_matrix([p[0, 2], 0, 0]),
    ]
    for part in range(1, 4):
        carried = np.linalg.multi_dot([np.eye(4), *own[:part]])
        slow = trimesh.transform_points(vertices[ARM.vertex_part == part], carried)
        np.testing.assert_allclose(ARM.vertices(p)[0][ARM.vertex_part == part], slow, atol=1e-12)


@given(ANGLES, ANGLES, ANGLES)
def test_joints_stand_where_their_parts_have_taken_them(shoulder, elbow, hand):
    p = np.clip(np.array([[shoulder, elbow, hand]]), -3, 3)
    found, nudged = ARM.joints(p)[0], p + np.array([0, 1e-6, 0])
    moved = (ARM.vertices(nudged) - ARM.vertices(p))[0][ARM.vertex_part >= 2] / 1e-6
    arms = ARM.vertices(p)[0][ARM.vertex_part >= 2] - found[1, 3:6]
    np.testing.assert_allclose(moved, np.cross(found[1, :3], arms), atol=1e-5)
    np.testing.assert_allclose(found[:, 6], p[0], atol=1e-12)
    assert found[:, 7].tolist() == [0, 0, 1]
    assert [joint.kind for joint in ARM.joint_list] == [HINGE, HINGE, SLIDE]


@pytest.mark.parametrize(("make", "kind"), [(hinge, "hinge"), (slide, "slide")])
@pytest.mark.parametrize("axis", [(0, 0, 0), (0, 1), (0, np.inf, 0), (np.nan, 0, 1)])
def test_an_axis_without_a_direction_is_refused(make, kind, axis):
    with pytest.raises(
        ValueError, match=rf"^{kind} knee: axis must be three numbers, not all 0, got \(.*; \(0, 1, 0\)"
    ):
        make("knee", ["post"], "foot", axis, (0, 0, 0), 0)


def test_what_turns_hinges_is_known_and_drawn_anew_between_the_corners():
    corners = np.tile(ARM.low, (5, 1))
    found = ARM.between(corners, np.random.default_rng(0))
    assert ARM.turning.tolist() == [True, True, False]
    assert (found[:, 2] == ARM.low[2]).all()
    assert len(np.unique(found[:, :2])) == 10
    assert (np.abs(found) <= 3.2 + 1e-6).all()


def test_after_is_the_product_of_the_motions():
    rng = np.random.default_rng(0)
    (one, a), (two, b) = ((rng.normal(size=(2, 3, 3)), rng.normal(size=(2, 3))) for _ in range(2))
    turn, shift = after((one, a), (two, b))
    x = rng.normal(size=3)
    np.testing.assert_allclose(turn @ x + shift, np.einsum("nij,nj->ni", one, two @ x + b) + a)
