"""The editor of handles without a front end: what it shows against slow twins, undo and redo, and what it refuses."""

import re

import ipywidgets
import numpy as np
import pytest
import torch

import data_gen
import dsn_lite
from dsn_lite import CoEditor, Config, EditProjector, modes, widgets
from dsn_lite.config import network
from dsn_lite.handles import BoxHandles, corners
from dsn_lite.plots.look import GREY, PALETTE
from dsn_lite.plots.traces import colours

LEG, TOP = "leg_2.scale.y", "top.translation.y"


@pytest.fixture(scope="module")
def tables():
    return dsn_lite.as_shapes(data_gen.generate("table/four_legs", count=4, points=96, seed=1))


@pytest.fixture(scope="module")
def space():
    return network(Config(k=6))


@pytest.fixture
def editor(space, tables):
    found = widgets.HandleEditor(space, tables[0], tables[1:])
    found.name = LEG
    return found


def shown(canvas, index, shape_count):
    """Points (n, 3) that a canvas shows of a shape, moved back from its place in the row."""
    x, y, z = (np.asarray(axis, dtype=float) for axis in canvas.points(index))
    dx, dy, _ = canvas._row.place(np.zeros((1, 3)), index)
    return np.stack([x - dx, z, -(y - dy)], 1)


def picture(editor):
    """All that is drawn: the edit, the snapped shape, the others, and the lines of all boxes."""
    views = editor.canvas.view, editor.others.view
    return [np.stack([trace[axis] for axis in "xyz"]) for view in views for trace in view.data]


def same(one, other):
    return all(np.array_equal(a, b, equal_nan=True) for a, b in zip(one, other, strict=True))


def test_it_begins_with_the_shapes_as_they_are(editor, tables):
    for index in (0, 1):
        np.testing.assert_allclose(shown(editor.canvas, index, 2), tables.points[0], atol=1e-6)
    for index in range(3):
        np.testing.assert_allclose(shown(editor.others, index, 3), tables.points[index + 1], atol=1e-6)
    height = tables.boxes[0, tables.part_names.index("leg_2"), 13].item()
    assert editor.value == pytest.approx(height)
    assert (editor.picker.slider.min, editor.picker.slider.max) == pytest.approx((0.5 * height, 1.5 * height))
    assert f"Nothing is edited yet. leg 2 scale y is at {height:.3f}." in editor.told.value
    assert [button.disabled for button in editor.buttons.values()] == [True] * 3


def test_the_slider_shows_the_broken_edit_the_snapped_shape_and_the_others_that_follow(editor, space, tables):
    editor.value = 0.3
    snapped = EditProjector.of(space, tables)({LEG: 0.3})
    handles = BoxHandles.of(tables)
    change = torch.zeros(len(handles.names))
    change[handles.names.index(LEG)] = 0.3 - handles.z0[handles.names.index(LEG)]
    np.testing.assert_allclose(shown(editor.canvas, 0, 2), tables.points[0] + handles.offsets(change), atol=1e-6)
    np.testing.assert_allclose(shown(editor.canvas, 1, 2), snapped.points, atol=1e-5)
    for index, z in enumerate(tables.points[1:]):
        np.testing.assert_allclose(shown(editor.others, index, 3), space.act(z, snapped.v.float()).detach(), atol=1e-5)
    assert "Edit 1: leg 2 scale y at 0.300." in editor.told.value
    assert f"The snap moved points by {snapped.distance:.3f}, met no bound." in editor.told.value


def test_boxes_are_those_of_the_edit_and_of_the_snapped_handles(editor, space, tables):
    editor.value = 0.3
    handles, snapped = BoxHandles.of(tables), EditProjector.of(space, tables)({LEG: 0.3})
    broken = handles.z0.clone()
    broken[handles.names.index(LEG)] = 0.3
    wanted = widgets.Canvas(
        [tables.points[0]] * 2,
        boxes={0: corners(handles, broken)[2:3], 1: corners(handles, snapped.z_hat)},
        room=1.25,
    )
    lines = [np.stack([canvas.view.data[-1][axis] for axis in "xyz"]) for canvas in (wanted, editor.canvas)]
    assert lines[0].shape == lines[1].shape == (3, 17 * 6)  # one box, then five
    off = np.nan_to_num(lines[0] - lines[1])
    off[:, :17] -= off[:, :1]
    off[:, 17:] -= off[:, 17:18]  # rows differ in the room between their shapes
    np.testing.assert_allclose(off[:, np.arange(17 * 6) % 17 != 16], 0, atol=2e-6)


