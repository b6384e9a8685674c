"""plots: what is drawn, where, and what is refused; how it looks is for eyes, in the browser."""

import json
from math import cos, hypot, sin
from types import SimpleNamespace

import numpy as np
import plotly.io as pio
import pytest
import torch

from dsn_lite import LinearSpace, axioms, byhand, plots
from dsn_lite.plots.look import PALETTE
from dsn_lite.plots.row import TILT, TURN, Row
from dsn_lite.plots.traces import MOST_POINTS


@pytest.fixture
def x():
    return torch.rand(3, 40, 3, generator=torch.Generator().manual_seed(0))


def drawn(trace):
    """A trace's points in the axes of the shapes, still at its place in the row."""
    return np.stack([trace.x, trace.z, -np.asarray(trace.y)], 1)


def centred(points):
    points = np.asarray(points)
    return points - points.mean(0)


def test_shapes_keep_their_form_and_their_scale(x):
    figure = plots.shapes([x[0], 2 * x[1].numpy()])
    for trace, points in zip(figure.data, [x[0], 2 * x[1]], strict=True):
        assert trace.x.dtype == np.float32  # 1-D float32 travels as bytes
        np.testing.assert_allclose(centred(drawn(trace)), centred(points), atol=1e-6)
    ratio = figure.layout.scene.aspectratio
    spans = [np.ptp(figure.layout.scene[f"{axis}axis"].range) for axis in "xyz"]
    assert ratio.x / spans[0] == pytest.approx(ratio.y / spans[1]) == pytest.approx(ratio.z / spans[2])


@pytest.mark.parametrize("count", [1, 2, 6])
def test_the_camera_sees_every_shape_of_the_row_and_none_covers_another(x, count):
    clouds = [cloud.numpy() for cloud in (*x, *x)][:count]
    row = Row.of(clouds)
    layout = row.layout(["title"] * count)
    right = np.array([cos(TURN), sin(TURN), 0])
    up = np.array([sin(TURN) * -sin(TILT), cos(TURN) * sin(TILT), cos(TILT)])
    scene, eye = layout["scene"], np.array([layout["scene"]["camera"]["eye"][axis] for axis in "xyz"])
    assert abs(eye @ right) < 1e-12
    assert abs(eye @ up) < 1e-12
    middle = np.array([np.mean(scene[f"{axis}axis"]["range"]) for axis in "xyz"])
    # an orthographic scene is two units high; a cube of `aspectratio` units spans the ranges
    pixels = layout["height"] / 2 * scene["aspectratio"]["x"] / np.ptp(scene["xaxis"]["range"])
    spans = []
    for index, cloud in enumerate(clouds):
        at = (np.stack(row.place(cloud, index), 1) - middle) * pixels
        assert np.abs(at @ right).max() <= layout["width"] / 2
        assert np.abs(at @ up).max() <= layout["height"] / 2
        spans.append((at @ right).min() - 1e-3)
        spans.append((at @ right).max())
    assert spans == sorted(spans)


def test_parts_are_told_apart_by_colour_by_legend_and_by_pointing_at_them(x):
    labels = torch.tensor([0, 1, 2, -1] * 10)
    figure = plots.shapes(x[0], labels=labels, part_names=("top", "leg_1", "leg_2"))
    cloud, *keys = figure.data
    assert [key.name for key in keys] == ["top", "leg 1", "leg 2"]
    assert [key.marker.color for key in keys] == list(PALETTE[:3])
    assert cloud.hovertext[:4] == ("top", "leg_1", "leg_2", "no part")
    scale = cloud.marker.colorscale  # bands of one colour each: where one begins, where it ends
    for place, colour in zip(cloud.marker.color[:3] / cloud.marker.cmax, PALETTE, strict=False):
        bands = zip(scale[::2], scale[1::2], strict=True)
        assert [(a[1], b[1]) for a, b in bands if a[0] < place < b[0]] == [(colour, colour)]


def test_a_large_cloud_is_thinned_evenly():
    figure = plots.shapes(np.linspace(0, 1, 300_000).reshape(100_000, 3))
    assert len(figure.data[0].x) == MOST_POINTS
    gaps = np.diff(figure.data[0].x)
    assert gaps.max() < 1.1 * gaps.mean()


def test_faces_make_meshes_and_take_the_colour_of_their_first_corner(x):
    faces = np.array([[0, 1, 2], [3, 2, 1]])
    figure = plots.shapes(x[0], faces=faces, labels=torch.arange(40))
    mesh = figure.data[0]
    assert np.array_equal(np.stack([mesh.i, mesh.j, mesh.k], 1), faces)
    assert mesh.intensity.tolist() == [0.5, 3.5]


