import numpy as np
import pytest
import torch
from hypothesis import example, given
from problems import dense, kkt, literal, made, pins, problems
from worlds import autoencoder, deform_sync_net, linear_space, near, randn, shapes_of, unchecked

import data_gen
from dsn_lite.data import Shapes
from dsn_lite.files import as_shapes
from dsn_lite.handles import BoxHandles, DenseHandles
from dsn_lite.projection import EditProjector, Prior


def optimality(edit, pinned, dz, v):
    """A law of Eq. 4: how far r = B z - A v is from square to A and to the columns of B that are free, 0 to 1."""
    A, B = dense(edit)
    r = B @ dz - A @ v
    square = [np.abs(each.T @ r).max(initial=0) / np.linalg.norm(each, 2) for each in (A, B[:, ~pinned]) if each.size]
    return max(square) / np.linalg.norm(B[:, pinned] @ dz[pinned])


@given(problems())
def test_it_solves_eq_4(problem):
    edit, pinned, z = made(problem)
    snapped, (r, _), B = edit(pins(edit, pinned, z), change=True), kkt(edit, pinned, z), list(dense(edit))[1]
    size = np.linalg.norm(B[:, pinned] @ z)
    ours = edit.handles.B.numpy() @ snapped.z_hat.numpy() - (edit.A @ snapped.v).numpy()
    assert abs((ours**2).sum() - (r**2).sum()) < 1e-8 * size**2
    if (r**2).sum() > 1e-6 * size**2:
        assert (ours**2).sum() == pytest.approx((r**2).sum(), rel=1e-8)
    assert np.abs(ours.ravel() - r).max() < 1e-8 * size
    assert snapped.residual == pytest.approx(((r**2).sum() / len(edit.x)) ** 0.5, abs=1e-8 * size)


@given(problems())
@example({"seed": 23106, "kind": "some in span", "sizes": (6, 2, 4), "pins": 2, "scales": (1.0, 1.0)})  # once 1e14
def test_where_several_are_best_it_takes_the_shortest(problem):
    edit, pinned, z = made(problem)
    expected, unique = literal(edit, pinned, z)
    found, B = edit(pins(edit, pinned, z), change=True).z_hat.numpy(), list(dense(edit))[1]
    assert np.abs(found - expected).max() < 1e-8 * max(1, np.abs(expected).max())
    assert np.linalg.norm(B @ (found - expected)) < 1e-8 * np.linalg.norm(B, 2) * np.linalg.norm(expected)
    if unique:
        assert np.abs(found - kkt(edit, pinned, z)[1]).max() < 1e-8 * max(1, np.abs(expected).max())


@given(problems())
def test_v_is_the_shortest_that_comes_nearest(problem):
    edit, pinned, z = made(problem)
    snapped, (A, B) = edit(pins(edit, pinned, z), change=True), dense(edit)
    v = np.linalg.pinv(A, rcond=1e-12) @ (B @ snapped.z_hat.numpy())
    assert np.abs(snapped.v.numpy() - v).max() < 1e-8 * max(1, np.abs(v).max())
    near(snapped.points, edit.x + edit.A @ snapped.v, scale=edit.A.abs().max() * snapped.v.norm())


@given(problems())
def test_nothing_is_left_to_gain_and_the_law_has_teeth(problem):
    edit, pinned, z = made(problem)
    dz, v = edit.drag(pinned, z)
    assert optimality(edit, pinned, dz, v) < 1e-9
    bent = np.where(pinned, dz, dz + 0.1)
    lazy = v if np.linalg.norm(v) == 0 else 0 * v
    if np.linalg.norm(edit.A.numpy() @ v) > 1e-3 * np.linalg.norm(edit.handles.B.numpy() @ dz):
        assert optimality(edit, pinned, dz, lazy) > 1e-7
    if literal(edit, pinned, z)[1] and (~pinned).any():
        assert optimality(edit, pinned, bent, v) > 1e-7


@given(problems())
def test_a_drag_is_linear_and_keeps_the_pins(problem):
    edit, pinned, z = made(problem)
    for once, twice in zip(edit.drag(pinned, z), edit.drag(pinned, -2 * z), strict=True):
        near(torch.from_numpy(twice), torch.from_numpy(-2 * once), scale=np.abs(once).max())
    snapped = edit(pins(edit, pinned, z), change=True)
    assert np.abs(snapped.z_hat.numpy()[pinned] - z).max() < 1e-9
    assert snapped.pinned == tuple(np.array(edit.handles.names)[pinned])
    assert snapped.at_bounds == ()


