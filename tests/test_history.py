"""A session of edits: what undo, redo, replay and a file give back is the same in every bit."""

import json
from dataclasses import replace

import numpy as np
import pytest
import torch
from edits import LEG, TOP, editor, history, others, same, shelf, table
from hypothesis import given, settings
from hypothesis import strategies as st
from worlds import deform_sync_net, randn

from dsn_lite.editing import History, Step
from dsn_lite.editing.keeping import identity, write
from dsn_lite.modes import change_of_basis
from dsn_lite.projection import Prior

EDITS = (
    {"edits": {LEG: 0.4}},
    {"edits": {TOP: 0.05}, "change": True, "strength": 0.5},
    {"edits": {"leg_*.scale.x": 0.03, TOP: 0.1}, "change": True, "bounds": {"leg_*.scale.y": (0.2, float("inf"))}},
    {"edits": {LEG: 0.3}, "bounds": {"top.scale.y": (None, 0.1)}, "strength": -2.0},
)


def all_done(seed=0):
    """A history of all EDITS."""
    session = history(seed)
    for told in EDITS:
        session.do(**told)
    return session


def test_a_history_is_its_edits_one_after_another():
    make, session = editor(), history()
    found = make.start
    for told in EDITS:
        found = make(**told, after=found)
        assert same(session.do(**told), found)
        assert session.state is session.state
        assert same(session.state, found)
    assert [step.edits for step in session.done] == [told["edits"] for told in EDITS]


def test_undo_gives_every_state_back_and_redo_too():
    session = history()
    states = [session.state, *(session.do(**told) for told in EDITS)]
    before = [states[0], *session.replay()[1:]]
    for state in states[-2::-1]:
        assert same(session.undo(), state)
    assert session.done == ()
    for state in states[1:]:
        assert same(session.redo(), state)
    assert session.undone == ()
    assert same(tuple(states), tuple(before))


def test_undo_of_everything_gives_the_very_bits_of_the_source():
    source = replace(table(), points=table().points.clone())
    source.points[0, :3] *= -0.0
    session = History(deform_sync_net(), source, [source.points[0]])
    session.do({LEG: 0.4})
    state = session.undo()
    for points in (state.source.points, state.source.edited, state.source.by_handles, state.others[0].points):
        assert same(points, source.points[0])
    assert (state.moved, state.others[0].moved, state.source.v.any().item()) == (0, 0, False)


@settings(max_examples=12)
@given(st.lists(st.sampled_from([*range(len(EDITS)), "undo", "redo"]), max_size=12))
def test_any_session_is_that_of_the_edits_that_are_left(events):
    """The slow twin keeps two plain lists and makes the state anew from the first."""
    session, done, undone = history(), [], []
    for event in events:
        if event == "undo" and done:
            undone.append(done.pop())
            session.undo()
        elif event == "redo" and undone:
            done.append(undone.pop())
            session.redo()
        elif not isinstance(event, str):
            done, undone = [*done, EDITS[event]], []
            session.do(**EDITS[event])
    fresh = history()
    for told in done:
        fresh.do(**told)
    assert same(session.state, fresh.state)
    assert same(session.replay()[-1], fresh.state)
    assert (len(session.done), len(session.undone)) == (len(done), len(undone))


def test_a_new_edit_drops_what_was_undone():
    session = all_done()
    session.undo()
    session.undo()
    session.do({TOP: 0.2})
    assert [*session.done[-1].edits] == [TOP]
    assert (len(session.done), session.undone) == (3, ())


def test_a_refused_edit_leaves_all_as_it_was():
    session = all_done()
    session.undo()
    before, state = (session.done, session.undone), session.state
    with pytest.raises(ValueError, match="there is no handle"):
        session.do({"nose.scale.x": 1.0})
    assert (session.done, session.undone) == before
    assert session.state is state


def test_a_preview_is_the_edit_but_is_not_done():
    session = all_done()
    session.undo()
    state, shown = session.state, session.preview(**EDITS[-1])
    assert session.state is state
    assert len(session.undone) == 1
    assert same(shown, session.redo())


def test_numbers_of_any_kind_become_plain_ones():
    kinds = {LEG: np.float32(0.5)}, np.bool_(True), {TOP: [torch.tensor(1.0), np.inf]}, 2
    step = Step.told(*kinds)
    assert step == Step({LEG: 0.5}, True, {TOP: (1.0, None)}, 2.0)
    assert Step.told(**json.loads(json.dumps(step.to_json()))) == step


@pytest.mark.parametrize("undone", [0, 2, 4])
def test_a_file_opens_to_the_identical_session(tmp_path, undone):
    session, file = all_done(), tmp_path / "edits.json"
    for _ in range(undone):
        session.undo()
    session.save(file)
    again = History.load(file, deform_sync_net(), table(), others())
    assert same(again.state, session.state)
    assert (again.done, again.undone) == (session.done, session.undone)
    assert same(again.replay(), session.replay())
    while again.undone:
        assert same(again.redo(), session.redo())
    again.save(tmp_path / "again.json")
    session.save(file)
    assert file.read_bytes() == (tmp_path / "again.json").read_bytes()
    assert [path.name for path in sorted(tmp_path.iterdir())] == ["again.json", "edits.json"]


