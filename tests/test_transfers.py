"""Transfers against the truth: the triplets that data_gen draws, and what is measured of them."""

from dataclasses import replace

import numpy as np
import pytest
import torch

import data_gen
from data_gen.__main__ import main
from dsn_lite import DoNothing, LinearSpace, as_shapes, load_shapes, transfers
from dsn_lite.space import ActionSpace

ROLES = 4


def drawn(family="table", count=34, **told):
    return data_gen.transfers(family, count=count, points=24, seed=3, **{"dtype": "float64", **told})


def quarters(made):
    count = made.about["transfers"]
    return [made[role * count : (role + 1) * count] for role in range(ROLES)]


class Oracle(ActionSpace):
    """Moves z to the truth, `share` of the way."""

    def __init__(self, truth, share=1.0):
        super().__init__()
        self.truth, self.share = truth, share

    def vector(self, x, y):
        return x.new_zeros(len(x), 1)

    def act(self, x, v):
        return x + self.share * (self.truth - x)


@pytest.mark.parametrize("family", ["table", "chair", "lamp", "carton/two_flaps"])
@pytest.mark.parametrize("single", [False, True])
def test_the_truth_is_that_of_true_transfer(family, single):
    x, y, z, truth = quarters(drawn(family, single=single))
    np.testing.assert_allclose(truth.points, data_gen.true_transfer(x, y, z), atol=1e-9)
    np.testing.assert_array_equal(truth.weights, z.weights)
    np.testing.assert_array_equal(truth.labels, z.labels)


def test_across_families_only_what_both_have_changes():
    x, y, z, truth = quarters(drawn(across=True))
    np.testing.assert_allclose(truth.points, data_gen.true_transfer(x, y, z), atol=1e-9)
    for i in range(len(z)):
        assert x.family(i) == y.family(i) != z.family(i) == truth.family(i)
        changed = {
            n for n, a, b in zip(x.parameter_names, x.parameters[i], y.parameters[i], strict=True) if a < b or b < a
        }
        assert changed
        assert changed <= set(data_gen.family(z.family(i)).parameter_names)


def test_one_parameter_changes_if_asked():
    x, y, _, _ = quarters(drawn(across=True, single=True))
    assert set((np.nan_to_num(x.parameters) != np.nan_to_num(y.parameters)).sum(1)) == {1}


def test_families_take_turns_and_seeds_differ():
    made = drawn()
    z = quarters(made)[2]
    assert [z.family(i) for i in range(17)] == list(data_gen.families("table"))
    np.testing.assert_array_equal(made.points, drawn().points)
    other = data_gen.transfers("table", count=34, points=24, seed=4, dtype="float64")
    assert not np.allclose(made.points[:3], other.points[:3])


@pytest.mark.parametrize(
    ("told", "sentence"),
    [
        ({"count": 0}, "transfers: count must be whole and >= 1, got 0; ask for more"),
        ({"dtype": "int8"}, "transfers: dtype must be float32 or float64, got 'int8'; files hold float32"),
        (
            {"family": "table/shelf", "across": True},
            "transfers: table/shelf must share a parameter with another family of its category, got none",
        ),
    ],
)
def test_what_cannot_be_drawn_is_refused(told, sentence):
    with pytest.raises(ValueError, match=sentence):
        drawn(**told)


def test_the_command_writes_what_the_function_gives(tmp_path):
    out = tmp_path / "a.npz"
    told = ["--count", "4", "--points", "24", "--seed", "3", "--across", "--out", str(out)]
    assert main(["transfers", "sofa", *told]) == 0
    np.testing.assert_array_equal(load_shapes(out).points, drawn("sofa", 4, across=True, dtype="float32").points)
    assert len(transfers.Triplets.of(load_shapes(out)).truth) == 4


def test_other_files_hold_no_triplets():
    shapes = as_shapes(drawn(count=2))
    for wrong in (shapes[:3], replace(shapes, about={})):
        with pytest.raises(ValueError, match=r"Triplets: the file must hold x, y, z and truth of .* transfers, got"):
            transfers.Triplets.of(wrong)


