"""Random handles, dictionaries and edits for the tests of projection, and what slow, obvious solvers make of them."""

import numpy as np
import torch
from hypothesis import strategies as st
from worlds import randn

from dsn_lite.handles import DenseHandles
from dsn_lite.projection import EditProjector

KINDS = ("plain", "some in span", "all in span", "twin handles", "twin columns", "wide A", "full A")


@st.composite
def problems(draw, kinds=KINDS):
    """What `made` takes."""
    n, k, m = draw(st.integers(3, 9)), draw(st.integers(1, 5)), draw(st.integers(2, 7))
    kind, pins, seed = draw(st.sampled_from(kinds)), draw(st.integers(1, m)), draw(st.integers(0, 2**16))
    scales = st.sampled_from([1e-2, 1.0, 1e2])
    return {"seed": seed, "kind": kind, "sizes": (n, k, m), "pins": pins, "scales": (draw(scales), draw(scales))}


def made(problem):
    """A projector, the pinned handles and their changes; `kind` says in which way A or B depend on themselves."""
    seed, kind, (n, k, m) = problem["seed"], problem["kind"], problem["sizes"]
    k = {"wide A": m + 2, "full A": 3 * n + 2}.get(kind, k)
    A, B = randn(seed, n, 3, k), randn(seed + 1, n, 3, m)
    if kind == "some in span":
        B[..., ::2] = A @ randn(seed + 2, k, m)[:, ::2]
    if kind == "all in span":
        B = A @ randn(seed + 2, k, m)
    if kind == "twin handles":
        B[..., -1] = B[..., 0]
    if kind == "twin columns":
        A = torch.cat([A, 2 * A], dim=-1)
    pinned = np.random.default_rng(seed).permutation(m) < problem["pins"]
    edit = EditProjector(A * problem["scales"][0], DenseHandles(B * problem["scales"][1]), randn(seed + 3, n, 3))
    return edit, pinned, randn(seed + 4, problem["pins"]).numpy()


def dense(edit):
    """The paper's matrices A and B."""
    return (each.flatten(0, 1).numpy() for each in (edit.A, edit.handles.B))


def pins(edit, pinned, z):
    """The edit as a person writes it: changes by name."""
    return dict(zip(np.array(edit.handles.names)[pinned].tolist(), z.tolist(), strict=True))


def kkt(edit, pinned, z):
    """r and z by the conditions of Eq. 4: r = B z - A v, B'r = -C'l, A'r = 0, C z = z_in; the shortest solution."""
    A, B = dense(edit)
    (rows, m), k, C = B.shape, A.shape[1], np.eye(len(pinned))[pinned]
    system = np.zeros((rows + m + k + len(C),) * 2)
    r, zs, vs, ls = np.split(np.arange(len(system)), np.cumsum([rows, m, k]))
    for where, block in ((zs, B), (vs, -A)):
        system[np.ix_(r, where)], system[np.ix_(where, r)] = -block, block.T
    system[np.ix_(r, r)], system[np.ix_(zs, ls)], system[np.ix_(ls, zs)] = np.eye(rows), C.T, C
    solved = np.linalg.lstsq(system, np.concatenate([np.zeros(rows + m + k), z]), rcond=1e-11)[0]
    return solved[r], solved[zs]


def literal(edit, pinned, z):
    """Eqs. 5-7 as they stand, but for a cut where pinv would divide by rounding. Gives z_hat, and how unique it is."""
    A, B = dense(edit)
    unmade = np.eye(len(A)) - A @ np.linalg.pinv(A, rcond=1e-12)
    P, c = unmade @ B[:, ~pinned], B[:, pinned] @ z
    U, s, Vt = np.linalg.svd(P, full_matrices=False)
    kept = s > 1e-11 * np.linalg.norm(B, 2)
    found = np.zeros(len(pinned))
    found[pinned], found[~pinned] = z, -(Vt[kept].T / s[kept]) @ (U[:, kept].T @ (unmade @ c))
    return found, kept.all() and len(kept) == (~pinned).sum()
