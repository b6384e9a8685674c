"""The exported factor: all that a browser needs, and no more than it can do."""

import json

import numpy as np
import pytest
import torch
from hypothesis import given
from problems import dense, made, problems
from worlds import deform_sync_net, randn, shapes_of

from dsn_lite.handles import DenseHandles
from dsn_lite.projection import EditProjector, Factor, Prior


def least(matrix, wanted, smallest):
    """The shortest x with matrix @ x nearest to wanted, without singular values below `smallest`."""
    U, s, Vt = np.linalg.svd(matrix, full_matrices=False)
    return (Vt.T * np.where(s > smallest, 1 / np.where(s > smallest, s, 1), 0)) @ (U.T @ wanted)


def in_a_browser(text, pinned, z):
    """What a page does with the exported text: changes of all handles, v, and how much is left (rms)."""
    known = json.loads(text, parse_constant=pytest.fail)
    R, k, noise = np.array(known["R"]), known["k"], known["noise"]
    A, B, m = R[:, :k], R[:, k:], R.shape[1] - k
    make = least(A, B, noise * np.linalg.norm(A, 2))
    P, size = B - A @ make, np.linalg.norm(B, 2)
    dz = np.zeros(m)
    dz[pinned] = z
    dz[~pinned] = least(P[:, ~pinned], -P[:, pinned] @ z, noise * size)
    v = make @ dz
    return (
        dz,
        v if known["basis"] is None else np.array(known["basis"]) @ v,
        (3 * ((P @ dz) ** 2).sum() / known["rows"]) ** 0.5,
    )


@given(problems())
def test_the_factor_alone_solves_any_selection(problem):
    edit, pinned, z = made(problem)
    for selected in (pinned, np.arange(len(pinned)) == 0, np.ones(len(pinned), dtype=bool)):
        value = np.resize(z, selected.sum())
        ours, theirs = edit.drag(selected, value), in_a_browser(edit.to_json(), selected, value)
        for mine, other in zip(ours, theirs, strict=False):
            assert np.abs(mine - other).max() < 1e-8 * max(1, np.abs(mine).max())


def test_a_network_and_its_boxes_in_a_browser():
    shapes, basis = shapes_of("chair/four_legs", 1, 300), randn(0, 3, 2)
    edit = EditProjector.of(deform_sync_net().float(), shapes, prior=Prior(basis))
    pinned = np.array([name == "leg_2.scale.y" for name in edit.handles.names])
    dz, v, left = in_a_browser(edit.to_json(), pinned, np.array([0.1]))
    snapped = edit({"leg_2.scale.y": 0.1}, change=True)
    assert np.abs(snapped.z_hat.numpy() - snapped.z0.numpy() - dz).max() < 1e-9
    assert np.abs(snapped.v.numpy() - v).max() < 1e-9
    assert snapped.residual == pytest.approx(left, rel=1e-3)


def test_what_is_exported_is_read_back_exactly():
    B, z0 = randn(1, 9, 3, 4), randn(2, 4)
    low = torch.tensor([-torch.inf, 0.1, -3, -torch.inf], dtype=torch.float64)
    edit = EditProjector(randn(0, 9, 3, 3) / 3, DenseHandles(B, z0, ("a", "b", "c", "d"), lower=low), randn(3, 9, 3))
    known, back = json.loads(edit.to_json()), Factor.from_json(edit.to_json())
    assert known["names"] == ["a", "b", "c", "d"]
    assert known["z0"] == z0.tolist()
    assert (known["lower"], known["upper"]) == ([None, 0.1, -3, None], [None] * 4)
    assert (known["k"], known["rows"], known["basis"]) == (3, 27, None)
    assert (back.R == edit.factor.R).all()
    assert (back.k, back.rows, back.noise) == (edit.factor.k, edit.factor.rows, edit.factor.noise)
    assert (Factor.from_json(back.to_json()).gain(np.arange(4) == 1) == edit.factor.gain(np.arange(4) == 1)).all()


@given(problems())
def test_the_triangle_measures_what_the_points_do(problem):
    edit, _, _ = made(problem)
    (A, B), R, k = dense(edit), edit.factor.R, edit.factor.k
    v, z = randn(0, k).numpy(), randn(1, B.shape[1]).numpy()
    assert (np.tril(R, -1) == 0).all()
    assert len(R) == min(len(A), k + B.shape[1])
    far = np.linalg.norm(A @ v + B @ z)
    assert np.linalg.norm(R @ np.concatenate([v, z])) == pytest.approx(far, rel=1e-12)


def test_it_keeps_what_a_gram_matrix_loses():
    """Columns that nearly depend on each other: A'A squares their condition, and its answer is off; ours is not."""
    A, B = randn(0, 40, 3, 6).numpy(), randn(1, 40, 3, 5).numpy()
    A[..., 5] = A[..., 0] + 1e-9 * A[..., 5]
    B[..., 4] = B[..., 3] + 1e-7 * B[..., 4]
    C, D = (each.reshape(120, -1) for each in (A, B))
    Q = np.linalg.qr(C)[0]
    P = D - Q @ (Q.T @ D)
    expected = np.linalg.lstsq(P[:, 1:], -P[:, 0], rcond=1e-14)[0]
    ours = Factor.of(A, B).gain(np.arange(5) == 0)[1:, 0]
    gram = -np.linalg.solve(P[:, 1:].T @ P[:, 1:], P[:, 1:].T @ P[:, 0])
    assert np.abs(ours - expected).max() < 1e-6 * np.abs(expected).max()
    assert np.abs(gram - expected).max() > 1e-4 * np.abs(expected).max()


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
def test_noise_is_that_of_the_numbers(dtype):
    edit = EditProjector(randn(0, 400, 3, 2, dtype=dtype), DenseHandles(randn(1, 400, 3, 2)), randn(2, 400, 3))
    assert edit.factor.noise == {torch.float32: 1200**0.5 * 2**-23, torch.float64: 1200 * 2**-52}[dtype]