def test_a_plausible_deformation_stays_as_it_is():
    B, W, w = randn(0, 9, 3, 5), randn(1, 5, 3), randn(2, 3)
    edit = EditProjector(B @ W, DenseHandles(B), randn(3, 9, 3))
    snapped = edit({f"handle_{j}": value for j, value in enumerate((W @ w).tolist())})
    near(snapped.v, w)
    near(snapped.points, edit.x + (B @ W) @ w)
    assert max(snapped.distance, snapped.residual) < 1e-12


def test_what_was_found_is_found_again():
    edit = EditProjector(randn(0, 9, 3, 3), DenseHandles(randn(1, 9, 3, 5)), randn(2, 9, 3))
    once = edit({"handle_1": 0.7})
    again = edit(dict(zip(edit.handles.names, once.z_hat.tolist(), strict=True)))
    near(again.v, once.v)
    near(again.edited, once.by_handles)


def test_handles_within_the_space_do_not_explode():
    A = randn(0, 200, 3, 8)
    B = torch.cat([A @ randn(1, 8, 4), randn(2, 200, 3, 2)], dim=-1)
    edit = EditProjector(A, DenseHandles(B), randn(3, 200, 3))
    for j in range(6):
        change = edit({f"handle_{j}": 1.0}, change=True).z_hat
        assert change.abs().max() < 1.5  # Eq. 7 taken literally divides 1e-14 by 1e-14


def gains(edit):
    """Changes of all handles for a change 1 of each."""
    return np.stack([edit.factor.gain(one)[:, 0] for one in np.eye(len(edit.handles.names), dtype=bool)])


@pytest.mark.parametrize("family", ["table/splayed", "chair/arms", "lamp/torchiere"])
def test_rounded_boxes_are_answered_like_exact_ones(family):
    """B of single precision lies in span(A) only to 1e-8: that is rounding too, and no reason to move by millions."""
    found = []
    for dtype in ("float64", "float32"):
        drawn = data_gen.generate(family, count=1, points=300, seed=0, dtype=dtype)
        shapes, A = as_shapes(drawn), torch.from_numpy(data_gen.valid_space(drawn)[0])
        found.append(gains(EditProjector(A, BoxHandles.of(shapes), shapes.points[0])))
    assert np.abs(found[0] - found[1]).max() < 1e-4
    blind = BoxHandles(shapes.labels[0], shapes.rest[0].double(), shapes.boxes[0].double(), shapes.part_names)
    assert np.abs(gains(EditProjector(A, blind, shapes.points[0]))).max() > 1e3


def test_the_four_legs_of_a_table_follow_one():
    drawn = data_gen.generate("table/four_legs", count=1, points=400, seed=0)
    shapes, A = as_shapes(drawn), torch.from_numpy(data_gen.valid_space(drawn)[0])
    edit = EditProjector(A, BoxHandles.of(shapes), shapes.points[0])
    legs = [name for name in edit.handles.names if name.startswith("leg") and name.endswith("scale.y")]
    snapped = edit({legs[1]: 0.05}, change=True)
    assert len(legs) == 4
    for leg in legs:
        assert snapped[leg] - edit.handles.z0[edit.handles.names.index(leg)].item() == pytest.approx(0.05, abs=1e-6)
    assert snapped.residual < 1e-6 < 0.01 < snapped.distance


@pytest.mark.parametrize("dtype", ["float32", "float64"])
def test_of_takes_the_dictionary_and_the_handles_of_one_shape(dtype):
    space, shapes = deform_sync_net(), shapes_of("chair/four_legs", 3, 200, dtype=dtype)
    edit = EditProjector.of(space, shapes, 1)
    near(edit.A, space.dictionary(shapes.points[1:2].double())[0].detach())
    near(edit.x, shapes.points[1])
    assert edit.handles.names == BoxHandles.of(shapes, 1).names
    assert not edit.A.requires_grad


