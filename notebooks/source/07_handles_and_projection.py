# %% [markdown]
# # 07 Handles and projection
#
# **Objectives.** By the end you can
# 1. name the handles of a shape, apply $B$, $B^+$ and $BB^+$ without ever forming a matrix, and say why handles break shapes,
# 2. take Eq. 4 apart into Eqs. 5 to 7, compute them, say which of many answers they give, and where floating point gives none,
# 3. hold what a learned space makes of an edit against the truth, edit under bounds, and let other shapes follow.
#
# **Time.** 60 minutes. &nbsp; **Prerequisites.** Lessons 05 and 06. &nbsp; **Paper.** Sections 3.2 (Eqs. 4 to 7) and 4.1 (*Shape Editing Projection and Transfer*).

# %%
import time

import torch

import data_gen
import dsn_lite
from dsn_lite import EditProjector, checks, lessons, metrics, modes, plots, widgets
from dsn_lite.dictionary import residual
from dsn_lite.handles import BoxHandles, DenseHandles, corners

lessons.begin()

# %% [markdown]
# ## 1 Handles
#
# Each part of a shape lies in a box, and a box has six numbers: where its centre is and how long its edges are, along its three axes. A person drags these, so they are called
# **handles**. They go by name, part first:

# %%
torch.set_grad_enabled(False)  # we only look
drawn = data_gen.generate("table/four_legs", count=60, points=512, seed=7)
tables = dsn_lite.as_shapes(drawn)
x, handles = tables.points[0], BoxHandles.of(tables)
names, z0 = handles.names, handles.z0.double()
{name: round(value, 3) for name, value in list(zip(names, z0.tolist(), strict=True))[12:18]}

# %% [markdown]
# A point of a part is $p = R\,(c + s \odot r)$, with $r$ its place in the unit box. That is linear in $c$ and $s$, so there is a matrix with $x = B z_0$, a column a handle:

# %%
B = handles.B.double()
B.shape, (B @ z0 - x).abs().max(), len(names), tables.parameter_names

# %% [markdown]
# Six numbers made this table; thirty handles pull at it. The paper says they *overparametrize*.
#
# $B^+u$ are the changes of handles that come nearest to offsets $u$. With the dense matrix that is a pseudo-inverse; but no point has two parts, and axes do not mix, so it falls apart into
# a regression of two numbers for each part and axis, a shift and a stretch (lesson 08 does one by hand). The same numbers, and the time of each in milliseconds:


# %%
def milliseconds(function, turns=5):
    times = []
    for _ in range(lessons.steps(turns)):
        start = time.perf_counter()
        function()
        times.append(time.perf_counter() - start)
    return 1000 * min(times)


# %%
noise = 0.05 * torch.randn(512, 3, generator=torch.Generator().manual_seed(0))
ways = {"pinv": lambda: torch.linalg.pinv(B.flatten(0, 1)) @ noise.flatten().double()}
ways |= {"two numbers a part and axis": lambda: handles.coordinates(noise)}
both = [way() for way in ways.values()]
(both[0] - both[1]).abs().max(), {said: milliseconds(way) for said, way in ways.items()}

# %% [markdown]
# And $BB^+u$ is what handles can make of $u$: all of a deformation of boxes, and of noise about $\sqrt{m / 3n}$, since handles see $m$ of $3n$ directions.

# %%
stretch = handles.offsets(torch.linspace(-0.1, 0.1, 30))
[metrics.rms(handles.project(u)) / metrics.rms(u) for u in (stretch, noise)], (30 / 1536) ** 0.5

# %% [markdown]
# ## 2 A broken edit
#
# Make one leg shorter: set one handle, and leave the others as they are.

# %%
pinned = torch.tensor([name == "leg_2.scale.y" for name in names])
broken = torch.where(pinned, 0.2, z0)
frames = [corners(handles, z) for z in (z0, broken)]
plots.shapes([x, B @ broken], labels=tables.labels[0], titles=["x", "one handle moved"], boxes=frames)

