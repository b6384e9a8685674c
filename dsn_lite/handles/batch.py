"""The box handles of a batch of shapes at once, for training: B+F(x) and BB+d, padded to the parts of the batch.

Sums over the points of a part, of a field u and of u times the rest coordinates, are all that B+ needs: one product
with an (n, 4P) indicator a shape, after which each part and axis is a regression of two numbers. Neither B, 3n x 6P,
nor BB+, 3n x 3n, is ever formed. BoxHandles are those of one shape, by name.
"""

import torch
from jaxtyping import Float, Int
from torch import Tensor

from ..shapes import Shapes


class BatchHandles:
    """Handles of N shapes with up to P parts each: labels (N, n), rest (N, n, 3), boxes (N, P, 15), NaN where no part.

    mask (N, P, 2, 3) tells which handles are real: translations and scales along the three axes of each part's box. A
    part without points has none, and an axis along which its points have no spread has no scale.
    """

    def __init__(self, labels: Int[Tensor, "N n"], rest: Float[Tensor, "N n 3"], boxes: Float[Tensor, "N P 15"]):
        P, rest = boxes.shape[1], rest.nan_to_num()
        self.free = (labels < 0)[..., None]  # points of no part: B+ does not see them, BB+ leaves them as they are
        own = torch.nn.functional.one_hot(labels.long() + 1, P + 1)[..., 1:].to(rest.dtype)
        self.rotation = boxes[..., 3:12].nan_to_num().unflatten(-1, (3, 3))
        self.count = own.sum(1)
        self.mean = own.mT @ rest / self.count.clamp_min(1).unsqueeze(-1)
        centred = rest - own @ self.mean
        variance = own.mT @ centred.square()
        spread = variance > 1e-10 * self.count.clamp_min(1).unsqueeze(-1)
        self.variance = torch.where(spread, variance, 0)
        self.weight = torch.where(spread, 1 / torch.where(spread, variance, 1), 0)
        self.mask = torch.stack([(self.count > 0).unsqueeze(-1).expand(spread.shape), spread], dim=2)
        # for each part its points, then its points' rest coordinates
        self.sums = torch.cat([own.unsqueeze(-1), own.unsqueeze(-1) * centred.unsqueeze(-2)], dim=-1).flatten(2)

    @classmethod
    def of(cls, shapes: Shapes) -> "BatchHandles":
        """The handles of a collection. Raises ValueError where it does not tell parts."""
        if not shapes.has_parts:
            raise ValueError(
                "BatchHandles: shapes must have labels, rest and boxes, these have no parts; take shapes of data_gen"
            )
        N, n = shapes.points.shape[:2]
        return cls(shapes.labels.expand(N, n), shapes.rest.expand(N, n, 3), shapes.boxes)

    def coordinates(self, u: Float[Tensor, "N n 3 *j"]) -> Float[Tensor, "N m *j"]:
        """B+u, m = 6P: of each part the translations, then the scales; rows that are no handles are 0."""
        mean, slope = self._fit(u)
        translation = torch.einsum("bpca,bpcj->bpaj", self.rotation, mean) - slope * self.mean.unsqueeze(-1)
        z = torch.stack([translation, slope], dim=2) * self.mask.unsqueeze(-1)
        return z.flatten(1, 3).unflatten(-1, u.shape[3:]) if u.ndim > 3 else z.flatten(1)

    def project(self, u: Float[Tensor, "N n 3 *j"]) -> Float[Tensor, "N n 3 *j"]:
        """BB+u; points labelled -1 keep theirs."""
        mean, slope = self._fit(u)
        out = torch.einsum("bpca,bpaj->bpacj", self.rotation, slope)
        placed = self.sums @ torch.cat([mean.unsqueeze(2), out], dim=2).flatten(3).flatten(1, 2)
        return torch.where(self.free, u.flatten(2), placed).view(u.shape)

    def seen(self, u: Float[Tensor, "N n 3 *j"]) -> Float[Tensor, "N *j"]:
        """Root of the mean over points of |BB+u|^2: how much of u the handles see, points of no part left out."""
        mean, slope = self._fit(u)
        square = (self.count[..., None, None] * mean.square() + self.variance.unsqueeze(-1) * slope.square()).sum(
            (1, 2)
        )
        return (square / u.shape[1]).clamp_min(1e-24).sqrt().view(len(u), *u.shape[3:])

    def _fit(self, u: Tensor) -> tuple[Tensor, Tensor]:
        """Mean of u over each part's points (N, P, 3, j), and slope along each axis of its box against rest."""
        total = (self.sums.mT @ u.flatten(2)).view(*self.count.shape, 4, 3, -1)
        mean = total[:, :, 0] / self.count.clamp_min(1)[..., None, None]
        slope = torch.einsum("bpca,bpacj->bpaj", self.rotation, total[:, :, 1:])
        return mean, slope * self.weight.unsqueeze(-1)