def test_a_network_in_single_precision_says_what_it_says_in_double():
    shapes = shapes_of("chair/four_legs", 2, 300)
    found = []
    for space in (deform_sync_net(), deform_sync_net().float()):
        edit = EditProjector.of(space, shapes)
        found.append([edit({name: 0.05}, change=True) for name in edit.handles.names])
    for double, single in zip(*found, strict=True):
        assert single.points.isfinite().all()
        assert (double.z_hat - single.z_hat).abs().max() < 1e-4
        assert (double.points - single.points).abs().max() < 1e-4


def test_a_basis_says_which_vectors_are_plausible():
    A, handles, basis = randn(0, 9, 3, 6), DenseHandles(randn(1, 9, 3, 4)), randn(2, 6, 2)
    edit, small = (
        EditProjector(A, handles, randn(3, 9, 3), Prior(basis)),
        EditProjector(A @ basis, handles, randn(3, 9, 3)),
    )
    found, expected = edit({"handle_2": 0.5}), small({"handle_2": 0.5})
    near(found.z_hat, expected.z_hat)
    near(found.v, basis @ expected.v)
    near(found.points, edit.x + A @ found.v)
    near(found.points, expected.points)


def test_noise_adds_what_far_shapes_are_off_to_what_is_minimised():
    """|B dz - A W w|^2 + n noise^2 |w|^2 over the free dz and w, written out."""
    A, B, basis = randn(0, 9, 3, 6), randn(1, 9, 3, 4), randn(2, 6, 2)
    found = EditProjector(A, DenseHandles(B), randn(3, 9, 3), Prior(basis, 0.4))({"handle_2": 0.5}, change=True)
    free, square = [0, 1, 3], 0.4 * 9**0.5 * torch.eye(2).double()
    rows = torch.cat([B[..., free].flatten(0, 1), -(A @ basis).flatten(0, 1)], dim=1)
    rows = torch.cat([rows, torch.cat([torch.zeros(2, 3).double(), square], dim=1)])
    wanted = torch.cat([-0.5 * B[..., 2].flatten(), torch.zeros(2).double()])
    solved = torch.linalg.lstsq(rows, wanted[:, None]).solution[:, 0]
    near((found.z_hat - found.z0)[free], solved[:3])
    near(found.v, basis @ solved[3:])


def test_without_noise_a_basis_is_all_that_counts():
    A, handles, basis = randn(0, 9, 3, 6), DenseHandles(randn(1, 9, 3, 4)), randn(2, 6, 2)
    plain, quiet = (
        EditProjector(A, handles, randn(3, 9, 3), Prior(basis, noise))({"handle_2": 0.5}) for noise in (0.0, 1e-9)
    )
    near(plain.z_hat, quiet.z_hat)


@pytest.mark.parametrize("noise", [-1.0, float("nan"), float("inf")])
def test_noise_is_a_length(noise):
    prior = Prior(randn(2, 6, 2), noise)
    with pytest.raises(ValueError, match=rf"EditProjector: the prior's noise must be a length, .*, got {noise}; modes"):
        EditProjector(randn(0, 9, 3, 6), DenseHandles(randn(1, 9, 3, 4)), randn(3, 9, 3), prior)


def test_values_are_absolute_unless_they_are_changes():
    handles = DenseHandles(randn(1, 9, 3, 4), torch.tensor([1.0, 2, 3, 4]).double())
    edit = EditProjector(randn(0, 9, 3, 2), handles, randn(2, 9, 3))
    value, change = edit({"handle_1": 2.5}), edit({"handle_1": 0.5}, change=True)
    near(value.z_hat, change.z_hat)
    assert value["handle_1"] == 2.5
    assert str(value).startswith("Snapped(handle_1 = 2.5; the snap went ")
    with pytest.raises(ValueError, match=r"snapped: there is no handle 'handle_9'; did you mean handle_3, handle_2"):
        value["handle_9"]
    near(value.edited, edit.x + 0.5 * handles.B[..., 1])


def test_patterns_pin_many_and_the_later_counts():
    handles = DenseHandles(randn(1, 9, 3, 3), names=("leg_1.y", "leg_2.y", "top[0].y"))
    edit = EditProjector(randn(0, 9, 3, 2), handles, randn(2, 9, 3))
    snapped = edit({"leg_*": 0.5, "leg_2.y": 0.25, "top[0].y": 1})
    assert snapped.z_hat.tolist() == [0.5, 0.25, 1]


