"""What a person asks for: which handles a pattern means, the values they are pinned at, and bounds of the rest."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase
from typing import Any

import numpy as np
from jaxtyping import Bool, Float

from ..handles import Handles

Bounds = Mapping[str, tuple[float | None, float | None]]


def chosen(names: Sequence[str], pattern: str, where: str) -> list[int]:
    """The handles that a name or a pattern (leg_*.scale.y) means. Raises ValueError, naming near ones, for none."""
    if pattern in names:
        return [names.index(pattern)]
    found = [j for j, name in enumerate(names) if fnmatchcase(name, str(pattern))]
    if not found:
        near = get_close_matches(str(pattern), names, 3, 0.4) or list(names[:3])
        raise ValueError(f"{where}: there is no handle {pattern!r}; did you mean {', '.join(near)}?")
    return found


def pins(handles: Handles, edits: Any, change: bool) -> tuple[Bool[np.ndarray, " m"], Float[np.ndarray, " s"]]:
    """Which handles an edit pins, and their changes; of two patterns that mean one handle, the later counts.

    Raises ValueError where it pins none, or not at a finite number.
    """
    if not isinstance(edits, Mapping) or not edits:
        raise ValueError(
            "edit: it must be a dictionary of handles and their values, at least one, "
            f"got {edits!r}; write {{{handles.names[0]!r}: {handles.z0[0].item():.4g}}}"
        )
    pinned, values = np.zeros(len(handles.names), dtype=bool), handles.z0.detach().cpu().double().numpy()
    values = np.zeros(len(pinned)) if change else -values
    z = np.zeros(len(pinned))
    for pattern, value in edits.items():
        which = chosen(handles.names, pattern, "edit")
        pinned[which], z[which] = True, values[which] + _number(value, "edit", pattern)
    return pinned, z[pinned]


def limits(
    handles: Handles, bounds: Any, pinned: Bool[np.ndarray, " m"], z: Float[np.ndarray, " s"]
) -> tuple[Float[np.ndarray, " m"], Float[np.ndarray, " m"]]:
    """Lowest and highest change of every handle: by its own bounds, tightened by `bounds`, which are values.

    Raises ValueError where none lies between them, or a pinned one does not, with all handles in conflict.
    """
    lower, upper, z0 = (ends.detach().cpu().double().numpy() for ends in (handles.lower, handles.upper, handles.z0))
    lower, upper = lower - z0, upper - z0
    for pattern, ends in _pairs(bounds).items():
        which = chosen(handles.names, pattern, "bounds")
        low, high = (end if end is None else _number(end, "bounds", pattern, open_end=True) for end in ends)
        lower[which] = np.maximum(lower[which], (-np.inf if low is None else low) - z0[which])
        upper[which] = np.minimum(upper[which], (np.inf if high is None else high) - z0[which])
    wanted = np.full(len(z0), np.nan)
    wanted[pinned] = z
    slack = 1e-6 * np.maximum(np.abs(z0), np.abs(wanted + z0))  # a bound may be pinned, rounded to single precision
    conflicts = [
        f"{handles.names[j]} between {lower[j] + z0[j]:.4g} and {upper[j] + z0[j]:.4g}"
        + (f" and pinned at {wanted[j] + z0[j]:.4g}" if pinned[j] else "")
        for j in np.flatnonzero((lower > upper) | (wanted < lower - slack) | (wanted > upper + slack))
    ]
    if conflicts:
        raise ValueError(f"bounds: some value must lie within all bounds, got {'; '.join(conflicts)}; loosen one")
    return lower, upper


def _pairs(bounds: Any) -> Mapping[str, Any]:
    bounds = {} if bounds is None else bounds
    if not isinstance(bounds, Mapping) or not all(
        isinstance(ends, Sequence) and len(ends) == 2 for ends in bounds.values()
    ):
        raise ValueError(
            "bounds: they must be a dictionary of handles and pairs (lowest, highest), None where open, "
            f"got {bounds!r}; write {{'leg_*.scale.y': (0.2, None)}}"
        )
    return bounds


def _number(value: Any, where: str, name: str, open_end: bool = False) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not (np.isfinite(number) or (open_end and np.isinf(number))):
        raise ValueError(
            f"{where}: {name} must be a finite number, got {value!r}; give its value in units of the shape"
        )
    return number
