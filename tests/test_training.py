import json
from copy import copy
from dataclasses import fields, replace
from itertools import pairwise
from pathlib import Path

import pytest
import torch
from worlds import TINY, shapes_of, stop_at, weights

from dsn_lite import losses
from dsn_lite.batches import Batches
from dsn_lite.config import Config
from dsn_lite.data import triplets
from dsn_lite.driving import drive, train
from dsn_lite.metrics import evaluate, transfer_error
from dsn_lite.runs import finished, load_run
from dsn_lite.training import AT_ONCE, Record, Training

shapes = shapes_of("box/one", 20, 32)


# what is trained


def test_training_beats_doing_nothing_in_fitting_and_against_the_true_transfer():
    boxes = shapes_of("box/one", 200, 64)
    training = Training(boxes, Config(k=3, batch=8, steps=400, features=(32, 64, 128), head=(64,)))
    for _ in training:
        pass
    training.space.load_state_dict(training.best)
    found = evaluate(training.space, training.test, pairs=40)
    assert found.fitting_cd < found.do_nothing_cd / 2
    assert found.transfer_error < 0.5
    assert found.identity == 0
    assert found.share_moved > 0.5
    assert transfer_error(training.space.untrained(), *triplets(training.test, 40, with_truth=True)) > 0.5


def test_the_same_seed_gives_the_same_weights_and_another_gives_others():
    one, again, other = (train(shapes, replace(TINY, seed=seed)) for seed in (0, 0, 1))
    assert torch.equal(weights(one), weights(again))
    assert not torch.equal(weights(one), weights(other))


def test_the_best_weights_are_kept():
    training = Training(shapes, replace(TINY, learning_rate=0.05))
    seen = [(record.validation_cd, weights(training.space).clone()) for record in training]
    cd, best = min(seen, key=lambda pair: pair[0])
    training.space.load_state_dict(training.best)
    assert training.best_cd == cd == training.validate()[0]
    assert torch.equal(weights(training.space), best)
    assert cd < max(seen, key=lambda pair: pair[0])[0]


def test_the_loss_is_fitting_plus_the_weight_times_symmetry():
    plain, symmetric = Training(shapes, TINY), Training(shapes, replace(TINY, symmetry=2.0))
    twice = Training(shapes, replace(TINY, symmetry=4.0))
    a, b, c = (training.loss().item() for training in (plain, symmetric, twice))
    assert a < b
    assert c - b == pytest.approx(b - a, rel=1e-4)


def test_denser_clouds_are_sub_sampled_anew_in_each_step_and_their_targets_are_not(monkeypatch):
    training, met = Training(shapes_of("box/one", 20, 64), replace(TINY, points=32)), []
    measure = losses.fitting
    monkeypatch.setattr(losses, "fitting", lambda x, y, *kept: met.append((x.detach(), y)) or measure(x, y, *kept))
    training.loss(), training.loss()
    training.step = 1
    training.loss()
    (first, target), (again, _), (later, _) = met
    assert (first.shape, target.shape) == ((4, 32, 3), (4, 64, 3))
    assert torch.equal(first, again)
    assert not torch.equal(first, later)


def test_nobody_is_paired_with_itself():
    """Then an untrained space, which never fits exactly, has a loss above that of pairs with themselves, which is 0."""
    two = Training(shapes, replace(TINY, batch=2))
    assert all(two.loss().item() > 1e-4 for two.step in range(20))


def test_shapes_that_are_validated_or_tested_are_not_trained_on():
    training = Training(shapes, TINY)
    groups = [set(part.names) for part in (shapes[training.rows], training.validation, training.test)]
    assert sum(map(len, groups)) == len(set.union(*groups)) == 20
    assert len(training.rows) == len(groups[0])


def test_the_learning_rate_rises_and_falls_to_nothing():
    training = Training(shapes, replace(TINY, steps=1000))
    rates = []
    for training.step in range(1001):
        rates.append(training.learning_rate)
    top = rates.index(max(rates))
    assert 0 < rates[0] < TINY.learning_rate / 100
    assert 15 <= top <= 25
    assert max(rates) == pytest.approx(TINY.learning_rate, rel=0.01)
    assert all(a > b for a, b in pairwise(rates[top:]))
    assert rates[-1] == 0


