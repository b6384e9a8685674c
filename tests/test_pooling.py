import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from worlds import near, randn

from dsn_lite import pooling
from dsn_lite.pooling import linear_max


def slow(h, weight, bias):
    """max over points of W h + b, with all activations kept."""
    return (h @ weight.mT + bias).amax(-2)


@settings(max_examples=15, deadline=None)
@given(st.integers(1, 3), st.integers(1, 90), st.integers(1, 5), st.integers(1, 9), st.integers(20, 600))
def test_value_and_gradients_are_those_of_the_two_steps(clouds, n, c, g, block):
    inputs = [randn(seed, *size).requires_grad_() for seed, size in enumerate([(clouds, n, c), (g, c), (g,)])]
    weights = randn(3, clouds, g)
    results = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pooling, "BLOCK", block)  # so that clouds are cut in many ways
        for pool in (slow, linear_max):
            value = pool(*inputs)
            results.append([value, *torch.autograd.grad((value * weights).sum(), inputs)])
    for expected, found in zip(*results, strict=True):
        near(found, expected)


def test_any_batch_axes_and_none():
    weight, bias = randn(0, 4, 3), randn(1, 4)
    h = randn(2, 2, 5, 70, 3)
    near(linear_max(h, weight, bias), slow(h, weight, bias))
    near(linear_max(h[0, 0], weight, bias), slow(h[0, 0], weight, bias))


def test_of_points_that_tie_one_gets_the_gradient():
    h = torch.ones(1, 64, 2, dtype=torch.float64, requires_grad=True)
    weight, bias = randn(0, 3, 2), randn(1, 3)
    linear_max(h, weight, bias).sum().backward()
    near(h.grad.sum(1)[0], weight.sum(0))
    assert int((h.grad != 0).any(-1).sum()) <= 3


def test_what_is_kept_for_the_gradient_does_not_grow_with_the_channels():
    """The activations (n, g) would be 64 times the points (n, c): what is saved is h, W and an index a channel."""
    h, kept = torch.rand(2, 500, 4, requires_grad=True), []
    with torch.autograd.graph.saved_tensors_hooks(lambda t: kept.append(t.numel()) or t, lambda t: t):
        linear_max(h, torch.rand(256, 4, requires_grad=True), torch.rand(256, requires_grad=True))
    assert sum(kept) == 2 * 500 * 4 + 256 * 4 + 2 * 256
