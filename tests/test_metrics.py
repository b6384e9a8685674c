from dataclasses import fields

import pytest
import torch
from worlds import randn, shapes_of

import data_gen
from dsn_lite import metrics
from dsn_lite.chamfer import chamfer
from dsn_lite.data import Shapes, triplets, true_transfer
from dsn_lite.files import as_shapes
from dsn_lite.metrics import evaluate, floor, rms, transfer_error
from dsn_lite.space import DoNothing, LinearSpace


def shared(count=30):
    """Corresponding tables, float64."""
    return shapes_of("table/four_legs", count, 64, sampling="shared", dtype="float64")


class Translate(DoNothing):
    """Moves every shape by half of the way between the middles of x and y."""

    def act(self, x, v):
        return x + v.unsqueeze(-2) / 2

    def vector(self, x, y):
        return y.mean(-2) - x.mean(-2)


def test_rms_by_hand():
    u = torch.tensor([[[3.0, 4, 0], [0, 0, 0]]])
    assert rms(u) == pytest.approx(12.5**0.5)


def test_the_floor_is_the_chamfer_distance_of_two_samplings():
    made = data_gen.generate("box/one", count=4, points=64)
    one, two = as_shapes(made), as_shapes(data_gen.resample(made, 1))
    assert floor(one, two) == pytest.approx(
        sum(chamfer(a, b).item() for a, b in zip(one.points, two.points, strict=True)) / 4
    )
    assert floor(one, one) == 0


def test_the_floor_needs_the_same_shapes():
    with pytest.raises(ValueError, match=r"floor: both samplings must be of the same shapes, got 4 and 3; resample"):
        floor(shapes_of(count=4), shapes_of(count=3))


def test_a_perfect_space_fits_transfers_and_moves():
    shapes = shared()
    found = evaluate(LinearSpace.fit(shapes.points, 6), shapes, pairs=40)
    assert max(found.identity, found.transfer_error) < 1e-20
    assert found.fitting_cd < 1e-20 < found.do_nothing_cd
    assert found.parallelogram_cd < 1e-20
    assert found.exact_cd < 1e-20
    assert 0.5 < found.share_moved < 2


def test_doing_nothing_scores_what_it_is_compared_with():
    found = evaluate(DoNothing(), shared(), pairs=40)
    assert found.transfer_error == 1
    assert found.fitting_cd == found.do_nothing_cd > 0
    assert (found.share_moved, found.identity) == (0, 0)


def test_every_number_by_another_way():
    shapes, space = shapes_of("table/four_legs", 30, 64, dtype="float64"), Translate()
    x, y, z = triplets(shapes, 20)
    found = evaluate(space, shapes, pairs=20)
    half = (y.points.mean(1, keepdim=True) - x.points.mean(1, keepdim=True)) / 2
    assert found.fitting_cd == pytest.approx(chamfer(x.points + half, y.points).mean().item())
    other = (z.points.mean(1, keepdim=True) - x.points.mean(1, keepdim=True)) / 2
    assert found.parallelogram_cd == pytest.approx(chamfer(z.points + half, y.points + other).mean().item())
    assert found.share_moved == pytest.approx(1)
    a, b, c = triplets(shapes, 20, with_truth=True)
    half = (b.points.mean(1, keepdim=True) - a.points.mean(1, keepdim=True)) / 2
    wrong = (c.points + half - true_transfer(a, b, c)).square().sum() / (
        c.points - true_transfer(a, b, c)
    ).square().sum()
    assert found.transfer_error == pytest.approx(wrong.item())
    assert transfer_error(space, a, b, c) == pytest.approx(wrong.item())


class Counting(LinearSpace):
    """Remembers the most shapes that it was given at once."""

    most = 0

    def act(self, x, v):
        self.most = max(self.most, len(x))
        return super().act(x, v)


@pytest.mark.parametrize("project", [False, True])
def test_pairs_go_through_in_pieces_that_change_no_number(monkeypatch, project):
    shapes = shared()
    space = Counting.fit(shapes.points, 2)
    found = evaluate(space, shapes, pairs=75, project=project)
    assert space.most == metrics.AT_ONCE == 32
    monkeypatch.setattr(metrics, "AT_ONCE", 75)
    whole = evaluate(space, shapes, pairs=75, project=project)
    assert space.most == 75
    for name in (field.name for field in fields(found) if field.name != "floor"):
        assert getattr(found, name) == pytest.approx(getattr(whole, name), rel=1e-12), name


def test_what_a_plain_file_does_not_tell_is_unknown():
    found = evaluate(DoNothing(), Shapes(points=randn(0, 5, 8, 3)), pairs=10)
    assert (found.floor, found.exact_cd, found.transfer_error) == (None, None, None)
    assert "transfer_error  unknown" in str(found)


@pytest.mark.parametrize("family", [("table/four_legs", "table/shelf"), "carton/two_flaps"])
def test_the_table_of_shapes_without_a_known_truth_still_gives_multiples_of_the_floor(family):
    made = data_gen.generate(family, count=6, points=16)
    found = evaluate(DoNothing(), made, again=data_gen.resample(made, 1), pairs=10)
    assert (found.exact_cd, found.transfer_error) == (None, None)
    lines = {line.split()[0]: line for line in str(found).splitlines()}
    compared = [name for name in lines if "x floor" in lines[name]]
    assert compared == ["fitting_cd", "do_nothing_cd", "parallelogram_cd", "parallelogram_idle_cd"]
    assert lines["exact_cd"].split()[1:] == ["unknown"]


def test_the_table_gives_multiples_of_the_floor():
    made = data_gen.generate("box/one", count=6, points=64)
    shapes = as_shapes(made)
    found = evaluate(DoNothing(), shapes, again=as_shapes(data_gen.resample(made, 1)), pairs=10)
    assert f"{found.fitting_cd / found.floor:.2f} x floor" in str(found)
    assert len(str(found).splitlines()) == len(fields(found)) + 2  # and the two shares
