"""Pictures of the experiment on structure, as SVG: ratios beside the paper's, and the worst edits."""

from collections.abc import Sequence
from html import escape
from itertools import product
from math import floor, log10

from .chart import COLOURS, Picture
from .results import Results
from .structure_page import FOUR_LEGS, PAPER
from .tables import Number

Box = Sequence[Number]  # centre, edge lengths
FONT = 'font-family="Open Sans, Helvetica, Arial, sans-serif" font-size="14" fill="#222222"'
LIGHT = {1: 1.0, 0: 0.72, 2: 0.86}  # of the face that looks along an axis: towards the light, away, to the front
AXES = ((0.82, 0.30), (0.0, -1.0), (-0.46, 0.34))  # where x, y and z point on the page
CELL, SCALE = 172, 108


def drawings(results: Results) -> list[Picture]:
    """Bars of the ratios, and the worst edits of the first seed; none where no table was measured."""
    if FOUR_LEGS not in results.arms:
        return []
    found = {
        "learned, mean": [results.mean(FOUR_LEGS, f"{r}_mean") for r in PAPER],
        "learned, median": [results.mean(FOUR_LEGS, f"{r}_median") for r in PAPER],
        "paper, mean": list(PAPER.values()),
        "no projection, mean": [results.mean(FOUR_LEGS, f"none_{r}_mean") for r in PAPER],
    }
    said = "Mean and median ratios of the learned projection beside the paper's means and those of no projection"
    worst = "The ten worst edits: before, edited, and completed"
    pictures = [Picture("ratios", said, bars(said, list(PAPER), found))]
    stored = results.values(FOUR_LEGS, "worst")
    return [*pictures, Picture("worst", worst, edited_boxes(worst, stored[0]))] if stored else pictures


def bars(said: str, groups: Sequence[str], found: dict[str, Sequence[Number]]) -> str:
    """Grouped bars on a scale of powers of ten."""
    width, top, bottom, left = 760, 20, 300, 78
    values = [value for each in found.values() for value in each if value > 0]
    low, high = floor(log10(min(values))), floor(log10(max(values))) + 1
    at = lambda value: bottom - (bottom - top) * (log10(max(value, 10**low)) - low) / (high - low)
    parts = []
    for power in range(low, high + 1):
        y = at(10**power)
        parts.append(f'<path d="M{left},{y:.1f}H{width - 10}" stroke="#E4E4E4"/>')
        parts.append(f'<text x="{left - 8}" y="{y + 5:.1f}" text-anchor="end">{10.0**power:g}</text>')
    room, wide = (width - 10 - left) / len(groups), (width - 10 - left) / len(groups) / (len(found) + 1)
    for (g, group), (i, each) in product(enumerate(groups), enumerate(found.values())):
        x, y = left + g * room + (i + 0.5) * wide, at(each[g])
        parts.append(f'<path d="M{x:.1f},{bottom}V{y:.1f}h{wide - 3:.1f}V{bottom}z" fill="{COLOURS[i]}"/>')
        if i == 0:
            parts.append(
                f'<text x="{left + (g + 0.5) * room:.1f}" y="{bottom + 20}" text-anchor="middle">{group}</text>'
            )
    for i, name in enumerate(found):
        x = left + i * 168
        parts.append(f'<path d="M{x},{bottom + 36}h14v14h-14z" fill="{COLOURS[i]}"/>')
        parts.append(f'<text x="{x + 20}" y="{bottom + 48}">{escape(name)}</text>')
    return _svg(width, bottom + 64, said, parts)