def test_a_file_opens_beside_any_others(tmp_path):
    session = all_done()
    session.save(tmp_path / "edits.json")
    again = History.load(tmp_path / "edits.json", deform_sync_net(), table(), shelf())
    assert same(again.state.source, session.state.source)
    assert same(again.state.others, session.state.others[:1])


def test_another_space_source_or_prior_is_refused(tmp_path):
    file, space, moved = tmp_path / "edits.json", deform_sync_net(), replace(table(), boxes=table().boxes.clone())
    all_done().save(file)
    moved.boxes[0, 0, 0] += 1e-9
    rebased, prior = change_of_basis(space, torch.eye(3)), Prior(torch.eye(3))
    for told in ((deform_sync_net(1), table()), (rebased, table()), (space, table(), (), prior)):
        with pytest.raises(ValueError, match="must be a history of this space, it is of another; load it with its own"):
            History.load(file, *told)
    for source in (table(1), moved):
        with pytest.raises(ValueError, match="must be a history of this source, it is of another"):
            History.load(file, space, source)


def test_with_its_own_prior_it_opens(tmp_path):
    file, prior = tmp_path / "edits.json", Prior(randn(0, 3, 2), 0.01)
    session = history(prior=prior)
    session.do({LEG: 0.4})
    session.save(file)
    assert same(History.load(file, deform_sync_net(), table(), others(), prior).state, session.state)
    with pytest.raises(ValueError, match="must be a history of this space, it is of another"):
        History.load(file, deform_sync_net(), table(), others(), prior._replace(noise=0.02))


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"there is no such file; write one with History.save"):
        History.load(tmp_path / "none.json", deform_sync_net(), table())


def changed(**keys):
    """The text of a saved history with some keys changed; None takes a key out."""

    def change(told):
        return json.dumps({name: value for name, value in (told | keys).items() if value is not None})

    return change


def step(**keys):
    """The text with keys of its second edit changed."""
    return lambda told: json.dumps(told | {"steps": [told["steps"][0], told["steps"][1] | keys, *told["steps"][2:]]})


CHANGED = "must be as History.save wrote it, it was changed since; take it from its source again"
FOREIGN = "must be of the format 'dsn_lite edit history', got {}; is it an edit history"


@pytest.mark.parametrize(
    ("damage", "match"),
    [
        (lambda told: json.dumps(told)[:-20], r"must be whole JSON, got \(.*\); copy it again"),
        (lambda told: "", "must be whole JSON"),
        (lambda told: "[" * 100_000, "must be whole JSON"),
        (changed(cursor=float("nan")), r"must be whole JSON, got \(NaN is no JSON\)"),
        (lambda told: "[1, 2]", FOREIGN.format(r"'\[1, 2\]'")),
        (changed(format="another"), FOREIGN.format("'another'")),
        (changed(format=None), FOREIGN.format("'None'")),
        (changed(digest=None), CHANGED),
        (changed(space=None), CHANGED),
        (changed(cursor=3), CHANGED),
        (changed(z_hat={LEG: 0.3}), CHANGED),
        (changed(steps=None), CHANGED),
        (step(edits={TOP: 0.06}), CHANGED),
        (step(change=False), CHANGED),
        (step(bounds={LEG: [None, 9.0]}), CHANGED),
        (step(strength=0.6), CHANGED),
        (step(more=1), CHANGED),
    ],
)
def test_a_damaged_file_is_refused_in_one_sentence(tmp_path, damage, match):
    file, session = tmp_path / "edits.json", all_done()
    session.save(file)
    file.write_text(damage(json.loads(file.read_text(encoding="utf-8"))), encoding="utf-8")
    with pytest.raises(ValueError, match=match) as refused:
        History.load(file, deform_sync_net(), table())
    assert str(refused.value).startswith(f"History.load: {file}")
    assert "\n" not in str(refused.value)


def test_a_file_may_be_laid_out_otherwise(tmp_path):
    file, session = tmp_path / "edits.json", all_done()
    session.save(file)
    file.write_text(json.dumps(json.loads(file.read_text(encoding="utf-8")), sort_keys=True), encoding="utf-8")
    assert same(History.load(file, deform_sync_net(), table(), others()).state, session.state)


def test_edits_that_lead_elsewhere_are_refused(tmp_path):
    """As if another version had written it, which projects otherwise."""
    file, session = tmp_path / "edits.json", all_done()
    whose = identity(deform_sync_net(), table(), None)
    write(file, whose, list(session.done), 4, session.undo().source)
    with pytest.raises(ValueError, match=r"must lead to the handle values that it tells within 0.0001, it is off by 0"):
        History.load(file, deform_sync_net(), table())


def test_bytes_that_are_no_text_are_refused(tmp_path):
    (tmp_path / "edits.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="must be whole JSON"):
        History.load(tmp_path / "edits.json", deform_sync_net(), table())


def test_a_folder_that_is_not_there_is_left_to_the_system(tmp_path):
    with pytest.raises(FileNotFoundError):
        history().save(tmp_path / "none" / "edits.json")


def test_undo_and_redo_say_when_there_is_nothing():
    session = history()
    with pytest.raises(ValueError, match="undo: there must be an edit to take back, got none; look at `done` first"):
        session.undo()
    with pytest.raises(ValueError, match="redo: there must be an undone edit, got none; look at `undone` first"):
        session.redo()
