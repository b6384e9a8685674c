"""A mesh as a small picture, by numpy alone: no graphics card, no browser.

The camera is orthographic and its scale fixed, so that shapes in neighbouring pictures compare. Every triangle is cut
into the spans that rows of pixels see of it, every span into its pixels, and of all that fall on a pixel the nearest is
kept: a depth buffer without a loop over triangles.
"""

import numpy as np
from PIL import Image, ImageFilter

EYE = (0.62, 0.56, 1.0)
"""The direction to the eye: in front, to the right and above."""
LIGHT = (-0.3, 1.0, 0.55)
"""The direction to the light, so that the three sides seen of a box get three tones."""
MARGIN = 0.03
"""White around the unit cube, as a share of the picture."""
WHOLE = (0.0, 0.0, 1.0)
"""The window of the whole picture."""
STEP = 2.0**-16
"""Depths are told apart in these steps; at the same step the later triangle is seen, so flush faces do not flicker."""
GAP = 0.02
"""Neighbouring pixels whose depths differ by more than this have a line between them."""
FLOOR = -0.5
"""The height of the floor."""


def paint(vertices, triangles, colours, size, *, eye=EYE, window=WHOLE, supersample=2, ground=True):
    """A picture (size, size, 3) uint8, on white, of closed parts that stand on the floor y = -0.5.

    vertices (V, 3) have y up and z to the front; the cube [-0.5, 0.5]^3 just fits the picture, whatever the shape.
    triangles (F, 3) are counter-clockwise from outside, others are not seen; colours (F, 3) are 0 to 255, one a
    triangle. `window` (left, top, side) is the square of that picture to show, in shares of it. A line goes where
    colour or depth jumps. A pixel is the mean of supersample^2; `ground` puts a soft shadow below.
    """
    vertices, triangles, colours = np.asarray(vertices, float), np.asarray(triangles), np.asarray(colours, float)
    pixels = size * supersample
    seen, depth = nearest(_project(vertices, eye, pixels, window)[triangles], pixels)
    rgba = _palette(vertices[triangles], colours)[seen + len(colours) * _lines(seen, depth, colours)]
    shape = Image.fromarray(rgba.view(np.uint8).reshape(pixels, pixels, 4)).reduce(supersample)
    floor = _shadow(vertices, triangles, eye, size, window) if ground else Image.new("RGBA", shape.size, "white")
    return np.asarray(Image.alpha_composite(floor, shape))[..., :3]


def window_around(points, eye=EYE):
    """The smallest window (left, top, side) in which `paint` shows all the points (..., 3), with a margin."""
    seen = _project(np.asarray(points, float).reshape(-1, 3), eye, 1, WHOLE)[:, :2] + 0.5
    low, high = seen.min(axis=0), seen.max(axis=0)
    side = (high - low).max() * (1 + 2 * MARGIN)
    return (*((low + high - side) / 2), side)


def nearest(corners, pixels):
    """Which triangle each pixel (pixels, pixels) sees, -1 for none, and how near it is there, -1 for none.

    corners (F, 3, 3) are column and row, whole at the pixels' centres, rows downwards, and nearness; a triangle is seen
    from where it runs counter-clockwise. Nearness is returned in STEPs from the least of all corners, or from 0.
    """
    far = corners[..., 2].min(initial=0)
    facing = np.flatnonzero(_doubled_area(corners) > 1e-3)  # thinner ones have no plane to speak of
    corners = corners[facing]
    triangle, row, first, last = _spans(corners, pixels)
    span, column = _ranges(first, last)
    triangle, row = triangle[span], row[span]
    level, across, down = _planes(corners).T
    near = level[triangle] + across[triangle] * column + down[triangle] * row - far
    best = np.full(pixels * pixels, -1, np.int64)
    np.maximum.at(best, row * pixels + column, (near / STEP).astype(np.int64).clip(0) << 32 | facing[triangle])
    best = best.reshape(pixels, pixels)
    return best.astype(np.int32), best >> 32


def _spans(corners, pixels):
    """The triangle, the row, and the first and last column (S,) of every piece that a row of pixels sees of a triangle.

    An edge crosses a row at the same number for the triangles on both its sides: no pixel falls between them.
    """
    x, y = corners[..., 0], corners[..., 1]
    triangle, row = _ranges(*_whole(y.min(1), y.max(1), pixels))
    x_next, y_next = np.roll(x, -1, 1), np.roll(y, -1, 1)
    fall = np.where(y_next == y, np.nan, y_next - y)
    crossing = ((x_next - x) / fall)[triangle] * row[:, None] + ((x * y_next - x_next * y) / fall)[triangle]
    left = np.where(fall[triangle] > 0, crossing, -np.inf).max(1)
    right = np.where(fall[triangle] < 0, crossing, np.inf).min(1)
    return triangle, row, *_whole(left, right, pixels)


