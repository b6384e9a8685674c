"""Shapes of the arrays, one letter per axis: n points, k dictionary columns, m handles, `*b` any batch axes.

Shape types are documentation at run time and are checked in the tests (pytest --jaxtyping-packages).
`#` marks axes that may broadcast: one dictionary A may serve many vectors v.
"""

from jaxtyping import Float, Int
from torch import Tensor

Points = Float[Tensor, "*#b n 3"]
OtherPoints = Float[Tensor, "*#b p 3"]
Vector = Float[Tensor, "*#b k"]
Dictionary = Float[Tensor, "*#b n 3 k"]
Partners = Int[Tensor, "*#b n"]
