# %% [markdown]
# # 02 Affine action spaces
#
# **Objectives.** By the end you can
# 1. state the three axioms of an affine action space and the four laws that follow from them,
# 2. check each one with numbers, on a space you can compute by hand and on a trained one,
# 3. say for each law what a space looks like that breaks it.
#
# **Time.** 45 minutes. &nbsp; **Prerequisites.** Lesson 00; vectors and matrices. &nbsp; **Paper.** Section 3.1.
#
# A shape is a point cloud $x \in \mathbb{R}^{n \times 3}$. A *vector* $v \in V = \mathbb{R}^k$ is an instruction: "wider, and a bit lower".
# An *action* $\oplus$ carries it out: $x \oplus v$ is again a shape. The point of the paper is that the instruction forgets the shape
# it was read from, so that it can be given to another one. The laws below say when that makes sense.

# %%
import torch

from dsn_lite import axioms, byhand, checks, lessons, plots, widgets

lessons.begin()

# %% [markdown]
# ## 1 The smallest space there is
#
# Take the smallest shape with any form, a triangle ($n = 3$ points), at a few places. These are our shapes $X$: copies of one triangle.

# %%
shapes = byhand.copies(3)
x, y, z = shapes.points
x, y

# %%
plots.together([x, y, z], faces=[[0, 1, 2]], titles=["x", "y", "z"])

# %% [markdown]
# A DeformSyncNet needs two functions. $\mathcal{E}$ turns a shape into a code; ours is the **centroid**, so $k = 3$.
# $\mathcal{F}$ turns a shape into a dictionary $A_x$, one 3-vector a point and column; ours is the **identity** at every point,
# so column $j$ moves all points by one unit along axis $j$.

# %%
space = byhand.translations()
space.encode(x)

# %%
space.dictionary(x)[0]

# %% [markdown]
# With these, Eq. 2 and Eq. 3 of the paper are what you would do by hand. The vector between two shapes is a difference of codes,
# $\overrightarrow{xy} = \mathcal{E}(y) - \mathcal{E}(x)$, and the action adds $A_x v$ to the points: $x \oplus v = A_x v + x$. Here that is translation.

# %%
v = space.vector(x, y)
v

# %%
space.act(x, v)

# %% [markdown]
# **Predict first.** The slider gives *one* vector to two triangles. When you drag the second slider, does the right triangle move
# as far as the left one? In the same direction? What would have to change in $\mathcal{F}$ for the answer to be no?

# %%
widgets.DictionarySliders(space, torch.stack([x, z]))

# %% [markdown]
# ## 2 The three axioms
#
# Each law is a function in `dsn_lite.axioms` that returns **how far the space is from keeping it**, as a root mean square distance
# in the unit of the shapes. Zero means it holds.
#
# **Axiom 1: $x \oplus \vec 0 = x$.** The vector that says nothing does nothing. (The paper calls this a *free* action. Elsewhere "free"
# means something stronger, that only $\vec 0$ leaves a shape alone; this one is the *identity law*.)

# %%
axioms.zero_acts_trivially(space, x)

# %% [markdown]
# **Axiom 2: $(x \oplus u) \oplus v = x \oplus (u + v)$.** Two instructions one after the other are the same as their sum. So the order
# does not matter, and every deformation can be undone by $-v$. Both sides, then the distance between them:

# %%
u, v = torch.tensor([[0.0, 0.5, 0.0], [1.0, 0.0, 0.0]], dtype=torch.float64)
twice, once = space.act(space.act(x, u), v), space.act(x, u + v)
twice - once

# %%
plots.together([x, space.act(x, u), twice], faces=[[0, 1, 2]], titles=["x", "x ⊕ u", "(x ⊕ u) ⊕ v"])

# %%
axioms.actions_add(space, x, u, v)

# %% [markdown]
# **Axiom 3: for every $x, y$ there is exactly one $v$ with $x \oplus v = y$.** Two claims in one. *There is one:* $\overrightarrow{xy}$ reaches $y$.

# %%
axioms.target_is_reached(space, x, y, corresponds=True)

# %% [markdown]
# *There is only one:* if $A_x v = A_x v'$ then $v = v'$, which holds exactly when the $k$ columns of $A_x$ are independent: rank $k$.
# Repeat one column and the target is still reached, but by infinitely many vectors.

# %%
from dsn_lite.dictionary import rank

A = space.dictionary(x)
doubled = torch.cat([A, A[..., :1]], dim=-1)
rank(A).item(), rank(doubled).item()