# %% [markdown]
# The leg shrinks about its middle: it hangs in the air and has let go of the top. The handle did what it was told. What a person meant is a *table* whose leg is 0.2 long, and to know that one
# has to know what tables can do. That is what a dictionary $A_x$ is for.
#
# ## 3 Equations 4 to 7
#
# Let $z$ be *changes* of handles. Some are pinned by the person, $Cz = z_{\text{in}}$; all others are free, and so is $v$. Look for the edit of boxes that comes nearest to something plausible:
# $$\hat z = \operatorname*{argmin}_z \min_v \| B z - A_x v \|^2 \quad \text{so that} \quad C z = z_{\text{in}}. \tag{4}$$
# For this family we know all that is plausible: $A$ with one column a parameter, exact.

# %%
A = torch.from_numpy(data_gen.valid_space(drawn)[0])
A.shape

# %% [markdown]
# **The inner minimum.** For a given $z$ the best $v$ is $A^+Bz$ (exercise 2), and what it leaves is $(I - AA^+)Bz$: the part of the edit that no table can follow.

# %%
A_plus = torch.linalg.pinv(A.flatten(0, 1))
left = B.flatten(0, 1) - A.flatten(0, 1) @ (A_plus @ B.flatten(0, 1))
metrics.rms((left @ (broken - z0)).view(512, 3)), metrics.rms(B @ (broken - z0))

# %% [markdown]
# So of the broken edit hardly anything is a table's. **The pinned handles** are known, so their columns move to the other side: $c = B C z_{\text{in}}$, and with $B'$, the columns of the others,
# $$\hat z' = \operatorname*{argmin}_{z'} \| (I - AA^+)(B'z' + c) \|^2 = P^+ Q c, \qquad P = (I - AA^+)B', \quad Q = -(I - AA^+). \tag{5–7}$$

# %%
P, Qc = left[:, ~pinned], -left[:, pinned] @ (0.2 - z0[pinned])
z = torch.where(pinned, 0.2 - z0, 0)
z[~pinned] = torch.linalg.pinv(P) @ Qc
v = A_plus @ (B @ z).flatten()
frames = [frames[1], corners(handles, z0 + z)]
plots.shapes([B @ broken, x + A @ v], labels=tables.labels[0], titles=["edit", "snapped"], boxes=frames)

# %% [markdown]
# A table again: all legs are 0.2 long, they stand on the floor and hold the top. Nobody said what a leg is. It is perfect, since $A$ is: nothing is left of $Bz - Av$.
# `EditProjector` does the same for one shape, and speaks of handles by name, in values instead of changes:

# %%
edit = EditProjector(A, handles, x)
snapped = edit({"leg_2.scale.y": 0.2})
snapped, (snapped.z_hat - z0 - z).abs().max()

# %% [markdown]
# ## 4 Which of many answers?
#
# Look at $v$, which for this $A$ are changes of the parameters that made the table:

# %%
dict(zip(tables.parameter_names, v.tolist(), strict=True))

# %% [markdown]
# Shorter legs, yes; but the top has become *thicker*. Is that wrong? A lower table with the top as it was also has legs of 0.2, and so has one that is wider besides. All of them solve Eq. 4 with
# nothing left. In numbers: $P$ has 29 columns, and its rank is

# %%
torch.linalg.matrix_rank(P), P.shape[1]

# %% [markdown]
# The pseudo-inverse takes the *shortest* $z'$ of all: rather than moving the top (one large change), it moves it half way and makes it thicker (two small ones). A tie-break, in the unit of handles,
# and nothing more. A person who minds pins more:

# %%
thin = edit({"leg_2.scale.y": 0.2 - z0[pinned].item(), "top.scale.y": 0}, change=True)
titles = ["one handle pinned", "the top's thickness pinned too"]
frames = [corners(handles, each.z_hat) for each in (snapped, thin)]
plots.shapes([snapped.points, thin.points], labels=tables.labels[0], titles=titles, boxes=frames)

# %% [markdown]
# **The trap.** What if the others can do anything they like, because all of them lie in the space? Take as $A$ the columns $B'$ themselves, and lift a leg by 0.1. Then $P = (I - AA^+)B'$ is 0: whatever
# the others do is plausible, nothing forces them, and the shortest $z'$ is 0. Eq. 7 as it is written:

# %%
lift = torch.tensor([name == "leg_2.translation.y" for name in names])
free = B[..., ~lift]
gone = residual(free, B).flatten(0, 1)
literal = torch.linalg.pinv(gone[:, ~lift]) @ (-0.1 * gone[:, lift])
gone[:, ~lift].abs().max(), literal.abs().max()

