import sys

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from worlds import near, randn, unchecked

from dsn_lite import chamfer as public
from dsn_lite.chamfer import _nearest_by_blocks, chamfer, nearest, plant


def loops(x, y):
    """Ch(x, y) of two clouds, pair by pair."""
    there = sum(min((a - b).square().sum() for b in y) for a in x) / len(x)
    back = sum(min((a - b).square().sum() for a in x) for b in y) / len(y)
    return there + back


@st.composite
def pairs(draw):
    """Two batches of clouds, (b, n, 3) and (b, p, 3)."""
    b, n, p, seed = draw(st.integers(1, 2)), draw(st.integers(1, 6)), draw(st.integers(1, 6)), draw(st.integers(0, 999))
    scale = draw(st.sampled_from([1e-2, 1.0, 1e2]))
    return randn(seed, b, n, 3, scale=scale), randn(seed + 1, b, p, 3, scale=scale)


@given(pairs())
def test_it_is_the_loops_in_value_and_gradient(clouds):
    x, y = (cloud.requires_grad_() for cloud in clouds)
    slow = torch.stack([loops(a, b) for a, b in zip(x, y, strict=True)])
    scale = x.detach().abs().max() ** 2
    near(chamfer(x, y), slow, scale=scale)
    for one, other in zip(
        torch.autograd.grad(chamfer(x, y).sum(), (x, y)), torch.autograd.grad(slow.sum(), (x, y)), strict=True
    ):
        near(one, other, scale=scale)


def test_by_hand():
    x, y = torch.tensor([[[0.0, 0, 0]]]), torch.tensor([[[1.0, 0, 0], [3, 0, 0]]])
    assert chamfer(x, y).tolist() == [1 + (1 + 9) / 2]


def test_gradcheck():
    x, y = randn(0, 2, 5, 3).requires_grad_(), randn(1, 2, 4, 3).requires_grad_()
    assert torch.autograd.gradcheck(chamfer, (x, y))


@given(pairs())
def test_a_cloud_is_at_no_distance_from_itself_exactly(clouds):
    for dtype in (torch.float32, torch.float64):
        x = clouds[0].to(dtype)
        assert (chamfer(x, x) == 0).all()
        assert (chamfer(x, x.flip(-2)) == 0).all()


@given(pairs())
def test_it_is_symmetric_and_blind_to_order_exactly_in_its_neighbours(clouds):
    x, y = clouds
    near(chamfer(x, y), chamfer(y, x), scale=x.abs().max() ** 2)
    near(chamfer(x.flip(-2), y), chamfer(x, y), scale=x.abs().max() ** 2)


@given(pairs())
def test_kept_trees_change_nothing(clouds):
    x, y = clouds
    assert torch.equal(chamfer(x, y, plant(y)), chamfer(x, y))


def test_trees_of_other_clouds_do_change_it():
    x, y = randn(0, 1, 30, 3), randn(1, 1, 30, 3)
    assert not torch.equal(chamfer(x, y, plant(y.flip(-2))), chamfer(x, y))


def test_batches_broadcast():
    x, y = randn(0, 5, 3), randn(1, 2, 3, 4, 3)
    every = chamfer(x, y)
    assert every.shape == (2, 3)
    near(every[1, 2], chamfer(x, y[1, 2]))
    assert chamfer(x, y[0, 0]).shape == ()


@pytest.mark.parametrize("block", [1, 7, 1 << 24])
def test_blocks_of_the_gpu_find_the_neighbours_of_the_trees(block, monkeypatch):
    monkeypatch.setattr(sys.modules["dsn_lite.chamfer"], "BLOCK", block)  # dsn_lite.chamfer is the function
    x, y = randn(0, 2, 40, 3), randn(1, 2, 33, 3)
    assert torch.equal(_nearest_by_blocks(x, y), nearest(x, y))


def test_blocks_find_every_point_itself_even_where_points_are_dense():
    """Distances from |x|^2 - 2 x.y + |y|^2 would fail here: in float32 a neighbour 1e-4 away looks as near."""
    x = randn(0, 1, 200, 3, dtype=torch.float32) / 4
    close = torch.cat([x, x + 1e-4], dim=-2)
    found = torch.take_along_dim(close, _nearest_by_blocks(close, close).unsqueeze(-1), dim=-2)
    assert torch.equal(found, close)


def test_the_public_name_is_the_function():
    assert public is chamfer


@pytest.mark.parametrize("shape", [(1, 3, 8), (3,), (2, 0, 3)])
@pytest.mark.parametrize("name", ["x", "y"])
def test_it_refuses_what_is_no_cloud(shape, name):
    clouds = {"x": torch.zeros(2, 4, 3), "y": torch.zeros(2, 4, 3)} | {name: torch.zeros(shape)}
    with pytest.raises(ValueError, match=rf"chamfer: {name} must be \(\.\.\., n, 3\) points with n > 0, got .*\.mT"):
        unchecked(chamfer)(**clouds)


@pytest.mark.parametrize("bad", [float("nan"), float("inf")])
@pytest.mark.parametrize("name", ["x", "y"])
def test_it_refuses_points_that_are_not_finite(bad, name):
    clouds = {"x": torch.zeros(2, 4, 3), "y": torch.zeros(2, 4, 3)}
    clouds[name][1, 2, 0] = bad
    with pytest.raises(ValueError, match=r"chamfer: .* must be finite"):
        chamfer(**clouds)
