"""Colours of parts: one hue for parts of one kind, the same in all families of a category where that is possible."""

import re

import numpy as np

from data_gen.families import families
from data_gen.families import family as rig_of

PALETTE = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442")
"""Okabe and Ito's colours, which colour-blind people tell apart."""
NUMBERED = re.compile(r"_(\d+|left|right|front|rear|back|top|bottom)$")
LIGHTER = 0.16
"""How far towards white every second part of a kind goes, so that neighbours can be told apart."""


def kind(part_name):
    """What a part is, without what tells it from others of its kind: `leg_1` is a `leg`, `wing_left` a `wing`."""
    shorter = NUMBERED.sub("", part_name)
    return part_name if shorter == part_name else kind(shorter)


def colours(family):
    """Colours (P, 3) uint8 of the parts of a family."""
    rig = rig_of(family)
    hues, seen, found = _hues(rig), {}, []
    for name in rig.part_names:
        which = seen[kind(name)] = seen.get(kind(name), -1) + 1
        hue = np.array(list(bytes.fromhex(PALETTE[hues[kind(name)]][1:])))
        found.append(hue + (which % 2) * LIGHTER * (255 - hue))
    return np.array(found).round().astype(np.uint8)


def _hues(rig):
    """The index of a colour for each kind: its own in the category, or the first one free in the family."""
    known = dict.fromkeys(kind(name) for one in families(rig.category) for name in rig_of(one).part_names)
    wanted = {name: i % len(PALETTE) for i, name in enumerate(known)}
    found = {}
    for name in dict.fromkeys(map(kind, rig.part_names)):
        taken = set(found.values()) if len(found) < len(PALETTE) else set()
        free = [i for i in range(len(PALETTE)) if i not in taken]
        found[name] = wanted[name] if wanted[name] in free else free[0]
    return found
