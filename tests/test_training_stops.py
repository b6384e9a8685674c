"""Trainings that are stopped, resumed, or go wrong."""

import json
import signal
import threading
from dataclasses import replace

import pytest
import torch
from worlds import TINY, shapes_of, stop_at, weights

from dsn_lite.driving import interrupts, train
from dsn_lite.runs import finished, load_run
from dsn_lite.training import Training
from dsn_lite.world import World

shapes = shapes_of("box/one", 20, 32)


# stopping and resuming


@pytest.mark.parametrize("steps", [30, 40])
@pytest.mark.parametrize("look", [1, 7, 13])
def test_stopped_and_resumed_is_the_same_as_never_stopped_bit_for_bit(look, steps, tmp_path):
    config = replace(TINY, steps=steps)
    whole = train(shapes, config, out=tmp_path / "whole")
    train(shapes, config, out=tmp_path / "parts", watch=stop_at(look))
    resumed = train(shapes, config, out=tmp_path / "parts", resume=True)
    assert torch.equal(weights(resumed), weights(whole))
    histories = [(tmp_path / run / "history.jsonl").read_text().splitlines() for run in ("whole", "parts")]
    one, other = ([json.loads(line) | {"seconds": 0} for line in lines] for lines in histories)
    assert one == other


def test_the_whole_state_is_resumed_and_not_only_the_best_weights(tmp_path):
    """Teeth: with a fresh Adam, the steps after the resumption would differ."""
    train(shapes, TINY, out=tmp_path, watch=stop_at(7))
    resumed, fresh = Training(shapes, TINY, run=tmp_path, resume=True), Training(shapes, TINY)
    fresh.space.load_state_dict(resumed.space.state_dict())
    fresh.step = resumed.step
    for training in (resumed, fresh):
        training.take_step()
    assert not torch.equal(weights(resumed.space), weights(fresh.space))


def test_stopping_keeps_the_best_weights_so_far_and_writes_the_run(tmp_path, capsys):
    space = train(shapes, TINY, out=tmp_path, watch=stop_at(5))
    assert "Stopped at step" in capsys.readouterr().out
    assert torch.equal(weights(load_run(tmp_path)), weights(space))
    assert not torch.equal(weights(space), weights(Training(shapes, TINY).space))


def test_stopping_before_the_first_look_keeps_what_was_learned(tmp_path, monkeypatch):
    config, take_step = replace(TINY, steps=1000), Training.take_step

    def stopped(training):
        if training.step == 20:
            raise KeyboardInterrupt
        return take_step(training)

    monkeypatch.setattr(Training, "take_step", stopped)
    space = train(shapes, config, out=tmp_path)
    assert not torch.equal(weights(space), weights(Training(shapes, config).space))
    assert json.loads((tmp_path / "history.jsonl").read_text())["step"] == 20


def test_a_finished_training_resumes_to_itself(tmp_path):
    space = train(shapes, TINY, out=tmp_path)
    assert torch.equal(weights(train(shapes, TINY, out=tmp_path, resume=True)), weights(space))


# what goes wrong


def test_numbers_that_are_none_stop_with_a_sentence_and_leave_a_run_that_loads(tmp_path):
    def explode(training, record):
        if len(training.history) == 3:
            with torch.no_grad():
                training.space.encode.head[-1].weight.fill_(float("nan"))

    words = r"train: .* must stay finite, got NaN or infinity at step \d+; lower learning_rate \(now .*\), the best"
    with pytest.raises(FloatingPointError, match=words):
        train(shapes, TINY, out=tmp_path, watch=explode)
    assert weights(load_run(tmp_path)).isfinite().all()


def test_a_training_that_fails_before_it_learned_anything_leaves_no_run(tmp_path):
    with pytest.raises(FloatingPointError, match=r"lower learning_rate \(now 1e\+30\)$"):
        train(shapes, replace(TINY, learning_rate=1e30), out=tmp_path / "run")
    assert not (tmp_path / "run").exists()
    train(shapes, TINY, out=tmp_path / "run")  # the retry is not refused


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ({"seed": 1}, "its seed is 0 instead of 1"),
        ({"columns": "unit"}, "its columns is rms instead of unit"),
        ({"symmetry": 1.0}, "its symmetry is 0.0 instead of 1.0"),
        ({"head": (8,)}, r"its head is \[16\] instead of \[8\]"),
        ({"learning_rate": 1e-3}, "its learning_rate is 0.004 instead of 0.001"),
    ],
)
def test_resuming_with_another_config(other, words, tmp_path):
    train(shapes, TINY, out=tmp_path, watch=stop_at(2))
    with pytest.raises(ValueError, match=rf"train: the checkpoint in .* must fit this Config, {words}; resume with"):
        train(shapes, replace(TINY, **other), out=tmp_path, resume=True)


def test_a_budget_can_be_raised(tmp_path):
    train(shapes, TINY, out=tmp_path, watch=stop_at(2))
    train(shapes, replace(TINY, steps=40), out=tmp_path, resume=True)
    assert json.loads((tmp_path / "history.jsonl").read_text().splitlines()[-1])["step"] == 40


