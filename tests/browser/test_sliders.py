"""A person moves sliders in JupyterLab, and the picture is x + A v."""

import json

import numpy as np
import pytest

CELLS = (
    """
import torch
from dsn_lite import Config, widgets
from dsn_lite.config import network
space = network(Config(k=10))
x = torch.rand(2, 300, 3, generator=torch.Generator().manual_seed(0)) - 0.5
""",
    "sliders = widgets.DictionarySliders(space, x, span=0.5, titles=['first', 'second'])\nsliders",
    "before = [list(map(float, axis)) for axis in sliders.canvas.points(0)]",
)
DRAWN = "() => ['x', 'y', 'z'].map(axis => Array.from(document.querySelector('.js-plotly-plot').data[0][axis]))"
READY = "() => document.querySelector('.js-plotly-plot .gl-container canvas, .js-plotly-plot canvas') !== null"


@pytest.fixture
def sliders(lab, notebook):
    opened = notebook(lab.write("sliders.ipynb", *CELLS))
    opened.run_all()
    opened.page.wait_for_function(READY)
    opened.page.wait_for_selector("[role=slider]")
    assert opened.errors() == []
    return opened


def settle(page, before):
    """Waits until the drawn points are others than before, then until they rest; returns them (3, n)."""
    page.wait_for_function(f"before => JSON.stringify(({DRAWN})()[0]) !== JSON.stringify(before[0])", arg=before)
    drawn = page.evaluate(DRAWN)
    while True:
        page.wait_for_timeout(1500)
        later = page.evaluate(DRAWN)
        if later == drawn:
            return later
        drawn = later


def expected_move(notebook):
    """A v on the first shape, (3, n), in plotly's axes, by the space itself."""
    answer = notebook.ask("(space.act(x, sliders.v) - x)[0].detach().numpy().T.round(7).tolist()")
    dx, dy, dz = json.loads(answer)
    return np.array([dx, -np.array(dz), dy])


def test_keyboard_moves_the_shape_by_its_dictionary(sliders, tmp_path):
    before = sliders.page.evaluate(DRAWN)
    handle = sliders.page.locator("[role=slider]").nth(2)
    handle.focus()
    for _ in range(5):
        handle.press("ArrowRight")
    after = settle(sliders.page, before)
    v = json.loads(sliders.ask("sliders.v.tolist()"))
    assert v[2] == pytest.approx(0.05)
    assert [value for j, value in enumerate(v) if j != 2] == [0] * 9
    np.testing.assert_allclose(np.array(after) - np.array(before), expected_move(sliders), atol=2e-6)
    sliders.page.screenshot(path=str(tmp_path / "sliders.png"))
    assert sliders.errors() == []


def test_mouse_and_buttons_move_the_shape(sliders):
    page, before = sliders.page, sliders.page.evaluate(DRAWN)
    box = page.locator("[role=slider]").first.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y, steps=6)
    page.mouse.up()
    after = settle(page, before)
    assert json.loads(sliders.ask("sliders.v.tolist()"))[0] > 0.02
    np.testing.assert_allclose(np.array(after) - np.array(before), expected_move(sliders), atol=2e-6)
    page.locator("button.jupyter-button", has_text="reset").click()
    np.testing.assert_allclose(settle(page, after), before, atol=1e-7)
    assert sliders.errors() == []


TRAINING = (
    """
import torch
from dsn_lite import Config, widgets
live = widgets.LiveTraining(torch.rand(12, 64, 3), Config(k=4, seconds=120, batch=4))
widgets.heartbeat()
""",
    "space = live.run()",
)


def test_the_heartbeat_is_answered_and_the_stop_button_is_heard_while_a_cell_trains(lab, notebook):
    opened = notebook(lab.write("training.ipynb", *TRAINING))
    opened.start_all()
    opened.page.get_by_text("Connected: the page draws widgets").wait_for()
    stop = opened.page.locator("button.jupyter-button", has_text="stop")
    opened.page.get_by_text("The button ends the training").wait_for()
    stop.click()
    opened.page.get_by_text("Stopped: ").wait_for(timeout=60_000)
    assert opened.errors() == []
