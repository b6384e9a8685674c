import pytest
import torch
from worlds import near, randn, unchecked

from dsn_lite.chamfer import chamfer, plant
from dsn_lite.dictionary import column_scales
from dsn_lite.handles import BatchHandles
from dsn_lite.losses import (
    AXES,
    fitting,
    handle_dictionary,
    mirror,
    seen_dictionary,
    sparsity_l1,
    sparsity_l21,
    symmetry,
)


def test_fitting_is_the_mean_chamfer_over_the_batch():
    x, y = randn(0, 3, 8, 3), randn(1, 3, 6, 3)
    near(fitting(x, y), sum(chamfer(x[i], y[i]) for i in range(3)) / 3)
    near(fitting(x, y, plant(y)), fitting(x, y))


@pytest.mark.parametrize(("axis", "index"), [("x", 0), ("y", 1), ("z", 2)])
def test_mirror_flips_one_coordinate(axis, index):
    x = randn(0, 2, 5, 3)
    flipped = mirror(x, axis)
    assert torch.equal(flipped[..., index], -x[..., index])
    assert torch.equal(mirror(flipped, axis), x)
    assert int((flipped != x).any(0).any(0).sum()) == 1


def test_symmetry_is_zero_for_a_mirrored_pair_and_only_along_its_axis():
    half = randn(0, 2, 5, 3)
    whole = torch.cat([half, mirror(half, "x")], dim=-2)
    assert symmetry(whole).item() == 0
    assert symmetry(whole, "y").item() > 1e-2
    near(symmetry(half), chamfer(half, half * torch.tensor([-1.0, 1, 1]).double()).mean())


def test_sparsity_by_loops():
    M = randn(0, 2, 5, 3)
    columns = [M[b, :, j] for b in range(2) for j in range(3)]
    near(sparsity_l1(M), sum(sum(abs(value) for value in column) for column in columns) / 2 / 3)
    near(sparsity_l21(M), sum(sum(value**2 for value in column) ** 0.5 for column in columns) / 2 / 3)


def test_sparsity_does_not_see_padded_handles():
    M = randn(0, 2, 5, 3)
    padded = torch.cat([M, torch.zeros(2, 4, 3).double()], dim=-2)
    near(sparsity_l1(padded), sparsity_l1(M))
    near(sparsity_l21(padded), sparsity_l21(M))


def test_a_zero_column_gives_no_nan():
    M = randn(0, 2, 5, 3)
    M[..., 1] = 0
    M.requires_grad_()
    (sparsity_l1(M) + sparsity_l21(M)).backward()
    assert M.grad.isfinite().all()


def test_l21_is_gradchecked():
    assert torch.autograd.gradcheck(sparsity_l21, randn(0, 2, 4, 3).requires_grad_())


def test_mirror_refuses_another_axis():
    with pytest.raises(ValueError, match='mirror: axis must be "x", "y" or "z", got \'w\''):
        unchecked(mirror)(randn(0, 4, 3), "w")


def test_a_column_cannot_hide_from_the_handles():
    """A ripple that no handle sees makes B+F of a normalised column small, but not where only what is seen counts."""
    rest = torch.linspace(-0.5, 0.5, 100).double()[:, None].expand(1, 100, 3)
    box = torch.tensor([0.0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]).double()
    handles = BatchHandles(torch.zeros(1, 100, dtype=torch.int64), rest, box.expand(1, 1, 15))
    shift = torch.ones(1, 100, 3, 1).double()
    ripple = 20 * torch.cos(2 * torch.pi * (torch.arange(100).double() + 0.5) / 100)[:, None, None].expand(1, 100, 3, 1)
    near(handles.project(ripple), torch.zeros_like(ripple))
    sizes = []
    for A in (shift, shift + ripple):
        whole = handle_dictionary(A / column_scales(A, "rms"), handles)
        sizes.append((whole.abs().sum().item(), seen_dictionary(A, handles).abs().sum().item()))
    assert sizes[1][0] < sizes[0][0] / 10
    assert sizes[1][1] == pytest.approx(sizes[0][1])
    assert sizes[0][0] == pytest.approx(sizes[0][1])


def test_both_directions_of_the_mirrored_distance_are_one_number():
    d = randn(3, 4, 20, 3).requires_grad_()
    for axis in AXES:
        slow = chamfer(d, mirror(d, axis)).mean()
        near(symmetry(d, axis), slow)
        near(symmetry(d, axis, plant(d)), slow)
        near(torch.autograd.grad(symmetry(d, axis), d)[0], torch.autograd.grad(slow, d)[0])


@pytest.mark.parametrize("n", [100, 400])
def test_a_weight_of_sparsity_means_the_same_for_either_kind_of_column_and_at_any_n(n):
    """B+F with columns of length 1 over 3n at n = 2048: here the same fields on more and more points of one box."""
    rest = randn(0, 1, n, 3).clamp(-0.5, 0.5)
    handles = BatchHandles(
        torch.zeros(1, n, dtype=torch.int64),
        rest,
        torch.tensor([[[0.0] * 3 + torch.eye(3).flatten().tolist() + [1.0] * 3]]).double(),
    )
    fields = torch.stack([torch.ones(1, n, 3).double() / 3**0.5, randn(1, 1, n, 3)], dim=-1)
    scaled = {columns: fields / column_scales(fields, columns) for columns in ("rms", "unit")}
    found = {columns: handle_dictionary(A, handles, columns) for columns, A in scaled.items()}
    near(found["rms"], found["unit"])
    near(found["rms"][0, :3, 0], torch.full((3,), (1 / 3 / 2048) ** 0.5).double())
