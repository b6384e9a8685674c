"""Widgets without a front end: what they draw, remember and refuse. tests/browser has the front end."""

import threading

import comm
import numpy as np
import pytest
import torch

import data_gen
from data_gen.colours import colours
from dsn_lite import AutoencoderSpace, Config, LinearSpace, widgets
from dsn_lite.config import network
from dsn_lite.data import Shapes
from dsn_lite.training import Record, Training
from dsn_lite.widgets.guard import Notice
from dsn_lite.widgets.live import SHARE


@pytest.fixture
def x():
    return torch.rand(12, 30, 3, generator=torch.Generator().manual_seed(0)) - 0.5


@pytest.fixture
def space():
    return network(Config(k=10, features=(8, 16), head=(8,)))


def drawn(canvas, index):
    """The points of a shape on a canvas in their own axes, still at their place in the row."""
    x, y, z = (np.asarray(axis) for axis in canvas.points(index))
    return np.stack([x, z, -y], 1)


def moved(canvas, index, before):
    return drawn(canvas, index) - before


def test_figures_reach_the_page_with_all_that_they_show(x, monkeypatch):
    opened, make = {}, comm.create_comm

    def listening(**message):
        made = make(**message)
        opened[made.comm_id] = message["data"]["state"]
        return made

    monkeypatch.setattr(comm, "create_comm", listening)
    live = widgets.LiveTraining(x, Config(k=4, steps=6, batch=4))
    threshold = widgets.ThresholdSlider({"elements": {"w": {0.01: 1.0, 0.1: 0.0}}}, {"w": 1.0}, cost="fitting")
    for view in (widgets.Canvas(x[:2], titles=["a", "b"]).view, live.curve, live.canvas.view, threshold.view):
        state = opened[view.comm.comm_id]
        assert [trace["type"] for trace in state["_widget_data"]] == [trace.type for trace in view.data]
        assert state["_widget_layout"]["meta"] == view.layout.meta
        assert state["_config"]["displaylogo"] is False


@pytest.mark.parametrize("n", [30, 10_000])
def test_canvas_moves_the_shape_it_is_told_to(n):
    points = np.random.default_rng(0).random((2, n, 3))
    canvas = widgets.Canvas(points, ghosts={1: points[0]})
    before = [drawn(canvas, index) for index in range(2)]
    canvas.update(1, points[1] + [0.1, 0.2, 0.3])
    np.testing.assert_allclose(moved(canvas, 0, before[0]), 0)
    np.testing.assert_allclose(
        moved(canvas, 1, before[1]), np.broadcast_to([0.1, 0.2, 0.3], before[1].shape), atol=1e-6
    )
    assert all(axis.dtype == np.float32 and axis.ndim == 1 for axis in canvas.points(1))  # these travel as bytes


def test_canvas_moves_meshes_without_sending_faces(x):
    faces = np.array([[0, 1, 2], [2, 3, 4]])
    canvas = widgets.Canvas(x[:1], faces=faces)
    before = drawn(canvas, 0)
    canvas.update(0, x[0] * 1.1)
    np.testing.assert_allclose(moved(canvas, 0, before), 0.1 * x[0].numpy(), atol=1e-6)
    assert canvas.view.data[0].i.tolist() == [0, 2]


def test_canvas_refuses_what_it_cannot_draw(x):
    canvas = widgets.Canvas(x[:2])
    with pytest.raises(ValueError, match="shape 1 has 30 points, got 29; make a new Canvas"):
        canvas.update(1, x[1, :29])
    with pytest.raises(ValueError, match=r"Canvas\.update: points must be finite"):
        canvas.update(1, x[1] / 0)


def test_a_slider_moves_every_shape_by_its_own_dictionary(space, x):
    sliders = widgets.DictionarySliders(space, x[:2])
    before = [drawn(sliders.canvas, index) for index in range(2)]
    sliders.sliders[3].value = 0.1
    v = torch.zeros(10)
    v[3] = 0.1
    assert torch.equal(sliders.v, v)
    with torch.no_grad():
        right = space.act(x[:2], v) - x[:2]
    for index in range(2):
        np.testing.assert_allclose(moved(sliders.canvas, index, before[index]), right[index].numpy(), atol=1e-6)


def test_setting_v_moves_sliders_and_shape_and_can_go_beyond_their_range(x):
    space = LinearSpace.fit(x.double(), 4)
    sliders = widgets.DictionarySliders(space, x[0], span=0.1, columns=(2, 0))
    before = drawn(sliders.canvas, 0)
    v = space.vector(x[0].double(), x[1].double())
    sliders.v = v
    assert list(sliders.sliders) == [2, 0]
    assert sliders.sliders[0].value == pytest.approx(v[0].item())
    np.testing.assert_allclose(
        moved(sliders.canvas, 0, before), (space.act(x[0].double(), v) - x[0]).numpy(), atol=1e-6
    )
    sliders.v += 0.01
    assert torch.allclose(sliders.v, v + 0.01)