# %% [markdown]
# In floating point $P$ is not 0 but rounding, and its pseudo-inverse divides by it: the rounding of one thing by the rounding of another. The largest number is how far a part of the table is to move.
# (`pinv` does cut off small singular values, but small *beside the largest of $P$*, and here all of them are noise.) Cut at $3n\,\epsilon\,|B|$ instead, which knows how large rounding is:

# %%
fixed = EditProjector(free, handles, x)({"leg_2.translation.y": 0.1}, change=True)
(fixed.z_hat - z0)[~lift].abs().max()

# %% [markdown]
# ## 5 Once, then live
#
# A person drags, and every frame asks for another $z_{\text{in}}$. The paper notes that $P^+$ and $Q$ can be computed before; they have $3n$ rows all the same. But of $3n$ rows only $k + m$ matter. A
# thin QR of both matrices at once, $[A\;B] = \mathcal{Q}R$, is all that looks at points; since $|Bz - Av| = |R\,[-v; z]|$, the triangle $R$ answers for any pinned handles. And for handles that stay
# pinned while their values move, $\hat z$ and $v$ are *one matrix*, of $m + k$ rows and a column a pin. For a chair of 2048 points and $k = 64$:


# %%
def eqs_5_to_7(A, B, pinned, change):
    left = residual(A, B).flatten(0, 1)
    z = torch.zeros(B.shape[-1]).double()
    z[pinned] = change
    z[~pinned] = torch.linalg.pinv(left[:, ~pinned]) @ (-left[:, pinned] @ change)
    return z, torch.linalg.pinv(A.flatten(0, 1)) @ (B @ z).flatten()


# %%
space = dsn_lite.load("chair")
large = dsn_lite.as_shapes(data_gen.generate("chair/four_legs", count=1, points=2048, seed=1))
whole = EditProjector.of(space, large)
wide, tall = whole.A.double(), whole.handles.B.double()
one = torch.tensor([name == "seat.translation.y" for name in whole.handles.names])
change = torch.tensor([0.1]).double()

# %%
ways = {"Eqs. 5 to 7 as they are written": lambda: eqs_5_to_7(wide, tall, one, change)}
ways |= {"the triangle, once a shape": lambda: EditProjector(wide, whole.handles, whole.x)}
ways |= {"a frame of a drag": lambda: whole.drag(one.numpy(), change.numpy())}
{said: round(milliseconds(way), 4) for said, way in ways.items()}

# %% [markdown]
# The first is what every frame would cost (and it is written kindly: $Q$ itself, $3n \times 3n$, would take 300 MB). The second is paid once a shape, whatever will be pinned; the third is a frame.
# The milliseconds are this computer's, the ratio is the point: all that is slow is done before the drag begins.
#
# ## 6 A learned space
#
# Nobody knows the true dictionary of chairs. Here is the learned one: fourteen kinds of chairs, and neither parts nor boxes are in its input (its sparsity loss looked at them in training). The same edit as with the table, beside what
# the chair's own parameters would have made of it:

# %%
made = data_gen.generate("chair", count=96, points=512, seed=6)
chairs, truth = dsn_lite.as_shapes(made), torch.from_numpy(data_gen.valid_space(made))
four = chairs.families.tolist().index(chairs.about["families"].index("chair/four_legs"))
learned = EditProjector.of(space, chairs, four)
exact = EditProjector(truth[four], learned.handles, learned.x)

# %%
told = {"leg_2.scale.y": 0.6 * learned.handles.z0[learned.handles.names.index("leg_2.scale.y")].item()}
both = [projector(told) for projector in (learned, exact)]
shown = [both[0].edited, *(each.points for each in both)]
frames = [None, *(corners(learned.handles, each.z_hat) for each in both)]
plots.shapes(
    shown, labels=[chairs.labels[four]] * 3, titles=["edit", "snapped, learned", "snapped, exact"], boxes=frames
)

# %% [markdown]
# Look at the two: do all four legs follow? Are they as long as each other? Does the seat stay a board? One edit is an anecdote. So take random edits by the paper's rule (a random handle; translations
# move by up to 0.5, edge lengths by up to a half), snap each with the learned dictionary, with that of the untrained network and with the truth, and ask which share of the motion *no chair of this
# kind can follow*.


