"""What is wrong with an answer, in one sentence: its type, shape, sign, factor, power, order or precision."""

from collections.abc import Iterator
from math import sqrt
from typing import Any

import numpy as np
from torch import Tensor

OPEN = "still open: put your code where the dots are"


def diagnose(
    answer: Any, expected: Any, *, hints: dict | None = None, factors: dict | None = None, tolerance: float = 1e-4
) -> str | None:
    """None where the answer is right to a relative tolerance, else a sentence without its full stop."""
    problem = unfinished(answer) or _not_numbers(answer)
    if problem:
        return problem
    given, right = _numbers(answer), _numbers(expected)
    problem = _infinite(given)
    if given.shape == right.shape and not problem and _near(given, right, tolerance):
        return None
    return problem or _recognise(given, right, hints or {}, factors or {}, tolerance)


def unfinished(answer: Any) -> str | None:
    """The sentence for an answer that is still `...`, or None."""
    return OPEN if answer is ... else None


def _recognise(given: np.ndarray, right: np.ndarray, hints: dict, factors: dict, tolerance: float) -> str:
    """The sentence for finite numbers that are wrong."""
    for sentence, wrong in hints.items():
        wrong = _numbers(wrong)
        if given.shape == wrong.shape and _near(given, wrong, tolerance):
            return sentence.rstrip(".")
    if given.shape != right.shape:
        return _shape(given, right, tolerance)
    sizes = {f"{size} (the size of axis {axis})": float(size) for axis, size in enumerate(right.shape) if size > 1}
    looks = (_precision, _sign, _power, _order, _shift)
    found = next((said for look in looks if (said := look(given, right, tolerance))), None)
    return (
        found
        or _factor(given, right, {name: float(value) for name, value in (factors | sizes).items()}, tolerance)
        or _elsewhere(given, right, tolerance)
    )


def _not_numbers(answer: Any) -> str | None:
    """The sentence for what cannot be compared with numbers."""
    if answer is None:
        return "it is None; the last step has no result, or a function has no return"
    if callable(answer):
        return "it is a function, not its value; call it"
    if isinstance(answer, (list, tuple)) and any(isinstance(each, Tensor) for each in answer):
        return "it is a list of tensors; join them with torch.stack"
    try:
        numbers = _numbers(answer)
    except (TypeError, ValueError, RuntimeError):
        return f"it must be a tensor of numbers, not a {type(answer).__name__}"
    if numbers.dtype == bool:
        return "it holds True and False, not numbers"
    return None


def _numbers(values: Any) -> np.ndarray:
    array = values.detach().cpu().numpy() if isinstance(values, Tensor) else np.asarray(values)
    if array.dtype.kind not in "biuf":
        raise TypeError
    return array if array.dtype == bool else array.astype(np.float64)


def _infinite(given: np.ndarray) -> str | None:
    bad = int((~np.isfinite(given)).sum())
    what = "NaN" if np.isnan(given).any() else "infinity"
    return (
        f"{bad} of its {given.size} numbers are {what}; look for a division by 0 or a root of a negative"
        if bad
        else None
    )


def _near(given: Any, right: Any, tolerance: float) -> bool:
    """Whether two arrays of one shape agree to a share of the rms of the right one, or, where that is 0, absolutely."""
    size = sqrt(float(np.mean(right**2))) if right.size else 0.0
    return bool((np.abs(given - right) <= tolerance * (size or 1.0)).all())


def _shape(given: np.ndarray, right: np.ndarray, tolerance: float) -> str:
    said = f"its shape is {given.shape}, it should be {right.shape}"
    if sorted(given.shape) == sorted(right.shape):
        return f"{said}; axes are swapped, try .mT or .permute"
    if given.size == right.size and tuple(s for s in given.shape if s > 1) == tuple(s for s in right.shape if s > 1):
        return f"{said}; squeeze or unsqueeze the axis of size 1"
    if given.ndim < right.ndim and not given.ndim:
        return f"{said}; a sum or mean went over all axes, name the axis with dim="
    if given.ndim < right.ndim:
        return f"{said}; an axis is lost, look for a sum or mean over it, or an index"
    if given.ndim > right.ndim:
        return f"{said}; an axis is left over, look for a missing sum, mean or index"
    return said


