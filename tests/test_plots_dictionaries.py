"""plots of dictionaries: what is drawn and what is refused; how it looks is for eyes, in the browser."""

import numpy as np
import pytest
import torch

from dsn_lite import plots

ENERGY = torch.tensor([[0.1, 0.9, 0.6], [0.9, 0.1, 0.4]])  # of two kinds, by three modes


def test_mode_heat_orders_modes_by_the_kind_that_they_move_most():
    figure = plots.mode_heat(ENERGY, ["seat", "arm_rest"])
    (cells,) = figure.data
    assert list(cells.x) == ["1", "2", "0"]
    np.testing.assert_allclose(cells.z, ENERGY.numpy()[:, [1, 2, 0]])
    assert list(cells.y) == ["seat", "arm rest"]
    assert (cells.zmin, cells.zmax) == (0, 1)  # figures of two spaces can be compared
    assert plots.alt(figure).endswith("modes that move a kind most: seat 2, arm rest 1.")
    assert list(plots.mode_heat(ENERGY, ["seat", "arm"], [5, 3, 7]).data[0].x) == ["3", "7", "5"]


@pytest.mark.parametrize("columns", [None, [1, 2]])
def test_mode_heat_refuses_shares_of_other_kinds_or_modes(columns):
    said = r"mode_heat: energy must be one share a kind and mode, \(\d, \d\), got \(2, 3\); take"
    with pytest.raises(ValueError, match=said):
        plots.mode_heat(ENERGY, ["seat"] if columns is None else ["seat", "arm"], columns)


@pytest.fixture
def shapes():
    points = torch.rand(2, 30, 3, generator=torch.Generator().manual_seed(0))
    fields = torch.zeros(2, 30, 3)
    fields[0, :10, 1], fields[1, :15, 2] = 2, -1
    return points, fields


def test_mode_on_shapes_paints_all_shapes_on_one_scale(shapes):
    figure = plots.mode_on_shapes(*shapes, titles=["x", "y"])
    first, second = figure.data
    np.testing.assert_array_equal(first.marker.color, [2.0] * 10 + [0.0] * 20)
    np.testing.assert_array_equal(second.marker.color, [1.0] * 15 + [0.0] * 15)
    assert first.marker.cmax == second.marker.cmax == 2
    assert (first.marker.showscale, second.marker.showscale) == (True, None)
    assert plots.alt(figure).endswith("of their points 33%, 50% move visibly.")


def test_mode_on_shapes_draws_what_does_not_move(shapes):
    points, fields = shapes
    assert plots.mode_on_shapes(points, 0 * fields).data[0].marker.cmax > 0


def test_mode_on_shapes_refuses_fields_of_other_shapes(shapes):
    points, fields = shapes
    with pytest.raises(ValueError, match=r"mode_on_shapes: fields must have one row for each point, got \[30\] rows"):
        plots.mode_on_shapes(points, fields[:1])


def test_paired_bars_are_told_apart_without_colour():
    values = {"trained": {"by part": 0.98, "by place": 0.74}, "not<br>trained": {"by part": 0.99}}
    figure = plots.paired_bars(values, y="cosine")
    part, place = figure.data
    assert (list(part.y), list(place.y)) == ([0.98, 0.99], [0.74, None])
    assert part.marker.pattern.shape != place.marker.pattern.shape
    assert list(place.text) == ["0.74", ""]
    assert plots.alt(figure) == "cosine, trained: by part 0.98, by place 0.74; not trained: by part 0.99."


def test_lines_count_in_powers_along_one_axis_only():
    figure = plots.lines({"w = 1": {0.01: 1.0, 1.0: 0.0}}, x="threshold", y="share", log="x")
    assert (figure.layout.xaxis.type, figure.layout.yaxis.type) == ("log", "linear")
