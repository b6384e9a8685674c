import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from worlds import near, randn, unchecked

from dsn_lite.dictionary import (
    column_rms,
    column_scales,
    coordinates,
    matrix,
    offsets,
    project,
    rank,
    residual,
)


@st.composite
def dictionaries(draw):
    """A (b, n, 3, k) with k <= 3n, u (b, n, 3) and v (b, k)."""
    b, n, k, seed = draw(st.integers(1, 3)), draw(st.integers(2, 6)), draw(st.integers(1, 5)), draw(st.integers(0, 99))
    scale = draw(st.sampled_from([1e-2, 1.0, 1e2]))
    return randn(seed, b, n, 3, k, scale=scale), randn(seed + 1, b, n, 3, scale=scale), randn(seed + 2, b, k)


def loops(A, v):
    """A v, point by point and axis by axis."""
    moved = torch.zeros(A.shape[:-1], dtype=A.dtype)
    for b in range(A.shape[0]):
        for i in range(A.shape[1]):
            for c in range(3):
                moved[b, i, c] = sum(A[b, i, c, j] * v[b, j] for j in range(A.shape[3]))
    return moved


@given(dictionaries())
def test_offsets_are_those_of_loops_in_value_and_gradient(world):
    A, u, v = (part.requires_grad_() for part in world)
    near(offsets(A, v), loops(A, v), scale=A.abs().max())
    fast = torch.autograd.grad((offsets(A, v) * u).sum(), (A, v))
    slow = torch.autograd.grad((loops(A, v) * u).sum(), (A, v))
    for one, other in zip(fast, slow, strict=True):
        near(one, other, scale=A.abs().max() * u.abs().max())


def test_matrix_is_the_papers_three_rows_a_point():
    A = randn(0, 4, 3, 2)
    assert torch.equal(matrix(A)[3 * 2 + 1], A[2, 1])


@given(dictionaries())
def test_coordinates_are_least_squares(world):
    A, u, _ = world
    slow = torch.linalg.lstsq(matrix(A), u.flatten(-2).unsqueeze(-1), driver="gelsd").solution.squeeze(-1)
    near(coordinates(A, u), slow, scale=slow.abs().max())


@given(dictionaries())
def test_a_projection_is_reached_again_and_leaves_nothing_along_A(world):
    A, u, v = world
    near(project(A, offsets(A, v)), offsets(A, v), scale=A.abs().max())
    near(project(A, project(A, u)), project(A, u), scale=u.abs().max())
    left = (u - project(A, u)).flatten(-2)
    near(left.unsqueeze(-2) @ matrix(A), torch.zeros(len(A), 1, A.shape[-1]).double(), scale=A.abs().max() ** 2)


def test_coordinates_of_a_repeated_column_are_the_shortest():
    A = randn(0, 4, 3, 1).expand(4, 3, 2)
    near(coordinates(A, offsets(A, torch.tensor([3.0, 1.0]).double())), torch.tensor([2.0, 2.0]).double())


def test_residual_is_what_projection_leaves_of_each_column():
    A, B = randn(0, 2, 5, 3, 4), randn(1, 2, 5, 3, 6)
    left = residual(A, B)
    for j in range(6):
        near(left[..., j], B[..., j] - project(A, B[..., j]))
    near(coordinates(A, left[..., 0]), torch.zeros(2, 4).double())


def test_rank_counts_independent_columns():
    A = randn(0, 5, 3, 4)
    repeated = torch.stack([A, A[..., [0, 1, 0, 1]], 0 * A])
    assert rank(repeated).tolist() == [4, 2, 0]


@given(dictionaries())
def test_scaled_columns_have_unit_rms_or_unit_length(world):
    A = world[0]
    one = torch.ones(A.shape[0], A.shape[-1]).double()
    near(column_rms(A / column_scales(A, "rms")), one)
    near(torch.linalg.vector_norm(matrix(A / column_scales(A, "unit")), dim=-2), one)


def test_rms_columns_move_a_subset_the_same_and_unit_ones_by_the_root_of_n():
    """The trap: with columns of unit length the same points move sqrt(n1 / n2) times as far when n changes."""
    A = randn(0, 8, 3, 2).repeat(4, 1, 1)  # 32 points that hold four times the same 8
    whole, part = A / column_scales(A, "rms"), A[:8] / column_scales(A[:8], "rms")
    near(whole[:8], part)
    whole, part = A / column_scales(A, "unit"), A[:8] / column_scales(A[:8], "unit")
    near(whole[:8] * (32 / 8) ** 0.5, part)


@pytest.mark.parametrize("columns", ["rms", "unit"])
def test_a_zero_column_gives_no_nan(columns):
    A = randn(0, 4, 3, 2)
    A[..., 1] = 0
    A.requires_grad_()
    scaled = A / column_scales(A, columns)
    scaled.square().sum().backward()
    assert (scaled[..., 1] == 0).all()
    assert A.grad.isfinite().all()


def test_column_scales_refuses_another_length():
    with pytest.raises(ValueError, match='column_scales: columns must be "rms" or "unit", got \'max\''):
        unchecked(column_scales)(randn(0, 4, 3, 2), "max")