def test_a_budget_of_seconds_ends(capsys):
    training = Training(shapes, replace(TINY, steps=None, seconds=0.3))
    records = list(training)
    assert training.seconds >= 0.3
    assert training.progress >= 1
    assert records[-1].step == training.step  # nothing was learned after the last look


def test_training_is_told_about_on_one_line(capsys):
    train(shapes, TINY)
    assert "validation=" in capsys.readouterr().out


# what is written


def test_the_history_is_json_lines_one_a_look(tmp_path):
    seen = []
    train(shapes, replace(TINY, steps=40), out=tmp_path, watch=lambda training, record: seen.append(record))
    lines = [json.loads(line) for line in (tmp_path / "history.jsonl").read_text(encoding="utf-8").splitlines()]
    assert [Record(**line) for line in lines] == seen
    assert [line["step"] for line in lines] == list(range(2, 41, 2))
    assert set(lines[0]) == {field.name for field in fields(Record)}


def test_the_run_holds_the_space_that_is_returned(tmp_path):
    space = train(shapes, TINY, out=tmp_path / "deep" / "run")
    assert torch.equal(weights(load_run(tmp_path / "deep" / "run")), weights(space))
    assert not list(tmp_path.rglob("*.part"))


def test_a_crash_while_writing_leaves_the_checkpoint_before_it(tmp_path, monkeypatch):
    train(shapes, TINY, out=tmp_path, watch=stop_at(5))
    before = (tmp_path / "checkpoint.safetensors").read_bytes()

    def crash(path, data):
        with path.open("wb") as file:
            file.write(data[:9])
        raise OSError("disk full")

    monkeypatch.setattr(Path, "write_bytes", crash)
    with pytest.raises(OSError, match=r"disk full"):
        train(shapes, TINY, out=tmp_path, resume=True)
    assert (tmp_path / "checkpoint.safetensors").read_bytes() == before
    assert not list(tmp_path.rglob("*.part"))


def test_the_dense_share_of_a_training_reads_all_points_of_its_sources(monkeypatch):
    """Sub-sampled until then, on the same shapes; a step before and after each border."""
    read, draw = [], Batches.draw

    def drawn(self, step, **told):
        batch = draw(self, step, **told)
        read.append(batch.x.shape[1])
        return batch

    monkeypatch.setattr(Batches, "draw", drawn)
    for dense, expected in ((0.0, [8] * 10), (0.3, [8] * 7 + [32] * 3), (1.0, [32] * 10)):
        read.clear()
        train(shapes, replace(TINY, points=8, steps=10, dense=dense))
        assert read == expected


def test_dense_and_sub_sampled_steps_draw_the_same_shapes():
    batches = Training(shapes, replace(TINY, points=8)).batches
    few, all_ = batches.draw(3), batches.draw(3, dense=True)
    assert torch.equal(few.y, all_.y)
    assert torch.equal(few.source, all_.source)
    assert all((row.unsqueeze(1) == whole).all(-1).any(1).all() for row, whole in zip(few.x, all_.x, strict=True))


# the whole of Section 3.3


def test_the_loss_is_that_of_its_terms_written_out():
    """L = 100 (L_F + w_R L_R) + w_S L_S on one batch, from the space's own doors, one pair at a time."""
    chairs = shapes_of("chair", 20, 40)
    for norm in ("l1", "l21"):
        told = replace(TINY, symmetry=0.5, sparsity=2.0, norm=norm, batch=4)
        training = Training(chairs, told)
        batch, space, total = training.batches.draw(0), training.space, 0.0
        for i in range(4):
            x, y = batch.x[batch.source[i]], batch.y[i]
            d = space.deform(x, y)
            found = losses.handle_dictionary(space.dictionary(x)[None], one(batch.handles, i))
            chamfers = losses.fitting(d[None], y[None]) + 0.5 * losses.chamfer(d, losses.mirror(d, "x"))
            total += 100 * chamfers + 2.0 * losses.SPARSITY[norm](found)
        assert training.loss().item() == pytest.approx(total.item() / 4, rel=1e-4)


