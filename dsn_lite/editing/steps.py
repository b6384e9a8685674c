"""One edit as a person tells it, and as JSON."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from math import isfinite
from typing import Any


@dataclass(frozen=True)
class Step:
    """The arguments of one edit: pins by name or pattern, values or changes, bounds (None: no end), strength."""

    edits: dict[str, float]
    change: bool = False
    bounds: dict[str, tuple[float | None, float | None]] = field(default_factory=dict)
    strength: float = 1.0

    @classmethod
    def told(cls, edits: Mapping[str, Any], change: Any, bounds: Mapping[str, Any], strength: Any) -> "Step":
        """In plain numbers, whatever kind they came in, with infinite bounds as none."""
        plain = {name: (_end(low), _end(high)) for name, (low, high) in bounds.items()}
        return cls({name: float(value) for name, value in edits.items()}, bool(change), plain, float(strength))

    def to_json(self) -> dict[str, Any]:
        """Plain dictionaries, lists, numbers and True or False."""
        return asdict(self) | {"bounds": {name: list(ends) for name, ends in self.bounds.items()}}


def _end(end: Any) -> float | None:
    return None if end is None or not isfinite(float(end)) else float(end)
