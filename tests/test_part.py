"""Parts: closed surfaces, outward, of the size they say, linear in what they are made of."""

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from data_gen.part import (
    AXES,
    RECTANGLE,
    Section,
    Tip,
    ball,
    box,
    cylinder,
    ellipse,
    joined,
    loft,
    mirrored,
    moved,
    normals,
    prism,
    rounded,
    section,
    volumes,
)

TRIANGLE = np.array([(0.0, 0.5), (-0.5, -0.5), (0.5, -0.5)])
SIZES = st.tuples(*[st.floats(0.01, 3.0)] * 3)
CENTRE = (0.3, -0.2, 0.1)


def cup(p=1.0):
    """Up the outside and down the inside."""
    levels = [(0, 1), (p, 1), (p, 0.8), (0.2, 0.8)]
    return loft("cup", [section("y", (0, y, 0), (w, w)) for y, w in levels], ellipse(16))


def ring():
    turn = 2 * np.pi * np.arange(12) / 12
    sections = [Section((np.cos(t), np.sin(t), 0), (0.2 * np.cos(t), 0.2 * np.sin(t), 0), (0, 0, 0.2)) for t in turn]
    return loft("ring", sections, ellipse(8), closed=True)


EVERY = {
    "box": box("box", CENTRE, (1, 2, 3)),
    "cylinder along x": cylinder("cylinder", CENTRE, (1, 2, 3), "x"),
    "cylinder along y": cylinder("cylinder", CENTRE, (1, 2, 3), "y"),
    "cylinder along z": cylinder("cylinder", CENTRE, (1, 2, 3), "z"),
    "prism": prism("prism", CENTRE, (1, 2, 3), "z", TRIANGLE),
    "rounded": prism("rounded", CENTRE, (1, 2, 3), "x", rounded(0.2)),
    "ball": ball("ball", CENTRE, (1, 2, 3)),
    "cone": loft("cone", [Tip((0, 0, 0)), section("x", (2, 0, 0), (1, 1))], ellipse(12)),
    "cup": cup(),
    "ring": ring(),
    "bars": joined("bars", *(moved(box("bar", CENTRE, (1, 1, 1)), by=(2 * i, 0, 0)) for i in range(5))),
    "mirrored": mirrored(loft("w", [section("x", (0, 0, 0), (1, 1)), section("x", (2, 0, 1), (1, 0.5))]), "m"),
}
PARTS = pytest.mark.parametrize("part", EVERY.values(), ids=EVERY.keys())


@PARTS
def test_every_part_is_closed_and_faces_outwards(part):
    mesh = trimesh.Trimesh(part.vertices[0], part.triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert all(body.volume > 0 for body in mesh.split(only_watertight=False))
    assert np.linalg.norm(normals(part.vertices, part.triangles), axis=-1).min() > 1e-6


@PARTS
def test_uvs_lie_in_the_unit_square_and_no_triangle_collapses_in_them(part):
    a, b, c = part.uv[part.triangles].transpose(1, 0, 2)
    assert part.uv.shape == (part.vertices.shape[1], 2)
    assert ((part.uv >= 0) & (part.uv <= 1)).all()
    assert (np.abs(np.linalg.det(np.stack([b - a, c - a], axis=1))) > 1e-5).all()


@PARTS
def test_volumes_and_normals_are_those_of_trimesh(part):
    mesh = trimesh.Trimesh(part.vertices[0], part.triangles, process=False)
    np.testing.assert_allclose(volumes(part.vertices, part.triangles), [mesh.volume], rtol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(normals(part.vertices, part.triangles)[0], axis=1) / 2, mesh.area_faces)


@given(SIZES)
def test_boxes_cylinders_and_balls_fill_the_box_they_are_told(extents):
    for make in (box, cylinder, ball, lambda *args: cylinder(*args, axis="x"), lambda *args: cylinder(*args, axis="z")):
        vertices = make("part", CENTRE, extents).vertices[0]
        np.testing.assert_allclose(np.ptp(vertices, axis=0), extents, rtol=1e-12)
        np.testing.assert_allclose((vertices.max(0) + vertices.min(0)) / 2, CENTRE, atol=1e-12)


def test_sizes_are_those_of_the_bodies_they_stand_for():
    assert np.isclose(volumes(EVERY["box"].vertices, EVERY["box"].triangles)[0], 6)
    fine = cylinder("fine", CENTRE, (1, 2, 1), "y", 200)
    assert np.isclose(volumes(fine.vertices, fine.triangles)[0], np.pi / 2, rtol=1e-3)
    fine = ball("fine", CENTRE, (1, 1, 1), 100, 100)
    assert np.isclose(volumes(fine.vertices, fine.triangles)[0], np.pi / 6, rtol=2e-3)
    wall = volumes(cup().vertices, cup().triangles)[0] / (np.pi / 4)
    assert np.isclose(wall, 1 - 0.8 * 0.64, rtol=0.03), "a cup is not full"


@pytest.mark.parametrize("axis", AXES)
def test_a_section_is_perpendicular_to_its_axis_and_takes_the_other_two_in_order(axis):
    along = AXES.index(axis)
    ring = loft("part", [section(axis, (0, 0, 0), (2, 3)), section(axis, np.eye(3)[along], (2, 3))]).vertices[0][:4]
    assert np.ptp(ring[:, along]) == 0
    assert [np.ptp(ring[:, other]) for other in range(3) if other != along] == [2, 3]


@given(st.floats(0.1, 2.0), st.floats(0.1, 2.0), st.floats(0.0, 1.0))
def test_vertices_are_linear_in_what_a_loft_is_made_of(one, other, share):
    between = (1 - share) * cup(one).vertices + share * cup(other).vertices
    np.testing.assert_allclose(cup((1 - share) * one + share * other).vertices, between, atol=1e-12)


def test_numbers_and_arrays_over_shapes_mix():
    widths = np.array([1.0, 2.0, 3.0])
    part = box("box", (0, widths, 0), (widths, 1, 1))
    assert part.vertices.shape == (3, 8, 3)
    np.testing.assert_allclose(np.ptp(part.vertices, axis=1)[:, 0], widths)
    assert joined("two", part, box("one", (0, 0, 0), (1, 1, 1))).vertices.shape == (3, 16, 3)


def test_a_mirrored_part_is_the_mirror_image():
    part, image = loft("w", [section("x", (0, 0, 0), (1, 1)), section("x", (2, 0, 1), (1, 0.5))]), EVERY["mirrored"]
    np.testing.assert_array_equal(image.vertices, part.vertices * [-1, 1, 1])


def test_the_part_that_faces_inwards_is_found_by_its_volume():
    part = EVERY["box"]
    assert volumes(part.vertices, part.triangles[:, ::-1])[0] < 0


def test_outlines_fill_the_unit_square_and_are_convex():
    for outline in (RECTANGLE, TRIANGLE, ellipse(8), ellipse(24), rounded(), rounded(0.5, 2)):
        np.testing.assert_allclose([outline.min(0), outline.max(0)], [[-0.5, -0.5], [0.5, 0.5]], atol=1e-12)
        edge = np.roll(outline, -1, axis=0) - outline
        turn = np.cross(np.c_[edge, np.zeros(len(edge))], np.c_[np.roll(edge, -1, axis=0), np.zeros(len(edge))])[:, 2]
        assert (turn > -1e-12).all()