def test_columns_that_the_vectors_use_most_come_first_and_set_the_range(space, x):
    vectors = torch.zeros(5, 10)
    vectors[:, 7], vectors[:, 2] = torch.arange(5.0), 0.1 * torch.arange(5.0)
    sliders = widgets.DictionarySliders(space, x[0], vectors=vectors)
    assert list(sliders.sliders)[:2] == [7, 2]
    assert sliders.sliders[7].max == pytest.approx(2 * vectors[:, 7].std().item())
    assert sliders.sliders[0].max > 0
    with torch.no_grad():
        xy = space.vector(x[0], x[1])
    assert next(iter(widgets.DictionarySliders(space, x[0], y=x[1]).sliders)) == int(xy.abs().argmax())


def test_buttons_reset_draw_at_random_and_go_to_the_target(space, x):
    sliders = widgets.DictionarySliders(space, x[0], y=x[1])
    reset, random, go = sliders.children[1].children
    before = drawn(sliders.canvas, 0)
    random.click()
    assert 0 < sliders.v.abs().max() < 2
    go.click()
    with torch.no_grad():
        right = space.deform(x[0], x[1]) - x[0]
    np.testing.assert_allclose(moved(sliders.canvas, 0, before), right.numpy(), atol=1e-6)
    reset.click()
    assert not sliders.v.any()
    np.testing.assert_allclose(moved(sliders.canvas, 0, before), 0, atol=1e-7)


def test_more_than_eight_sliders_come_in_pages(space, x):
    rows, choice = widgets.DictionarySliders(space, x[0]).children[2].children
    assert len(rows.children) == 8
    choice.index = 1
    assert [slider.description for slider in rows.children] == ["column 8", "column 9"]


def test_sliders_refuse_what_does_not_fit(space, x):
    refused = {
        "must have a dictionary, AutoencoderSpace has none": lambda: widgets.DictionarySliders(
            AutoencoderSpace(torch.nn.Identity(), torch.nn.Identity()), x[0]
        ),
        r"columns must lie in 0 \.\.\. 9, got \(10,\)": lambda: widgets.DictionarySliders(space, x[0], columns=(10,)),
        "span must be a number above 0": lambda: widgets.DictionarySliders(space, x[0], span=0.0),
        r"vectors must be finite \(N, 10\)": lambda: widgets.DictionarySliders(space, x[0], vectors=torch.ones(4, 3)),
        "v must be 10 finite numbers": lambda: setattr(widgets.DictionarySliders(space, x[0]), "v", torch.ones(3)),
        "points must be finite": lambda: widgets.DictionarySliders(space, x[0] / 0),
    }
    for words, call in refused.items():
        with pytest.raises(ValueError, match=words):
            call()


def test_an_error_in_a_callback_is_shown_in_one_line_and_logged(caplog):
    notice = Notice()

    def bad(_change):
        raise ValueError("too <far>\nsecond line")

    notice.guard(bad)({})
    assert "ValueError: too &lt;far&gt;" in notice.value
    assert "role='alert'" in notice.value
    assert "second line" not in notice.value
    assert "second line" in caplog.text
    notice.guard(lambda _change: None)({})
    assert notice.value == ""


def test_a_path_leads_from_x_to_its_deformation_and_takes_z_along(space, x):
    path = widgets.DeformationPath(space, x[0], x[1], x[2])
    before = [drawn(path.canvas, index) for index in range(3)]
    for t in (1.0, 0.5, 1.5):
        path.t = t
        with torch.no_grad():
            v = t * space.vector(x[0], x[1])
            right = space.act(x[0], v) - x[0], 0 * x[1], space.act(x[2], v) - x[2]
        for index in range(3):
            np.testing.assert_allclose(moved(path.canvas, index, before[index]), right[index].numpy(), atol=1e-6)


def test_a_path_needs_no_dictionary(x):
    flat = torch.nn.Sequential(torch.nn.Flatten(-2), torch.nn.Linear(90, 4))
    space = AutoencoderSpace(flat, torch.nn.Sequential(torch.nn.Linear(4, 90), torch.nn.Unflatten(-1, (30, 3))))
    path = widgets.DeformationPath(space, x[0], x[1])
    before = drawn(path.canvas, 0)
    path.t = 1.0
    with torch.no_grad():
        right = space.deform(x[0], x[1]) - x[0]
    np.testing.assert_allclose(moved(path.canvas, 0, before), right.numpy(), atol=1e-6)


@pytest.fixture
def live(x):
    config = Config(k=4, steps=6, batch=4, features=(8, 16), head=(8,))
    return widgets.LiveTraining(Shapes(points=x), config, x[0], x[1], floor=1e-3)