def test_points_of_no_part_count_for_nothing_but_move_along():
    shapes = shapes_of("chair/four_legs", 1, 200, dtype="float64")
    labels, A = shapes.labels[0].clone(), randn(0, 200, 3, 4)
    labels[:50] = -1
    handles = BoxHandles(labels, shapes.rest[0], shapes.boxes[0], shapes.part_names)
    edit = EditProjector(A, handles, shapes.points[0])
    held = EditProjector(A[50:], handles.at(labels[50:], shapes.rest[0, 50:]), shapes.points[0, 50:])
    ours, theirs = edit({handles.names[1]: 0.1}, change=True), held({handles.names[1]: 0.1}, change=True)
    near(ours.z_hat, theirs.z_hat)
    near(ours.points[50:], theirs.points)
    near(ours.points[:50], edit.x[:50] + A[:50] @ ours.v)
    assert ours.residual == pytest.approx(theirs.residual)


EDITS = {
    "an unknown name": ({"leg_9.scale.y": 1}, r"edit: there is no handle 'leg_9.scale.y'; did you mean leg_2.scale.y,"),
    "a name of nothing": ({"": 1}, r"edit: there is no handle ''; did you mean leg_1.scale.y, leg_2.scale.y, top.x\?"),
    "no pin": ({}, r"edit: it must be a dictionary of handles .*, got {}; write {'leg_1.scale.y': 0.2}"),
    "a list": ([("top.x", 1)], r"edit: it must be a dictionary of handles .*, got \[\('top.x', 1\)\]; write"),
    "NaN": ({"top.x": np.nan}, r"edit: top.x must be a finite number, got nan; give its value in units of the shape"),
    "NaN beside a number": ({"leg_1.scale.y": 1, "top.x": np.nan}, r"edit: top.x must be a finite number, got nan;"),
    "infinity": ({"top.*": np.inf}, r"edit: top.\* must be a finite number, got inf;"),
    "no number": ({"top.x": None}, r"edit: top.x must be a finite number, got None;"),
}


@pytest.mark.parametrize("which", EDITS)
def test_wrong_edits_are_refused(which):
    names, z0 = ("leg_1.scale.y", "leg_2.scale.y", "top.x"), torch.tensor([0.2, 0.2, 0]).double()
    edit = EditProjector(randn(0, 9, 3, 2), DenseHandles(randn(1, 9, 3, 3), z0, names))
    edits, said = EDITS[which]
    with pytest.raises(ValueError, match=f"^{said}"):
        unchecked(EditProjector.__call__)(edit, edits)


PROJECTORS = {
    "other points": ((8, 3, 2), (9, 3), None, r"A must be \(n, 3, k\), .* the n = 9 points .*, got \(8, 3, 2\); take"),
    "a flat A": ((27, 2), (9, 3), None, r"A must be \(n, 3, k\), .*, got \(27, 2\); take the dictionary"),
    "other x": ((9, 3, 2), (8, 3), None, r"x must be the 9 points \(n, 3\) of the handles, finite, got \(8, 3\)"),
    "no x": ((9, 3, 2), None, None, r"x must be given where handles alone do not place all points, got none; pass x"),
    "another basis": (
        (9, 3, 2),
        (9, 3),
        (3, 2),
        r"the prior's basis must be \(k, r\), .* the k = 2 .*, got \(3, 2\); transpose it",
    ),
}


@pytest.mark.parametrize("which", PROJECTORS)
def test_what_does_not_belong_together_is_refused(which):
    A, x, basis, said = PROJECTORS[which]
    given = [None if shape is None else randn(0, *shape) for shape in (x, basis)]
    given[1] = None if basis is None else Prior(given[1])
    with pytest.raises(ValueError, match=f"EditProjector: {said}"):
        unchecked(EditProjector.__init__)(
            object.__new__(EditProjector), randn(0, *A), DenseHandles(randn(1, 9, 3, 4)), *given
        )


def test_a_space_without_a_dictionary_is_refused_and_shapes_without_parts():
    shapes = shapes_of(points=7)
    with pytest.raises(
        ValueError, match=r"must have a dictionary of offsets, AutoencoderSpace has none; take a Deform"
    ):
        EditProjector.of(autoencoder(), shapes)
    with pytest.raises(
        ValueError, match=r"BoxHandles: shapes must have labels, rest and boxes, .* take shapes of data"
    ):
        EditProjector.of(linear_space(), Shapes(points=shapes.points.double()))
