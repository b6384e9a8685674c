"""Kinds of parts, which shapes of different structure share: `leg_1` and `leg_left` are legs."""

import re
from collections.abc import Sequence

NUMBERED = re.compile(r"_(\d+|left|right|front|rear|back|top|bottom)$")  # as the sample file says


def kind(part_name: str) -> str:
    """A part's name without what tells it from others of its kind."""
    shorter = NUMBERED.sub("", part_name)
    return part_name if shorter == part_name else kind(shorter)


def kinds(part_names: Sequence[str]) -> tuple[str, ...]:
    """The different kinds of these parts, in the order in which they come up."""
    return tuple(dict.fromkeys(map(kind, part_names)))
