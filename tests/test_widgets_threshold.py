"""The threshold slider without a front end: what it shows, remembers and refuses."""

import numpy as np
import pytest

from dsn_lite import widgets

ELEMENTS = {"w = 0": {0.001: 100.0, 0.01: 90.0, 0.1: 40.0}, "w = 1": {0.001: 80.0, 0.01: 40.0, 0.1: 10.0}}
COLUMNS = {name: {at: value / 2 for at, value in curve.items()} for name, curve in ELEMENTS.items()}
COSTS = {"w = 0": 2.0, "w = 1": 2.5}


@pytest.fixture
def slider():
    return widgets.ThresholdSlider({"elements": ELEMENTS, "columns": COLUMNS}, COSTS, cost="fitting")


def shown(slider):
    """The curves' ends, their marks over the costs, and where the line stands."""
    data, line = slider.view.data, slider.view.layout.shapes[0]
    return [trace.y[-1] for trace in data[::2]], [(mark.x[0], mark.y[0]) for mark in data[1::2]], (line.x0, line.x1)


def test_it_begins_at_the_threshold_it_is_told(slider):
    assert slider.values == pytest.approx({"w = 0": 90.0, "w = 1": 40.0})
    assert shown(slider) == ([40.0, 10.0], [(2.0, 90.0), (2.5, 40.0)], (0.01, 0.01))
    assert [trace.name for trace in slider.view.data[::2]] == list(COSTS)


def test_the_slider_moves_the_line_and_every_mark(slider):
    slider.slider.value = 10**-1.5
    assert slider.threshold == pytest.approx(10**-1.5)
    between = {name: (curve[0.01] + curve[0.1]) / 2 for name, curve in ELEMENTS.items()}  # half way on a log axis
    assert slider.values == pytest.approx(between)
    _, marks, line = shown(slider)
    np.testing.assert_allclose(marks, [(2.0, 65.0), (2.5, 25.0)])
    np.testing.assert_allclose(line, 10**-1.5)


def test_the_threshold_can_be_set(slider):
    slider.threshold = 0.1
    assert shown(slider)[1] == [(2.0, 40.0), (2.5, 10.0)]


def test_a_button_chooses_what_is_counted(slider):
    slider.choice.value = "columns"
    assert slider.values == pytest.approx({"w = 0": 45.0, "w = 1": 20.0})
    assert shown(slider)[:2] == ([20.0, 5.0], [(2.0, 45.0), (2.5, 20.0)])
    layout = slider.view.layout
    assert layout.yaxis.title.text == "columns"
    assert layout.yaxis.range == layout.yaxis2.range == pytest.approx((0, 52.5))
    assert slider.notice.value == ""


def test_one_quantity_needs_no_buttons_and_one_figure_says_what_it_shows():
    alone = widgets.ThresholdSlider({"elements": ELEMENTS}, COSTS, cost="fitting", threshold=0.001)
    assert alone.choice not in alone.children
    assert alone.view.layout.meta["alt"] == (
        "elements at a threshold of 0.001, against fitting: w = 0 100 for 2, w = 1 80 for 2.5."
    )


def test_no_two_curves_look_alike():
    many = {f"w = {w}": {0.01: 1.0 + w, 0.1: 1.0} for w in range(12)}
    slider = widgets.ThresholdSlider({"elements": many}, dict.fromkeys(many, 1.0), cost="fitting")
    assert len({(trace.marker.color, trace.marker.symbol) for trace in slider.view.data[::2]}) == 12


@pytest.mark.parametrize(
    ("quantities", "costs", "words"),
    [
        ({"elements": ELEMENTS}, {"w = 0": 1.0}, "every curve must have a cost, 'w = 1' has none; add it to costs"),
        (
            {"elements": {"w = 0": {0.1: 1.0}}},
            COSTS,
            r"two thresholds or more, above 0 and rising, 'w = 0' has \[0.1\]",
        ),
        ({"elements": {"w = 0": {0.0: 1.0, 0.1: 1.0}}}, COSTS, r"above 0 and rising, 'w = 0' has \[0.0, 0.1\]"),
        ({"elements": {"w = 0": {0.1: 1.0, 0.01: 1.0}}}, COSTS, r"above 0 and rising, 'w = 0' has \[0.1, 0.01\]"),
        ({}, COSTS, r"the same curves, at least one, got \[\]; leave the others out"),
        ({"elements": ELEMENTS, "columns": {"w = 0": ELEMENTS["w = 0"]}}, COSTS, "must have the same curves"),
    ],
)
def test_what_cannot_be_drawn_is_refused(quantities, costs, words):
    with pytest.raises(ValueError, match=f"ThresholdSlider: .*{words}"):
        widgets.ThresholdSlider(quantities, costs, cost="fitting")


def test_a_threshold_beyond_the_curves_is_refused(slider):
    with pytest.raises(
        ValueError, match=r"must be between 0.001 and 0.1, where the curves are, got 2.0; choose one there"
    ):
        slider.threshold = 2.0
    assert slider.threshold == pytest.approx(0.01)