def one(handles, i):
    """The handles of one shape of a batch."""
    alone = copy(handles)
    for name, value in vars(handles).items():
        setattr(alone, name, value[i : i + 1])
    return alone


def test_projection_while_training_is_what_the_loss_sees():
    chairs = shapes_of("chair", 20, 40)
    plain, held = (Training(chairs, replace(TINY, project=project)) for project in (False, True))
    for each in (plain, held):  # far enough that parts bend
        torch.nn.init.normal_(each.space.encode.head[-1].weight, std=5, generator=torch.Generator().manual_seed(0))
    batch = held.batches.draw(0)
    x = batch.x[batch.source]
    d = batch.handles.project(held.space.deform(x, batch.y))
    assert held.loss().item() == pytest.approx(100 * losses.fitting(d, batch.y).item(), rel=1e-4)
    assert held.loss().item() != pytest.approx(plain.loss().item(), rel=1e-3)


def test_columns_are_normalised_before_projection_so_the_scale_of_the_network_does_not_matter():
    chairs = shapes_of("chair", 20, 40)
    training = Training(chairs, replace(TINY, sparsity=1.0))
    before = training.loss().item()
    with torch.no_grad():
        for weights_ in training.space.dictionary.head[-1][-1].parameters():
            weights_ *= 3
    assert training.loss().item() == pytest.approx(before, rel=1e-4)


@pytest.mark.parametrize("told", [{"k": 1}, {"k": 512}, {"vector": "concat"}, {"columns": "unit", "sparsity": 1.0}])
def test_every_kind_of_network_trains_is_kept_and_comes_back(told, tmp_path):
    clouds = shapes_of("chair", 20, 200)
    space = train(clouds, replace(TINY, points=200, steps=3, **told), out=tmp_path / "run")
    again = load_run(tmp_path / "run")
    x, y = clouds.points[:2]
    assert torch.equal(again.deform(x, y), space.deform(x, y))
    assert space.dictionary(x).shape[-1] == told.get("k", TINY.k)
    assert finished(tmp_path / "run")


def test_sparsity_needs_parts():
    with pytest.raises(ValueError, match="train: sparsity and project need shapes with labels, rest and boxes"):
        train(torch.rand(20, 30, 3).numpy(), replace(TINY, sparsity=1.0))


def test_gradients_are_clipped(monkeypatch):
    lengths = []
    clip = torch.nn.utils.clip_grad_norm_
    monkeypatch.setattr(torch.nn.utils, "clip_grad_norm_", lambda p, c: lengths.append(c) or clip(p, c))
    training = Training(shapes, replace(TINY, clip=1e-3))
    training.take_step()
    length = torch.stack([p.grad.norm() for p in training.space.parameters()]).norm().item()
    assert lengths == [1e-3]
    assert length == pytest.approx(1e-3, rel=1e-3)


def test_columns_that_move_nothing_are_counted_and_reported(capsys):
    """A code that never changes along the last two of three coordinates."""
    training = Training(shapes, replace(TINY, learning_rate=1e-9))
    assert training.validate()[1] == 0
    with torch.no_grad():
        training.space.encode.head[-1].weight[1:] = 0
    assert training.validate()[1] == 2
    drive(training, None)
    assert training.history[-1].dead == 2
    assert "2 of the 3 columns of the dictionary move nothing; a smaller k will do." in capsys.readouterr().out


def test_validation_in_pieces_is_that_of_all_at_once():
    training = Training(shapes_of("chair", 200, 40), TINY)
    x = training.validation.points
    assert len(x) == 10 > AT_ONCE
    y = x.roll(1, 0)
    assert training.validate()[0] == pytest.approx(losses.chamfer(training.space.deform(x, y), y).mean().item())
