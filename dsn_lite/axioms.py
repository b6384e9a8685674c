"""How far a space is from each law of Section 3.1, as rms residuals in the unit of the shapes.

The three axioms and four derived laws are functions that return numbers; tests assert them, notebooks plot them and
`report` puts them in one table. Names are plain because the paper's are not always the usual ones: its "free" action is
what others call the identity law, and its "transitive" names an axiom and a derived law.

A law about vectors (xx = 0, say) is measured by how far the left-over vector moves x, so that all residuals share one
unit.
"""

from dataclasses import dataclass
from typing import Any

import torch

from .chamfer import chamfer
from .data import Shapes, triplets, true_deformation
from .dictionary import rank
from .files import as_shapes
from .metrics import rms
from .space import ActionSpace, DoNothing
from .types import OtherPoints, Points, Vector


def gap(a: Points, b: OtherPoints, corresponds: bool) -> float:
    """Distance of two shapes: rms over points in correspondence, else sqrt(Ch / 2), rms to the nearest neighbour."""
    return rms(a - b) if corresponds else (chamfer(a, b).mean() / 2).sqrt().item()


def moved_by(space: ActionSpace, x: Points, v: Vector) -> float:
    """How far v moves x, rms."""
    return rms(space.act(x, v) - space.act(x, torch.zeros_like(v)))


def zero_acts_trivially(space: ActionSpace, x: Points) -> float:
    """x (+) 0 = x, the paper's "free action"."""
    return rms(space.act(x, torch.zeros_like(space.vector(x, x))) - x)


def actions_add(space: ActionSpace, x: Points, u: Vector, v: Vector) -> float:
    """(x (+) u) (+) v = x (+) (u + v), the paper's "additive action"."""
    return rms(space.act(space.act(x, u), v) - space.act(x, u + v))


def target_is_reached(space: ActionSpace, x: Points, y: OtherPoints, *, corresponds: bool) -> float:
    """x (+) xy = y, the paper's "transitive action" (that xy is unique is a matter of rank, see `report`)."""
    return gap(space.deform(x, y), y, corresponds)


def self_vector_is_zero(space: ActionSpace, x: Points) -> float:
    """xx = 0, the paper's "identity"."""
    return moved_by(space, x, space.vector(x, x))


def reversal_negates(space: ActionSpace, x: Points, y: Points) -> float:
    """xy = -yx, the paper's "anticommutativity"."""
    return moved_by(space, x, space.vector(x, y) + space.vector(y, x))


def triangle_closes(space: ActionSpace, x: Points, y: Points, z: Points) -> float:
    """xy + yz + zx = 0, the paper's "transitivity"."""
    return moved_by(space, x, space.vector(x, y) + space.vector(y, z) + space.vector(z, x))


def parallelogram_closes(space: ActionSpace, x: Points, y: Points, z: Points, *, corresponds: bool) -> float:
    """z (+) xy = y (+) xz: both ways round the parallelogram give one shape."""
    return gap(space.transfer(x, y, z), space.transfer(x, z, y), corresponds)


AXIOMS = {"zero_acts_trivially": "x (+) 0 = x", "actions_add": "(x (+) u) (+) v = x (+) (u + v)"}
AXIOMS["target_is_reached"] = "x (+) xy = y"
DERIVED = {"self_vector_is_zero": "xx = 0", "reversal_negates": "xy = -yx", "triangle_closes": "xy + yz + zx = 0"}
DERIVED["parallelogram_closes"] = "z (+) xy = y (+) xz"
LAWS = AXIOMS | DERIVED


@torch.no_grad()
def residuals(space: ActionSpace, x: Shapes, y: Shapes, z: Shapes) -> dict[str, float]:
    """The seven residuals on triplets; where the true deformation is known it is the target, sample by sample."""
    px, py, pz, same = x.points, y.points, z.points, x.corresponds
    known = x.truth_is_known
    return {
        "zero_acts_trivially": zero_acts_trivially(space, px),
        "actions_add": actions_add(space, px, space.vector(px, py), space.vector(px, pz)),
        "target_is_reached": gap(space.deform(px, py), true_deformation(x, y) if known else py, known or same),
        "self_vector_is_zero": self_vector_is_zero(space, px),
        "reversal_negates": reversal_negates(space, px, py),
        "triangle_closes": triangle_closes(space, px, py, pz),
        "parallelogram_closes": parallelogram_closes(space, px, py, pz, corresponds=same),
    }


