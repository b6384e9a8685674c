"""The handles of a batch against those of each shape, which tests/test_handles.py holds against the dense matrices."""

from dataclasses import replace

import pytest
import torch

import data_gen
from dsn_lite.files import as_shapes
from dsn_lite.handles import BatchHandles, BoxHandles
from dsn_lite.shapes import Shapes


@pytest.fixture(params=["chair", ("table/four_legs", "lamp/arc"), "table/four_legs"], scope="module")
def shapes(request):
    """Chairs of several structures, two categories mixed, one family; in double precision, some points of no part."""
    drawn = as_shapes(data_gen.generate(request.param, count=6, points=200, seed=3)).like(
        torch.nn.Linear(1, 1).double()
    )
    labels = drawn.labels.expand(6, 200).clone()
    labels[:, ::17] = -1
    return replace(drawn, labels=labels)


def one_by_one(shapes):
    """BoxHandles of each shape, and where their handles stand among the padded ones."""
    for i in range(len(shapes)):
        present = shapes.boxes[i].isfinite().all(-1)
        boxes = torch.where(present[:, None], shapes.boxes[i], 0.0)
        rest = (shapes.rest if shapes.rest.ndim == 2 else shapes.rest[i]).nan_to_num()
        yield BoxHandles(shapes.labels[i], rest, boxes)


def test_coordinates_are_those_of_each_shape(shapes):
    u = torch.randn(*shapes.points.shape, 5, dtype=torch.float64, generator=torch.Generator().manual_seed(0))
    batch = BatchHandles.of(shapes)
    found = batch.coordinates(u)
    for i, own in enumerate(one_by_one(shapes)):
        mask = batch.mask[i].flatten()
        assert torch.equal(mask, own.kept.flatten())
        torch.testing.assert_close(found[i][mask], own.coordinates(u[i]))
        assert not found[i][~mask].any()


def test_projection_is_that_of_each_shape(shapes):
    u = torch.randn(*shapes.points.shape, dtype=torch.float64, generator=torch.Generator().manual_seed(1))
    batch = BatchHandles.of(shapes)
    expected = torch.stack([own.project(u[i]) for i, own in enumerate(one_by_one(shapes))])
    torch.testing.assert_close(batch.project(u), expected)
    torch.testing.assert_close(batch.project(torch.stack([u, -u], -1))[..., 1], -expected)
    torch.testing.assert_close(batch.project(batch.project(u)), expected)


def test_what_handles_see_is_the_length_of_the_projection(shapes):
    u = torch.randn(*shapes.points.shape, 4, dtype=torch.float64, generator=torch.Generator().manual_seed(2))
    held = (shapes.labels >= 0)[..., None, None]
    slow = (BatchHandles.of(shapes).project(u) * held).square().sum(2).mean(1).sqrt()
    torch.testing.assert_close(BatchHandles.of(shapes).seen(u), slow)
    torch.testing.assert_close(BatchHandles.of(shapes).seen(u[..., 0]), slow[:, 0])


def test_gradients_pass(shapes):
    few = shapes[:2]
    batch = BatchHandles.of(replace(few, points=few.points))
    u = few.points.clone().requires_grad_()
    (batch.coordinates(u).square().sum() + batch.project(u).square().sum()).backward()
    assert u.grad.isfinite().all()
    assert u.grad.abs().sum() > 0


def test_shapes_without_parts_are_refused():
    with pytest.raises(ValueError, match="BatchHandles: shapes must have labels, rest and boxes, these have no parts"):
        BatchHandles.of(Shapes(points=torch.rand(3, 10, 3)))