# %%
def random_edit(handles, generator):
    j = int(torch.randint(len(handles.names), (), generator=generator))
    by = torch.rand((), generator=generator).item() - 0.5
    start = handles.z0[j].item()
    return {handles.names[j]: start + (by if ".translation." in handles.names[j] else by * start)}


def impossible(points, x, truth):
    u = (points - x).double()
    return metrics.rms(residual(truth, u[..., None])[..., 0]) / max(metrics.rms(u), 1e-9)


# %%
def snaps(i):
    """One random edit of chair i, snapped in every way."""
    handles = BoxHandles.of(chairs, i)
    told = random_edit(handles, generator)
    found = {said: EditProjector.of(each, chairs, i)(told) for said, each in spaces.items()}
    found["exact"] = EditProjector(truth[i], handles, chairs.points[i])(told)
    return {"not snapped": found["exact"].edited} | {said: each.points for said, each in found.items()}


# %%
spaces, generator = {"untrained": space.untrained(), "learned": space}, torch.Generator().manual_seed(0)
found = [snaps(i) for i in range(lessons.steps(30))]
shares = {
    said: [impossible(each[said], chairs.points[i], truth[i]) for i, each in enumerate(found)] for said in found[0]
}

# %%
medians = {said: torch.tensor(each).median().item() for said, each in shares.items()}
plots.bars(medians, x="snapped by", y="no chair can follow, share")

# %% [markdown]
# That is the median over the edits. The gap between *learned* and *exact* is what training has not found; that between *untrained* and *learned* is what it has. Lesson 13 asks the same about structure: are
# the four legs still alike, do parts still touch?
#
# ## 7 Bounds
#
# Linear algebra knows no edges. Push the top of the table down by 0.5, farther than its legs are long:

# %%
down = torch.tensor([name == "top.translation.y" for name in names]).numpy()
change, _ = edit.drag(down, torch.tensor([-0.5]).numpy())
inside_out = z0 + torch.from_numpy(change)
edges = {name: value for name, value in zip(names, inside_out.tolist(), strict=True) if ".scale." in name}
min(edges.items(), key=lambda edge: edge[1])

# %% [markdown]
# An edge of negative length is a box turned inside out. So edges stay above 0 unless you say otherwise, and Eq. 4 gets a second constraint. It is still a convex problem, and a tiny one:
# with $P$ in place of $3n$ rows a least squares with bounds (an *active set*) takes milliseconds. Only when a bound is met, of course: while none is, the matrix of the drag has the answer.

# %%
held = edit({"top.translation.y": -0.5}, change=True)
held

# %%
frames = [corners(handles, each) for each in (inside_out, held.z_hat)]
titles = ["without bounds", "edge lengths above 0"]
plots.shapes([handles.offsets(inside_out), held.by_handles], labels=tables.labels[0], titles=titles, boxes=frames)

# %% [markdown]
# With bounds no table fits any more: what is left, $|B\hat z - Av|$, is no longer 0, and that is the honest answer. Bounds of your own go by name too. What contradicts itself is refused, in words:

# %%
edit({"leg_2.scale.y": 0.2}, bounds={"top.scale.y": (None, 0.06)}).z_hat[names.index("top.scale.y")].item()

# %%
lessons.error_of(lambda: edit({"leg_2.scale.y": 0.2}, bounds={"leg_*.scale.y": (0.3, None)}))

# %% [markdown]
# ## 8 Any linear handles
#
# Nothing so far needs boxes. Put the chair in a cage of eight corners, and let each point follow them by how near it is to each (trilinear weights): a lattice, 24 handles, and a dense $B$.

# %%
from itertools import product

corner = torch.tensor(list(product((0, 1), repeat=3)))
t = (learned.x - learned.x.amin(0)) / (learned.x.amax(0) - learned.x.amin(0))
weights = (corner * t[:, None] + (1 - corner) * (1 - t[:, None])).prod(-1)
called = [f"corner_{''.join(map(str, c.tolist()))}.{axis}" for c in corner for axis in "xyz"]
lattice = DenseHandles(torch.einsum("nc,ab->nacb", weights, torch.eye(3)).flatten(2), names=called)

# %%
bent = EditProjector(learned.A, lattice, learned.x)({"corner_110.y": 0.3})
shown, titles = [learned.x, bent.edited, bent.points], ["x", "one corner raised", "snapped"]
plots.shapes(shown, labels=[chairs.labels[four]] * 3, titles=titles)

