"""checks: what is wrong is said in words, right answers are praised, and solutions must be right."""

import math

import pytest
import torch

from dsn_lite import byhand, checks
from dsn_lite.diagnosis import diagnose

RIGHT = torch.randn(7, 3, generator=torch.Generator().manual_seed(0), dtype=torch.float64)
POSITIVE = RIGHT.abs() + 0.1
WRONG = {
    "still open": ...,
    "it is None": None,
    "it is a function": torch.sin,
    "list of tensors; join them": list(RIGHT),
    "must be a tensor of numbers, not a str": "3",
    "True and False": RIGHT > 0,
    r"shape is \(3, 7\), it should be \(7, 3\); axes are swapped": RIGHT.mT,
    "squeeze or unsqueeze": RIGHT[None],
    "went over all axes": RIGHT.sum(),
    "an axis is lost": RIGHT.mean(0),
    "an axis is left over": RIGHT.expand(2, 7, 3),
    r"shape is \(6, 3\), it should be \(7, 3\)$": RIGHT[:6],
    "21 of its 21 numbers are NaN; look for": RIGHT * torch.nan,
    "numbers are infinity": RIGHT / 0,
    "sign is flipped": -RIGHT,
    "signs are lost": RIGHT.abs(),
    "it is 2 times the right": 2 * RIGHT,
    "it is 1 / 2 times": RIGHT / 2,
    r"it is 7 \(the size of axis 0\) times": 7 * RIGHT,
    r"it is 1 / the root of 7 \(the size": RIGHT / 7**0.5,
    "it is 100 times": 100 * RIGHT,
    "it is the root of n times": 512**0.5 * RIGHT,
    "it is 2.345 times the right answer$": 2.345 * RIGHT,
    r"it is 3 \(the size of axis 1\) times the right answer, and its sign is flipped": -3 * RIGHT,
    "its rows are right but in another order": RIGHT.flip(0),
    "its columns are right but in another order": RIGHT.flip(1),
    "off by 0.5 everywhere": RIGHT + 0.5,
    "every row is off by the same": RIGHT + torch.tensor([1, 2, 3]),
    r"1 of its 21 numbers are wrong, most of all at \[2, 1\]": RIGHT.index_put(
        (torch.tensor(2), torch.tensor(1)), torch.tensor(9.0).double()
    ),
    "you forgot to centre": RIGHT**3,
}


@pytest.mark.parametrize("words", WRONG)
def test_each_mistake_has_its_sentence(words, capsys):
    checks.array(WRONG[words], RIGHT, "A", hints={"you forgot to centre.": RIGHT**3}, factors={"n": 512})
    printed = capsys.readouterr().out.strip()
    assert printed.startswith("Not yet, A: ")
    assert printed.count("\n") == 0
    with pytest.raises(AssertionError, match=words):
        raise AssertionError(printed.removesuffix("."))


@pytest.mark.parametrize(
    ("answer", "words"), [(POSITIVE**2, "the square of the right answer"), (POSITIVE.sqrt(), "the root of the right")]
)
def test_powers_are_told(answer, words):
    assert words in diagnose(answer, POSITIVE)


def test_single_precision_is_told_only_where_double_is_asked():
    rounded = RIGHT.float()
    assert diagnose(rounded, RIGHT) is None
    assert "single precision only" in diagnose(rounded, RIGHT, tolerance=1e-9)


@pytest.mark.parametrize(
    "answer", [RIGHT, RIGHT.numpy(), RIGHT.tolist(), RIGHT.float(), RIGHT.clone().requires_grad_()]
)
def test_right_answers_of_any_kind_are_right(answer, capsys):
    checks.array(answer, RIGHT, "A")
    assert capsys.readouterr().out == "Right: A.\n"


def test_nothing_near_is_accepted_and_zeros_are_compared_absolutely():
    assert diagnose(RIGHT * 1.01, RIGHT)
    assert diagnose(torch.zeros(3), torch.zeros(3)) is None
    assert diagnose(torch.full((3,), 1e-2), torch.zeros(3))


