"""Line charts as SVG: small, made without a browser, readable without colours, for each line has its mark."""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from math import floor, log10

from .tables import Number

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 400, 88, 206, 20, 58
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")  # Okabe and Ito (2008)
MARKS = (
    "m-4,0a4,4 0 1 0 8,0a4,4 0 1 0 -8,0z",
    "m-3.6,-3.6h7.2v7.2h-7.2z",
    "m0,-5l4.6,8.4h-9.2z",
    "m0,-5.4l5.4,5.4l-5.4,5.4l-5.4,-5.4z",
    "m0,5l4.6,-8.4h-9.2z",
    "m-1.5,-5h3v3.5h3.5v3h-3.5v3.5h-3v-3.5h-3.5v-3h3.5z",
)


@dataclass(frozen=True)
class Line:
    """A line through the points x, y, with a bar of `spread` to each side of y; a flat one is dashed, without marks."""

    name: str
    x: Sequence[Number]
    y: Sequence[Number]
    spread: Sequence[Number] = ()
    flat: bool = False

    @property
    def ends(self) -> list[tuple[Number, Number]]:
        """Lower and upper end of the bar at each point."""
        return [(y - s, y + s) for y, s in zip(self.y, self.spread or [0.0] * len(self.y), strict=True)]


@dataclass(frozen=True)
class Axis:
    """What is written along an axis, whether it counts in powers of ten, and its numbers, if they are to be these."""

    label: str
    log: bool = False
    at: tuple[Number, ...] = ()

    def ticks(self, values: Sequence[Number]) -> list[Number]:
        """The numbers along the axis: they enclose the values."""
        low, high = min(values), max(values)
        steps = list(self.at) or (self._powers(low, high) if self.log else self._steps(low, high))
        first = max(0, bisect_right(steps, low) - 1)
        return steps[first : max(first + 2, bisect_left(steps, high) + 1)]

    def share(self, value: Number, ends: Sequence[Number]) -> float:
        """How far from the first of the ends to the last a value lies; what is beyond an end lies at it."""
        value = min(max(value, ends[0]), ends[-1])
        low, value, high = (log10(each) if self.log else each for each in (ends[0], value, ends[-1]))
        return (value - low) / (high - low)

    def _powers(self, low: Number, high: Number) -> list[Number]:
        first, last = floor(log10(low)), floor(log10(high)) + 1
        digits = (1,) if last - first > 2 else (1, 2, 5)
        return [float(f"{digit}e{power}") for power in range(first, last + 1) for digit in digits]

    def _steps(self, low: Number, high: Number) -> list[Number]:
        rough = (high - low or abs(high) or 1) / 5
        power = 10.0 ** floor(log10(rough))
        step = power * next(digit for digit in (1, 2, 5, 10) if digit * power >= rough)
        return [round((floor(low / step) + i) * step, 12) for i in range(8)]


@dataclass(frozen=True)
class Picture:
    """A named SVG file and the sentence for those who do not see it."""

    name: str
    said: str
    svg: str


@dataclass(frozen=True)
class Chart:
    """Lines between two axes; `said` is the sentence for those who do not see it, `name` tells it from its siblings."""

    name: str
    said: str
    lines: Sequence[Line]
    x: Axis
    y: Axis

    @property
    def svg(self) -> str:
        """The text of the SVG file."""
        across = self.x.ticks([value for line in self.lines for value in line.x])
        up = self.y.ticks([value for line in self.lines for ends in line.ends for value in ends])
        at_x = lambda value: LEFT + (WIDTH - LEFT - RIGHT) * self.x.share(value, across)
        at_y = lambda value: HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * self.y.share(value, up)
        parts = _frame([(at_x(value), value) for value in across], [(at_y(value), value) for value in up])
        parts += [_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 14, self.x.label, "middle")]
        middle = (TOP + HEIGHT - BOTTOM) / 2
        parts += [f'<g transform="rotate(-90 20 {middle})">{_text(20, middle, self.y.label, "middle")}</g>']
        for i, line in enumerate(self.lines):
            bars = [(at_y(low), at_y(high)) for low, high in line.ends]
            parts += _drawn(i, line.flat, [(at_x(a), at_y(b)) for a, b in zip(line.x, line.y, strict=True)], bars)
            parts += _named(i, line)
        return "\n".join([HEAD, f"<title>{escape(self.said)}</title>", PANEL, *parts, "</svg>", ""])


HEAD = (
    f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" fill="#222222"'
    ' font-family="Open Sans, Helvetica, Arial, sans-serif" font-size="14">'
)
PANEL = f'<rect width="{WIDTH}" height="{HEIGHT}" rx="8" fill="white"/>'  # pages may be dark


def _frame(across: Sequence[tuple[Number, Number]], up: Sequence[tuple[Number, Number]]) -> list[str]:
    """The rules of the grid, and the numbers beside them, of (place, value)."""
    parts = [_rule(at, TOP, at, HEIGHT - BOTTOM, "#E4E4E4") for at, _ in across]
    parts += [_rule(LEFT, at, WIDTH - RIGHT, at, "#E4E4E4") for at, _ in up]
    parts += [_text(at, HEIGHT - BOTTOM + 19, f"{value:g}", "middle") for at, value in across]
    return parts + [_text(LEFT - 8, at + 5, f"{value:g}", "end") for at, value in up]


def _named(i: int, line: Line) -> list[str]:
    """The i-th line of the legend."""
    left, row = WIDTH - RIGHT + 14, TOP + 10 + 22 * i
    return [*_drawn(i, line.flat, [(left, row), (left + 28, row)], []), _text(left + 38, row + 5, line.name)]


def _drawn(i: int, flat: bool, points: Sequence[tuple], bars: Sequence[tuple]) -> list[str]:
    """A line, its bars and its marks, in the i-th colour."""
    colour, mark = COLOURS[i % len(COLOURS)], MARKS[i % len(MARKS)]
    path, dash = "L".join(f"{a:.1f},{b:.1f}" for a, b in points), ' stroke-dasharray="7 4"' if flat else ""
    parts = [f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>']
    parts += [_rule(a, low, a, high, colour) for (a, _), (low, high) in zip(points, bars, strict=False) if low != high]
    return parts + [f'<path d="M{a:.1f},{b:.1f}{mark}" fill="{colour}"/>' for a, b in points if not flat]


def _rule(x0: Number, y0: Number, x1: Number, y1: Number, colour: str) -> str:
    return f'<path d="M{x0:.1f},{y0:.1f}L{x1:.1f},{y1:.1f}" stroke="{colour}" stroke-width="1.2"/>'


def _text(x: Number, y: Number, words: str, anchor: str = "start") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(words)}</text>'
