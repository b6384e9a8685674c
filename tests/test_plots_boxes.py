"""Boxes of parts as lines: their corners, what is drawn of them in figures and widgets, and what is refused."""

import itertools
import re

import numpy as np
import pytest
import torch

import data_gen
import dsn_lite
from dsn_lite import plots, widgets
from dsn_lite.handles import BoxHandles, corners

SHAPES = dsn_lite.as_shapes(data_gen.generate("chair", count=14, points=512, seed=3))


def corner_by_corner(box):
    """The eight corners of one box (15,): centre + rotation (half extents with signs)."""
    centre, rotation, edges = box[:3], box[3:12].reshape(3, 3), box[12:]
    return [centre + rotation @ (edges * np.array(signs)) for signs in itertools.product((-0.5, 0.5), repeat=3)]


def drawn_edges(trace):
    """The lines of a trace as pairs of ends in the axes of shapes, each once, whatever its direction."""
    x, y, z = (np.asarray(axis, dtype=float) for axis in (trace.x, trace.y, trace.z))
    points = np.stack([x, z, -y], 1).round(4)
    pairs = itertools.pairwise(points.tolist())
    return {frozenset(map(tuple, pair)) for pair in pairs if np.isfinite(pair).all() and pair[0] != pair[1]}


@pytest.mark.parametrize("i", [0, 7, 13])
def test_corners_are_those_of_the_boxes(i):
    found, boxes = corners(BoxHandles.of(SHAPES, i)), SHAPES.boxes[i]
    own = boxes[sorted(set(SHAPES.labels[i].tolist()) - {-1})].double().numpy()
    np.testing.assert_allclose(found, [corner_by_corner(box) for box in own], atol=1e-6)


def test_corners_follow_the_values():
    handles = BoxHandles.of(SHAPES)
    z = handles.z0.clone()
    z[handles.names.index("seat.translation.y")] += 0.25
    moved = corners(handles, z) - corners(handles)
    up = corners(handles)[0].new_tensor([0, 0.25, 0])
    torch.testing.assert_close(moved[0], up.expand(8, 3), atol=1e-6, rtol=0)
    assert not moved[1:].any()


def test_a_figure_draws_the_twelve_edges_of_every_box():
    handles = BoxHandles.of(SHAPES)
    box = corners(handles)[:1]
    trace = plots.shapes(SHAPES.points[0], boxes=[box]).data[-1]
    signs = list(itertools.product((0, 1), repeat=3))
    near = lambda a, b: np.abs(np.subtract(signs[a], signs[b])).sum() == 1
    ends = [pair for pair in itertools.combinations(range(8), 2) if near(*pair)]
    lengths = [np.linalg.norm(box[0, a] - box[0, b]) for a, b in ends]
    found = drawn_edges(trace)
    assert len(found) == len(ends) == 12
    drawn = [np.linalg.norm(np.subtract(*edge)) for edge in found]
    np.testing.assert_allclose(sorted(drawn), sorted(lengths), atol=5e-4)
    assert len(set().union(*found)) == 8


def test_a_figure_without_boxes_has_no_lines_and_some_shapes_may_have_none():
    points = SHAPES.points[:2]
    assert {trace.mode for trace in plots.shapes(points).data} == {"markers"}
    some = plots.shapes(points, boxes=[None, corners(BoxHandles.of(SHAPES, 1))])
    assert [trace.mode for trace in some.data] == ["markers", "markers", "lines"]


@pytest.mark.parametrize(
    ("boxes", "words"),
    [
        ([torch.zeros(2, 3)], "boxes must be (p, 8, 3) finite corners, those of shape 0 are (2, 3); take them from"),
        ([torch.full((1, 8, 3), torch.nan)], "boxes must be (p, 8, 3) finite corners, those of shape 0 are (1, 8, 3)"),
        ([None, None], "boxes must be one array for each of the 1 shapes, got 2"),
    ],
)
def test_wrong_boxes_are_refused(boxes, words):
    with pytest.raises(ValueError, match=re.escape(f"shapes: {words}")):
        plots.shapes(SHAPES.points[0], boxes=boxes)


def test_a_canvas_moves_the_boxes_it_is_told_and_leaves_the_others():
    both = [corners(BoxHandles.of(SHAPES, i)).numpy() for i in (0, 1)]
    canvas = widgets.Canvas(SHAPES.points[:2], boxes=dict(enumerate(both)))
    lines = lambda: np.stack([canvas.view.data[-1][axis] for axis in "xyz"])
    before, length = lines(), 17 * len(both[0])
    canvas.update_all({}, boxes={0: both[0] + np.array([0, 0.5, 0])})
    moved = lines() - before
    np.testing.assert_allclose(moved[2, :length][np.isfinite(moved[2, :length])], 0.5, atol=1e-6)
    assert not np.nan_to_num(moved[:, length:]).any()
    assert not np.nan_to_num(moved[:2]).any()


def test_a_canvas_refuses_boxes_that_were_not_there():
    canvas = widgets.Canvas(SHAPES.points[:2], boxes={0: corners(BoxHandles.of(SHAPES))[:1]})
    with pytest.raises(ValueError, match=r"Canvas\.update: shape 0 has 1 boxes, got 2; make a new Canvas for others"):
        canvas.update_all({}, boxes={0: corners(BoxHandles.of(SHAPES))[:2]})
    with pytest.raises(ValueError, match=r"Canvas\.update: shape 1 has 0 boxes, got 1"):
        canvas.update_all({}, boxes={1: corners(BoxHandles.of(SHAPES))[:1]})