def test_one_drag_is_one_edit_and_another_handle_begins_the_next(editor, space, tables):
    for value in (0.28, 0.3, 0.32):
        editor.picker.slider.value = value
    assert [step.edits for step in editor.history.done] == [{LEG: 0.32}]
    editor.name = TOP
    at = editor.state.source[TOP]
    assert editor.value == pytest.approx(at)
    editor.value = at + 0.05
    assert [step.edits for step in editor.history.done] == [{LEG: 0.32}, {TOP: at + 0.05}]
    twin = CoEditor(space, tables[0], tables[1:])
    expected = twin({TOP: at + 0.05}, after=twin({LEG: 0.32}))
    np.testing.assert_allclose(shown(editor.canvas, 1, 2), expected.source.points, atol=1e-6)
    np.testing.assert_allclose(shown(editor.others, 2, 3), expected.others[2].points, atol=1e-6)


def test_what_was_edited_before_lets_go_or_is_held(editor):
    editor.value = 0.3
    editor.name = TOP
    editor.value = editor.value + 0.1
    assert abs(editor.state.source[LEG] - 0.3) > 1e-3
    editor.hold.value = True
    editor.value = editor.value + 0.01
    assert editor.state.source[LEG] == pytest.approx(0.3)
    assert editor.state.source[TOP] == pytest.approx(editor.value)


def test_undo_redo_and_reset_bring_back_the_very_pictures(editor):
    pictures = [picture(editor)]
    for name, by in ((LEG, 0.05), (TOP, -0.1)):
        editor.name = name
        editor.value = editor.value + by
        editor.name = name  # lets the drag end
        pictures.append(picture(editor))
    editor.buttons["undo"].click()
    snapped = editor.canvas.points(1)
    assert same(snapped, [pictures[1][1][axis] for axis in range(3)])
    assert editor.value == pytest.approx(editor.state.source[TOP])
    assert not editor.buttons["redo"].disabled
    editor.buttons["redo"].click()
    assert same(picture(editor), pictures[2])
    editor.buttons["reset"].click()
    assert editor.history.done == ()
    assert len(editor.history.undone) == 2
    assert [button.disabled for button in editor.buttons.values()] == [True, False, True]
    editor.name = LEG
    assert same(picture(editor), pictures[0])


def test_a_value_that_the_page_only_rounds_is_no_edit(editor):
    slider, at = editor.picker.slider, editor.value
    slider.value = at + 0.4 * slider.step
    assert editor.history.done == ()
    slider.value = at + 3 * slider.step
    slider.value = at + 0.4 * slider.step  # but somebody who moves it may come back
    assert [step.edits for step in editor.history.done] == [{LEG: at + 0.4 * slider.step}]


def test_a_new_drag_after_undo_is_a_new_edit(editor):
    editor.value = 0.3
    editor.buttons["undo"].click()
    editor.value = 0.33
    assert [step.edits for step in editor.history.done] == [{LEG: 0.33}]
    assert editor.history.undone == ()


def test_strength_moves_the_others_and_not_the_source(editor, tables):
    editor.value = 0.3
    source, moved = shown(editor.canvas, 1, 2), shown(editor.others, 0, 3) - tables.points[1].numpy()
    editor.strength.value = 0.5
    np.testing.assert_array_equal(shown(editor.canvas, 1, 2), source)
    np.testing.assert_allclose(shown(editor.others, 0, 3) - tables.points[1].numpy(), 0.5 * moved, atol=1e-6)
    assert len(editor.history.done) == 1
    assert editor.history.done[0].strength == 0.5


def test_bounds_that_were_met_are_said():
    drawn = data_gen.generate("table/four_legs", count=2, points=96, seed=1, sampling="shared")
    exact, both = dsn_lite.LinearSpace(torch.from_numpy(data_gen.valid_space(drawn)[0])), dsn_lite.as_shapes(drawn)
    editor = widgets.HandleEditor(exact, both[0], both[1:])
    editor.name = "leg_2.translation.y"
    editor.value = editor.value - 0.5
    at_bounds = editor.state.source.at_bounds
    assert at_bounds
    assert "met no bound" not in editor.told.value
    assert at_bounds[0].replace("_", " ").replace(".", " ") in editor.told.value


def test_an_edit_that_is_refused_is_said_and_leaves_all_as_it_was(editor):
    editor.value = 0.3
    before, state = picture(editor), editor.state
    editor.value = -1.0  # an edge length, which is more than 0
    assert "ValueError: bounds: some value must lie within all bounds, got leg_2.scale.y" in editor.notice.value
    assert "role='alert'" in editor.notice.value
    assert editor.state is state
    assert same(picture(editor), before)
    editor.value = 0.31
    assert editor.notice.value == ""
    assert editor.history.done[-1].edits == {LEG: 0.31}


