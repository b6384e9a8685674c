"""The twin of tests/benchmarks/step.py: one training step of DeformSyncNet, written down as the paper says it.

Every layer is a 1x1 convolution (or a linear layer, after the pooling), batch norm and LeakyReLU(0.2); the encoder runs
on the source and on the target; the global feature is repeated for every point; B B+ is formed as a (3n, 3n) matrix
from B and B+ given ready made; nearest neighbours come from all distances. Nothing is made slow on purpose.
"""

from itertools import pairwise

import torch
from torch import Tensor, nn

from dsn_lite import Shapes
from dsn_lite.handles import BoxHandles

MOST = 96  # handles of a shape: 16 parts of 3 translations and 3 scales; fewer are padded with zeros
STACK = (64, 64, 128, 1024)  # after the first layer; the point feature that F reads again is that of its second layer


def block(layer: nn.Module, norm: type[nn.Module], *between: nn.Module) -> nn.Sequential:
    """A layer, what comes between, batch norm and LeakyReLU."""
    return nn.Sequential(layer, *between, norm(layer.weight.shape[0]), nn.LeakyReLU(0.2))


def convolutions(widths: tuple[int, ...], norm: type[nn.Module]) -> nn.Sequential:
    """1x1 convolutions over (b, channels, n)."""
    return nn.Sequential(*(block(nn.Conv1d(before, after, 1), norm) for before, after in pairwise(widths)))


class LiteralEncoder(nn.Module):
    """E of a cloud (b, 3, n)."""

    def __init__(self, k: int, norm: type[nn.Module] = nn.BatchNorm1d):
        super().__init__()
        self.features = convolutions((3, 64, *STACK), norm)
        self.head = nn.Sequential(
            block(nn.Linear(1024, 512), norm), block(nn.Linear(512, 256), norm, nn.Dropout(0.3)), nn.Linear(256, k)
        )

    def forward(self, x: Tensor) -> Tensor:
        """The code (b, k)."""
        return self.head(self.features(x).amax(-1))


class LiteralDictionary(nn.Module):
    """F of a cloud (b, 3, n), its columns of length 1 over 3n."""

    def __init__(self, k: int, norm: type[nn.Module] = nn.BatchNorm1d):
        super().__init__()
        self.k = k
        self.local, self.features = convolutions((3, 64, 64), norm), convolutions(STACK, norm)
        self.head = convolutions((1024 + 64, 512, 256, 128, 3 * k), norm)

    def forward(self, x: Tensor) -> Tensor:
        """The dictionary (b, 3n, k)."""
        point = self.local(x)
        whole = self.features(point).amax(-1, keepdim=True).expand(-1, -1, x.shape[-1])
        fields = self.head(torch.cat([whole, point], dim=1))
        A = fields.unflatten(1, (3, self.k)).permute(0, 3, 1, 2).flatten(1, 2)
        return A / A.square().sum(1, keepdim=True).sqrt()


class Theirs(nn.Module):
    """Both networks and the loss of pairs of shapes, whose B (b, 3n, m) and B+ (b, m, 3n) are at hand."""

    def __init__(self, shapes: Shapes, pairs: int, k: int, norm: type[nn.Module] = nn.BatchNorm1d):
        super().__init__()
        self.encode, self.dictionary = LiteralEncoder(k, norm), LiteralDictionary(k, norm)
        self.x, self.y = paired(shapes.points, pairs)
        dense = [BoxHandles(shapes.labels[i], shapes.rest[i], shapes.boxes[i]).B for i in range(pairs)]
        self.B, self.B_plus = map(torch.stack, zip(*map(padded, dense), strict=True))

    def forward(self) -> Tensor:
        """100 (L_F + L_R), with the deformed shapes projected onto the handles of the sources."""
        x, y = self.x.mT, self.y.mT
        v = self.encode(y) - self.encode(x)
        deformed = self.x.flatten(1).unsqueeze(-1) + self.dictionary(x) @ v.unsqueeze(-1)
        deformed = (torch.bmm(self.B, self.B_plus) @ deformed).view_as(self.x)
        return 100 * (all_pairs(deformed, self.y) + all_pairs(deformed, deformed * deformed.new_tensor([-1, 1, 1])))

    def take(self, encode: nn.Module, dictionary: nn.Module) -> None:
        """Takes the weights of dsn_lite's E and F: before a maximum and at their end no LeakyReLU, slope 1."""
        E, F, twin = _linear(encode), _linear(dictionary.local, dictionary.features), self.dictionary
        whole, point = dictionary.from_global.weight, dictionary.from_local
        joined = torch.cat([whole, point.weight], dim=1), point.bias
        weights = [(layer.weight, layer.bias) for layer in (*E, *F)]
        weights += [joined, *((layer.weight, layer.bias) for layer in _linear(dictionary.head))]
        own = [layer for layer in self.modules() if isinstance(layer, (nn.Conv1d, nn.Linear))]
        for layer, (weight, bias) in zip(own, weights, strict=True):
            layer.weight.data.copy_(weight.view_as(layer.weight))
            layer.bias.data.copy_(bias)
        for stack in (self.encode.features, twin.features, twin.head):
            stack[-1][-1].negative_slope = 1.0


def paired(values: Tensor, pairs: int) -> tuple[Tensor, Tensor]:
    """Sources and targets: the first rows with those behind them, or each row with the next where there are no more."""
    return values[:pairs], values.roll(-pairs if len(values) > pairs else -1, 0)[:pairs]


def all_pairs(x: Tensor, y: Tensor) -> Tensor:
    """Mean Chamfer distance from all distances."""
    distances = torch.cdist(x, y)
    return sum(distances.min(axis).values.square().mean() for axis in (-1, -2))


def padded(dense: Tensor) -> tuple[Tensor, Tensor]:
    """B (3n, m) and B+ (m, 3n) of one shape's dense handles (n, 3, m), as a data set would hold them."""
    B = dense.flatten(0, 1)
    empty = MOST - B.shape[1]
    B_plus = torch.linalg.pinv(B.double()).to(B)
    return nn.functional.pad(B, (0, empty)), nn.functional.pad(B_plus, (0, 0, 0, empty))


def _linear(*modules: nn.Module) -> list[nn.Linear]:
    return [layer for module in modules for layer in module.modules() if isinstance(layer, nn.Linear)]