def test_errors_are_shares_of_doing_nothing():
    triplets = transfers.Triplets.of(as_shapes(drawn(across=True, count=20, dtype="float32")), points=16)
    idle, _ = transfers.errors(DoNothing(), triplets)
    assert idle.share == 1
    assert set(idle.by_family) == set(data_gen.families("table"))
    right, _ = transfers.errors(Oracle(triplets.truth.points), triplets)
    assert right.share < 1e-12
    half, _ = transfers.errors(Oracle(triplets.truth.points, 0.5), triplets)
    assert half.share == pytest.approx(0.25, rel=1e-5)
    assert set(np.round(list(half.by_family.values()), 5)) == {0.25}


def test_families_are_summed_and_not_averaged():
    found = transfers.Errors(torch.tensor([1.0, 0.0, 2.0]), torch.tensor([1.0, 3.0, 2.0]), ("a", "a", "b"))
    assert found.by_family == {"a": 0.25, "b": 1.0}
    assert found.share == 0.5


class Bent(LinearSpace):
    """A dictionary that changes with the shape, by `bend` times its first coordinate."""

    bend = 0.0

    def act(self, x, v):
        return x + (1 + self.bend * x[..., :1, :1]) * (super().act(x, v) - x)


def test_one_dictionary_goes_there_and_back_and_a_bent_one_does_not():
    A = torch.randn(8, 3, 2, generator=torch.Generator().manual_seed(0), dtype=torch.float64)
    x, v = torch.ones(4, 8, 3, dtype=torch.float64), torch.ones(4, 2, dtype=torch.float64)
    space = Bent(A)
    y = space.act(x, v)
    assert transfers.round_trip(space, x, v) < 1e-25
    assert transfers.two_way(space, x, y) < 1e-25
    space.bend = 0.5
    factor = 1.5, 1 + 0.5 * (1 + 1.5 * (y - x)[0, 0, 0].item())
    expected = (1 - factor[1] / factor[0]) ** 2
    assert transfers.round_trip(space, x, v) == pytest.approx(expected, rel=1e-9)
    assert transfers.two_way(space, x, y) > 1e-4


def test_pins_of_a_part_hold_the_others_if_asked():
    names = ("seat.scale.x", "arm_left.translation.y", "arm_left.scale.y", "arm_right.translation.y")
    change = {"translation.y": 0.1}
    free = {"arm_left.translation.y": 0.1, "arm_right.translation.y": 0.1}
    assert transfers.pins_of_part(names, "arm", change, hold=False) == free
    assert transfers.pins_of_part(names, "arm", change, hold=True) == {"seat.scale.x": 0.0} | free


class Knowing(LinearSpace):
    """A dictionary of one column that moves points of the left half, and is `echo` times as long where x is empty."""

    echo = 0.25

    def __init__(self, lacking):
        super().__init__(torch.ones(24, 3, 1))
        self.lacking = lacking

    def dictionary(self, x):
        without = torch.stack([(each == self.lacking).all((1, 2)).any() for each in x.unsqueeze(1)])
        return torch.where(without, self.echo, 1.0)[:, None, None, None] * self.A.expand(*x.shape, 1)


def test_an_echo_is_the_motion_of_shapes_without_the_part():
    shapes = as_shapes(data_gen.generate(("table/four_legs", "table/shelf"), count=12, points=24, seed=1))
    has = shapes.boxes[:, shapes.part_names.index("shelf")].isfinite().all(1)
    assert 1 < has.sum() < 12
    space = Knowing(shapes.points[~has])
    for echo in transfers.echoes(space, shapes, "shelf", {"translation.y": 0.1}, 2).values():
        assert echo.plain == pytest.approx(0.25, rel=1e-4)
        assert 0 < echo.projected <= 0.3


def test_an_echo_needs_shapes_with_and_without():
    shapes = as_shapes(data_gen.generate("table/shelf", count=3, points=24))
    with pytest.raises(
        ValueError, match=r"echoes: some shapes must have a shelf and others not, got 3 of 3; mix families"
    ):
        transfers.echoes(DoNothing(), shapes, "shelf", {"translation.y": 0.1}, 2)