# %% [markdown]
# A lattice stretches everything towards that corner of the back, and no chair does that. The snap keeps what chairs can do of it, and the corner handle is at 0.3 as it was told.
#
# ## 9 The others follow
#
# The snap gives handles for this chair, and it gives $v$. Handles are of one shape: a stool has no `back.scale.y`. But $v$ acts on all shapes, each through its own dictionary, and that is the
# paper's transfer: $z \oplus v = z + A_z v$. `co_edit` does both. Five other chairs:

# %%
kinds = ("four_legs", "arms", "ladder_back", "sled", "rocking", "swivel")
rows = [chairs.families.tolist().index(chairs.about["families"].index(f"chair/{kind}")) for kind in kinds]
source, others = chairs[rows[0]], chairs[torch.tensor(rows[1:])]
raised = dsn_lite.co_edit(space, source, {"seat.translation.y": 0.12}, others, change=True)
[round(one.moved, 3) for one in raised.others], round(raised.moved, 3)

# %% [markdown]
# That is how far each of them moved (rms), and how far the source did. Now with your hands. `HandleEditor` keeps everything that a drag needs; every drag is an edit from where the last one ended, and
# undo goes back. *Strength* is how far the others follow. The line below the buttons says how far the snap went, and which bounds it met.
#
# **Predict first.** (1) Shorten one leg (`leg 2`, `scale y`): will the other three be as short as that one, and what will the sled and the swivel chair do, which have no such legs?
# (2) Raise the back (`back`, `scale y`): does the seat stay where it is? (3) Push the seat sideways (`translation x`): what *can* a chair do with that?

# %%
editor = widgets.HandleEditor(space, source, others, titles=kinds[1:])
editor.name = "leg_2.scale.y"
editor

# %% [markdown]
# What you see on the left is what handles alone would do, with the box you pulled at. In numbers, what the first question comes to, as changes of the four legs' lengths:

# %%
shorter = dsn_lite.co_edit(space, source, {"leg_2.scale.y": -0.1}, others, change=True).source
by = dict(zip(shorter.names, (shorter.z_hat - shorter.z0).tolist(), strict=True))
{name: round(by[name], 3) for name in by if name.startswith("leg") and name.endswith("scale.y")}

# %% [markdown]
# The pinned leg is where it must be; that the other three are as short, only training can teach, and so far as these numbers differ it has not. A person helps by pinning all of them at once, by a
# pattern:

# %%
four_pinned = dsn_lite.co_edit(space, source, {"leg_*.scale.y": -0.1}, others, change=True)
kind = torch.tensor([modes.kinds(chairs.part_names).index(modes.kind(name)) for name in chairs.part_names])
plots.shapes(
    [four_pinned.source.points, *(one.points for one in four_pinned.others)],
    labels=[kind[one.long()] for one in (source.labels[0], *others.labels)],
    titles=kinds,
)

# %% [markdown]
# Edits add up because actions do, $(x \oplus v) \oplus w = x \oplus (v + w)$. So a session of edits is a list of vectors; `editor.history` can be saved, opened elsewhere, and replayed.
#
# **On meshes.** From a terminal, with any mesh whose parts are separate (a GLB from a modelling tool, say):
# ```
# python -m dsn_lite edit chair MESH.glb --list
# python -m dsn_lite edit chair MESH.glb --set leg_2.scale.y=0.3 -o EDITED.glb
# ```
# The handles come from the parts' boxes, the dictionary is evaluated at the vertices, and faces, colours and names stay. With `--by-boxes` each part follows its box, $B\hat z$, and stays as crisp as it was:

# %%
rig = data_gen.family("chair/four_legs")
solid = data_gen.mesh("chair/four_legs", rig.middle[0])
by_network = dsn_lite.meshes.edit(space, solid, {"seat.translation.y": 0.12}, change=True)
by_boxes = dsn_lite.meshes.edit(space, solid, {"seat.translation.y": 0.12}, change=True, by_boxes=True)
plots.meshes([solid, by_network.mesh, by_boxes.mesh], titles=["x", "x + A v", "B z"])

# %% [markdown]
# ## 10 Exercises
#
# **1.** Handles alone can keep a leg attached, if you know how. Which changes of *two* handles shorten `leg_2` by 0.1 while its upper end stays? (`dict` of names and changes.)

