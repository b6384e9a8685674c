"""A dictionary read as numbers: what each mode moves, how locally, how alike on every shape, and in which basis.

reading = modes.read(space, shapes)
modes.quiet_share(reading), modes.consistency(reading), reading.energy_by_kind, modes.silence(reading, "shelf")
local = modes.change_of_basis(space, modes.local_basis(space, x, y.points).R)
"""

from .bases import Rebased, change_of_basis
from .columns import dead_columns, moved_by_columns, moved_by_lengths, unused
from .consistency import consistency, shuffled
from .following import Following, following
from .kinds import kind, kinds
from .local import Local, disagreement, local_basis, principal, varimax
from .reading import Reading, read
from .silence import Silence, echo, silence
from .sparsity import nonzero_columns, nonzero_elements, quiet_share

__all__ = [
    "Following",
    "Local",
    "Reading",
    "Rebased",
    "Silence",
    "change_of_basis",
    "consistency",
    "dead_columns",
    "disagreement",
    "echo",
    "following",
    "kind",
    "kinds",
    "local_basis",
    "moved_by_columns",
    "moved_by_lengths",
    "nonzero_columns",
    "nonzero_elements",
    "principal",
    "quiet_share",
    "read",
    "shuffled",
    "silence",
    "unused",
    "varimax",
]
