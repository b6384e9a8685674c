"""Charts and tables of RESULTS.md: their numbers are where they say they are."""

import re
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from dsn_lite.experiments.chart import MARKS, Axis, Chart, Line
from dsn_lite.experiments.tables import listed, mean_and_spread, table


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ([], "–"),
        ([1.23456], "1.23"),
        ([2.0, 2.0], "2"),
        ([1.0, 1.2, 1.4], "1.20 ± 0.20"),
        ([120.0, 140.0], "130 ± 14"),
        ([1e-9, 2e-9], "0.00000 ± 0.00000"),
    ],
)
def test_mean_and_spread(values, said):
    assert mean_and_spread(values) == said


def test_words_and_tables():
    assert [listed(words) for words in (["a"], ["a", "b"], ["a", "b", "c"], [])] == ["a", "a and b", "a, b and c", ""]
    assert table(["x", "y"], [["1", "2"]]) == "| x | y |\n| --- | --- |\n| 1 | 2 |"


@pytest.mark.parametrize("log", [False, True])
@pytest.mark.parametrize("values", [(0.1, 10.0), (0.0011, 0.0032), (3.0, 3.0), (98.0, 99.9), (1e-4, 1.0), (2.0, 7e5)])
def test_ticks_enclose_the_values_and_rise(values, log):
    ticks = Axis("", log).ticks(values)
    assert ticks[0] <= values[0] <= values[1] <= ticks[-1]
    assert all(a < b for a, b in pairwise(ticks))
    assert 2 <= len(ticks) <= 12
    assert Axis("", log).share(ticks[0], ticks) == 0
    assert Axis("", log).share(ticks[-1], ticks) == 1


def test_a_chart_is_whole():
    lines = [Line(f"line <{i}>", (1, 10, 100), (1.0, 2.0 + i, 3.0), (0.5, 5.0, 0.1)) for i in range(len(MARKS))]
    lines.append(Line("flat", (1, 100), (2.0, 2.0), flat=True))
    root = ElementTree.fromstring(Chart("a", "What & why", lines, Axis("x", log=True), Axis("y")).svg)
    words = [text.text for text in root.findall(".//{*}text")]
    assert {"x", "y", "flat", *(line.name for line in lines)} <= set(words)
    places = [float(text.get(axis)) for text in root.findall(".//{*}text") for axis in ("x", "y")]
    assert all(0 <= place <= 760 for place in places)
    paths = [path.get("d") for path in root.findall(".//{*}path")]
    starts = [tuple(map(float, re.match(r"M([\d.-]+),([\d.-]+)", path).groups())) for path in paths]
    assert all(0 <= x <= 760 and 0 <= y <= 400 for x, y in starts)
    assert len({path.split("m")[1] for path in paths if "m" in path}) == len(MARKS)


def test_a_point_lies_where_the_axes_say():
    line = Line("", (1, 10, 100), (0.0, 5.0, 10.0))
    root = ElementTree.fromstring(Chart("a", "", [line], Axis("", log=True), Axis("")).svg)
    at = {text.text: (float(text.get("x")), float(text.get("y"))) for text in root.findall(".//{*}text")}
    path = next(path for path in root.findall(".//{*}path") if path.get("stroke-width") == "2")
    places = [tuple(map(float, place.split(","))) for place in path.get("d")[1:].split("L")]
    assert [x for x, _ in places] == [at["1"][0], (at["1"][0] + at["100"][0]) / 2, at["100"][0]]
    assert [y + 5 for _, y in places] == pytest.approx([at["0"][1], (at["0"][1] + at["10"][1]) / 2, at["10"][1]])