def test_long_titles_are_broken_and_stay_in_order(x):
    figure = plots.shapes(x, titles=["a title so long that it would run into its neighbour, twice over", "b", "c"])
    texts = [note.text for note in figure.layout.scene.annotations]
    assert "<br>" in texts[0]
    assert texts[1:] == ["b", "c"]
    assert figure.layout.scene.annotations[0].font.size >= 19


def test_compare_draws_the_target_again_behind_the_deformed(x):
    source, target, ghost, deformed = plots.compare(x[0], x[1, :30], x[2]).data
    assert len(source.x) == len(deformed.x) == 40
    assert len(target.x) == len(ghost.x) == 30
    assert ghost.opacity < 0.5
    beside, behind = drawn(target), drawn(ghost)
    np.testing.assert_allclose(centred(beside), centred(behind), atol=1e-6)
    np.testing.assert_allclose(centred(drawn(deformed)) + np.asarray(x[2].mean(0) - x[1, :30].mean(0)) + behind.mean(0),
                               drawn(deformed), atol=1e-5)  # fmt: skip


def test_offsets_are_lines_from_x_to_x_plus_u(x):
    _, lines, ends = plots.offsets(x[0], x[1]).data
    start, end, gap = (drawn(lines)[i::3] for i in range(3))
    np.testing.assert_allclose(end - start, x[1].numpy(), atol=1e-6)
    np.testing.assert_allclose(drawn(ends), end, atol=1e-6)
    assert np.isnan(gap).all()


def test_many_fields_stand_in_a_row_on_one_shape_or_on_as_many(x):
    one, many = plots.offsets(x[0], x, titles=["a", "b", "c"]), plots.offsets(x, x, titles=["a", "b", "c"])
    for figure, starts in ((one, x[[0, 0, 0]]), (many, x)):
        for i in range(3):
            start, end = (drawn(figure.data[3 * i + 1])[j::3] for j in range(2))
            np.testing.assert_allclose(end - start, x[i].numpy(), atol=1e-6)
            np.testing.assert_allclose(centred(start), centred(starts[i]), atol=1e-6)
    assert "of 3 shapes: a, b, c;" in plots.alt(one)


def test_modes_move_x_along_one_column_each(x):
    A = torch.randn(40, 3, 5, generator=torch.Generator().manual_seed(1))
    figure = plots.modes(x[0], A, columns=(4, 1), amount=0.2)
    ghosts, moved = figure.data[:2], figure.data[2:]
    for ghost, cloud, j in zip(ghosts, moved, (4, 1), strict=True):
        np.testing.assert_allclose(drawn(cloud) - drawn(ghost), 0.2 * A[..., j].numpy(), atol=1e-6)
    assert [note.text for note in figure.layout.scene.annotations] == ["+0.2 column 4", "+0.2 column 1"]


@pytest.fixture
def report():
    return axioms.report(byhand.translations(), byhand.copies(), triplets_drawn=8)


def test_axiom_bars_show_residuals_and_put_zero_at_the_edge(report):
    figure = plots.axiom_bars(report, before=report)
    bars = [trace for trace in figure.data if trace.type == "bar"]
    assert len({bar.marker.color for bar in bars}) == len({bar.marker.pattern.shape for bar in bars}) == 2
    assert {trace.name for trace in figure.data[2:]} == {
        "before training",
        "untrained space",
        "space that does nothing",
    }
    zero = figure.layout.xaxis.tickvals[0]
    assert figure.layout.xaxis.ticktext[0] == "0"
    for row in report.rows:
        bar = next(bar for bar in bars if any(axioms.LAWS[row.law].replace("(+)", "⊕") in name for name in bar.y))
        at = next(i for i, name in enumerate(bar.y) if name.startswith(row.law.replace("_", " ")))
        assert bar.base + bar.x[at] == pytest.approx(row.residual or zero)
    written = [note.text for note in figure.layout.annotations]
    assert written == ["0" if row.residual == 0 else f"{row.residual:.1e}" for row in report.rows]
    assert figure.layout.shapes[0].x0 == report.spread