def _whole(low, high, pixels):
    """The first and last whole number in each interval (S,) and the picture; a vertex's rounding falls outside none."""
    low, high = np.ceil(low - 1e-7).clip(0, pixels), np.floor(high + 1e-7).clip(-1, pixels - 1)
    return low.astype(int), high.astype(int)


def _ranges(first, last):
    """The whole numbers of all the ranges first..last (S,) in turn, after the index of the range each is of."""
    count = np.maximum(last - first + 1, 0)
    owner = np.repeat(np.arange(len(count)), count)
    return owner, np.arange(len(owner)) + (first - np.cumsum(count) + count)[owner]


def _doubled_area(corners):
    """Twice the area (F,) in the picture, positive for triangles that run counter-clockwise on it."""
    (x, y), (u, v) = (np.moveaxis(corners[:, i, :2] - corners[:, 0, :2], -1, 0) for i in (1, 2))
    return u * y - x * v


def _planes(corners):
    """Nearness at pixel 0, 0, per column and per row (F, 3) of each triangle's plane."""
    (x, y, n), (u, v, m) = (np.moveaxis(corners[:, i] - corners[:, 0], -1, 0) for i in (1, 2))
    slopes = np.stack([n * v - m * y, m * x - n * u], 1) / -_doubled_area(corners)[:, None]
    return np.concatenate([corners[:, :1, 2] - (slopes * corners[:, 0, :2]).sum(1, keepdims=True), slopes], 1)


def _project(points, eye, pixels, window):
    """Column, row and nearness of points (..., 3), the unit cube's silhouette filling the picture but for MARGIN."""
    towards = np.asarray(eye) / np.linalg.norm(eye)
    right = np.cross((0, 1, 0), towards)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(right, towards), towards])
    left, top, side = window
    pixels = pixels / side
    scale = (1 - 2 * MARGIN) * pixels / np.abs(axes[:2]).sum(1).max()
    return points @ axes.T * [scale, scale, 1] + [*(pixels * (0.5 - np.array([left, top])) - 0.5), 0]


def tones(corners):
    """How bright (F,) triangles with corners (F, 3, 3) are, 0 to a little over 1: flat shading by one light."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True).clip(1e-30)
    return 0.7 + 0.33 * normals @ (np.array(LIGHT) / np.linalg.norm(LIGHT))


def _palette(corners, colours):
    """RGBA of all triangles, of lines on them, and of nothing, as (2 F + 1,) uint32."""
    lit = colours * tones(corners)[:, None]
    rgba = np.zeros((2 * len(colours) + 1, 4), np.uint8)
    rgba[:-1, :3] = np.concatenate([lit, lit * 0.4]).clip(0, 255).round()
    rgba[:-1, 3] = 255
    return rgba.view(np.uint32)[:, 0]


def _lines(seen, depth, colours):
    """The pixels (pixels, pixels) on the nearer side of a jump in colour, or in depth by more than a slope makes."""
    code, gap = np.append(colours @ [1, 256, 65536], -1), (GAP + 4 / len(seen)) / STEP
    lines = np.zeros(seen.shape, bool)
    for here, there in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        at = np.nonzero(seen[here] != seen[there])
        nearer = depth[here][at] - depth[there][at]
        jump = (code[seen[here][at]] != code[seen[there][at]]) | (np.abs(nearer) > gap)
        lines[here][at] |= jump & (nearer >= 0)
        lines[there][at] |= jump & (nearer < 0)
    return lines


def _shadow(vertices, triangles, eye, size, window):
    """The floor as an image: as seen from below, dark where the shape is near it and light where it is high above."""
    height = vertices[:, 1] - FLOOR
    flat = _project(vertices * [1, 0, 1] + [0, FLOOR, 0], eye, size, window)
    flat[:, 2] = -height
    seen, depth = nearest(flat[triangles[:, ::-1]], size)
    far = height.max(initial=0)
    dark = np.where(seen < 0, 0, 0.42 * np.exp(-(far - depth * STEP).clip(0) / 0.35))
    grey = Image.fromarray((255 * (1 - dark)).astype(np.uint8))
    return grey.filter(ImageFilter.GaussianBlur(size / 70)).convert("RGBA")
