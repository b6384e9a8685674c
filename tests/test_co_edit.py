"""One edit and those that follow it, against the dense formulas; and the laws: actions add, strength and blends."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from edits import LEG, TOP, clouds, editor, others, same, shelf, table
from hypothesis import given, settings
from hypothesis import strategies as st
from worlds import autoencoder, deform_sync_net, near, randn, shapes_of

import data_gen
import dsn_lite
from dsn_lite.dictionary import matrix
from dsn_lite.editing import CoEditor, co_edit
from dsn_lite.files import as_shapes
from dsn_lite.handles import BoxHandles
from dsn_lite.projection import EditProjector, Prior
from dsn_lite.space import ActionSpace

values = st.floats(-0.3, 0.3)
few = settings(max_examples=10)


def unbounded(make):
    """Lets every handle take any value."""
    make.handles.lower.fill_(-torch.inf)
    return make


def dense(A, handles, pins):
    """Changes z of all handles, and v, by the matrices of Eqs. 4-7, everything formed."""
    A, B = matrix(A), matrix(handles.B)
    P = B - A @ torch.linalg.pinv(A) @ B
    pinned = torch.tensor([name in pins for name in handles.names])
    z = torch.zeros(len(pinned), dtype=A.dtype)
    z[pinned] = torch.tensor([pins[name] for name in handles.names if name in pins], dtype=A.dtype)
    z[~pinned] = -torch.linalg.pinv(P[:, ~pinned], rtol=1e-12) @ P[:, pinned] @ z[pinned]
    return z, torch.linalg.pinv(A) @ B @ z


@few
@given(st.integers(0, 99), values, values, st.floats(-2, 2))
def test_an_edit_is_the_dense_one_and_others_are_acted_on_by_its_vector(seed, leg, top, strength):
    make = unbounded(editor(seed))
    space, handles, x = deform_sync_net(seed), make.handles, make.start.source.points
    found = make({LEG: leg, TOP: top}, change=True, strength=strength)
    z, v = dense(space.dictionary(x), handles, {LEG: leg, TOP: top})
    near(found.source.z_hat, handles.z0 + z)
    near(found.source.points, space.act(x, v))
    near(found.source.by_handles, x + handles.offsets(z))
    assert found.moved == pytest.approx((found.source.points - x).square().sum(-1).mean().sqrt().item())
    for one, still in zip(found.others, make.start.others, strict=True):
        near(one.points, space.act(still.points, strength * v))
        assert one.moved == pytest.approx((one.points - still.points).square().sum(-1).mean().sqrt().item())


def test_what_others_make_of_it_with_their_own_handles_is_the_dense_projection():
    """BB+A v, and the values B+A v; points of no part keep what the vector made of them."""
    space = deform_sync_net()
    other = replace(shelf(), labels=shelf().labels.expand(1, 48).clone())
    other.labels[0, :5] = -1
    edit = co_edit(space, table(), {LEG: 0.1}, other, change=True)
    found, handles, z = edit.others[0], BoxHandles.of(other), other.points[0]
    B, u = matrix(handles.B), (space.act(z, edit.v) - z).flatten()
    near(found.z_hat, handles.z0 + torch.linalg.pinv(B) @ u)
    near(found.by_handles[5:], (z + (B @ torch.linalg.pinv(B) @ u).unflatten(0, z.shape))[5:])
    assert torch.equal(found.by_handles[:5], found.points[:5])
    assert found["shelf.scale.y"] == found.z_hat[handles.names.index("shelf.scale.y")]


def test_one_edit_is_that_of_the_projector():
    """co_edit adds the others and nothing else."""
    space, told = deform_sync_net(), {"change": True, "bounds": {"leg_*.scale.y": (0.3, 0.5)}}
    found = co_edit(space, table(), {LEG: -0.02}, (), **told).source
    snapped = EditProjector.of(space, table())({LEG: -0.02}, **told)
    assert (found.pinned, found.at_bounds) == (snapped.pinned, snapped.at_bounds)
    for name in ("z0", "z_hat", "v", "points", "edited", "by_handles"):
        near(getattr(found, name), getattr(snapped, name))
    assert (found.distance, found.residual) == pytest.approx((snapped.distance, snapped.residual))


def test_a_prior_says_which_vectors_are_plausible():
    basis = randn(0, 3, 1)
    found = co_edit(deform_sync_net(), table(), {LEG: 0.1}, (), change=True, prior=Prior(basis)).source.v
    near(found, basis[:, 0] * (found[0] / basis[0, 0]))


def test_others_may_be_shapes_clouds_or_both():
    bare, space = randn(0, 2, 5, 3), deform_sync_net()
    apart = co_edit(space, table(), {LEG: 0.2}, [shelf(2), bare[0], bare[1]])
    assert same(co_edit(space, table(), {LEG: 0.2}, shelf(2)).others, apart.others[:2])
    assert same(co_edit(space, table(), {LEG: 0.2}, bare).others, apart.others[2:])
    assert [one.by_handles is one.z_hat is None for one in apart.others] == [False, False, True, True]


@few
@given(st.integers(0, 99), values, st.sampled_from([-1.0, 0.25, 2.0]))
def test_strength_scales_how_far_others_go_and_leaves_the_source(seed, leg, strength):
    make = editor(seed)
    once, again = make({LEG: leg}, change=True), make({LEG: leg}, change=True, strength=strength)
    assert same(once.source, again.source)
    assert torch.equal(again.v, strength * once.v)
    for a, b, still in zip(once.others, again.others, make.start.others, strict=True):
        near(b.points - still.points, strength * (a.points - still.points))
        assert b.moved == pytest.approx(abs(strength) * a.moved, abs=1e-12)


def test_strength_0_leaves_others_to_the_last_bit():
    cloud = randn(0, 9, 3)
    cloud[0] = -0.0
    make = CoEditor(deform_sync_net(), table(), [cloud, table(1)])
    assert same(make({LEG: 0.5}, strength=0.0).others, make.start.others)
    assert same(make.start.others[0].points, cloud)


@few
@given(st.integers(0, 99), values, values)
def test_two_changes_of_a_handle_are_the_one_change_by_their_sum(seed, a, b):
    make = unbounded(editor(seed))
    together = make({LEG: a + b}, change=True)
    steps = make({LEG: b}, change=True, after=make({LEG: a}, change=True))
    near(steps.source.z_hat, together.source.z_hat)
    near(clouds(steps), clouds(together))


@few
@given(st.integers(0, 99), values, values)
def test_the_order_of_two_changes_does_not_matter(seed, a, b):
    make = unbounded(editor(seed))
    one = make({TOP: b}, change=True, after=make({LEG: a}, change=True), strength=0.5)
    other = make({LEG: a}, change=True, after=make({TOP: b}, change=True, strength=0.5))
    near(one.source.z_hat, other.source.z_hat)
    near(clouds(one), clouds(other))


def test_a_dictionary_read_anew_after_each_edit_would_not_add_up():
    """The law has teeth: F at the moved table is another dictionary."""
    space, x = deform_sync_net(), table().points[0]
    v = co_edit(space, table(), {LEG: 0.2}, (), change=True).source.v
    there = space.act(x, v)
    assert (space.act(there, v) - space.act(x, 2 * v)).abs().max() > 1e-3


@few
@given(st.integers(0, 99), values, values)
def test_earlier_pins_let_go_and_named_again_both_edits_are_one(seed, a, b):
    make = unbounded(editor(seed))
    first = make({LEG: a}, change=True)
    held = make({TOP: b, LEG: 0.0}, change=True, after=first).source
    at_once = make({LEG: a, TOP: first.source[TOP] - make.start.source[TOP] + b}, change=True).source
    near(held.z_hat, at_once.z_hat)
    near(held.points, at_once.points)
    free = make({TOP: b}, change=True, after=first).source
    assert set(held.pinned) == {TOP, LEG}
    assert free.pinned == (TOP,)
    assert abs(b) < 1e-3 or free[LEG] != held[LEG]


def test_values_are_absolute_unless_told_and_the_broken_edit_is_that_of_the_latest():
    make = editor()
    first = make({LEG: 0.5})
    second = make({TOP: 0.2}, after=first).source
    assert first.source[LEG] == pytest.approx(0.5)
    assert second[TOP] == pytest.approx(0.2)
    pins = torch.zeros(len(second.names), dtype=torch.float64)
    pins[second.names.index(TOP)] = 0.2 - first.source[TOP]
    near(second.edited, first.source.points + make.handles.offsets(pins))
    assert second.distance == pytest.approx((second.points - second.edited).square().sum(-1).mean().sqrt().item())


def test_bounds_hold_for_the_totals():
    make, bounds = editor(), {"leg_2.scale.y": (None, 0.45)}
    found = make.start
    for _ in range(4):
        found = make({LEG: 0.1}, change=True, bounds=bounds, after=found)
    assert found.source["leg_2.scale.y"] <= 0.45 + 1e-9
    assert "leg_2.scale.y" in found.source.at_bounds
    with pytest.raises(ValueError, match=r"leg_2.scale.y between .* and 0.45 and pinned at 0.65"):
        make({"leg_2.scale.y": 0.2}, change=True, bounds=bounds, after=found)


def three_edits(make):
    """Two edits of their own and one that goes on from the second."""
    first, second = make({LEG: 0.3}, strength=0.5), make({TOP: 0.1}, change=True)
    return [first, second, make({"leg_*.scale.x": 0.02}, change=True, bounds={LEG: (0.1, 0.6)}, after=second)]


@pytest.mark.parametrize("j", range(3))
def test_weights_of_1_and_0_give_one_edit_exactly(j):
    make = editor()
    edits = three_edits(make)
    blend = make.blend(edits, [float(i == j) for i in range(3)])
    assert same(blend, edits[j])
    assert same(make.blend(edits, [0.0, 0.0, 0.0]), make.start)


@few
@given(st.integers(0, 9), st.lists(st.floats(-1, 2), min_size=3, max_size=3))
def test_a_blend_is_the_weighted_sum_of_its_edits(seed, weights):
    make = editor(seed)
    edits, start = three_edits(make), make.start
    blend = make.blend(edits, weights)
    for of in (clouds, lambda edit: edit.source.z_hat, lambda edit: edit.source.edited, lambda edit: edit.v):
        near(of(blend) - of(start), sum(w * (of(edit) - of(start)) for w, edit in zip(weights, edits, strict=True)))


def test_means_of_edits_keep_the_bounds_that_all_of_them_keep():
    make, bounds = editor(), {"leg_2.scale.y": (0.3, 0.4)}
    edits = [make({LEG: value}, bounds=bounds) for value in (0.1, 0.6)]
    assert any(edit.source.at_bounds for edit in edits)
    assert all(0.3 - 1e-9 <= make.blend(edits, (w, 1 - w)).source["leg_2.scale.y"] <= 0.4 + 1e-9 for w in (0.2, 0.7))


class Counted(ActionSpace):
    """A space that counts how often it is asked for a dictionary."""

    def __init__(self, space):
        super().__init__()
        self.space, self.asked = space, 0

    def act(self, x, v):
        raise AssertionError("an edit needs dictionaries alone")

    vector = act

    def dictionary(self, x):
        self.asked += 1
        return self.space.dictionary(x)


def test_every_dictionary_is_computed_once_whatever_is_edited():
    space = Counted(deform_sync_net())
    make = CoEditor(space, table(), others())
    for value in np.linspace(0.3, 0.5, 5).tolist():
        make({LEG: value})
    make.blend(three_edits(make), [1.0, 1.0, 1.0])
    assert space.asked == 5


class Exact(ActionSpace):
    """The space of the true dictionaries of some shapes, found by their points."""

    def __init__(self, *collections):
        super().__init__()
        self.known = {c.points[i].tobytes(): A for c in collections for i, A in enumerate(data_gen.valid_space(c))}

    def act(self, x, v):
        return x + torch.einsum("...nck,...k->...nc", self.dictionary(x), v)

    vector = act

    def dictionary(self, x):
        return torch.from_numpy(np.stack([self.known[cloud.numpy().tobytes()] for cloud in x]))


def test_with_the_true_dictionary_others_become_what_truth_says():
    """A table gets longer legs; the vector that this takes are its new parameters, and others change by as much."""
    x, z = (data_gen.generate("table/four_legs", count=1, points=64, seed=seed) for seed in (0, 1))
    found = co_edit(Exact(x, z), as_shapes(x), {LEG: 0.03, TOP: 0.03}, as_shapes(z), change=True)
    y = replace(x, parameters=x.parameters + found.v.numpy())
    truth = torch.from_numpy(data_gen.true_transfer(x, y, z, clip=False)[0])
    near(found.others[0].points.double(), truth, scale=1e3)  # points are float32
    near(found.others[0].by_handles.double(), truth, scale=1e3)
    assert found.others[0].moved > 0.01


def test_a_ready_space_co_edits_chairs_of_all_families():
    """A seat is made wider by a fifth: every other seat is too, nothing is thrown far, and mostly parts move whole."""
    chairs = shapes_of("chair", 10, 256, seed=5)
    make = CoEditor(dsn_lite.load("chair"), chairs[0], chairs[1:])
    found = make({"seat.scale.x": 1.2 * make.start.source["seat.scale.x"]})
    assert found.source["seat.scale.x"] == pytest.approx(1.2 * make.start.source["seat.scale.x"])
    assert len(set(chairs.family_names)) > 3
    for before, after in zip(make.start.others, found.others, strict=True):
        assert after["seat.scale.x"] > 1.05 * before["seat.scale.x"]
        assert 0 < after.moved < 3 * found.moved
        assert (after.points - after.by_handles).square().sum(-1).mean().sqrt() < 0.5 * after.moved


class OneDictionary(Counted):
    """A space of 64 corresponding points, whatever it is given."""

    def dictionary(self, x):
        return randn(0, 1, 64, 3, 3)


@pytest.mark.parametrize(
    ("space", "source", "told", "match"),
    [
        (autoencoder(64), table(), {}, "the space must have a dictionary, AutoencoderSpace has none"),
        (deform_sync_net(), table(count=5), {}, r"co_edit: source must be one shape, got 5; take shapes\[0\]"),
        (deform_sync_net(), as_shapes(randn(0, 1, 9, 3)), {}, "must have labels, rest and boxes, these have no parts"),
        (deform_sync_net(), table(), {"strength": float("nan")}, "strength must be a finite number, got nan; 1 moves"),
        (OneDictionary(None), table(), {}, "others must have the 64 points of the space's one dictionary, got 48"),
        (deform_sync_net(), table(), {"bounds": {LEG: (0.5, None)}}, f"{LEG} between 0.5 and inf and pinned at 0.1"),
    ],
)
def test_a_wrong_co_edit_is_refused(space, source, told, match):
    with pytest.raises(ValueError, match=match):
        co_edit(space, source, {LEG: 0.1}, others(), **told)


def test_an_unknown_handle_is_refused_with_those_near():
    with pytest.raises(ValueError, match=r"there is no handle 'leg_9.scale.y'; did you mean leg_4.scale.y"):
        editor()({"leg_9.scale.y": 0.1})


def test_wrong_blends_are_refused():
    make, foreign = editor(), CoEditor(deform_sync_net(), table(3))({LEG: 0.3})
    edits = three_edits(make)
    with pytest.raises(ValueError, match=r"one finite number for each of the 3 edits, got \[1.0, 2.0\]; count again"):
        make.blend(edits, [1.0, 2.0])
    with pytest.raises(ValueError, match=r"one finite number for each of the 3 edits, got .*nan"):
        make.blend(edits, [1.0, 2.0, float("nan")])
    with pytest.raises(ValueError, match="edits must be of the source of this CoEditor, got one of another"):
        make.blend([edits[0], foreign], [0.5, 0.5])
