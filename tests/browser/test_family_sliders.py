"""A person chooses a family in JupyterLab and moves its parameters: the mesh, its colours and the sliders follow."""

import json

import numpy as np

CELLS = (
    """
import data_gen
from data_gen.colours import colours
from dsn_lite import widgets
rigs = {name: data_gen.family(name) for name in ("box/one", "table/four_legs")}
""",
    "gallery = widgets.FamilySliders(rigs, colours)\ngallery",
)
MESH = """() => {
    const mesh = document.querySelector('.js-plotly-plot').data[0];
    return {points: ['x', 'y', 'z'].map(axis => Array.from(mesh[axis])), faces: mesh.i.length, colours: mesh.facecolor};
}"""
SHOWN = "n => document.querySelector('.js-plotly-plot')?.data?.[0]?.i?.length === n"
MOVED = f"before => JSON.stringify(({MESH})().points) !== JSON.stringify(before.points)"


def test_a_family_is_chosen_and_its_parameters_move_it(lab, notebook):
    opened = notebook(lab.write("families.ipynb", *CELLS))
    opened.run_all()
    page = opened.page
    page.wait_for_function(SHOWN, arg=12)
    page.select_option(".widget-dropdown select", label="table/four_legs")
    page.wait_for_function(SHOWN, arg=60)
    page.get_by_text("top thickness").wait_for()
    before = page.evaluate(MESH)
    assert before["colours"] == json.loads(opened.ask("list(gallery.canvas.view.data[0].facecolor)").replace("'", '"'))
    handle = page.locator("[role=slider]").nth(1)  # the height
    handle.focus()
    handle.press("End")
    page.wait_for_function(MOVED, arg=before)
    after = page.evaluate(MESH)
    moved = np.array(after["points"]) - np.array(before["points"])
    np.testing.assert_allclose(moved[2].max(), 0.3, atol=1e-6)  # from 0.7 to 1; up is drawn along z
    np.testing.assert_allclose(moved[:2], 0, atol=1e-6)
    assert opened.errors() == []
