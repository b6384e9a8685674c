# %% [markdown]
# # 03 Known correspondences: PCA
#
# **Objectives.** By the end you can
# 1. build the deformation space of Eq. 1 from corresponding shapes with one singular value decomposition,
# 2. prove, and measure, that a *shared* dictionary keeps every law,
# 3. show what is lost when the correspondence is lost.
#
# **Time.** 40 minutes. &nbsp; **Prerequisites.** Lesson 02; the singular value decomposition. &nbsp; **Paper.** Section 3.1, Eq. 1.

# %%
import torch

import data_gen
from dsn_lite import LinearSpace, Shapes, axioms, checks, lessons, plots, widgets
from dsn_lite.data import triplets, true_transfer
from dsn_lite.files import as_shapes

lessons.begin()

# %% [markdown]
# ## 1 Shapes whose points correspond
#
# Two hundred tables with four legs. Six numbers make a table: width, height, depth, the thickness of the top, and two of the legs.
# The samples are *shared*: point $i$ lies at the same spot of the same part in every table. Real collections never come like this.

# %%
tables = as_shapes(
    data_gen.generate("table/four_legs", count=200, points=400, seed=3, sampling="shared", dtype="float64")
)
x = tables.points
x.shape, tables.parameter_names

# %%
plots.shapes(x[:4], labels=tables.labels, part_names=tables.part_names, titles=[f"table {i}" for i in range(4)])

# %% [markdown]
# ## 2 Eq. 1: one dictionary for all
#
# If points correspond, a deformation is a list of offsets, one a point, and offsets can be added to any shape:
# $$x \oplus v = A v + x.$$
# $A$ should span the differences that occur. Put the shapes as rows of a matrix, take away the mean, and the
# right singular vectors are those directions, the most useful first: principal component analysis.

# %%
mean = x.mean(0)
rows = (x - mean).flatten(1)
rows.shape

# %%
axes = torch.linalg.svd(rows, full_matrices=False)
plots.spectrum(axes.S[:20])

# %% [markdown]
# Six singular values, then nothing (the rest is rounding): the six parameters, seen without anyone telling. The dictionary is the first
# six directions. We scale columns to unit *root mean square*: one unit of $v_j$ moves the points by 1 on average, whatever $n$ is.

# %%
space = LinearSpace.fit(x, k=6)
space.A.shape, axes.S[5] / axes.S[6]

# %% [markdown]
# **Predict first.** The first axis is the direction in which tables differ most. Which of the six parameters will it move: one of them,
# or several together? And does the slider keep the legs attached to the top?

# %%
widgets.DictionarySliders(space, x[:2], vectors=space.vector(x[:1], x))

# %% [markdown]
# Principal axes are not parameters: they mix those that vary much. Their order is that of the spread, and their sign is arbitrary,
# so a colleague's first slider may run the other way. Any rotation $A R$ with $R^{-1} v$ gives the same shapes.

# %%
plots.modes(x[0], space.A, columns=range(4), amount=0.12)

# %% [markdown]
# How many columns are needed? With $k$ columns the target is missed by what lies outside their span.

# %%
missed = {k: axioms.target_is_reached(LinearSpace.fit(x, k), x[:100], x[100:], corresponds=True) for k in range(1, 8)}
missed

# %%
plots.bars(missed, x="columns k", y="distance to the target, rms")

# %% [markdown]
# ## 3 Why every law holds
#
# Additivity is one line, and it uses that $A$ is the *same* matrix in both steps:
# $$(x \oplus u) \oplus v = A v + (A u + x) = A (u + v) + x = x \oplus (u + v).$$
# With $A_x$ in its place the line would read $A_{x \oplus u} v + A_x u + x$, and there it ends.

# %%
u, v = space.vector(x[0], x[1]), space.vector(x[0], x[2])
space.act(space.act(x[0], u), v) - space.act(x[0], u + v)

# %%
axioms.report(space, tables)

# %%
plots.axiom_bars(axioms.report(space, tables))

# %% [markdown]
# Every residual is rounding in double precision, about $10^{-15}$. In single precision the same shapes give some $10^{-8}$: the law is
# as exact as the numbers.

# %%
single = Shapes(points=x.float(), about=tables.about)
axioms.report(LinearSpace.fit(single.points, 6), single)["actions_add"]

# %% [markdown]
# Transfer has a right answer here: add the *parameters'* difference to the third table. The space knows nothing of parameters, and agrees.

# %%
a, b, c = triplets(tables, 3, with_truth=True)
moved = space.transfer(a.points, b.points, c.points)
axioms.gap(moved, true_transfer(a, b, c), corresponds=True)