def test_curve_shows_loss_validation_and_floor():
    history = [SimpleNamespace(seconds=float(i), loss=2.0**-i, validation_cd=3.0**-i) for i in range(1, 4)]
    figure = plots.curve(history, floor=0.01)
    loss, validation = figure.data
    assert list(loss.x) == list(validation.x) == [1, 2, 3]
    assert list(loss.y) == [0.5, 0.25, 0.125]
    assert list(validation.y) == pytest.approx([1 / 3, 1 / 9, 1 / 27])
    assert figure.layout.shapes[0].y0 == 0.01
    assert figure.layout.annotations[0].y == pytest.approx(-2)  # plotly places notes by the logarithm
    assert figure.layout.yaxis.type == "log"
    assert len(plots.curve([]).data) == 2


def test_spectrum_is_the_share_of_variance(x):
    points = x.double()
    values = torch.linalg.svdvals((points - points.mean(0)).flatten(1))[:2]
    explained, left = plots.spectrum(values).data
    assert explained.y == pytest.approx([1 - left.y[0], 1.0])
    space = LinearSpace.fit(points, 1)
    rest = points - points.mean(0) - space.act(torch.zeros(40, 3).double(), space.vector(points.mean(0), points))
    share = rest.square().sum() / (points - points.mean(0)).square().sum()
    assert left.y[0] == pytest.approx(share.item())


def test_every_figure_says_what_is_to_be_seen(x, report):
    figures = [plots.shapes(x), plots.compare(*x), plots.offsets(x[0], x[1]), plots.axiom_bars(report)]
    figures += [plots.modes(x[0], torch.ones(40, 3, 4)), plots.curve([]), plots.spectrum([1.0])]
    said = [plots.alt(figure) for figure in figures]
    assert len(set(said)) == len(said)
    assert all(sentence.endswith(".") for sentence in said)


def test_pages_get_the_figure_and_its_alternative_text(x):
    html = pio.renderers["notebook"].to_mimebundle(json.loads(plots.shapes(x).to_json()))["text/html"]
    assert "3 shapes in a row, at one scale." in html
    assert 'setAttribute("aria-label"' in html


def test_figures_are_exported_from_jupyter_unless_the_reader_chose_otherwise():
    before = pio.renderers.default
    try:
        pio.renderers.default = "plotly_mimetype"
        plots.appear_when_exported()
        assert pio.renderers.default == "plotly_mimetype+notebook"
        pio.renderers.default = "json"
        plots.appear_when_exported()
        assert pio.renderers.default == "json"
    finally:
        pio.renderers.default = before


def test_what_does_not_fit_is_refused_in_a_sentence(x):
    refused = {
        "shape 1 holds NaN or infinity; clean or drop it": lambda: plots.shapes([x[0], x[0] / 0]),
        r"shape 0 is \(40, 2\); give": lambda: plots.shapes(x[0, :, :2]),
        "at least one cloud": lambda: plots.shapes([]),
        "one part index for each of the 40 points of shape 0": lambda: plots.shapes(x[0], labels=torch.zeros(7)),
        "one array for each of the 3 shapes, got 2": lambda: plots.shapes(x, labels=torch.zeros(2, 40)),
        "faces must be .* indices of the 40 points": lambda: plots.shapes(x[0], faces=[[0, 1, 40]]),
        "titles must be one for each of the 3 shapes": lambda: plots.shapes(x, titles=["a"]),
        "one shape .* is drawn here, got 3": lambda: plots.compare(x, x[0], x[0]),
        r"one row for each point of x, got \[5\] rows for \[40\] points": lambda: plots.offsets(x[0], x[0, :5]),
        r"one row for each point of x, got \[40\] rows for \[40, 40\]": lambda: plots.offsets(x[:2], x[:1]),
        r"A must be \(n, 3, k\) for the 40 points": lambda: plots.modes(x[0], torch.ones(3, 3, 2)),
        r"columns must lie in 0 \.\.\. 1, got \(2,\)": lambda: plots.modes(x[0], torch.ones(40, 3, 2), columns=(2,)),
        "finite and not all 0": lambda: plots.spectrum([0.0, 0.0]),
    }
    for words, call in refused.items():
        with pytest.raises(ValueError, match=words):
            call()


def test_the_row_is_as_wide_as_the_camera_sees_it():
    row = Row(np.zeros(3), np.array([3.0, 1.0, 0.0]), 2)
    assert row.seen[0] == pytest.approx(3 * cos(TURN))
    assert row.pitch > row.seen[0]
    first, second = (np.ravel(row.place(np.zeros((1, 3)), index)) for index in (0, 1))
    assert hypot(*(second - first)[:2]) == pytest.approx(row.pitch)
