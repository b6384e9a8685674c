"""The contact sheet of a family as a picture: twelve random shapes, and what each parameter does."""

from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from data_gen.colours import colours, kind
from data_gen.families import family as rig_of
from data_gen.paint import paint, window_around
from data_gen.rig import FLOOR

COLUMNS, ROWS, STEPS, SIDE_BY_SIDE = 4, 3, 5, 2
CELL, SMALL, MARGIN = 260, 100, 24
WIDTH = 2 * MARGIN + COLUMNS * CELL
INK, GREY, PAPER = (34, 34, 34), (110, 110, 110), (255, 255, 255)
PAD = 10
NEAR = 0.02
LINE = 26
"""Height of a line of text."""


def shapes(rig, seed=0):
    """Parameters (12, p) of the random shapes of a sheet."""
    return rig.draw(COLUMNS * ROWS, np.random.default_rng(seed))


def sweeps(rig):
    """Parameters (p, 5, p): each from the low to the high end of its range, the others in the middle."""
    found = np.tile(rig.middle, (len(rig.parameters), STEPS, 1))
    for i, parameter in enumerate(rig.parameters):
        found[i, :, i] = np.linspace(parameter.low, parameter.high, STEPS)
    return found


def sheet(family, seed=0):
    """The contact sheet, a PIL image. Raises ValueError for an unknown family."""
    rig = rig_of(family)
    below = _line("One parameter at a time, the others in the middle", 18)
    return _stacked([_head(rig), _random(rig, seed), below, _sweeps(rig)])


@lru_cache(maxsize=32)  # a page shows them after the picture
def sweep(rig, i):
    """The five shapes of one parameter's sweep side by side, a PIL image."""
    return _row(painted(rig, sweeps(rig)[i], SMALL, window(rig, sweeps(rig).reshape(-1, len(rig.parameters)))))


def range_of(parameter):
    """A parameter's range in words, angles in degrees too."""
    if parameter.unit == "rad":
        low, high = np.degrees((parameter.low, parameter.high))
        return f"{parameter.low:.3g} to {parameter.high:.3g} rad ({low:.0f} to {high:.0f} degrees)"
    return f"{parameter.low:.3g} to {parameter.high:.3g}"


def sort_of(rig):
    """In words: how many parts, parameters and joints, and whether the rig is linear."""
    joints = [joint.kind for joint in rig.joint_list]
    hung = ", ".join(_many(joints.count(one), one) for one in dict.fromkeys(joints))
    linear = "linear in its parameters" if rig.linear else "articulated: angles are not linear"
    counted = (_many(len(rig.part_names), "part"), _many(len(rig.parameters), "parameter"))
    return ", ".join([*counted, *([hung] if hung else []), linear])


def _many(count, word):
    return f"{count} {word}" + ("s" if count != 1 else "")


def painted(rig, parameters, size, seen, cut=True):
    """Pictures of shapes in one window, `seen`, all cut to the rows that one of them needs if `cut` says so."""
    shades, vertices = colours(rig.name)[rig.triangle_part], rig.vertices(parameters)
    look = {"window": seen, "ground": _stand(vertices)}
    cells = np.stack([paint(one, rig.triangles, shades, size, **look) for one in vertices])
    used = np.flatnonzero((cells < 250).any(axis=(0, 2, 3)))
    return [Image.fromarray(cell) for cell in (cells[:, max(0, used[0] - PAD) : used[-1] + PAD] if cut else cells)]


def window(rig, parameters):
    """The window that holds shapes, and the shadows of those that stand."""
    vertices = rig.vertices(parameters)
    return window_around([vertices, vertices * [1, 0, 1] + [0, FLOOR, 0]] if _stand(vertices) else vertices)


def _stand(vertices):
    """Whether shapes are near the floor: what flies or hangs has no shadow near by."""
    return vertices[..., 1].min() < FLOOR + NEAR


def _random(rig, seed):
    parameters = shapes(rig, seed)
    cells = painted(rig, parameters, CELL, window(rig, parameters))
    return _stacked([_row(cells[i : i + COLUMNS]) for i in range(0, len(cells), COLUMNS)])


def _head(rig):
    named = Image.new("RGB", (WIDTH, 84), PAPER)
    draw = ImageDraw.Draw(named)
    draw.text((MARGIN, 18), rig.name, INK, font(34))
    draw.text((MARGIN, 60), sort_of(rig), GREY, font(17))
    return _stacked([named, _key(rig)])


def _key(rig):
    """The kinds of parts in their colours, in as many lines as they need."""
    first = {kind(name): colour for name, colour in reversed(list(zip(rig.part_names, colours(rig.name), strict=True)))}
    places, x, y = {}, MARGIN, 6
    for name in dict.fromkeys(map(kind, rig.part_names)):
        width = 24 + font(17).getlength(_plural(rig, name)) + 22
        x, y = (MARGIN, y + LINE) if x + width > WIDTH else (x, y)
        places[name], x = (x, y), x + width
    key = Image.new("RGB", (WIDTH, y + LINE + 4), PAPER)
    for name, (x, y) in places.items():
        ImageDraw.Draw(key).rectangle((x, y + 3, x + 16, y + 19), tuple(first[name].tolist()))
        ImageDraw.Draw(key).text((x + 24, y), _plural(rig, name), INK, font(17))
    return key


def _plural(rig, name):
    count = sum(kind(part) == name for part in rig.part_names)
    return name.replace("_", " ") + (f" ({count})" if count > 1 else "")


def _sweeps(rig):
    labelled = [_labelled(rig, i) for i in range(len(rig.parameters))]
    labelled += [Image.new("RGB", labelled[0].size, PAPER)] * (-len(labelled) % SIDE_BY_SIDE)
    rows = [labelled[i : i + SIDE_BY_SIDE] for i in range(0, len(labelled), SIDE_BY_SIDE)]
    return _stacked([_row(row) for row in rows])


def _labelled(rig, i):
    parameter = rig.parameters[i]
    label = Image.new("RGB", (WIDTH // SIDE_BY_SIDE - MARGIN, LINE), PAPER)
    draw = ImageDraw.Draw(label)
    draw.text((4, 4), parameter.name, INK, font(16))
    draw.text((12 + font(16).getlength(parameter.name), 5), range_of(parameter), GREY, font(15))
    return _stacked([label, sweep(rig, i)])


def _line(text, size):
    line = Image.new("RGB", (WIDTH, 2 * LINE), PAPER)
    draw = ImageDraw.Draw(line)
    draw.line((MARGIN, 10, WIDTH - MARGIN, 10), (210, 210, 210), 1)
    draw.text((MARGIN, 22), text, INK, font(size))
    return line


def font(size):
    """The font of sheets at a size in pixels."""
    return ImageFont.load_default(size)


def _row(images):
    whole = Image.new("RGB", (sum(image.width for image in images), max(image.height for image in images)), PAPER)
    for i, image in enumerate(images):
        whole.paste(image, (sum(one.width for one in images[:i]), 0))
    return whole


def _stacked(images):
    """Images above each other, those narrower than the widest with a margin on the left."""
    width = max(image.width for image in images)
    whole, y = Image.new("RGB", (width, sum(image.height for image in images)), PAPER), 0
    for image in images:
        whole.paste(image, (MARGIN if image.width < width else 0, y))
        y += image.height
    return whole