def _precision(given: np.ndarray, right: np.ndarray, tolerance: float) -> str | None:
    if tolerance < 1e-6 and _near(given, right, 1e-5):
        return "it is right in single precision only; compute in float64, with .double() at the start"
    return None


def _sign(given: np.ndarray, right: np.ndarray, tolerance: float) -> str | None:
    if _near(-given, right, tolerance):
        return "its sign is flipped; a difference is taken the wrong way round"
    return "only its size is right, signs are lost" if _near(np.abs(given), np.abs(right), tolerance) else None


def _power(given: np.ndarray, right: np.ndarray, tolerance: float) -> str | None:
    if (right < 0).any():
        return None
    if _near(given, right**2, tolerance):
        return "it is the square of the right answer; take the root"
    return "it is the root of the right answer; leave out the root" if _near(given, np.sqrt(right), tolerance) else None


def _order(given: np.ndarray, right: np.ndarray, tolerance: float) -> str | None:
    """Rows, or columns, in another order."""
    for what, a, b in (("rows", given, right), ("columns", given.T, right.T)):
        if right.ndim < (1 if what == "rows" else 2):
            continue
        flat, straight = a.reshape(len(a), -1), b.reshape(len(b), -1)
        if _near(flat[np.lexsort(flat.T)], straight[np.lexsort(straight.T)], tolerance):
            return f"its {what} are right but in another order"
    return None


def _shift(given: np.ndarray, right: np.ndarray, tolerance: float) -> str | None:
    """The same number, or the same row, added everywhere."""
    off = given - right
    if right.size > 1 and _near(off - off.mean(), 0 * right, tolerance * float(np.abs(off).max())):
        return f"it is off by {off.mean():.3g} everywhere; something is added too much or forgotten"
    if right.ndim > 1 and len(right) > 1 and _near(off - off.mean(0), 0 * right, tolerance * float(np.abs(off).max())):
        return "every row is off by the same; something is added too much or forgotten, such as the mean or x itself"
    return None


def _factor(given: np.ndarray, right: np.ndarray, names: dict[str, float], tolerance: float) -> str | None:
    """One factor everywhere, by name where it has one."""
    square = float((right * right).sum())
    factor = float((given * right).sum()) / square if square else 0.0
    if not factor or not _near(given / factor, right, tolerance):
        return None
    known = next((name for name, value in _factors(names) if abs(abs(factor) / value - 1) < 10 * tolerance), None)
    if known is None and right.size == 1:
        return None  # any number is some multiple of any other
    sign = ", and its sign is flipped" if factor < 0 else ""
    return f"it is {known or f'{abs(factor):.4g}'} times the right answer{sign}"


def _factors(names: dict[str, float]) -> Iterator[tuple[str, float]]:
    for name, value in (names | {"2": 2.0, "3": 3.0, "100": 100.0}).items():
        yield from ((name, value), (f"1 / {name}", 1 / value))
        yield from ((f"the root of {name}", sqrt(value)), (f"1 / the root of {name}", 1 / sqrt(value)))


def _elsewhere(given: np.ndarray, right: np.ndarray, tolerance: float) -> str:
    off = np.abs(given - right)
    size = sqrt(float(np.mean(right**2))) or 1.0
    if not right.ndim:
        return f"{float(given):.4g} is not the right number"
    wrong = int((off > tolerance * size).sum())
    worst = tuple(int(i) for i in np.unravel_index(off.argmax(), off.shape))
    return f"{wrong} of its {right.size} numbers are wrong, most of all at {list(worst)}, which is {given[worst]:.4g}"
