"""The figure of the plane: one scale on both axes, every curve and point in its place, what it refuses."""

import numpy as np
import pytest
import torch

from dsn_lite import plots

SQUARE = torch.tensor([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]])


def test_curves_and_points_lie_where_they_are_at_one_scale():
    figure = plots.plane({"l1": SQUARE, "l2": 2 * SQUARE}, {"answer": [0.5, 0.25]}, x="first", y="second")
    np.testing.assert_array_equal([figure.data[1].x, figure.data[1].y], 2 * SQUARE.T.numpy())
    assert (figure.data[2].x[0], figure.data[2].y[0], figure.data[2].text) == (0.5, 0.25, ("answer",))
    assert (figure.layout.yaxis.scaleanchor, figure.layout.yaxis.scaleratio) == ("x", 1)
    assert (figure.layout.xaxis.title.text, figure.layout.yaxis.title.text) == ("first", "second")
    assert plots.alt(figure) == "Curves in the plane of first and second: l1, l2, answer at (0.50, 0.25)."


def test_curves_differ_without_colour():
    figure = plots.plane({name: SQUARE for name in "abcd"}, x="first", y="second")
    assert len({curve.line.dash for curve in figure.data}) == 4


@pytest.mark.parametrize(
    ("curves", "points", "words"),
    [
        ({"l1": SQUARE.T}, {}, r"'l1' is \(2, 5\)"),
        ({"l1": SQUARE}, {"answer": [1.0]}, r"'answer' is \(1,\)"),
    ],
)
def test_what_is_not_in_the_plane_is_refused(curves, points, words):
    with pytest.raises(
        ValueError, match=rf"plane: a curve must be \(m, 2\) and a point \(2,\), {words}; stack its two"
    ):
        plots.plane(curves, points, x="first", y="second")