# %%
plots.shapes([a.points[0], b.points[0], c.points[0], moved[0]], labels=tables.labels, titles=["x", "y", "z", "z ⊕ xy"])

# %% [markdown]
# ## 4 Without correspondence
#
# Now shuffle the points of each table. As *sets* nothing has changed: you could not tell the pictures apart.

# %%
generator = torch.Generator().manual_seed(0)
orders = torch.rand(x.shape[:2], generator=generator).argsort(1)
shuffled = torch.take_along_dim(x, orders.unsqueeze(-1), dim=1)
plots.shapes([x[0], shuffled[0]], titles=["in order", "shuffled"])

# %% [markdown]
# **Predict first.** Will the spectrum of the shuffled tables have six large values, more, or fewer?

# %%
lost = torch.linalg.svd((shuffled - shuffled.mean(0)).flatten(1), full_matrices=False)
plots.spectrum(lost.S[:20])

# %% [markdown]
# No cliff any more: the differences of shuffled lists fill every direction. **Predict first:** what will a slider do to a table now?

# %%
wrong = LinearSpace.fit(shuffled, k=6)
widgets.DictionarySliders(wrong, shuffled[:2], vectors=wrong.vector(shuffled[:1], shuffled))

# %% [markdown]
# The laws that hold by construction do not notice. Reaching the target and closing the parallelogram do: measured between sets, to nearest neighbours,
# two thirds of the distance of two tables is left. *A law that holds by construction tells you nothing about the data.*

# %%
plots.axiom_bars(axioms.report(wrong, Shapes(points=shuffled)))

# %% [markdown]
# This is the situation of the paper: shapes as sets, and no order to lean on. Its answer is to let a network predict a dictionary for each
# shape, $A_x = \mathcal{F}(x)$, row by row from where a point lies. Lesson 05 trains one.
#
# ## 5 Exercises
#
# **1.** Your own PCA: the first two principal axes of the tables as a dictionary of shape `(400, 3, 2)`, columns of unit root mean square
# (mean over the points of the squared length is 1).

# %%
# solution
two = (axes.Vh[:2] * 400**0.5).T.reshape(400, 3, 2)

# %%
ours = space.A[..., :2]
signs = [1, -1], [-1, 1], [-1, -1]
flipped = {f"right but for signs, which are arbitrary: ours is times {s}": ours * torch.tensor(s) for s in signs}
checks.array(two, ours, "two", hints=flipped)

# %% [markdown]
# **2.** The smallest $k$ for which the columns carry 99 % of the variance (variance is the *square* of a singular value).

# %%
# solution
share = axes.S.square().cumsum(0) / axes.S.square().sum()
k_99 = int((share < 0.99).sum()) + 1

# %%
checks.number(k_99, int((axes.S.square().cumsum(0) < 0.99 * axes.S.square().sum()).sum()) + 1, "k_99")

# %% [markdown]
# **3.** The vector between two shapes by least squares, without `space.vector`: the $v$ that brings $A v$ nearest to $y - x$.

# %%
target = x[1] - x[0]
# solution
v_01 = torch.linalg.lstsq(space.A.flatten(0, 1), target.flatten()).solution

# %%
checks.array(v_01, space.vector(x[0], x[1]), "v_01")

# %% [markdown]
# **4.** How far apart are shapes 0 and 1, rms over points, (a) as lists of points and (b) as sets, after shuffling, to the *nearest* point?
# Give $\sqrt{\mathrm{Ch}/2}$ for (b).

# %%
from dsn_lite import chamfer

# solution
as_lists = target.square().sum(-1).mean().sqrt()
as_sets = (chamfer(shuffled[0], shuffled[1]) / 2).sqrt()

# %%
checks.number(as_lists, axioms.gap(x[0], x[1], corresponds=True), "as_lists")
checks.number(as_sets, axioms.gap(shuffled[0], shuffled[1], corresponds=False), "as_sets")

# %% [markdown]
# ## Take-away
#
# - With correspondences, a deformation space is a singular value decomposition, and *all* laws hold because every shape shares one $A$.
# - The number of large singular values is the number of degrees of freedom.
# - Shuffle the points and it is gone: the shared $A$ has no meaning for sets.
#
# ## What the paper does not say
#
# - Eq. 1 spans the differences *about the mean*; the mean itself never appears, because the action starts from $x$.
# - "Transitive if $k$ is large enough" holds only for shapes inside the span: a table with a shelf is out of reach for every $k$ fitted to tables without.
# - Principal axes are unique only up to sign, and up to rotation where singular values are equal. Learned dictionaries have the same freedom, only more of it.
