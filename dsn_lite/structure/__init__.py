"""What a space has discovered about structure: whether edits that it completes keep symmetry and contact (Section 4.4).

edits = structure.random_edits(tables, 2000, seed=0)
used = structure.used_directions(space, seen.points[:200], seen.points[200:400])
done = structure.complete(structure.learned(space, used.basis), tables, edits)
structure.leg_ratios(tables, edits, done), structure.pair_ratios(tables, edits, done)
"""

from .completing import Completed, complete, uncompleted
from .edits import Edit, random_edits
from .ratios import leg_ratios, pair_ratios
from .spaces import Used, box_slopes, handle_components, learned, moved_by_boxes, used_directions

__all__ = [
    "Completed",
    "Edit",
    "Used",
    "box_slopes",
    "complete",
    "handle_components",
    "learned",
    "leg_ratios",
    "moved_by_boxes",
    "pair_ratios",
    "random_edits",
    "uncompleted",
    "used_directions",
]
