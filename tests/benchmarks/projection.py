"""Snapping an edit, against Eqs. 5-7 as they stand and against solving the small triangle for every edit.

    python tests/benchmarks/projection.py [THREADS]        the table; exit 1 where a goal is missed

n = 2048 points of 16 boxes turned in space, m = 96 handles, k = 64 random fields, one handle pinned. Literal is the
formula with pinv of dense matrices of 3n rows and Q = -(I - AA+), 3n x 3n, in double precision: with nothing kept from
edit to edit, and, as the paper suggests for one handle at a time, with P+ and Q kept. The small triangle is what
remains of n: here P = (I - AA+)B, 96 rows, is known, and a QR of the columns of the free handles is solved for each
edit. A drag is what EditProjector keeps for a selection: one product with a small matrix, giving all handles and v.
The last row is a whole call, which also places 2048 points three times (snapped, broken, by handles alone) and measures
how far they are apart.

All give the same values, which is checked first. Each number is the shortest of several runs in a process of its own;
memory is the peak resident one above that after imports. The clock is judged. The row of the processor's own time
leaves out what the system took to hand out the literal formula's 600 MB, again for every selection: on a machine that
is slow at that, most of its time, and without it the ratio is 15 to 20. THREADS is for numpy's products too, 1 unless
told.
"""

import os
import sys

import numpy as np
import torch
from apart import alone, machine, peak, shortest
from scipy.linalg import qr, solve_triangular

from dsn_lite import BoxHandles, EditProjector

POINTS, K, PARTS, PINNED, SECONDS, LOOP = 2048, 64, 16, 10, 4, 1000
GOALS = {"preparing one handle": 20, "an edit, nothing kept": 1000, "an edit by the small triangle": 100}


def world():
    """A dictionary, box handles of parts turned in space, and which handle is pinned."""
    make = torch.Generator().manual_seed(0)
    rest = torch.rand(POINTS, 3, generator=make, dtype=torch.float64) - 0.5
    turns = torch.linalg.qr(torch.randn(PARTS, 3, 3, generator=make, dtype=torch.float64)).Q
    centres, edges = torch.rand(2, PARTS, 3, generator=make, dtype=torch.float64)
    handles = BoxHandles(torch.arange(POINTS) % PARTS, rest, torch.cat([centres, turns.flatten(1), edges], dim=1))
    A = torch.randn(POINTS, 3, K, generator=make, dtype=torch.float64)
    return A, handles, np.arange(len(handles.names)) == PINNED


class Literal:
    """Eqs. 5-7 word by word for one selection of handles."""

    def __init__(self, A, B, pinned):
        self.B, self.pinned = B, pinned
        unmade = np.eye(len(A)) - A @ np.linalg.pinv(A)
        self.P_plus, self.Q = np.linalg.pinv(unmade @ B[:, ~pinned]), -unmade

    def __call__(self, z):
        """The changes of the free handles for a change z of the pinned one."""
        return self.P_plus @ (self.Q @ (self.B[:, self.pinned] @ z))


def literal(z):
    """Milliseconds: preparing (clock, processor), an edit with nothing kept, with P+ and Q kept; MB; the answer."""
    before, (A, handles, pinned) = peak(), world()
    A, B = A.flatten(0, 1).numpy(), handles.B.flatten(0, 1).numpy()
    prepared = shortest(lambda: Literal(A, B, pinned), SECONDS)
    nothing_kept = shortest(lambda: Literal(A, B, pinned)(z), SECONDS)[0]
    kept = Literal(A, B, pinned)
    times = *prepared, nothing_kept, shortest(lambda: kept(z), SECONDS)[0]
    return times, peak() - before, kept(z)


def ours(z):
    """Milliseconds: preparing (clock, processor), a drag, the small triangle, a whole call; MB; the answers."""
    before, (A, handles, pinned) = peak(), world()
    prepared = shortest(lambda: EditProjector(A, handles).drag(pinned, z), SECONDS)
    edit, change = EditProjector(A, handles), {handles.names[PINNED]: z.item()}
    drag = shortest(lambda: [edit.drag(pinned, z) for _ in range(LOOP)], SECONDS)[0] / LOOP
    P = edit.factor.P
    triangle = shortest(lambda: small_triangle(P, pinned, z), SECONDS)[0]
    called = shortest(lambda: edit(change, change=True), SECONDS)[0]
    answers = edit.drag(pinned, z)[0][~pinned], small_triangle(P, pinned, z)
    return (*prepared, drag, triangle, called), peak() - before, answers


def small_triangle(P, pinned, z):
    """The changes of the free handles, from a QR of their columns of P."""
    Q, R = qr(P[:, ~pinned], mode="economic", check_finite=False)
    return solve_triangular(R, -Q.T @ (P[:, pinned] @ z), check_finite=False)


def table(threads):
    """Print the table; exit status 1 where a goal is missed."""
    z = np.array([0.1])
    (*theirs, nothing_kept, kept), theirs_mb, expected = alone(literal, z)
    (*prepared, drag, triangle, called), ours_mb, answers = alone(ours, z)
    for answer in answers:
        np.testing.assert_allclose(answer, expected, rtol=0, atol=1e-9)
    print(f"{machine(threads)}; numpy {np.__version__}; all answers agree to 1e-9")
    print(f"n = {POINTS}, k = {K}, m = {6 * PARTS}, one handle pinned; milliseconds")
    print(f"{'':<36}{'they':>10}{'dsn_lite':>10}{'ratio':>8}{'goal':>6}")
    rows = {
        "preparing one handle": (theirs[0], prepared[0]),
        "preparing one handle, of processor": (theirs[1], prepared[1]),
        "an edit, nothing kept": (nothing_kept, drag),
        "an edit, P+ and Q kept": (kept, drag),
        "an edit by the small triangle": (triangle, drag),
        "peak memory, MB": (theirs_mb, ours_mb),
    }
    for row, (they, we) in rows.items():
        print(f"{row:<36}{they:>10.3g}{we:>10.3g}{they / we:>8.0f}{GOALS.get(row, ''):>6}")
    print(f"{'a whole call, to points':<36}{'':>10}{called:>10.3g}")
    return int(any(rows[row][0] < goal * rows[row][1] for row, goal in GOALS.items()))


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    torch.set_num_threads(count)
    os.environ |= {f"{name}_NUM_THREADS": str(count) for name in ("OMP", "OPENBLAS", "MKL")}  # of the processes to come
    sys.exit(table(count))
