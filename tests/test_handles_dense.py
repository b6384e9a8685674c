import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from worlds import near, randn, unchecked

from dsn_lite.dictionary import matrix
from dsn_lite.handles import DenseHandles


def lattice(points, low, high, bins=2):
    """B (n, 3, m) of a lattice of (bins + 1)^3 corners around points, each moved along x, y and z: trilinear."""
    place = (points - low) / (high - low) * bins
    corner = torch.cartesian_prod(*[torch.arange(bins + 1, dtype=points.dtype)] * 3)
    weight = (1 - (place[:, None] - corner).abs()).clamp_min(0).prod(-1)
    return torch.einsum("nl,cd->ncld", weight, torch.eye(3, dtype=points.dtype)).flatten(2)


def cage(points):
    """B (n, 3, m) of a cage of four corners around points: the barycentric coordinates of a tetrahedron."""
    corners = torch.tensor([[-4, -4, -4], [12, -4, -4], [-4, 12, -4], [-4, -4, 12]]).to(points)
    ones = torch.ones(len(points), 1).to(points)
    weight = torch.linalg.solve(torch.cat([corners, ones[:4]], 1).T, torch.cat([points, ones], 1).T).T
    return torch.einsum("nl,cd->ncld", weight, torch.eye(3).to(points)).flatten(2), corners.flatten()


def test_a_lattice_follows_affine_motions_exactly():
    points = randn(0, 50, 3).clamp(-1.9, 1.9)
    handles = DenseHandles(lattice(points, -2, 2))
    assert len(handles.names) == 27 * 3
    assert (handles.names[80], handles.z0.sum().item()) == ("handle_80", 0)
    motion = points @ randn(1, 3, 3) + randn(2, 3)
    near(handles.project(motion), motion)
    near(handles.offsets(handles.coordinates(motion)), motion)
    assert (handles.project(randn(3, 50, 3)) - randn(3, 50, 3)).abs().max() > 0.1


def test_corners_of_a_cage_are_values_that_place_the_points():
    points = randn(0, 50, 3)
    B, corners = cage(points)
    handles = DenseHandles(B, corners, [f"corner_{i}.{axis}" for i in range(4) for axis in "xyz"])
    near(handles.offsets(handles.z0), points)
    near(handles.coordinates(points), corners)
    near(handles.offsets(corners + 1), points + 1)


@given(st.integers(0, 999), st.integers(1, 8), st.booleans())
def test_dense_handles_are_the_pseudo_inverse(seed, m, twice):
    B = randn(seed, 9, 3, m)
    handles = DenseHandles(torch.cat([B, B], -1) if twice else B)
    A, plus = randn(seed + 1, 9, 3, 2), torch.linalg.pinv(matrix(handles.B))
    near(handles.coordinates(A[..., 0]), plus @ A[..., 0].flatten())
    near(handles.coordinates(A), plus @ matrix(A))
    near(handles.project(A), (matrix(handles.B) @ plus @ matrix(A)).view(A.shape))


@pytest.mark.parametrize(
    ("B", "z0", "names", "said"),
    [
        (torch.zeros(4, 2, 3), None, None, r"B must be \(n, 3, m\) of finite numbers, got \(4, 2, 3\); look at it"),
        (torch.full((4, 3, 2), torch.nan), None, None, r"B must be \(n, 3, m\) of finite numbers"),
        (torch.zeros(4, 3, 2), torch.zeros(3), None, r".* one for each of the m = 2 handles, .* got 2, 3 and 2 names;"),
        (torch.zeros(4, 3, 2), None, ("a", "a"), r".* names all different, got 2 and 1 names; count again"),
        (torch.zeros(4, 3, 2), None, ("a", "b", "c"), r".* got 2, 3 and 3 names; count again"),
    ],
)
def test_dense_handles_refuse_what_does_not_fit(B, z0, names, said):
    with pytest.raises(ValueError, match=f"DenseHandles: {said}"):
        unchecked(DenseHandles.__init__)(object.__new__(DenseHandles), B, z0, names)