# %%
# solution
changes = {"leg_2.scale.y": -0.1, "leg_2.translation.y": 0.05}


# %%
def attached(changes):
    z = torch.tensor([changes.get(name, 0.0) for name in names]).double()
    before, after = (corners(handles, each)[2, :, 1] for each in (z0, z0 + z))
    if abs((after.max() - after.min()) - (before.max() - before.min()) + 0.1) > 1e-4:
        yield "leg_2 must be 0.1 shorter; set leg_2.scale.y"
    if abs(after.max() - before.max()) > 1e-4:
        yield f"its upper end moves by {after.max() - before.max():+.3f}; a box shrinks about its centre"


checks.accepted(changes, attached, "changes")

# %% [markdown]
# **2.** The inner minimum: the `nearest` $v$ with $Av$ nearest to the broken edit `u`, of the table.

# %%
u = B @ (broken - z0)
# solution
nearest = torch.linalg.lstsq(A.flatten(0, 1), u.flatten()).solution

# %%
wrong = {"A^T u would do if the columns of A were orthonormal": A.flatten(0, 1).mT @ u.flatten()}
checks.array(nearest, A_plus @ u.flatten(), "nearest", hints=wrong)

# %% [markdown]
# **3.** The projection as a function: from `A` $(3n, k)$, `B` $(3n, m)$, `pinned` $(m)$ true or false, and the `change` of the pinned handles, the changes $\hat z$ $(m)$ of all.


# %%
# the changes of all handles
# solution
def snap(A, B, pinned, change):
    left = B - A @ (torch.linalg.pinv(A) @ B)
    z = torch.zeros(B.shape[1], dtype=B.dtype)
    z[pinned] = change
    z[~pinned] = -torch.linalg.pinv(left[:, ~pinned]) @ (left[:, pinned] @ change)
    return z


# %%
two = pinned | torch.tensor([name == "top.scale.x" for name in names])
flat = A.flatten(0, 1), B.flatten(0, 1)
asked = [(*flat, pinned, torch.tensor([-0.1]).double()), (*flat, two, torch.tensor([0.2, -0.1]).double())]
by_projector = lambda A, B, pinned, change: torch.from_numpy(edit.drag(pinned.numpy(), change.numpy())[0])
checks.function(snap, by_projector, asked, "snap")

# %% [markdown]
# **4.** In how many directions can $z'$ still move at no cost, on this table, (a) when only `leg_2.scale.y` is pinned, (b) when `top.scale.y` is pinned too? (Section 4 has the numbers for the first.)

# %%
# solution
one_pin, two_pins = 5, 4

# %%
thick = pinned | torch.tensor([name == "top.scale.y" for name in names])
idle = [int((~pins).sum() - torch.linalg.matrix_rank(left[:, ~pins])) for pins in (pinned, thick)]
checks.number(one_pin, idle[0], "one_pin", hints={"that is the rank of P": 24, "one of the six is pinned": 6})
checks.number(two_pins, idle[1], "two_pins")

# %% [markdown]
# A table has six parameters, and each pin that asks for something new takes one of them. Pin the same length of three legs and you have still taken only one: what can be said twice without contradiction is
# what the space holds to be the same.
#
# ## Take-away
#
# - Handles are linear, $x = Bz_0$, and can do far more than a shape should. An edit of one handle alone nearly always breaks something.
# - Eq. 4 looks for the edit of all handles that comes nearest to something plausible. With an exact dictionary it is perfect; with a learned one it is as good as the dictionary.
# - All of it is in one small triangle, computed once a shape; a drag is a product with one small matrix, and a bound costs a small least squares.
# - $\hat z$ is of one shape, $v$ is of all: that is why an edit can be passed on.
#
# ## What the paper does not say
#
# - Which of many answers is meant where $P$ is rank-deficient, as it is whenever $A$ allows more than the person asked for. Eq. 7 takes the shortest $z'$, which depends on the units of handles.
# - That in floating point $P^+$ needs a cut-off which knows the size of $B$.
# - Which $v$ is passed on when the columns of $A_x$ depend on each other: the source cannot tell them apart, but another shape may. Ours is the shortest.
# - Whether $x + A_x v$ or $B\hat z$ is shown. They differ by what is left of Eq. 4.
# - What was done to bounds in its experiments, beyond that "scale parameters must be positive".
