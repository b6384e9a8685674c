import re
from base64 import b64decode
from io import BytesIO

import numpy as np
import PIL.Image
import pytest
import trimesh

import data_gen
from dsn_lite import axioms, byhand, plots


def table(width=0.8):
    return data_gen.mesh("table/four_legs", [width, 0.6, 0.6, 0.05, 0.06, 0.06])


def test_together_draws_shapes_where_they_lie():
    triangle = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    figure = plots.together([triangle, triangle + np.array([0, 0, 2.0])], faces=[[0, 1, 2]], titles=["x", "y"])
    first, second = figure.data
    assert [first.name, second.name] == ["x", "y"]
    assert np.allclose(np.array(first.x), np.array(second.x))
    assert np.allclose(np.array(first.y) - np.array(second.y), 2)  # depth is drawn along -y
    assert "x, y" in plots.alt(figure)


def test_together_refuses_titles_that_do_not_fit():
    with pytest.raises(ValueError, match=r"together: titles must be one for each of the 1 shapes, got 2"):
        plots.together([np.eye(3)], faces=[[0, 1, 2]], titles=["x", "y"])


def test_meshes_are_drawn_in_their_own_colours():
    figure = plots.meshes([table(), table(0.5)], titles=["wide", "narrow"])
    assert len(figure.data) == 10
    assert set(figure.data[0].facecolor) == {"rgb(0,114,178)"}  # the colour that data_gen gives the top
    assert plots.alt(figure).startswith("2 meshes")


def test_meshes_without_colours_are_grey():
    (solid,) = plots.meshes(trimesh.creation.box()).data
    assert (solid.color, solid.facecolor) == ("#8A8A8A", None)


def test_law_table_shows_zero_for_what_holds_to_rounding():
    spaces = {"translation": byhand.translations()} | byhand.BROKEN
    table = byhand.who_breaks_what(spaces, byhand.copies(6))
    figure = plots.law_table(table, list(spaces), list(axioms.LAWS))
    assert set(figure.data[0].text[0]) == {"0"}
    assert "translation breaks none." in plots.alt(figure)
    assert "parallelogram_closes breaks actions_add" in plots.alt(figure)


def test_law_table_refuses_numbers_of_other_spaces():
    with pytest.raises(ValueError, match=r"law_table: residuals must be one a space and law, \(1, 7\), got \(2, 7\)"):
        plots.law_table(np.zeros((2, 7)), ["one"], list(axioms.LAWS))


def test_bars_are_one_a_choice():
    figure = plots.bars({1: 0.5, 2: 0.25}, x="columns", y="distance")
    assert (list(figure.data[0].x), list(figure.data[0].y)) == (["1", "2"], [0.5, 0.25])
    assert plots.alt(figure) == "distance against columns: 1: 0.5, 2: 0.25"


def test_lines_are_told_apart_without_colour():
    figure = plots.lines({"measured": {1: 4.0, 10: 0.5}, "told": {1: 3.0, 10: 0.3}}, x="points", y="floor", log=True)
    measured, told = figure.data
    assert (list(measured.x), list(measured.y), told.name) == ([1, 10], [4.0, 0.5], "told")
    assert measured.line.dash != told.line.dash
    assert measured.marker.symbol != told.marker.symbol
    assert (figure.layout.xaxis.type, figure.layout.yaxis.type) == ("log", "log")
    assert plots.alt(figure) == "floor against points: measured goes from 4 to 0.5, told goes from 3 to 0.3."
    assert plots.lines({"one": {1: 1.0}}, x="a", y="b").layout.xaxis.type == "linear"


def test_a_picture_is_the_picture_with_its_words():
    image = PIL.Image.new("RGB", (3, 2), "red")
    shown = plots.picture(image, "a <red> square").data
    assert 'alt="a &lt;red&gt; square"' in shown
    data = b64decode(re.search('base64,([^"]+)', shown)[1])
    assert PIL.Image.open(BytesIO(data)).getcolors() == [(6, (255, 0, 0))]
