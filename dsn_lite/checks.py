"""Self-checks of exercises: they print that an answer is right, or what is wrong with it in one sentence.

A check never raises, so a notebook with open exercises runs to its end, unless the environment variable
DSN_LITE_SOLUTIONS is 1: then whatever is not right is an AssertionError, which proves the solutions.
"""

import os
from collections.abc import Callable, Sequence
from typing import Any

from .axioms import residuals
from .data import Shapes, triplets
from .diagnosis import diagnose, unfinished
from .space import ActionSpace

SOLUTIONS = "DSN_LITE_SOLUTIONS"


def array(
    answer: Any,
    expected: Any,
    name: str,
    *,
    hints: dict[str, Any] | None = None,
    factors: dict[str, Any] | None = None,
    tolerance: float = 1e-4,
) -> None:
    """Checks a tensor against the expected one, to a relative `tolerance` of its rms.

    hints: sentences, each with the wrong answer it speaks of. factors: names and values of numbers that may have been
    forgotten or doubled, such as {"n": 512}; 2, 3 and 100 are tried anyway, and the sizes of the expected axes.
    """
    _tell(name, diagnose(answer, expected, hints=hints, factors=factors, tolerance=tolerance))


def number(
    answer: Any,
    expected: Any,
    name: str,
    *,
    hints: dict[str, Any] | None = None,
    factors: dict[str, Any] | None = None,
    tolerance: float = 1e-3,
) -> None:
    """Checks one number, to a relative `tolerance`; hints and factors as for `array`."""
    _tell(name, diagnose(answer, expected, hints=hints, factors=factors, tolerance=tolerance))


def function(
    answer: Any,
    reference: Callable[..., Any],
    examples: Sequence[tuple],
    name: str,
    *,
    hints: dict[str, Callable[..., Any]] | None = None,
    factors: dict[str, Any] | None = None,
    tolerance: float = 1e-4,
) -> None:
    """Checks a function against the reference on examples, tuples of arguments; hints hold wrong functions."""
    problem = None if callable(answer) else unfinished(answer) or f"it must be a function, not a {_kind(answer)}"
    for arguments in examples:
        problem = problem or _try(answer, reference, arguments, hints or {}, factors, tolerance)
    _tell(name, problem)


def accepted(answer: Any, judge: Callable[[Any], Sequence[str]], name: str) -> None:
    """Checks an answer that can be right in many ways; `judge` returns what is wrong with it, in sentences."""
    problem = unfinished(answer)
    if problem is None:
        try:
            problem = next(iter(judge(answer)), None)
        except Exception as error:  # whatever comes of a student's answer is the diagnosis
            problem = _raised(error)
    _tell(name, problem)


def laws(space: ActionSpace, shapes: Shapes, name: str, *, keeps: Sequence[str], breaks: Sequence[str]) -> None:
    """Checks that a space of the reader's own keeps some laws of axioms.LAWS on these shapes and breaks others."""
    problem = unfinished(getattr(space, "function", None))
    if problem is None:
        try:
            problem = _laws_problem(residuals(space, *triplets(shapes, 32)), keeps, breaks)
        except Exception as error:  # whatever a student's function does is the diagnosis
            problem = _raised(error)
    _tell(name, problem)


def _laws_problem(found: dict[str, float], keeps: Sequence[str], breaks: Sequence[str]) -> str | None:
    kept = [f"it must keep {law}, but the residual is {found[law]:.2g}" for law in keeps if not found[law] <= 1e-9]
    broken = [f"it must break {law}, but the residual is {found[law]:.2g}" for law in breaks if not found[law] >= 1e-6]
    return next(iter(kept + broken), None)


def _try(answer, reference, arguments: tuple, hints: dict, factors, tolerance: float) -> str | None:
    """What is wrong with the function on one example."""
    given = [_copy(value) for value in arguments]
    try:
        value = answer(*given)
    except Exception as error:  # whatever a student's function raises is the diagnosis
        return _raised(error)
    if value is None:
        return "it returns None; end it with a return"
    if any(_changed(before, after) for before, after in zip(arguments, given, strict=True)):
        return "it changes its arguments in place; compute new tensors instead"
    wrong = {sentence: each(*map(_copy, arguments)) for sentence, each in hints.items()}
    expected = reference(*map(_copy, arguments))
    return diagnose(value, expected, hints=wrong, factors=factors, tolerance=tolerance)


def _raised(error: Exception) -> str:
    return f"it raises {type(error).__name__} ({str(error).splitlines()[0][:120] if str(error) else 'no message'})"


def _copy(value: Any) -> Any:
    return value.clone() if hasattr(value, "clone") else value


def _changed(before: Any, after: Any) -> bool:
    return hasattr(before, "clone") and not bool(((before == after) | (before != before)).all())


def _kind(value: Any) -> str:
    return type(value).__name__


def _tell(name: str, problem: str | None) -> None:
    if problem and os.environ.get(SOLUTIONS) == "1":
        raise AssertionError(f"{name}: {problem}")
    print(f"Not yet, {name}: {problem}." if problem else f"Right: {name}.")
