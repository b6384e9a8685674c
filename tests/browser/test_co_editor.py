"""A person edits a handle of a table in JupyterLab: the edit, the snapped table and five others move, and come back."""

import json

import numpy as np
import pytest

CELLS = (
    """
import data_gen, dsn_lite
from dsn_lite import Config, co_edit, widgets
from dsn_lite.config import network
tables = dsn_lite.as_shapes(data_gen.generate("table/four_legs", count=6, points=200, seed=0))
space, source, others = network(Config(k=10)), tables[0], tables[1:]
""",
    "editor = widgets.HandleEditor(space, source, others, titles=list('abcde'))\neditor",
)
PLOTS = "() => [...document.querySelectorAll('.js-plotly-plot')].filter(plot => plot.querySelector('canvas')).length"
DRAWN = """() => [...document.querySelectorAll('.js-plotly-plot')].map(plot =>
    plot.data.map(trace => ['x', 'y', 'z'].map(axis => Array.from(trace[axis]))))"""
STANDS = f"told => JSON.stringify(({DRAWN})()[1][4]) {{}} JSON.stringify(told)"  # the last of the others
NOW = """(lambda e: [e.source.edited, e.source.points, *(o.points for o in e.others)])(
    co_edit(space, source, {editor.name: editor.value}, others))"""


@pytest.fixture
def editor(lab, notebook):
    opened = notebook(lab.write("editor.ipynb", *CELLS))
    opened.run_all()
    opened.page.wait_for_function(f"({PLOTS})() === 2")
    assert opened.errors() == []
    return opened


def rested(page, told, sign):
    """What is drawn once the last of the others stands elsewhere than told (!==), or there (===), and all rest."""
    page.wait_for_function(STANDS.format(sign), arg=told[1][4])
    drawn = page.evaluate(DRAWN)
    while True:
        page.wait_for_timeout(1500)
        later = page.evaluate(DRAWN)
        if later == drawn:
            return later
        drawn = later


def moves(before, after):
    """How far the points of the seven tables moved, (7, 200, 3) in the axes of shapes."""
    (edit, others), (edit_after, others_after) = before, after
    pairs = [*zip(edit[:2], edit_after[:2], strict=True), *zip(others[:5], others_after[:5], strict=True)]
    dx, dy, dz = np.array([np.subtract(later, told) for told, later in pairs]).transpose(1, 0, 2)
    return np.stack([dx, dz, -dy], -1)


def expected(opened):
    """The same, by one edit of its own in the kernel."""
    began = "[source.points[0], source.points[0], *others.points]"
    told = opened.ask(f"[(now - began).round(decimals=7).tolist() for now, began in zip({NOW}, {began})]")
    return np.array(json.loads(told))


def test_a_drag_moves_the_edit_the_snapped_shape_and_the_others(editor, tmp_path):
    page = editor.page
    page.get_by_label("part", exact=True).select_option("leg 2")
    page.get_by_label("handle", exact=True).select_option("scale y")
    page.get_by_text("leg 2 scale y is at").wait_for()
    before = page.evaluate(DRAWN)
    box = page.locator("[role=slider]").first.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 60, y, steps=5)
    page.mouse.up()
    after = rested(page, before, "!==")
    assert editor.ask("editor.name") == "'leg_2.scale.y'"
    np.testing.assert_allclose(moves(before, after), expected(editor), atol=3e-6)
    page.get_by_text("Edit 1: leg 2 scale y at").wait_for()
    page.screenshot(path=str(tmp_path / "editor.png"))
    handle = page.locator("[role=slider]").first
    handle.focus()
    handle.press("ArrowRight")
    np.testing.assert_allclose(moves(before, rested(page, after, "!==")), expected(editor), atol=3e-6)
    page.locator("button.jupyter-button", has_text="undo").click()
    assert rested(page, before, "===") == before
    assert editor.errors() == []
