from itertools import product

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from problems import dense, made, pins, problems
from scipy.optimize import minimize
from worlds import randn, shapes_of, unchecked

from dsn_lite.handles import BoxHandles, DenseHandles
from dsn_lite.projection import EditProjector

NAMES = ("leg_1.scale.y", "leg_2.scale.y", "leg_3.scale.y", "top.x")


def unmade(edit):
    """(I - AA+)B: |unmade @ z|^2 is what Eq. 4 minimises."""
    A, B = dense(edit)
    return B - A @ (np.linalg.pinv(A, rcond=1e-12) @ B)


def ends(edit, pinned, seed, size):
    """Bounds of all free handles, some open, some closed on both sides, some that leave out no change at all."""
    rng, m = np.random.default_rng(seed), len(pinned)
    low, high = np.sort(size * rng.standard_normal((2, m)), axis=0)
    low, high = np.where(rng.random(m) < 0.3, -np.inf, low), np.where(rng.random(m) < 0.3, np.inf, high)
    return {edit.handles.names[j]: (low[j], high[j]) for j in np.flatnonzero(~pinned)}


def by_all_active_sets(P, c, bounds):
    """The least |P x + c|^2 within bounds, trying for every number: at the lower end, at the upper, or free."""
    best = np.inf
    for where in product((0, 1, None), repeat=len(bounds)):
        x = np.array([0.0 if at is None else ends[at] for at, ends in zip(where, bounds, strict=True)])
        free = np.array([at is None for at in where], dtype=bool)
        if np.isfinite(x).all():
            x[free] = np.linalg.lstsq(P[:, free], -c - P[:, ~free] @ x[~free], rcond=1e-12)[0]
            if all(low - 1e-9 <= value <= high + 1e-9 for value, (low, high) in zip(x, bounds, strict=True)):
                best = min(best, ((P @ x + c) ** 2).sum())
    return best


