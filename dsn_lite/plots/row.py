"""A row of shapes in one 3D view: one scale for all, seen from the same side, so that sizes can be compared.

Shapes have y up and look along +z; plotly turns its scenes about z. So (x, y, z) is drawn at (x, -z, y). The view is
orthographic and the row runs across it: neither distance nor place makes a shape look smaller.
"""

from dataclasses import dataclass
from math import cos, hypot, radians, sin
from textwrap import wrap

import numpy as np
from jaxtyping import Float

from .look import FONT

TURN, TILT = radians(28), radians(18)  # of the camera: to the right of the front, and above it
WIDEST, CELL = 860.0, 400.0  # pixels: of a row, beside the file browser of a projected page too; of one shape in it
LINE = 24  # pixels of one line of a title

Cloud = Float[np.ndarray, "_ 3"]  # clouds of a row may differ in size


@dataclass(frozen=True)
class Row:
    """Where `count` shapes stand that fit between the corners `low` and `high`, in the unit of the shapes."""

    low: Float[np.ndarray, " 3"]
    high: Float[np.ndarray, " 3"]
    count: int

    @classmethod
    def of(cls, clouds: list[Cloud], count: int | None = None, room: float = 1.0) -> "Row":
        """A row for these clouds, or for `count` shapes of their size; room 1.3 leaves 30 % for movement."""
        low, high = (np.float64([getattr(c, end)(0) for c in clouds]) for end in ("min", "max"))
        low, high = low.min(0), high.max(0)
        middle, half = (low + high) / 2, np.maximum((high - low) / 2, 1e-3 * max(np.ptp([low, high]), 1e-6))
        return cls(middle - room * half, middle + room * half, count or len(clouds))

    @property
    def seen(self) -> tuple[float, float]:
        """Width and height of one shape's box as the camera sees it."""
        width, up, depth = self.high - self.low
        across = width * sin(TURN) + depth * cos(TURN)
        return width * cos(TURN) + depth * sin(TURN), up * cos(TILT) + across * sin(TILT)

    @property
    def pitch(self) -> float:
        """Distance from one shape to the next."""
        return 1.12 * self.seen[0]

    @property
    def cell(self) -> float:
        """Pixels of one pitch: as many as the row's width and a height of two cells allow."""
        return min(CELL, WIDEST / self.count, 1.2 * CELL * self.pitch / self.seen[1])

    def place(self, points: Cloud, index: int) -> tuple[np.ndarray, ...]:
        """What plotly is given for a cloud that stands at `index`: three 1-D float32 arrays, which travel as bytes."""
        x, y, z = points.T
        along = (index - (self.count - 1) / 2) * self.pitch
        drawn = (x + along * cos(TURN), along * sin(TURN) - z, y)
        return tuple(np.ascontiguousarray(axis, dtype=np.float32) for axis in drawn)

    def marker_size(self, n: int) -> float:
        """Pixels of a point's disc, so that n of them show a surface and not a blot."""
        return float(np.clip(0.3 * self.cell / max(n, 1) ** 0.5, 2.0, 7.0))

    def layout(self, titles: list[str]) -> dict:
        """Scene, camera and size of a figure that shows the whole row, with the titles above."""
        lines = [wrap(title, max(8, int(self.cell / 10.5))) for title in titles]
        scale = self.cell / self.pitch  # pixels for one unit
        band = LINE * max([len(line) for line in lines], default=0) + 8
        height = max(1.06 * self.seen[1] * scale + band, 120)
        middle = (self.low + self.high) / 2
        centre = np.array([middle[0], -middle[2], middle[1] + band / scale / 2 / cos(TILT)])
        reach = 2 * (self.count * self.pitch + hypot(*self.seen))
        axes = {
            f"{axis}axis": {"visible": False, "range": [float(at - reach), float(at + reach)], "showspikes": False}
            for axis, at in zip("xyz", centre, strict=True)
        }
        zoom = float(
            2 * reach * 2 * scale / height
        )  # an orthographic scene is 2 units high, whatever the distance of the eye
        eye = {"x": 2 * sin(TURN) * cos(TILT), "y": -2 * cos(TURN) * cos(TILT), "z": 2 * sin(TILT)}
        camera = {"eye": eye, "up": {"x": 0, "y": 0, "z": 1}, "projection": {"type": "orthographic"}}
        return {
            "width": round(max(self.count * self.cell, 240)),
            "height": round(height),
            "margin": {"l": 0, "r": 0, "t": 0, "b": 0},
            "scene": {
                **axes,
                "aspectmode": "manual",
                "aspectratio": dict.fromkeys("xyz", zoom),
                "camera": camera,
                "dragmode": "turntable",
                "annotations": [self._title(line, index, middle) for index, line in enumerate(lines)],
            },
        }

    def _title(self, lines: list[str], index: int, middle: np.ndarray) -> dict:
        top = middle + np.array([0, self.seen[1] / 2 / cos(TILT), 0])
        at = dict(zip("xyz", map(float, np.ravel(self.place(top[None], index))), strict=True))
        return at | {"text": "<br>".join(lines), "showarrow": False, "yanchor": "bottom", "font": FONT}