def test_a_live_training_ends_with_the_space_the_curve_and_the_shape(live, x):
    before = drawn(live.canvas, 0)
    space = live.run()
    with torch.no_grad():
        right = space.deform(x[0], x[1]) - x[0]
    np.testing.assert_allclose(moved(live.canvas, 0, before), right.numpy(), atol=1e-6)
    assert len(live.curve.data[0].x) == len(live.curve.data[1].y) == 6
    assert "Done: step 6," in live.notice.value
    assert "times the sampling floor" in live.notice.value
    assert live.button.disabled


def test_drawing_waits_while_it_has_taken_more_than_its_share(live, monkeypatch):
    clock = iter(np.arange(0.0, 100.0, 0.5))  # a picture takes half a second
    monkeypatch.setattr("dsn_lite.widgets.live.perf_counter", lambda: next(clock))
    training = Training(live.shapes, live.config)
    for second in range(1, 121):
        live._watch(training, Record(second, float(second), 1.0, 1.0, 0.0))
    assert live.pictures == pytest.approx(120 * SHARE / 0.5, abs=1)
    assert len(live.history) == 120


def test_the_button_stops_a_training_from_another_thread_and_keeps_its_weights(x):
    config = Config(k=4, seconds=60.0, batch=4, features=(8, 16), head=(8,))
    live = widgets.LiveTraining(Shapes(points=x), config)
    clicks = threading.Timer(1.0, live.button.click)
    clicks.start()
    space = live.run()
    clicks.join()
    assert "Stopped:" in live.notice.value
    assert space.encode.head[-1].out_features == 4


def test_the_button_does_nothing_while_no_training_runs(live):
    live.stop()
    assert live.pictures == 0


def test_live_training_refuses_what_cannot_be_trained(x):
    with pytest.raises(ValueError, match="at least 8 shapes"):
        widgets.LiveTraining(Shapes(points=x[:5]))


def test_the_heartbeat_is_answered(capsys):
    beating = widgets.heartbeat()
    assert "If there is no green sentence" in capsys.readouterr().out
    assert beating.answer == ""
    beating.beat += 1
    assert "Connected" in beating.answer


@pytest.fixture
def families():
    rigs = {name: data_gen.family(name) for name in ("box/one", "table/four_legs", "carton/two_flaps")}
    return widgets.FamilySliders(rigs, colours)


def test_a_parameter_moves_the_mesh_of_its_family(families):
    families.family = "table/four_legs"
    rig, before = data_gen.family("table/four_legs"), drawn(families.canvas, 0)
    families.sliders["height"].value = 0.9
    there = rig.middle.copy()
    there[0, rig.parameter_names.index("height")] = 0.9
    right = rig.vertices(there)[0] - rig.vertices(rig.middle)[0]
    np.testing.assert_allclose(moved(families.canvas, 0, before), right, atol=1e-6)
    assert families.values["height"] == 0.9
    assert families.values["width"] == pytest.approx(rig.middle[0, 0])


@pytest.mark.parametrize("name", ["table/four_legs", "carton/two_flaps"])
def test_another_family_brings_its_own_mesh_colours_and_sliders(families, name):
    families.family = name
    rig, (trace,) = data_gen.family(name), families.canvas.view.data
    np.testing.assert_array_equal(np.stack([trace.i, trace.j, trace.k], 1), rig.triangles)
    assert len(trace.x) == len(rig.vertex_part)
    first = tuple(colours(name)[0].tolist())
    assert trace.facecolor[0] == "rgb({},{},{})".format(*first)
    assert tuple(families.sliders) == rig.parameter_names
    key = families.children[1].value
    assert all(part.replace("_", " ") in key for part in rig.part_names)
    assert f"rgb{first}" in key


def test_families_have_buttons_for_the_middle_and_for_a_random_shape(families):
    families.family = "table/four_legs"
    rig, panel = data_gen.family("table/four_legs"), families.children[0].children[1]
    middle, random = panel.children[1].children
    before = drawn(families.canvas, 0)
    random.click()
    values = np.array([list(families.values.values())])
    assert (np.abs(values - rig.middle) > 1e-3).all()
    right = rig.vertices(values)[0] - rig.vertices(rig.middle)[0]
    np.testing.assert_allclose(moved(families.canvas, 0, before), right, atol=1e-6)
    middle.click()
    np.testing.assert_allclose(moved(families.canvas, 0, before), 0, atol=1e-6)
    families.values = {"width": 0.6}
    assert families.values["width"] == 0.6


def test_canvas_refuses_faces_of_other_points(families, x):
    with pytest.raises(ValueError, match=r"Canvas\.replace: faces must be \(f, 3\) indices of the 30 points"):
        families.canvas.replace(0, x[0], [[0, 1, 30]], [[0, 0, 0]])
