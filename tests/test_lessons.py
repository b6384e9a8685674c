import pytest
import torch

from dsn_lite import lessons, load


def test_begin_seeds_and_says_what_runs(capsys):
    lessons.begin(3)
    first = torch.rand(2)
    lessons.begin(3)
    assert torch.equal(torch.rand(2), first)
    said = capsys.readouterr().out
    assert all(word in said for word in ("Python 3.", "torch 2.", "seed 3"))


def test_budgets_are_small_while_lessons_are_tested(monkeypatch):
    monkeypatch.delenv(lessons.SMOKE, raising=False)
    assert lessons.seconds(150.0) == 150
    monkeypatch.setenv(lessons.SMOKE, "1")
    assert lessons.seconds(150.0) == 1


def test_the_sentence_of_an_error_is_shown(capsys):
    lessons.error_of(lambda: load("spoon"))
    assert "ValueError: load: there is no ready-made space 'spoon'" in capsys.readouterr().out


def test_other_errors_are_not_hidden():
    with pytest.raises(ZeroDivisionError):
        lessons.error_of(lambda: 1 / 0)


def test_steps_are_few_while_lessons_are_tested(monkeypatch):
    monkeypatch.delenv(lessons.SMOKE, raising=False)
    assert lessons.steps(240) == 240
    monkeypatch.setenv(lessons.SMOKE, "1")
    assert lessons.steps(240) == 5
