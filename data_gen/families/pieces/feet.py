"""Four feet that taper and splay, or bulge, as low furniture has them."""

from data_gen.part import ellipse, loft, mirrored, moved, section
from data_gen.rig import FLOOR, Contact

SYMMETRIC = (("leg_1", "leg_2"), ("leg_3", "leg_4"))
TAPERED = ((0, 0.5), (1, 1))
"""How high and how wide a foot is from the floor up, as shares of its height and of its thickness at its widest."""
BUN = ((0, 0.6), (0.25, 0.95), (0.5, 1.0), (0.75, 0.9), (1, 0.5))


def four_feet(x, z, height, thickness, splay=0.0, profile=TAPERED, outline=None):
    """Feet whose tops stand at (+-x, height, +-z); on the floor they stand farther out by `splay` along x and z.

    1 and 2 stand in front (z > 0), 1 and 3 at x > 0.
    """
    outline = ellipse(12) if outline is None else outline
    front, rear = (_foot(x, side * z, (splay, side * splay), height, thickness, profile, outline) for side in (1, -1))
    return moved(front, "leg_1"), mirrored(front, "leg_2"), moved(rear, "leg_3"), mirrored(rear, "leg_4")


def under(*parts):
    """The contacts of what stands on the four feet: one part, or for each foot its own."""
    carried = parts * 4 if len(parts) == 1 else parts
    return tuple(Contact(f"leg_{i}", part, "face_y") for i, part in enumerate(carried, start=1))


def _foot(x, z, splay, height, thickness, profile, outline):
    sections = []
    for share, wide in profile:
        at = (x + (1 - share) * splay[0], FLOOR + share * height, z + (1 - share) * splay[1])
        sections.append(section("y", at, (wide * thickness, wide * thickness)))
    return loft("leg", sections, outline)
