"""A box as a part: its areas, its rest coordinates, its mesh."""

import numpy as np
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from data_gen.part import Box


@given(st.tuples(*[st.floats(0.01, 3.0)] * 3))
def test_areas_add_up_to_the_surface_of_a_box(extents):
    patches = Box.areas(np.array(extents))
    assert patches.shape == (Box.PATCHES,)
    assert np.isclose(patches.sum(), trimesh.creation.box(extents).area, rtol=1e-12)
    for across in range(3):
        assert np.isclose(patches[across], 2 * np.prod(extents) / extents[across], rtol=1e-12)


@given(st.integers(0, 2**32 - 1))
def test_rest_coordinates_lie_on_their_patch(seed):
    rng = np.random.default_rng(seed)
    patch = rng.integers(0, Box.PATCHES, 200)
    u, v = rng.random((2, 200), np.float32)
    rest = Box.rest(patch, u, v)
    across = rest[np.arange(200), patch]
    assert rest.dtype == np.float32
    assert (np.abs(rest) <= 0.5).all()
    np.testing.assert_array_equal(across, np.where(v < 0.5, -0.5, 0.5))
    assert (np.abs(rest) == 0.5).sum(axis=1).max() <= 2, "a point fills its face, it does not sit on a corner"


def test_rest_coordinates_are_not_rounded():
    u = (np.arange(2**12, dtype=np.float32) * 4099 % 2**24) / np.float32(2**24)
    rest = Box.rest(np.zeros(len(u), int), u, u)
    np.testing.assert_array_equal(rest[:, 1].astype(np.float64), u.astype(np.float64) - 0.5)
    np.testing.assert_array_equal(rest[:, 2].astype(np.float64), 2 * u.astype(np.float64) % 1 - 0.5)


def test_points_fill_both_faces_of_each_patch_evenly():
    rng = np.random.default_rng(0)
    for patch in range(Box.PATCHES):
        rest = Box.rest(np.full(20_000, patch), *rng.random((2, 20_000), np.float32))
        cells = np.floor((rest + 0.5) * 1.999).astype(int) @ [4, 2, 1]
        counts = np.bincount(cells, minlength=8)
        assert np.abs(counts - 2500).max() < 5 * np.sqrt(2500), "each of 8 octants gets an eighth"


def test_unit_mesh_is_the_watertight_unit_box_facing_outwards():
    corners, triangles, uv = Box.unit_mesh()
    mesh = trimesh.Trimesh(corners, triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert np.isclose(mesh.volume, 1.0), "a negative volume would mean inward normals"
    assert ((mesh.face_normals * mesh.triangles_center).sum(1) > 0).all()
    assert uv.shape == (8, 2)
    assert ((0 <= uv) & (uv <= 1)).all()


def test_no_face_of_the_unit_mesh_collapses_in_its_uvs():
    _, triangles, uv = Box.unit_mesh()
    a, b, c = uv[triangles].transpose(1, 0, 2)
    assert (np.abs(np.linalg.det(np.stack([b - a, c - a], axis=1))) > 0.05).all()