def edited_boxes(said: str, trials: Sequence[Sequence[Sequence[Box]]]) -> str:
    """Trials of three shapes each, two trials a row: the part that was edited is in another colour."""
    parts, wide = [], 3 * CELL + 24
    for place, (before, edited, after) in enumerate(trials):
        left, top = 12 + place % 2 * wide, 8 + place // 2 * (CELL + 30)
        pinned, scale = _pinned(before, edited), SCALE / max(1.0, *map(_reach, (before, edited, after)))
        parts.append(f'<text x="{left + 6}" y="{top + 16}">{place + 1}. {escape(_told(before, edited, pinned))}</text>')
        for column, boxes in enumerate((before, edited, after)):
            middle = left + (column + 0.5) * CELL, top + 26 + 0.52 * CELL
            parts += _drawn(boxes, pinned[0], middle, scale)
    rows = (len(trials) + 1) // 2
    return _svg(2 * wide + 12, rows * (CELL + 30) + 16, said, parts)


def _pinned(before: Sequence[Box], edited: Sequence[Box]) -> tuple[int, int]:
    """The part and the number of its box that an edit changed."""
    numbers = [(p, j) for p, j in product(range(len(before)), range(6))]
    return max(numbers, key=lambda each: abs(edited[each[0]][each[1]] - before[each[0]][each[1]]))


def _told(before: Sequence[Box], edited: Sequence[Box], pinned: tuple[int, int]) -> str:
    part, j = pinned
    name = "top" if part == 0 else f"leg_{part}"
    return f"{name}.{('translation', 'scale')[j // 3]}.{'xyz'[j % 3]}: {before[part][j]:.2f} → {edited[part][j]:.2f}"


def _drawn(boxes: Sequence[Box], pinned: int, middle: tuple[Number, Number], scale: Number) -> list[str]:
    """The visible faces of boxes, those behind first."""
    faces = [(_depth(face), face, axis, part) for part, box in enumerate(boxes) for axis, face in _faces(box)]
    drawn = []
    for _, face, axis, part in sorted(faces, key=lambda each: each[0]):
        path = "L".join(f"{x:.1f},{y:.1f}" for x, y in (_at(corner, middle, scale) for corner in face))
        colour = _shade(COLOURS[1] if part == pinned else "#9FB8CC", LIGHT[axis])
        drawn.append(f'<path d="M{path}z" fill="{colour}" stroke="#222222" stroke-width="0.6"/>')
    return drawn


def _faces(box: Box) -> list[tuple[int, list[list[Number]]]]:
    """The faces of a box that look to the viewer, up, to the right and to the front: (axis, four corners)."""
    centre, half, found = box[:3], [abs(edge) / 2 for edge in box[3:]], []
    for axis in range(3):
        one, other = [each for each in range(3) if each != axis]
        corners = []
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            corner = list(centre)
            corner[axis] += half[axis]
            corner[one] += a * half[one]
            corner[other] += b * half[other]
            corners.append(corner)
        found.append((axis, corners))
    return found


def _reach(boxes: Sequence[Box]) -> Number:
    """Twice the farthest coordinate: 1 where boxes fill [-0.5, 0.5]."""
    return 2 * max(abs(box[axis]) + abs(box[axis + 3]) / 2 for box in boxes for axis in range(3))


def _depth(face: Sequence[Sequence[Number]]) -> Number:
    """How near a face is: the viewer is to the right, above and in front."""
    return sum(0.5 * x + 0.35 * y + 0.8 * z for x, y, z in face)


def _at(corner: Sequence[Number], middle: tuple[Number, Number], scale: Number) -> tuple[Number, Number]:
    x, y = (sum(value * axis[i] for value, axis in zip(corner, AXES, strict=True)) for i in (0, 1))
    return middle[0] + scale * x, middle[1] + scale * y


def _shade(colour: str, light: float) -> str:
    return "#" + "".join(f"{round(int(colour[i : i + 2], 16) * light):02X}" for i in (1, 3, 5))


def _svg(width: Number, height: Number, said: str, parts: Sequence[str]) -> str:
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" role="img" {FONT}>'
    panel = f'<rect width="{width:g}" height="{height:g}" rx="8" fill="white"/>'
    return "\n".join([head, f"<title>{escape(said)}</title>", panel, *parts, "</svg>", ""])