def test_numbers(capsys):
    checks.number(torch.tensor(2.0), 2.0, "rms")
    checks.number(3, 3.0, "k")
    checks.number(8.0, 2.0, "rms", factors={"n": 4.0})
    checks.number(2.5, 2.0, "rms", hints={"that is the median": 2.5})
    checks.number(0.7, 0.3, "rms")
    checks.number(torch.ones(2), 1.0, "rms")
    right, whole, factor, hint, other, shape = capsys.readouterr().out.splitlines()
    assert [right, whole] == ["Right: rms.", "Right: k."]
    assert factor == "Not yet, rms: it is n times the right answer."
    assert hint == "Not yet, rms: that is the median."
    assert other == "Not yet, rms: 0.7 is not the right number."
    assert "its shape is (2,), it should be ()" in shape


def negate_in_place(x):
    return x.neg_()


def raises(x):
    raise KeyError("k\nsecond line")


FUNCTIONS = {
    "still open": ...,
    "it must be a function, not a Tensor": RIGHT,
    "still open: put": lambda x: ...,
    "it returns None; end it with a return": lambda x: None,
    "it raises KeyError": raises,
    "it changes its arguments in place": negate_in_place,
    "its sign is flipped": lambda x: -x.mean(0),
    "take the mean, not the sum": lambda x: x.sum(0),
}


@pytest.mark.parametrize("words", FUNCTIONS)
def test_functions_are_tried_on_examples(words, capsys):
    hints = {"take the mean, not the sum": lambda x: x.sum(0)}
    checks.function(FUNCTIONS[words], lambda x: x.mean(0), [(RIGHT.clone(),)], "centroid", hints=hints)
    assert words in capsys.readouterr().out


def test_every_example_counts(capsys):
    examples = [(torch.tensor(2.0),), (torch.tensor(-2.0),)]
    checks.function(lambda x: x, torch.abs, examples, "size")
    checks.function(torch.abs, torch.abs, examples, "size")
    assert capsys.readouterr().out == (
        "Not yet, size: its sign is flipped; a difference is taken the wrong way round.\nRight: size.\n"
    )


def test_nan_arguments_are_not_taken_for_changed_ones(capsys):
    checks.function(torch.nan_to_num, torch.nan_to_num, [(torch.tensor([1.0, math.nan]),)], "cleaning")
    assert "Right" in capsys.readouterr().out


def test_solutions_must_be_right(monkeypatch, capsys):
    monkeypatch.setenv("DSN_LITE_SOLUTIONS", "1")
    with pytest.raises(AssertionError, match="A: its sign is flipped"):
        checks.array(-RIGHT, RIGHT, "A")
    with pytest.raises(AssertionError, match="rms: still open"):
        checks.number(..., 1.0, "rms")
    with pytest.raises(AssertionError, match="f: it returns None"):
        checks.function(lambda x: None, torch.abs, [(RIGHT,)], "f")
    checks.array(RIGHT, RIGHT, "A")
    assert capsys.readouterr().out == "Right: A.\n"


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (2, "Right: even."),
        (3, "Not yet, even: 3 is odd."),
        (..., "still open"),
        ("2", "it raises TypeError"),
        (0, "first."),
    ],
)
def test_a_judge_says_what_is_wrong(answer, said, capsys):
    def judge(number):
        return {0: ["first", "second"]}.get(number, [f"{number} is odd"] * (number % 2))

    checks.accepted(answer, judge, "even")
    assert said in capsys.readouterr().out


# the laws of a reader's own space


def judge(function, capsys):
    space = byhand.OfDifference(function)
    checks.laws(space, byhand.copies(6), "own", keeps=["reversal_negates"], breaks=["triangle_closes"])
    return capsys.readouterr().out


@pytest.mark.parametrize(
    ("function", "said"),
    [
        (torch.tanh, "Right: own."),
        (lambda d: d, "it must break triangle_closes, but the residual is"),
        (torch.abs, "it must keep reversal_negates, but the residual is"),
        (..., "still open"),
        (lambda d: d * float("nan"), "it must keep reversal_negates, but the residual is nan"),
        (lambda d: 1 / 0, "it raises ZeroDivisionError"),
        (lambda d: None, "it raises "),
        (3, "it raises TypeError"),
    ],
)
def test_laws_of_ones_own_space(function, said, capsys):
    assert said in judge(function, capsys)