# %% [markdown]
# ## 3 Four laws that follow
#
# Nothing new is assumed here: each law follows from the axioms in a line or two. Try it before you read on.
#
# **Identity: $\overrightarrow{xx} = \vec 0$.** By axiom 1, $\vec 0$ leads from $x$ to $x$; by axiom 3, nothing else does.

# %%
space.vector(x, x), axioms.self_vector_is_zero(space, x)

# %% [markdown]
# **Anticommutativity: $\overrightarrow{xy} = -\overrightarrow{yx}$.** By axiom 2, $x \oplus (\overrightarrow{xy} + \overrightarrow{yx}) = y \oplus \overrightarrow{yx} = x$;
# by uniqueness the sum is $\vec 0$.

# %%
space.vector(x, y), space.vector(y, x), axioms.reversal_negates(space, x, y)

# %% [markdown]
# **Transitivity: $\overrightarrow{xy} + \overrightarrow{yz} + \overrightarrow{zx} = \vec 0$.** The same argument around a triangle of shapes.
# It is why no loss for *cycle consistency* is needed: a difference of codes has it built in.

# %%
axioms.triangle_closes(space, x, y, z)

# %% [markdown]
# **Parallelogram: $\overrightarrow{xy} = \overrightarrow{zw} \Leftrightarrow \overrightarrow{xz} = \overrightarrow{yw}$.** Do to $z$ what turned $x$ into $y$, and you get the $w$
# that you get by doing to $y$ what turned $x$ into $z$. This is deformation transfer, and the law says that it does not depend on the route.
# Proof: if $\overrightarrow{xy} = \overrightarrow{zw}$ then $\overrightarrow{yw} = \overrightarrow{yx} + \overrightarrow{xz} + \overrightarrow{zw} = \overrightarrow{xz}$, by the two laws before.

# %%
w = space.transfer(x, y, z)
plots.together([x, y, z, w], faces=[[0, 1, 2]], titles=["x", "y", "z", "z ⊕ xy"])

# %%
axioms.parallelogram_closes(space, x, y, z, corresponds=True)

# %% [markdown]
# All seven at once, on random triplets of twelve triangles. "Construction" marks what holds whatever $\mathcal{E}$ and $\mathcal{F}$ are;
# "learning" marks what depends on them. Two spaces stand beside ours: the same with random weights (here there are none to
# randomise), and one that **does nothing**, which keeps five of the seven laws. Keep that in mind when somebody shows you a small residual.

# %%
triangles = byhand.copies(12)
axioms.report(space, triangles)

# %% [markdown]
# **On a trained space.** The same seven numbers for a network that learned tables from points alone. $\overrightarrow{xx}$, reversal and triangle are exact, since they hold
# for any difference of codes. The target is reached, and actions add up, approximately. "Untrained" is the same network with random weights.

# %%
import data_gen
import dsn_lite

tables = data_gen.generate("table/four_legs", count=60, points=512, seed=1)
axioms.report(dsn_lite.load("table_four_legs"), tables)

# %% [markdown]
# ## 4 Seven ways to break it
#
# For each law there is a space in `byhand.BROKEN` that changes *one* thing and fails it. Read the sentence, predict which law goes, run the cell.
#
# **A stamp.** $x \oplus v$ draws one template at the place where $x$ was. This is an autoencoder in miniature, $\mathcal{D}(\mathcal{E}(x) + v)$: the code keeps
# the place and loses the shape.

# %%
broken = byhand.BROKEN["zero_acts_trivially"]
residual = axioms.zero_acts_trivially(broken, x)
assert residual > 0.1
residual

# %%
plots.together([x, broken.act(x, torch.zeros(3))], faces=[[0, 1, 2]], titles=["x", "x ⊕ 0"])

# %% [markdown]
# **A stride of its own.** The higher a triangle stands, the longer its step: $A_x$ depends on $x$. After $u$ has lifted it, $v$ carries it further
# than $v$ alone would have. This is the law that the paper gives up when it replaces $A$ by $\mathcal{F}(x)$, and hopes to win back by training.

# %%
residual = axioms.actions_add(byhand.BROKEN["actions_add"], x, u, v)
assert residual > 0.1
residual

# %% [markdown]
# **No height.** The dictionary lacks a column: $k$ is too small for the differences in $X$. Some targets are out of reach.

# %%
residual = axioms.target_is_reached(byhand.BROKEN["target_is_reached"], x, y, corresponds=True)
assert residual > 0.1
residual

