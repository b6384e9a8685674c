"""How far completed edits are from symmetry and contact, in shares of the shape's own width, height and depth."""

from collections.abc import Sequence

import torch
from jaxtyping import Float
from torch import Tensor

from ..shapes import Shapes
from .completing import Completed
from .edits import Edit

FACES = ("face_x", "face_y", "face_z")
Ratios = dict[str, Float[Tensor, " T"]]


def leg_ratios(shapes: Shapes, edits: Sequence[Edit], done: Completed) -> Ratios:
    """The four ratios of Section 4.4 for tables: "x", "y", "z", "gap".

    x, y, z: the mean over all pairs of legs of how much their edge lengths along an axis differ, over the table's
    width, height, depth. gap: the mean over legs of |lower face of the top - upper face of the leg|, over its height.
    Raises ValueError where the parts are not a top and legs.
    """
    names = shapes.part_names
    legs = [p for p, name in enumerate(names) if name.startswith("leg_")]
    if "top" not in names or len(legs) < 2:
        raise ValueError(f"leg_ratios: shapes must have a top and legs leg_1, leg_2 ..., got {names}; use pair_ratios")
    size, (low, high) = sizes(shapes, edits), faces(done.boxes)
    edges = (high - low)[:, legs]
    pairs = torch.combinations(torch.arange(len(legs)))
    apart = (edges[:, pairs[:, 0]] - edges[:, pairs[:, 1]]).abs().mean(1) / size
    gap = (low[:, names.index("top"), 1, None] - high[:, legs, 1]).abs().mean(1) / size[:, 1]
    return {"x": apart[:, 0], "y": apart[:, 1], "z": apart[:, 2], "gap": gap}


def pair_ratios(shapes: Shapes, edits: Sequence[Edit], done: Completed) -> Ratios:
    """For any shapes that tell their mirrored pairs and contacts: "scale", "place" and "gap".

    Pairs mirror each other across x = 0: scale is the mean over pairs and axes of how much edge lengths differ, place
    that of one centre from the mirror image of the other (of a part in the middle, its own). gap is the mean over
    contacts of the distance between the two faces that touch. Each over the shape's extent along that axis; NaN where
    a family has none. Boxes must be parallel to the axes, as those of families without hinges are.
    """
    found = [_of_pairs(shapes, edit.shape, boxes) for edit, boxes in zip(edits, done.boxes, strict=True)]
    return {name: torch.stack([each[name] for each in found]) for name in ("scale", "place", "gap")}


def _of_pairs(shapes: Shapes, i: int, boxes: Float[Tensor, "P 15"]) -> dict[str, Tensor]:
    rig, index = shapes.about["rigs"][family(shapes, i)], shapes.part_names.index
    low, high = faces(boxes)
    size, mirror = extents(shapes.boxes[i].double()), boxes.new_tensor([-1, 1, 1])
    one, other = ([index(pair[side]) for pair in rig["symmetric_pairs"]] for side in (0, 1))
    scale = ((high - low)[one] - (high - low)[other]).abs() / size
    place = ((low + high)[one] - mirror * (low + high)[other]).abs() / (2 * size)
    upper, lower = ([index(contact[side]) for contact in rig["contacts"]] for side in (0, 1))
    axis = torch.tensor([FACES.index(contact[2]) for contact in rig["contacts"]], dtype=torch.long)
    gap = (low[lower, axis] - high[upper, axis]).abs() / size[axis]
    paired = torch.tensor([a != b for a, b in zip(one, other, strict=True)], dtype=torch.bool)
    return {"scale": scale[paired].mean(), "place": place.mean(), "gap": gap.mean()}


def faces(boxes: Float[Tensor, "*b 15"]) -> tuple[Float[Tensor, "*b 3"], Float[Tensor, "*b 3"]]:
    """Lowest and highest coordinates of boxes."""
    reach = (boxes[..., 3:12].unflatten(-1, (3, 3)).abs() @ boxes[..., 12:, None])[..., 0] / 2
    return boxes[..., :3] - reach, boxes[..., :3] + reach


def extents(boxes: Float[Tensor, "*b P 15"]) -> Float[Tensor, "*b 3"]:
    """Width, height and depth of whole shapes; NaN rows are parts that are not there."""
    low, high = faces(boxes)
    return high.nan_to_num(-torch.inf).amax(-2) - low.nan_to_num(torch.inf).amin(-2)


def sizes(shapes: Shapes, edits: Sequence[Edit]) -> Float[Tensor, "T 3"]:
    """Extents of the shape of each edit, as it was."""
    return extents(shapes.boxes.double())[[edit.shape for edit in edits]]


def family(shapes: Shapes, i: int) -> str:
    """The family of one shape."""
    return shapes.about["family"] if shapes.families is None else shapes.about["families"][int(shapes.families[i])]
