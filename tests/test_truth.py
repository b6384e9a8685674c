"""True answers about collections, also between families and for shapes that turn."""

from dataclasses import replace

import numpy as np
import pytest

import data_gen

EXACT = 1e-12
MIXED = ("table/four_legs", "table/shelf")


def made(family, count=6, seed=0, **options):
    return data_gen.generate(family, count=count, points=30, seed=seed, dtype="float64", **options)


def values(shapes, i):
    return dict(zip(shapes.parameter_names, shapes.parameters[i], strict=True))


@pytest.mark.parametrize("family", ["table/shelf", "carton/two_flaps"])
@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_a_true_deformation_stands_where_the_target_does(family, sampling):
    shapes = made(family, sampling=sampling)
    x, y = shapes[:3], shapes[3:]
    moved = data_gen.true_deformation(x, y)
    np.testing.assert_allclose(data_gen.true_deformation(x, x), x.points, atol=EXACT)
    if sampling == "shared":
        np.testing.assert_allclose(moved, y.points, atol=EXACT)
    slow = data_gen.family(family).place(x.samples(1), y.parameters[1:2])[0]
    np.testing.assert_allclose(moved[1], slow, atol=EXACT)


def test_a_transfer_goes_by_name_from_one_structure_to_another():
    plain, shelf = made("table/four_legs", 4), made("table/shelf", 2, seed=3)
    x, y, z = plain[:2], plain[2:], shelf
    moved = data_gen.true_transfer(x, y, z, clip=True)
    rig = data_gen.family("table/shelf")
    for i in range(2):
        one, two, wanted = values(x, i), values(y, i), values(z, i)
        for name in one:
            wanted[name] += two[name] - one[name]
        row = np.clip([list(wanted.values())], rig.low, rig.high)
        np.testing.assert_allclose(moved[i], rig.place(z.samples(i), row)[0], atol=EXACT)
        assert wanted["shelf_height"] == values(z, i)["shelf_height"], "what a plain table lacks stays"


def test_a_transfer_out_of_range_is_refused_by_name_row_and_range():
    shapes = made("box/one", 40)
    low, high = (shapes[[int(find(shapes.parameters[:, 0]))]] for find in (np.argmin, np.argmax))
    with pytest.raises(ValueError, match=r"true_transfer: width of box/one must be in \[0.3, 1\], got .* in row 0"):
        data_gen.true_transfer(low, high, high)
    moved = data_gen.true_transfer(low, high, high, clip=True)
    assert np.abs(moved).max() <= 0.5 + EXACT


@pytest.mark.parametrize("family", [MIXED, "carton/two_flaps"])
def test_the_valid_space_is_what_differences_say(family):
    shapes = made(family, 4)
    A, step = data_gen.valid_space(shapes), 1e-6
    assert A.shape == (4, 30, 3, len(shapes.parameter_names))
    for i in range(4):
        rig = data_gen.family(shapes.family(i))
        for name in shapes.parameter_names:
            column = A[i, ..., shapes.parameter_names.index(name)]
            if name not in rig.parameter_names:
                assert not column.any()
                continue
            p = np.array([[values(shapes, i)[own] for own in rig.parameter_names]])
            p = np.clip(p, rig.low + step, rig.high - step)
            change = step * np.eye(p.shape[1])[rig.parameter_names.index(name)]
            high, low = (rig.place(shapes.samples(i), p + sign * change)[0] for sign in (1, -1))
            np.testing.assert_allclose(column, (high - low) / (2 * step), atol=1e-5)


def test_the_valid_space_of_a_linear_family_is_the_same_for_all_its_shapes():
    A = data_gen.valid_space(made("table/shelf", 3, sampling="shared"))
    np.testing.assert_allclose(A[1:], A[:1].repeat(2, 0), atol=EXACT)
    turning = data_gen.valid_space(made("carton/two_flaps", 3, sampling="shared"))
    assert np.abs(turning[1] - turning[0]).max() > 1e-3


def test_truths_of_a_file_are_those_of_the_memory(tmp_path):
    shapes = data_gen.generate("carton/two_flaps", count=6, points=30)
    data_gen.save(shapes, tmp_path / "a.npz")
    read = data_gen.load(tmp_path / "a.npz")
    memory, file = (data_gen.true_transfer(one[:2], one[2:4], one[4:], clip=True) for one in (shapes, read))
    np.testing.assert_array_equal(file, memory)


def test_questions_without_a_true_answer_are_refused():
    table, box = made("table/shelf", 2), made("box/one", 2)
    with pytest.raises(ValueError, match=r"true_deformation: the two shapes of a pair must be of one family, got"):
        data_gen.true_deformation(table, box)
    with pytest.raises(ValueError, match=r"true_transfer: the collections must hold equally many shapes, got 2, 1, 2;"):
        data_gen.true_transfer(table, table[:1], table)
    plain = data_gen.Collection(points=np.zeros((2, 3, 3)))
    with pytest.raises(ValueError, match=r"valid_space: shapes must say their family, parameters and samples, got a"):
        data_gen.valid_space(plain)
    with pytest.raises(
        ValueError, match=r"handles: shapes must have labels, rest coordinates and boxes, got none; make"
    ):
        data_gen.handles(plain, 0)


def test_handles_of_a_mixed_collection_give_the_points():
    shapes = made(MIXED, 5)
    for i in range(5):
        B, z0 = data_gen.handles(shapes, i)
        np.testing.assert_allclose(B @ z0, shapes.points[i], atol=EXACT)
        lacking = np.isnan(shapes.boxes[i, :, 0]).repeat(6)
        assert not B[..., lacking].any()
        assert not z0[lacking].any()


def test_a_transfer_stays_in_one_category():
    table, shelf, box = made("table/four_legs", 2), made("table/shelf", 2), made("box/one", 2)
    for x, y, z in ((table, shelf, box), (box, table, shelf), (table, box, shelf)):
        named = ", ".join(one.family(0) for one in (x, y, z))
        words = rf"true_transfer: x, y and z must be of one category, got {named} in row 0; take families whose names"
        with pytest.raises(ValueError, match=words):
            data_gen.true_transfer(x, y, z, clip=True)
    mixed = made(("table/four_legs", "box/one"), 8)
    row = next(i for i in range(8) if mixed.family(i) == "box/one")
    with pytest.raises(ValueError, match=f"box/one in row {row}; take families"):
        data_gen.true_transfer(made("table/four_legs", 8), made("table/four_legs", 8), mixed, clip=True)


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_points_of_no_part_have_no_handles(sampling):
    shapes = made("table/four_legs", 2, sampling=sampling)
    labels = shapes.labels.copy()
    labels[..., ::3] = -1
    B, z0 = data_gen.handles(replace(shapes, labels=labels), 1)
    whole, same = data_gen.handles(shapes, 1)
    assert not B[::3].any()
    np.testing.assert_array_equal(np.delete(B, slice(None, None, 3), 0), np.delete(whole, slice(None, None, 3), 0))
    np.testing.assert_array_equal(z0, same)


@pytest.mark.parametrize("row", [99, 2, -3])
def test_handles_of_a_shape_that_is_not_there_are_refused(row):
    with pytest.raises(ValueError, match=rf"handles: i must be the row of one of 2 shapes, got {row}; count from 0"):
        data_gen.handles(made("box/one", 2), row)