# %% [markdown]
# **Concatenation.** The vector is another function of both codes than their difference, $\mathcal{E}(y) - \tfrac12 \mathcal{E}(x)$. Networks that read
# $[\mathcal{E}(x); \mathcal{E}(y)]$ are of this kind: nothing in them says that $\overrightarrow{xx}$ is zero.

# %%
residual = axioms.self_vector_is_zero(byhand.BROKEN["self_vector_is_zero"], x)
assert residual > 0.1
residual

# %% [markdown]
# **A distance instead of a difference.** $|\mathcal{E}(y) - \mathcal{E}(x)|$ knows how far, but not which way.

# %%
residual = axioms.reversal_negates(byhand.BROKEN["reversal_negates"], x, y)
assert residual > 0.1
residual

# %% [markdown]
# **Saturation.** $\tanh(\mathcal{E}(y) - \mathcal{E}(x))$ treats both directions alike, but cuts long steps: three cut sides do not close.

# %%
residual = axioms.triangle_closes(byhand.BROKEN["triangle_closes"], x, y, z)
assert residual > 0.1
residual

# %% [markdown]
# **A ruler of its own.** Each triangle measures the way with its own stride, so *every target is reached exactly*. Looking only at
# fitting, nothing is wrong. But the numbers of one shape mean something else to another, and transfer fails: the dictionaries are not *synchronized*.

# %%
ruler = byhand.BROKEN["parallelogram_closes"]
reached = axioms.target_is_reached(ruler, x, y, corresponds=True)
closed = axioms.parallelogram_closes(ruler, x, y, z, corresponds=True)
assert reached < 1e-12 < 0.1 < closed
reached, closed

# %% [markdown]
# **Predict first.** Which of the seven spaces break *more* than the law they were made for? Write down a guess for two rows, then look.

# %%
spaces = {"translation": space} | {type(s).__name__: s for s in byhand.BROKEN.values()}
plots.law_table(byhand.who_breaks_what(spaces, triangles), list(spaces), list(axioms.LAWS))

# %% [markdown]
# ## 5 Exercises
#
# **1.** Without the library: the vector from `y` to `z` in the translation space.

# %%
# solution
yz = z.mean(0) - y.mean(0)

# %%
checks.array(yz, space.vector(y, z), "yz")

# %% [markdown]
# **2.** Undo. A deformation `u` was made to `x`; you only have the result `moved`. Which one vector leads from `moved` to `x ⊕ v`?
# Use axioms, not shapes: your answer is an expression in `u` and `v`.

# %%
moved = space.act(x, u)
# solution
back_and_on = v - u

# %%
checks.array(back_and_on, space.vector(moved, space.act(x, v)), "back_and_on")

# %% [markdown]
# **3.** A counter-example of your own. Find a function of the difference $d = \mathcal{E}(y) - \mathcal{E}(x)$, other than `tanh`, that keeps
# $\overrightarrow{xx} = \vec 0$ and $\overrightarrow{xy} = -\overrightarrow{yx}$ but breaks the triangle.

# %%
# solution
crooked = lambda d: d**3

# %%
own = byhand.OfDifference(crooked)
checks.laws(own, triangles, "crooked", keeps=["self_vector_is_zero", "reversal_negates"], breaks=["triangle_closes"])

# %% [markdown]
# **4.** The paper calls axiom 1 "free". The usual meaning is: *if $x \oplus v = x$ for some $x$ then $v = \vec 0$*. Which rank would
# `doubled` need for that, and which has it? So: is it free in the usual sense?

# %%
# solution
needed_rank, its_rank = 4, 3

# %%
checks.number(needed_rank, doubled.shape[-1], "needed_rank")
checks.number(its_rank, rank(doubled).item(), "its_rank")

# %% [markdown]
# ## Take-away
#
# - Three axioms make a set of shapes an affine space; four laws follow, and transfer along a parallelogram is one of them.
# - A difference of codes gives three of the laws for nothing. Adding up, reaching the target and closing the parallelogram must come from the dictionaries.
# - A small residual alone proves little: doing nothing keeps five laws. Always look at *reaching the target* beside it.
#
# ## What the paper does not say
#
# - Its axiom "free action" is the identity law, and "transitive" names both axiom 3 and a derived law. We use plain names: `zero_acts_trivially`,
#   `target_is_reached`, `triangle_closes`.
# - With $A_x = \mathcal{F}(x)$, axiom 3 needs $y - x$ to lie in the span of $A_x$ and $A_x$ to have rank $k$. A large $k$ makes the first easier and the second harder.
# - *How far* axiom 2 is from holding. The paper says that Eq. 2 gives it up and that joint training regularizes it. Lesson 05 measures that, with a surprise.
