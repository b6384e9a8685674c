"""What a rig says about its shapes is true: points, handles, Jacobian, transfers, and its refusals."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import data_gen
from data_gen import draw
from data_gen.rig import Contact, Parameter, Rig

EXACT = 1e-12
SEEDS = st.integers(0, 2**32 - 1)
FAMILIES = pytest.mark.parametrize("name", data_gen.families())


def drawn(name, seed, count=4, points=50):
    """A rig, random parameters of it, and shared samples."""
    rig = data_gen.family(name)
    parameters = rig.draw(count, np.random.default_rng(seed))
    return rig, parameters, *draw.shared(rig, points, np.random.SeedSequence(seed))


@FAMILIES
@given(seed=SEEDS, points=st.integers(2, 200))
def test_handle_matrix_times_handles_gives_the_points(name, seed, points):
    rig, parameters, labels, rest = drawn(name, seed, points=points)
    B, z = rig.handle_matrix(labels, rest), rig.handles(parameters)
    np.testing.assert_allclose(rig.place(labels, rest, parameters), np.einsum("pim,nm->npi", B, z), atol=EXACT)


@FAMILIES
@given(seed=SEEDS)
def test_a_change_of_parameters_moves_points_by_the_jacobian(name, seed):
    rig, parameters, labels, rest = drawn(name, seed)
    moved = rig.place(labels, rest, parameters[1:]) - rig.place(labels, rest, parameters[:-1])
    truth = np.einsum("pim,mk,nk->npi", rig.handle_matrix(labels, rest), rig.jacobian, np.diff(parameters, axis=0))
    np.testing.assert_allclose(moved, truth, atol=EXACT)
    assert np.abs(moved).max() > 1e-6


def test_the_jacobian_of_a_rig_that_is_not_linear_is_found_out():
    bent = Rig("bent", data_gen.family("box/one").parameters, lambda p: _bent(p), (("body", "body"),))
    labels, rest = np.zeros(3, np.int16), np.full((3, 3), 0.5)
    p = bent.draw(2, np.random.default_rng(0))
    moved = bent.place(labels, rest, p[1:]) - bent.place(labels, rest, p[:1])
    truth = bent.handle_matrix(labels, rest) @ bent.jacobian @ (p[1] - p[0])
    assert np.abs(moved - truth).max() > 1e-3


def _bent(p):
    (body,) = data_gen.family("box/one").build(p)
    return (type(body)("body", body.centre, (p.width**2, p.height, p.depth)),)


@FAMILIES
@given(seed=SEEDS)
def test_placing_own_samples_equals_a_slow_loop(name, seed):
    rig, parameters, _, _ = drawn(name, seed, count=3)
    labels, rest = draw.fresh(rig, parameters, 20, np.random.SeedSequence(seed))
    boxes = rig.boxes(parameters)
    slow = np.zeros((3, 20, 3))
    for shape in range(3):
        for point in range(20):
            box = boxes[shape, labels[shape, point]]
            slow[shape, point] = box[:3] + box[3:12].reshape(3, 3) @ (box[12:] * rest[shape, point])
    np.testing.assert_allclose(rig.place(labels, rest, parameters), slow, atol=EXACT)


def test_float32_points_are_those_of_float64_rounded():
    rig, parameters, labels, rest = drawn("table/shelf", 3)
    exact, single = (rig.place(labels, rest, parameters, dtype) for dtype in (np.float64, np.float32))
    assert single.dtype == np.float32
    np.testing.assert_allclose(single, exact, atol=1.2e-7)


@FAMILIES
@given(seed=SEEDS)
def test_true_transfer_adds_the_difference_of_the_parameters(name, seed):
    rig, p, labels, rest = drawn(name, seed, count=3)
    p_x, p_z = p[:1], p[1:2]
    p_y = p_x + 0.5 * (rig.middle - p_z)
    p_x, p_y = np.clip(p_x, rig.low, rig.high), np.clip(p_y, rig.low, rig.high)
    x, y, z = (rig.place(labels, rest, q) for q in (p_x, p_y, p_z))
    new = np.clip(p_z + p_y - p_x, rig.low, rig.high)
    np.testing.assert_allclose(rig.true_transfer(labels, rest, p_z, p_x, p_y, clip=True), rig.place(labels, rest, new))
    np.testing.assert_allclose(rig.true_transfer(labels, rest, p_x, p_x, p_y), y, atol=EXACT)
    np.testing.assert_allclose(rig.true_transfer(labels, rest, p_z, p_x, p_x), z, atol=EXACT)
    if np.array_equal(new, p_z + p_y - p_x):
        np.testing.assert_allclose(rig.true_transfer(labels, rest, p_z, p_x, p_y), z + y - x, atol=EXACT)


def test_true_transfer_out_of_range_is_refused_by_name_or_clipped():
    rig, _, labels, rest = drawn("box/one", 0)
    low, high = rig.low[None], rig.high[None]
    with pytest.raises(ValueError, match=r"true_transfer: width of box/one must be in \[0.3, 1\], got 1.7 in row 0"):
        rig.true_transfer(labels, rest, high, low, high)
    clipped = rig.true_transfer(labels, rest, high, low, high, clip=True)
    np.testing.assert_array_equal(clipped, rig.place(labels, rest, high))


@pytest.mark.parametrize("value", [0.2999, 1.0001, np.nan])
def test_parameters_out_of_range_are_refused_by_name_and_range(value):
    rig, parameters, labels, rest = drawn("box/one", 0)
    parameters[2, 1] = value
    with pytest.raises(ValueError, match=r"place: height of box/one must be in \[0.3, 1\], got .* in row 2; keep it"):
        rig.place(labels, rest, parameters)
    with pytest.raises(ValueError, match=r"boxes: height of box/one must be in"):
        rig.boxes(parameters)


def test_ends_of_ranges_survive_float32():
    rig = data_gen.family("table/four_legs")
    ends = np.stack([rig.low, rig.high]).astype(np.float32)
    assert np.isfinite(rig.boxes(ends)).all()


def test_misshapen_parameters_are_refused():
    rig = data_gen.family("box/one")
    with pytest.raises(ValueError, match=r"boxes: box/one takes parameters \(N, 3\), width, height, depth, got \(3,\)"):
        rig.boxes(rig.middle[0])


@pytest.mark.parametrize("label", [-1, 1])
def test_labels_that_are_no_part_are_refused(label):
    rig = data_gen.family("box/one")
    with pytest.raises(ValueError, match=r"place: labels of box/one must be 0 to 0, got .*; drop the points"):
        rig.place(np.array([0, label]), np.zeros((2, 3)), rig.middle)


def test_gaps_and_asymmetries_see_parts_that_do_not_fit():
    table = data_gen.family("table/four_legs")
    contacts = (Contact("leg_1", "top", "face_y"), Contact("leg_1", "top", "face_x"))
    wrong = Rig("wrong", table.parameters, table.build, (("leg_1", "leg_2"), ("leg_1", "leg_3")), contacts)
    (fits, overlaps), (mirrored, other) = wrong.gaps(table.middle)[0], wrong.asymmetries(table.middle)[0]
    assert abs(fits) < EXACT
    assert overlaps < -0.1
    assert mirrored < EXACT
    assert other > 0.1


def test_parameters_are_uniform_in_their_ranges_and_exact_in_float32():
    rig = Rig("two", (Parameter("a", -1.0, 1.0, ""), Parameter("b", 0.1, 0.2, "")), lambda p: (), ())
    drawn = rig.draw(4000, np.random.default_rng(0))
    np.testing.assert_array_equal(drawn, drawn.astype(np.float32))
    quarters = np.floor((drawn - rig.low) / (rig.high - rig.low) * 4).astype(int)
    for column in quarters.T:
        assert np.abs(np.bincount(column, minlength=4)[:4] - 1000).max() < 5 * np.sqrt(1000)
    assert abs(np.corrcoef(drawn.T)[0, 1]) < 0.08