@given(problems(kinds=("plain", "twin columns")), st.integers(0, 999), st.sampled_from([0.1, 1.0]))
def test_bounded_edits_are_as_good_as_the_best_of_all_active_sets(problem, seed, size):
    problem |= {"sizes": (*problem["sizes"][:2], min(problem["sizes"][2], 6))}
    edit, pinned, z = made(problem | {"pins": min(problem["pins"], problem["sizes"][2])})
    bounds, P = ends(edit, pinned, seed, size), unmade(edit)
    found = edit(pins(edit, pinned, z), change=True, bounds=bounds).z_hat.numpy()
    assert all(
        low - 1e-12 <= found[edit.handles.names.index(name)] <= high + 1e-12 for name, (low, high) in bounds.items()
    )
    best = by_all_active_sets(P[:, ~pinned], P[:, pinned] @ z, list(bounds.values()))
    size = np.linalg.norm(P, 2) ** 2 * (found**2).sum()
    assert abs(((P @ found) ** 2).sum() - best) < 1e-8 * max(best, 1e-3 * size)
    np.testing.assert_allclose(found[pinned], z, atol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_bounded_edits_of_many_handles_are_as_good_as_a_quasi_newton_solver_finds(seed):
    edit = EditProjector(randn(seed, 60, 3, 20), DenseHandles(randn(seed + 9, 60, 3, 40)), randn(seed, 60, 3))
    pinned = np.arange(40) % 8 == 0
    z, P = randn(seed + 1, 5).numpy(), unmade(edit)
    bounds, free, c = ends(edit, pinned, seed, 0.05), P[:, ~pinned], P[:, pinned] @ z
    told = {"ftol": 1e-16, "gtol": 1e-12, "maxiter": 5000, "maxfun": 50000}
    other = minimize(
        lambda x: (((free @ x + c) ** 2).sum(), 2 * free.T @ (free @ x + c)),
        np.zeros(35),
        jac=True,
        method="L-BFGS-B",
        bounds=list(bounds.values()),
        options=told,
    )
    snapped = edit(pins(edit, pinned, z), change=True, bounds=bounds)
    assert ((P @ snapped.z_hat.numpy()) ** 2).sum() == pytest.approx(other.fun, rel=1e-8)
    assert len(snapped.at_bounds) > 10


@given(problems(kinds=("all in span", "twin handles", "full A", "some in span")), st.integers(0, 99))
def test_bounded_edits_that_leave_a_choice_obey_the_conditions_of_the_best(problem, seed):
    edit, pinned, z = made(problem)
    bounds, P = ends(edit, pinned, seed, 1.0), unmade(edit)
    snapped = edit(pins(edit, pinned, z), change=True, bounds=bounds)
    found, size = snapped.z_hat.numpy(), np.linalg.norm(list(dense(edit))[1], 2)
    slope = P.T @ (P @ found) / size**2
    for name, (low, high) in bounds.items():
        j = edit.handles.names.index(name)
        assert low - 1e-12 <= found[j] <= high + 1e-12
        if found[j] < high - 1e-9:
            assert slope[j] > -1e-7
        if found[j] > low + 1e-9:
            assert slope[j] < 1e-7
    assert np.abs(found).max() < 1e4


def table(**told):
    """Three legs that a plausible change stretches alike, and a top that goes up with them; x is 5 all over."""
    B, z0 = torch.eye(12).double()[:, :4].view(4, 3, 4), torch.tensor([0.2, 0.3, 0.4, 1.0], dtype=torch.float64)
    A = (B @ torch.tensor([1.0, 1, 1, 2]).double())[..., None]
    return EditProjector(A, DenseHandles(B, z0, NAMES, **told), torch.full((4, 3), 5.0).double())


def test_without_bounds_all_legs_follow():
    snapped = table()({"leg_1.scale.y": 0.1})
    assert snapped.z_hat.tolist() == pytest.approx([0.1, 0.2, 0.3, 0.8])
    assert snapped.v.tolist() == pytest.approx([-0.1])
    assert snapped.residual < 1e-12


def test_bounds_that_are_not_met_change_nothing():
    free = table()({"leg_1.scale.y": 0.1})
    wide = table()(
        {"leg_1.scale.y": 0.1}, bounds={"*": (-9.0, 9.0), "leg_2.scale.y": (0.1, None), "top.x": (None, 2.0)}
    )
    torch.testing.assert_close(wide.z_hat, free.z_hat, rtol=0, atol=0)
    assert wide.at_bounds == ()


def test_a_bound_that_is_met_holds_and_is_named():
    snapped = table()({"leg_1.scale.y": 0.1}, bounds={"leg_2.scale.y": (0.25, None)})
    assert snapped["leg_2.scale.y"] == 0.25
    assert snapped.at_bounds == ("leg_2.scale.y",)
    t = -0.1 * 1 - 0.05  # changes 1, 1, 1, 2 of v; legs 1 and 2 are held at -0.1 and -0.05: v is their mean
    assert snapped.v.item() == pytest.approx(t / 2)
    assert snapped.z_hat.tolist()[2:] == pytest.approx([0.4 + t / 2, 1 + t])
    assert "held at a bound: leg_2.scale.y" in repr(snapped)


def test_bounds_by_pattern_are_tightened_by_later_ones_and_by_those_of_the_handles():
    edit = table(lower=torch.tensor([0.0, 0, 0.35, -9], dtype=torch.float64))
    snapped = edit({"top.x": 0.0}, bounds={"leg_*": (0.01, None), "leg_2*": (0.15, None)})
    assert [snapped[name] for name in NAMES[:3]] == pytest.approx([0.01, 0.15, 0.35], abs=1e-12)
    assert snapped.at_bounds == NAMES[:3]


def test_a_bound_can_move_what_no_pin_does():
    snapped = table()({"leg_1.scale.y": 0.0}, change=True, bounds={"top.x": (1.2, 1.3)})
    assert snapped["top.x"] == pytest.approx(1.2, abs=1e-12)
    assert snapped["leg_2.scale.y"] > 0.3


def test_a_handle_may_have_one_value_only():
    snapped = table()({"leg_1.scale.y": 0.1}, bounds={"top.x": (1.0, 1.0), "leg_3.scale.y": (0.4, 0.4)})
    assert snapped["top.x"] == pytest.approx(1, abs=1e-12)
    assert snapped["leg_3.scale.y"] == pytest.approx(0.4, abs=1e-12)
    assert snapped.at_bounds == ("leg_3.scale.y", "top.x")
    fixed = table()({"leg_1.scale.y": 0.1}, bounds={name: (0.3, 0.3) for name in NAMES[1:]})
    assert fixed.z_hat.tolist() == pytest.approx([0.1, 0.3, 0.3, 0.3])


@pytest.mark.parametrize("change", [False, True])
def test_a_handle_may_be_pinned_at_its_bound(change):
    value = 0.7 - 0.2 if change else 0.7
    snapped = table()({"leg_1.scale.y": value}, change=change, bounds={"leg_1.scale.y": (0.7, 0.7)})
    assert snapped["leg_1.scale.y"] == pytest.approx(0.7, abs=1e-12)
    assert snapped.at_bounds == ()


def test_edges_stay_longer_than_nothing():
    shapes = shapes_of("table/four_legs", 1, 300, dtype="float64")
    handles = BoxHandles.of(shapes)
    edit = EditProjector(randn(0, 300, 3, 6), handles, shapes.points[0])
    snapped = edit({"*.translation.y": -40.0}, change=True)
    edges = [value for name, value in zip(snapped.names, snapped.z_hat.tolist(), strict=True) if ".scale." in name]
    assert min(edges) > 0
    assert all(".scale." in name for name in snapped.at_bounds)
    with pytest.raises(ValueError, match=r"got leg_1.scale.y between .* and inf and pinned at -0.1; loosen one"):
        edit({"leg_1.scale.y": -0.1})


REFUSED = {
    "crossed": ({"top.x": (2, 1)}, r"some value must lie within all bounds, got top.x between 2 and 1; loosen one"),
    "several": ({"leg_*": (2, 1)}, r".* got leg_1.* between 2 and 1 and pinned at 0.1; leg_2.* and 1; leg_3.* and 1;"),
    "pinned outside": (
        {"*.scale.y": (0.15, None)},
        r".* got leg_1.scale.y between 0.15 and inf and pinned at 0.1; loos",
    ),
    "patterns apart": ({"leg_2*": (3, None), "*y": (0, 2)}, r".* got leg_2.scale.y between 3 and 2; loosen one"),
    "no handle": ({"leg_4.scale.y": (0, 1)}, r"there is no handle 'leg_4.scale.y'; did you mean leg_3.scale.y"),
    "NaN": ({"top.x": (np.nan, 1)}, r"top.x must be a finite number, got nan; give its value in units of the shape"),
    "one number": ({"top.x": 1}, r"they must be a dictionary of handles and pairs .*, got {'top.x': 1}; write {'leg_"),
    "three": ({"top.x": (1, 2, 3)}, r"they must be a dictionary of handles and pairs"),
    "a list": ([("top.x", (1, 2))], r"they must be a dictionary of handles and pairs"),
}


@pytest.mark.parametrize("which", REFUSED)
def test_what_nothing_keeps_is_refused_with_all_names(which):
    bounds, said = REFUSED[which]
    with pytest.raises(ValueError, match=f"^bounds: {said}"):
        unchecked(EditProjector.__call__)(table(), {"leg_1.scale.y": 0.1}, bounds=bounds)
