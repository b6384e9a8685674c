import json
from dataclasses import replace

import pytest
import torch
from worlds import TINY, randn, shapes_of

import data_gen
from dsn_lite import batches
from dsn_lite.batches import Batches, crowded
from dsn_lite.chamfer import chamfer
from dsn_lite.files import load_shapes
from dsn_lite.handles import BatchHandles
from dsn_lite.losses import sparsity_l1, sparsity_l21
from dsn_lite.shapes import Shapes
from dsn_lite.training import Training
from dsn_lite.world import World

chairs = shapes_of("chair", 24, 40)


def drawn(shapes=chairs, world=None, **told):
    return Batches(shapes, torch.arange(len(shapes)), replace(TINY, **told), world or World())


def test_a_step_is_the_same_again_and_another_is_another():
    one, again = drawn().draw(3), drawn().draw(3)
    assert torch.equal(one.x, again.x)
    assert torch.equal(one.y, again.y)
    assert not torch.equal(one.x, drawn().draw(4).x)


def test_targets_are_other_shapes_of_the_batch_and_trees_are_theirs():
    batch = drawn(points=40).draw(0)
    assert len(batch.x) == len(batch.source) == len(batch.target) == 4
    assert sorted(batch.target.tolist()) == sorted(batch.source.tolist())
    assert not (batch.source == batch.target).any()
    assert torch.equal(batch.x[batch.target], batch.y)
    for tree, cloud in zip(batch.trees, batch.y, strict=True):
        assert torch.equal(torch.from_numpy(tree.data).float(), cloud)


@pytest.mark.parametrize("size", [2, 3])
def test_processes_share_the_pairs_of_one(size):
    alone = drawn(batch=6, sparsity=1.0).draw(5)
    pairs = {(alone.x[i].sum().item(), alone.y[n].sum().item()) for n, i in enumerate(alone.source)}
    shared = [drawn(batch=6, sparsity=1.0, world=World(rank, size)).draw(5) for rank in range(size)]
    found = {(b.x[i].sum().item(), b.y[n].sum().item()) for b in shared for n, i in enumerate(b.source)}
    assert found == pairs
    assert sum(len(b.source) for b in shared) == 6
    assert all(len(b.handles.mask) == len(b.source) for b in shared)


def test_kept_trees_give_the_same_distance_and_there_is_an_end_to_them(monkeypatch):
    monkeypatch.setattr(batches, "ROOM", 40 * 6)
    kept = drawn()
    for step in range(12):
        batch = kept.draw(step)
        x = batch.x[batch.source]
        torch.testing.assert_close(chamfer(x, batch.y, batch.trees), chamfer(x, batch.y))
    assert 6 <= len(kept.trees) <= 6 + TINY.batch


def test_parts_moved_together_are_the_same_parts():
    """Handles of mixed chairs with every part of every family, and with those of a shape alone: equal losses."""
    labels, boxes = crowded(chairs.labels, chairs.boxes)
    assert boxes.shape[1] < chairs.boxes.shape[1] / 2
    A = randn(0, *chairs.points.shape, 3, dtype=torch.float32)
    wide, narrow = BatchHandles.of(chairs), BatchHandles(labels, chairs.rest, boxes)
    torch.testing.assert_close(narrow.project(A), wide.project(A), atol=1e-5, rtol=0)
    for loss in (sparsity_l1, sparsity_l21):
        torch.testing.assert_close(loss(narrow.coordinates(A)), loss(wide.coordinates(A)), rtol=1e-4, atol=0)
    unlabelled = torch.where(chairs.labels == 0, -1, chairs.labels)
    assert torch.equal(crowded(unlabelled, chairs.boxes)[0] < 0, unlabelled < 0)


def test_of_a_collection_in_shards_only_the_rows_of_a_step_are_read(tmp_path):
    data_gen.save_shards(data_gen.pieces("chair", count=64, points=40, seed=0), tmp_path / "many")
    shapes = load_shapes(tmp_path / "many")
    training = Training(shapes, replace(TINY, sparsity=0.1, steps=4, batch=2))
    assert not isinstance(training.batches.shapes.points, list)
    first = training.take_step()
    again = Training(
        Shapes(
            points=shapes.points.clone(),
            labels=shapes.labels,
            rest=shapes.rest,
            boxes=shapes.boxes,
            about=shapes.about,
            families=shapes.families,
        ),
        training.config,
    )
    assert again.take_step() == first
    assert json.loads((tmp_path / "many" / "about.json").read_text(encoding="utf-8"))["arrays"]


def test_a_shape_that_is_not_finite_is_named_when_it_is_drawn():
    """Collections in shards are not looked through when they are opened."""
    points = chairs.points.clone()
    points[7, 3] = float("nan")
    broken = drawn(replace(chairs, points=points), batch=24)
    with pytest.raises(ValueError, match="train: points must be finite, shape 7 holds NaN or infinity; clean or drop"):
        broken.draw(0)