@dataclass(frozen=True)
class Row:
    """One law: its residual, whether it holds by construction, and what two spaces that know nothing score."""

    law: str
    statement: str
    kind: str
    residual: float
    untrained: float
    do_nothing: float


@dataclass(frozen=True)
class Report:
    """The table of laws for one space; print it, show it in a notebook, or plot it with plots.axiom_bars."""

    rows: tuple[Row, ...]
    k: int | None
    rank: int | None  # smallest rank of A over the shapes: xy is unique only if it is k
    spread: float  # typical distance of two shapes: a residual of this size means nothing was learned
    moved: float  # how far a vector xy moves x, rms: a residual means little where nothing moves
    notes: tuple[str, ...]

    def __getitem__(self, law: str) -> float:
        return next(row.residual for row in self.rows if row.law == law)

    def __str__(self) -> str:
        head = f"{'law':<21} {'statement':<31} {'holds by':<13} {'residual':>9} {'untrained':>9} {'do nothing':>10}"
        lines = [head, "-" * len(head)]
        for row in self.rows:
            numbers = f"{row.residual:9.2e} {row.untrained:9.2e} {row.do_nothing:10.2e}"
            lines.append(f"{row.law:<21} {row.statement:<31} {row.kind:<13} {numbers}")
        return "\n".join([*lines, *self.notes])

    def _repr_html_(self) -> str:
        columns = ("law", "statement", "holds by", "residual", "untrained", "do nothing")
        left = "<td style='text-align:left'>"
        head = "".join(f"<th style='text-align:left'>{column}</th>" for column in columns)
        body = "".join(
            f"<tr>{left}{row.law.replace('_', ' ')}</td>{left}{row.statement.replace('(+)', '&oplus;')}</td>"
            f"{left}{row.kind}</td>"
            f"<td>{row.residual:.1e}</td><td>{row.untrained:.1e}</td><td>{row.do_nothing:.1e}</td></tr>"
            for row in self.rows
        )
        notes = "".join(f"<p>{note}</p>" for note in self.notes)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{notes}"


@torch.no_grad()
def report(space: ActionSpace, shapes: Any, *, triplets_drawn: int = 64, seed: int = 0) -> Report:
    """Every axiom and derived law of Section 3.1 on random triplets, beside the untrained and the do-nothing space.

    `shapes` is a collection or a plain array (N, n, 3). Raises ValueError where there are fewer than three shapes.
    """
    drawn = triplets(as_shapes(shapes).like(space), triplets_drawn, seed)
    random = space.untrained(seed)
    scores = [residuals(each, *drawn) for each in (space, random, DoNothing())]
    rows = tuple(
        Row(law, statement, "construction" if law in space.by_construction else "learning", *(s[law] for s in scores))
        for law, statement in LAWS.items()
    )
    A = space.dictionary(drawn[0].points[:8]) if hasattr(space, "dictionary") else None
    k, smallest = (None, None) if A is None else (A.shape[-1], int(rank(A).min()))
    spread = scores[2]["target_is_reached"]
    x, y = drawn[0].points, drawn[1].points
    moved, unmoved = (moved_by(each, x, each.vector(x, y)) for each in (space, random))
    lengths = (
        f"Residuals are rms lengths. Two of these shapes are {spread:.2g} apart; a vector xy moves x by {moved:.2g}, "
        f"in the untrained space by {unmoved:.2g}. Who moves nothing adds up perfectly."
    )
    return Report(rows, k, smallest, spread, moved, (lengths, *_notes(space, drawn[0], k, smallest)))


def _notes(space: ActionSpace, x: Shapes, k: int | None, smallest: int | None) -> tuple[str, ...]:
    notes = []
    if k is not None:
        unique = "so every vector is unique" if smallest == k else "so vectors are not unique: some do nothing"
        notes.append(f"rank(A) is {smallest} of k = {k}, {unique}.")
    if not x.corresponds:
        notes.append(
            "The shapes share no samples: the parallelogram is measured to nearest neighbours, where even the right "
            "answer does not score 0."
        )
    return (*notes, *space.remarks)
