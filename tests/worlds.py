"""What the tests of the core share: tolerances, drawn sizes and scales, and small spaces to try laws on."""

import inspect

import numpy as np
import torch
from hypothesis import strategies as st
from torch import nn

import data_gen
from dsn_lite.config import Config
from dsn_lite.data import Shapes
from dsn_lite.files import as_shapes
from dsn_lite.networks import DictionaryPredictor, Encoder, perceptron, reset
from dsn_lite.space import AutoencoderSpace, DeformSyncNet, LinearSpace

TOL = {torch.float32: 1e-4, torch.float64: 1e-9}  # relative to the size of what is compared
FAMILIES = {"box/one": 3, "table/four_legs": 6, "table/shelf": 8, "chair/four_legs": 8}  # name: degrees of freedom
K = 3


def near(a, b, *, scale=1.0):
    """Assert that two tensors agree to the tolerance of their type, relative to `scale`."""
    torch.testing.assert_close(a, b, rtol=0, atol=TOL[a.dtype] * max(1.0, float(torch.as_tensor(scale).detach())))


def unchecked(function):
    """A function without its shape checks, to reach the sentence that users meet where shapes are not checked."""
    return inspect.unwrap(function)


def randn(seed, *shape, scale=1.0, dtype=torch.float64):
    """Normal numbers from a seed."""
    return scale * torch.from_numpy(np.random.default_rng(seed).standard_normal(shape)).to(dtype)


@st.composite
def worlds(draw):
    """Shapes x, y, z (b, n, 3) and vectors u, v (b, K): sizes and scales are drawn, numbers come from a seed."""
    batch, n = draw(st.integers(1, 3)), draw(st.integers(2, 9))
    scale, seed = draw(st.sampled_from([1e-2, 1.0, 1e2])), draw(st.integers(0, 2**16))
    x, y, z = randn(seed, 3, batch, n, 3, scale=scale)
    u, v = randn(seed + 1, 2, batch, K)
    return x, y, z, u, v


def deform_sync_net(seed=0, columns="rms"):
    """A small untrained DeformSyncNet in float64."""
    encoder, predictor = Encoder(K, (8, 16), (8,)), DictionaryPredictor(K, (8,), (16,), (16,), columns)
    return reset(DeformSyncNet(encoder, predictor), seed).double()


def linear_space(n=7, seed=0):
    """A linear space over n points with a random dictionary."""
    return LinearSpace(randn(seed, n, 3, K))


class Decoder(nn.Module):
    """A code to n points."""

    def __init__(self, n):
        super().__init__()
        self.layers = perceptron((K, 16, 3 * n))

    def forward(self, code):
        return self.layers(code).unflatten(-1, (-1, 3))


def autoencoder(n=7, seed=0):
    """A small untrained autoencoder space."""
    return reset(AutoencoderSpace(Encoder(K, (8, 16), (8,)), Decoder(n)), seed).double()


def shapes_of(family="box/one", count=12, points=64, *, seed=0, **choices) -> Shapes:
    """Generated shapes, as the library sees them."""
    return as_shapes(data_gen.generate(family, count=count, points=points, seed=seed, **choices))


TINY = Config(k=3, batch=4, steps=30, features=(8, 16, 32), head=(16,))


def weights(space):
    return torch.cat([value.flatten() for value in space.state_dict().values()])


def stop_at(look):
    """A watch that presses Ctrl-C at one of the looks."""

    def watch(training, record):
        if len(training.history) == look:
            raise KeyboardInterrupt

    return watch