def test_the_slider_reaches_as_far_as_the_paper_goes_or_to_where_the_handle_is(editor):
    start = editor.state.source[TOP]
    editor.name = TOP
    assert (editor.picker.slider.min, editor.picker.slider.max) == pytest.approx((start - 0.5, start + 0.5))
    editor.value = start + 0.7
    assert (editor.picker.slider.min, editor.picker.slider.max) == pytest.approx((start - 0.5, start + 0.7))


def test_another_part_keeps_the_handle_where_it_has_it(space):
    chairs = dsn_lite.as_shapes(data_gen.generate("chair", count=8, points=64, seed=0))
    editor = widgets.HandleEditor(space, chairs[0], chairs[1:])
    editor.picker.handle.value = "scale.y"
    for part, names in editor.picker.parts.items():
        before, editor.picker.part.value = editor.picker.handle.value, part
        assert editor.name == f"{part}.{before if before in names else names[0]}"
        assert editor.value == pytest.approx(editor.state.source[editor.name])


def test_one_colour_is_one_kind_of_part_on_all_shapes(space, tables):
    desks = dsn_lite.as_shapes(data_gen.generate("table", count=8, points=96, seed=2))
    editor = widgets.HandleEditor(space, tables[0], desks)
    legs = [f"leg_{i}" for i in range(1, 5)]
    wanted = {tables.part_names.index(name) for name in legs}
    own = np.isin(tables.labels[0].numpy(), list(wanted))
    colour = set(np.asarray(editor.canvas.view.data[0].marker.color)[own])
    assert colour == set(colours(np.array([1])))  # top, then leg
    for index, one in enumerate(desks[i] for i in range(len(desks))):
        rows = [i for i, name in enumerate(one.part_names) if name.split("_")[0] == "leg" and name in legs]
        own = np.isin(one.labels[0].numpy(), rows)
        assert set(np.asarray(editor.others.view.data[index].marker.color)[own]) <= colour


def test_kinds_beyond_the_palette_are_grey_and_not_another_kind_s_colour(space):
    chairs = dsn_lite.as_shapes(data_gen.generate("chair", count=16, points=64, seed=6))
    editor = widgets.HandleEditor(space, chairs[0], chairs[1:])
    own = [one.part_names[label] for one in chairs for label in one.labels.unique() if label >= 0]
    known = modes.kinds(own)
    assert len(known) > len(PALETTE)
    keyed = re.findall(r"color:(#\w+)'>&#9632;</span> ([^<]+)<", editor.children[-1].value)
    greys = [GREY] * (len(known) - len(PALETTE))
    assert keyed == [(c, name.replace("_", " ")) for c, name in zip([*PALETTE, *greys], known, strict=True)]
    grey, beyond = colours(np.array([-1])), known[len(PALETTE) :]
    for index, one in enumerate(chairs[i] for i in range(1, 16)):
        kinds = np.array([modes.kind(name) for name in one.part_names])[one.labels[0].numpy()]
        drawn = np.asarray(editor.others.view.data[index].marker.color)
        np.testing.assert_array_equal(drawn == grey, np.isin(kinds, beyond))


def test_others_may_be_clouds_without_parts(space, tables):
    editor = widgets.HandleEditor(space, tables[0], tables.points[1:], titles=["b", "c", "d"])
    editor.name, editor.value = LEG, 0.3
    assert {trace.mode for trace in editor.others.view.data} == {"markers"}
    assert editor.others.view.layout.meta["alt"] == "3 shapes that can be moved: b, c, d."
    assert editor.canvas.view.layout.meta["alt"] == "2 shapes that can be moved: your edit, snapped."


def test_every_control_has_a_name(editor):
    controls = [editor.picker.part, editor.picker.handle, editor.picker.slider, editor.strength, editor.hold]
    assert all(control.description for control in [*controls, *editor.buttons.values()])


def test_wrong_arguments_are_refused(space, tables, editor):
    with pytest.raises(ValueError, match="HandleEditor: there must be at least one other shape, got none; take some"):
        widgets.HandleEditor(space, tables[0], [])
    with pytest.raises(ValueError, match="co_edit: source must be one shape, got 4"):
        widgets.HandleEditor(space, tables, tables[1:])
    with pytest.raises(
        ValueError, match=r"HandlePicker.name: there is no handle 'leg_9.scale.y'; it must be one of top"
    ):
        editor.name = "leg_9.scale.y"
    with pytest.raises(ValueError, match=r"HandlePicker\.value: it must be a finite number, got nan; see handles.z0"):
        editor.value = float("nan")


def test_a_picture_reaches_the_page_in_one_piece(tables, monkeypatch):
    sent = []
    monkeypatch.setattr(ipywidgets.Widget, "open", lambda self: sent.append(len(self._widget_data)))
    widgets.Canvas(tables.points[:2])
    assert sent == [2]