def test_ctrl_c_in_the_midst_of_a_step_waits_for_its_end_and_resumes_to_the_same(tmp_path, monkeypatch):
    """A signal while Adam has changed some weights and not others; the look it causes is not one of the resumed run."""
    whole, handler = train(shapes, TINY, out=tmp_path / "whole"), signal.getsignal(signal.SIGINT)
    taken, step = [], torch.optim.Adam.step

    def interrupted(optimizer):
        taken.append(1)
        if len(taken) == 8:
            signal.raise_signal(signal.SIGINT)
        return step(optimizer)

    with monkeypatch.context() as patch:
        patch.setattr(torch.optim.Adam, "step", interrupted)
        train(shapes, TINY, out=tmp_path / "parts")
    assert len(taken) == 8
    assert not finished(tmp_path / "parts")
    assert torch.equal(weights(train(shapes, TINY, out=tmp_path / "parts", resume=True)), weights(whole))
    records = [(tmp_path / run / "history.jsonl").read_text().splitlines() for run in ("whole", "parts")]
    assert [json.loads(line)["step"] for line in records[0]] == [json.loads(line)["step"] for line in records[1]]
    assert signal.getsignal(signal.SIGINT) is handler  # its own again: a job in the background may ignore it


def test_a_second_ctrl_c_does_not_wait(tmp_path):
    training = Training(shapes, TINY)
    with interrupts(training):
        signal.raise_signal(signal.SIGINT)
        assert training.stopping
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


def test_a_training_in_another_thread_leaves_signals_alone():
    found = []
    thread = threading.Thread(target=lambda: found.append(train(shapes, TINY)))
    thread.start(), thread.join()
    assert torch.equal(weights(found[0]), weights(train(shapes, TINY)))


def test_more_processes_than_pairs():
    with pytest.raises(ValueError, match="train: batch must have a pair for each of 5 processes, got 4; raise it"):
        Training(shapes, TINY, world=World(0, 5))


def test_resuming_with_other_shapes(tmp_path):
    train(shapes, TINY, out=tmp_path, watch=stop_at(2))
    with pytest.raises(ValueError, match=r"train: the checkpoint in .* must be of these shapes, it is of others"):
        train(replace(shapes, points=shapes.points * 1.01), TINY, out=tmp_path, resume=True)


def test_without_a_run_the_sentence_names_none():
    with pytest.raises(FloatingPointError, match=r"lower learning_rate \(now 1e\+30\)$"):
        train(shapes, replace(TINY, learning_rate=1e30))


def test_a_batch_larger_than_the_training_shapes():
    with pytest.raises(ValueError, match=r"train: batch must be at most the 16 training shapes, got 17; lower batch"):
        train(shapes, replace(TINY, batch=17))


def test_too_few_shapes():
    with pytest.raises(ValueError, match=r"train: at least 8 shapes are needed .*, got 7; bring more shapes"):
        train(shapes_of("box/one", 7, 32), TINY)


def test_eight_shapes_are_enough_and_are_validated_on_others(tmp_path):
    space = train(shapes_of("box/one", 8, 32), TINY, out=tmp_path)
    assert torch.equal(weights(load_run(tmp_path)), weights(space))
    assert all(json.loads(line)["validation_cd"] > 0 for line in (tmp_path / "history.jsonl").read_text().splitlines())


def test_more_columns_than_coordinates():
    with pytest.raises(ValueError, match=r"train: k must be at most 3n = 96 for shapes of 32 points, got 97; lower k"):
        train(shapes, replace(TINY, k=97))


def test_points_that_are_not_finite():
    points = shapes.points.numpy().copy()
    points[3, 4, 1] = float("nan")
    with pytest.raises(ValueError, match=r"as_shapes: points must be finite, shape 3 holds NaN or infinity"):
        train(points, TINY)


def test_resuming_needs_a_folder():
    with pytest.raises(
        ValueError, match=r"train: resume needs the run folder to go on from, got no out; give out=FOLDER"
    ):
        train(shapes, TINY, resume=True)


def test_resuming_needs_a_checkpoint(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"must hold checkpoint\.safetensors, it does not; is it a run folder?"):
        train(shapes, TINY, out=tmp_path, resume=True)


def test_resuming_with_another_k(tmp_path):
    train(shapes, TINY, out=tmp_path, watch=stop_at(2))
    with pytest.raises(ValueError, match=r"train: the checkpoint in .* must fit this Config, its k is 3 instead of 4"):
        train(shapes, replace(TINY, k=4), out=tmp_path, resume=True)


def test_a_run_is_not_written_over(tmp_path):
    train(shapes, TINY, out=tmp_path, watch=stop_at(2))
    before = (tmp_path / "model.safetensors").read_bytes()
    with pytest.raises(ValueError, match=r"train: .* must not hold a run already, it does; resume it, or choose"):
        train(shapes, TINY, out=tmp_path)
    assert (tmp_path / "model.safetensors").read_bytes() == before
