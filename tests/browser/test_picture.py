"""The README's picture: a slider of lesson 00's widget is moved in JupyterLab, and two tables follow.

DSN_LITE_PICTURE=docs/slider.gif python -m pytest tests/browser/test_picture.py   writes it anew
"""

import io
import os

from conftest import ROOT
from PIL import Image

CELLS = (
    """
import data_gen, dsn_lite
from dsn_lite import widgets
space = dsn_lite.load("table_four_legs")
tables = dsn_lite.as_shapes(data_gen.generate("table/four_legs", count=40, points=1200, seed=7))
""",
    "sliders = widgets.DictionarySliders(space, tables.points[:2], labels=tables.labels[:2], "
    "vectors=space.encode(tables.points))\nsliders",
)
STEPS = [8] * 5 + [-8] * 10 + [8] * 4  # presses of an arrow key between two frames: to one end, to the other, back
DRAWN = "() => document.querySelector('.js-plotly-plot .gl-container canvas, .js-plotly-plot canvas') !== null"


def frames(page):
    """Pictures of the widget while its first slider goes to and fro."""
    widget, handle = page.locator(".jp-OutputArea-output .widget-vbox").first, page.locator("[role=slider]").first
    for presses in [0, *STEPS]:
        handle.focus()
        for _ in range(abs(presses)):
            handle.press("ArrowRight" if presses > 0 else "ArrowLeft")
        page.wait_for_timeout(1200)
        yield Image.open(io.BytesIO(widget.screenshot())).convert("P", palette=Image.Palette.ADAPTIVE, colors=64)


def test_one_slider_moves_two_tables(lab, notebook, tmp_path):
    opened = notebook(lab.write("picture.ipynb", *CELLS))
    opened.run_all()
    opened.page.wait_for_function(DRAWN)
    opened.page.wait_for_timeout(2000)
    wanted = os.environ.get("DSN_LITE_PICTURE")
    taken = frames(opened.page)
    pictures = list(taken) if wanted else [next(taken), next(taken)]
    assert opened.errors() == []
    assert pictures[0].tobytes() != pictures[1].tobytes()
    if wanted:
        path = ROOT / wanted
        path.parent.mkdir(exist_ok=True)
        pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=160, loop=0, optimize=True)
