"""PointNet-style networks: E reads a whole cloud into a code, F writes k offset fields over its points.

Neither has batch norm or dropout: with either, E(x) - E(x) would not be 0 while training. Source: Section 3.3 of the
paper; widths are smaller than the authors' (64-64-64-128-1024 and 512-256-128) so that two cores suffice.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import pi

import torch
from jaxtyping import Float
from torch import Tensor, nn

from .dictionary import column_scales
from .pooling import linear_max
from .types import OtherPoints, Points, Vector


def perceptron(widths: Sequence[int]) -> nn.Sequential:
    """Linear layers with LeakyReLU between them, none after the last."""
    layers: list[nn.Module] = []
    for before, after in pairwise(widths):
        layers += [nn.Linear(before, after), nn.LeakyReLU(0.2, inplace=True)]  # no layer needs what it overwrites
    return nn.Sequential(*layers[:-1])


class Waves(nn.Module):
    """Coordinates x and their sines and cosines at 2^j pi x, j < count; a period is 2 / 2^j units long.

    A small network bends slowly: with waves it tells the two sides of a thin part apart (Tancik et al. 2020).
    """

    def __init__(self, count: int):
        super().__init__()
        self.width = 3 + 6 * count
        self.register_buffer("powers", 2.0 ** torch.arange(count), persistent=False)

    def forward(self, x: Points) -> Float[Tensor, "*#b n c"]:
        """x, then the sines, then the cosines."""
        if self.width == 3:
            return x
        turned = (pi * x.unsqueeze(-1) * self.powers.to(x)).flatten(-2)
        return torch.cat([x, turned.sin(), turned.cos()], -1)


class Features(nn.Module):
    """One feature a cloud: the maximum over its points of what a perceptron makes of each; blind to their order."""

    def __init__(self, widths: Sequence[int]):
        super().__init__()
        self.points = perceptron(widths)

    def forward(self, h: Float[Tensor, "*b n c"]) -> Float[Tensor, "*b g"]:
        """The feature of each cloud."""
        if not self.training:  # nothing is kept for a gradient, and torch.func can look through
            return self.points(h).amax(-2)
        last = self.points[-1]
        return linear_max(self.points[:-1](h), last.weight, last.bias)


class Encoder(nn.Module):
    """E: one code a cloud, blind to the order of its points and to repeated points."""

    def __init__(self, k: int, features: Sequence[int] = (64, 128, 256), head: Sequence[int] = (128,)):
        super().__init__()
        self.features = Features((3, *features))
        self.head = perceptron((features[-1], *head, k))

    def forward(self, x: Points) -> Vector:
        """E(x)."""
        return self.head(self.features(x))


class PairEncoder(nn.Module):
    """The Concat ablation of Section 4.2: one vector from the features of two clouds, not a difference of codes."""

    def __init__(self, k: int, features: Sequence[int] = (64, 128, 256), head: Sequence[int] = (128,)):
        super().__init__()
        self.features = Features((3, *features))
        self.head = perceptron((2 * features[-1], *head, k))

    def forward(self, from_x: Float[Tensor, "*#b g"], from_y: Float[Tensor, "*#b g"]) -> Vector:
        """The vector of a pair from its two features [g(x); g(y)]."""
        return self.head(torch.cat(torch.broadcast_tensors(from_x, from_y), dim=-1))


class DictionaryPredictor(nn.Module):
    """F: a dictionary A_x whose rows follow the points and whose columns have unit length ("rms" or "unit")."""

    def __init__(
        self,
        k: int,
        local: Sequence[int] = (64, 64),
        features: Sequence[int] = (128, 256),
        head: Sequence[int] = (256, 128),
        columns: str = "rms",
        waves: int = 0,
    ):
        super().__init__()
        self.k, self.columns = k, columns
        self.waves = Waves(waves)
        # ends in an activation: without it, a single width would make every feature of a point affine in its place
        self.local = nn.Sequential(perceptron((self.waves.width, *local)), nn.LeakyReLU(0.2, inplace=True))
        self.features = Features((local[-1], *features))
        self.from_local = nn.Linear(local[-1], head[0])
        self.from_global = nn.Linear(features[-1], head[0], bias=False)
        self.head = nn.Sequential(nn.LeakyReLU(0.2, inplace=True), perceptron((*head, 3 * k)))

    def forward(self, x: Points, at: OtherPoints | None = None) -> Float[Tensor, "*#b _ 3 k"]:
        """F(x) at the points of x, or at other points of the same shape with x's global feature and column scales."""
        A, scales, whole = self._read(x)
        return A / scales if at is None else self._fields(self._local(at), whole) / scales

    def unscaled(self, x: Points) -> tuple[Float[Tensor, "*#b n 3 k"], Float[Tensor, "*#b 1 1 k"]]:
        """F(x) as fields and their column scales, F(x) = fields / scales: A v = fields (v / scales) never divides A."""
        return self._read(x)[:2]

    def _read(self, x: Points) -> tuple[Tensor, Tensor, Tensor]:
        here = self._local(x)
        whole = self.features(here).unsqueeze(-2)
        A = self._fields(here, whole)
        return A, column_scales(A, self.columns), whole

    def _local(self, x: Tensor) -> Tensor:
        return self.local(self.waves(x))

    def _fields(self, local: Tensor, whole: Tensor) -> Tensor:
        # W [g; p] = W_g g + W_p p: the global feature g meets W once a cloud, not once a point
        return self.head(self.from_local(local) + self.from_global(whole)).unflatten(-1, (3, self.k))


def reset(module: nn.Module, seed: int) -> nn.Module:
    """Fresh random weights drawn from a seed, leaving torch's global generator as it was."""
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        for layer in module.modules():
            if isinstance(layer, nn.Linear):
                layer.reset_parameters()
    return module
