# %% [markdown]
# # 00 Start here
#
# **Objectives.** By the end you
# 1. know that everything runs on your machine,
# 2. have moved a table with a slider, along a direction that a network found by itself,
# 3. have deformed a mesh from a file, with its faces and colours, and written it back.
#
# **Time.** 20 minutes. &nbsp; **Prerequisites.** None; Python helps. &nbsp; **Paper.** Figures 1 and 3; the notation of Section 3.
#
# Run a cell with **Shift + Enter**, from top to bottom.

# %%
import data_gen
import dsn_lite
from dsn_lite import checks, lessons, meshes, plots, widgets

lessons.begin()

# %% [markdown]
# ## 1 Does it work?
#
# Python calculates in one process, the page you look at is another. A green sentence says that the two talk to each other.

# %%
widgets.heartbeat()

# %% [markdown]
# ## 2 Forty tables, and what a network made of them
#
# `data_gen` makes shapes whose truth is known. Here are tables with four legs: six numbers each, drawn at random, and 512 points sampled on the surface.
# Every table has *its own* samples: point 17 of one has nothing to do with point 17 of another.

# %%
tables = dsn_lite.as_shapes(data_gen.generate("table/four_legs", count=40, points=512, seed=7))
plots.shapes(tables.points[:4], labels=tables.labels[:4], part_names=tables.part_names)

# %% [markdown]
# A network was trained on thousands of such tables, given only the points: no part names, no parameters, no correspondences. In lesson 05 you train one yourself,
# live. For each shape it predicts a **dictionary** $A_x$: $k$ ways to deform that shape. A vector $v$ says how much of each, and
# $$x \oplus v = A_x v + x.$$

# %%
space = dsn_lite.load("table_four_legs")
space.dictionary(tables.points[0]).shape

# %% [markdown]
# **Predict first.** One slider below gives the *same* instruction to two different tables. Will "wider" on the left be "wider" on the right, although
# no one ever told the network which points are legs? (The colours are for you.)

# %%
widgets.DictionarySliders(space, tables.points[:2], labels=tables.labels[:2], vectors=space.encode(tables.points))

# %% [markdown]
# Where do vectors come from? From pairs: a second network turns each shape into a code, and $\overrightarrow{xy} = \mathcal{E}(y) - \mathcal{E}(x)$ is what turns $x$ into $y$.
# Given to a third table $z$, it does there what it did here. **Predict first:** at $t = 1$, what will $z$ have become?

# %%
x, y, z = tables.points[[3, 5, 9]]
widgets.DeformationPath(space, x, y, z)

# %% [markdown]
# ## 3 A mesh from a file
#
# Points are for learning; what you have is meshes. `data_gen` writes two tables as GLB files, with a colour a part, into a folder beside this lesson.
# Drop a file of your own there (GLB, OBJ, PLY, STL) and put its name in place of `low.glb`.

# %%
from pathlib import Path

folder = Path("my_meshes")
folder.mkdir(exist_ok=True)
data_gen.save_mesh(data_gen.mesh("table/four_legs", [0.9, 0.5, 0.6, 0.05, 0.09, 0.09]), folder / "low.glb")
data_gen.save_mesh(data_gen.mesh("table/four_legs", [0.6, 0.85, 0.7, 0.09, 0.05, 0.05]), folder / "high.glb")

# %%
source, target = meshes.load_mesh(folder / "low.glb"), meshes.load_mesh(folder / "high.glb")
plots.meshes([source, target], titles=["low.glb", "high.glb"])

# %% [markdown]
# The network reads shapes as points in a fixed box. So the mesh is sampled, turned upright, and brought into the box by one similarity
# (scale, rotation, translation), which is remembered and undone at the end. The dictionary is then evaluated *at the mesh's vertices*: faces, colours and
# texture coordinates stay what they were.

# %%
deformed = meshes.deform(space, source, target)
plots.meshes([source, target, deformed], titles=["source", "target", "source, deformed"])

# %%
meshes.save_mesh(deformed, folder / "deformed.glb")

# %% [markdown]
# Look closely at the upper ends of the legs. Where a leg meets the top, one place in space belongs to both parts, and a dictionary that is read point by
# point has one answer for it: the leg cannot become thinner there while the top does not. In return no seam ever opens.
#
# Eight corners cannot bend a face: what is wrong at one end of a leg is seen along all of it. Ask for smaller edges, and the leg is thin up to where it meets the
# top. The number is the longest edge allowed, as a share of the mesh's size.

# %%
finer = meshes.deform(space, source, target, subdivide=0.05)
plots.meshes([deformed, finer], titles=["vertices as they were", "subdivided"])

# %% [markdown]
# The same without a notebook: `python -m dsn_lite deform table_four_legs SOURCE TARGET -o OUT`.
#
# ## 4 The map
#
# | paper | in words | here |
# |---|---|---|
# | $x, y, z$ | shapes, $n$ points each | arrays `(n, 3)`, many at once `(N, n, 3)` |
# | $u, v \in V$, $k$ | vectors, their length | arrays `(k,)` |
# | $x \oplus v$ (Eqs. 1, 2) | deform $x$ by $v$ | `space.act(x, v)` |
# | $\overrightarrow{xy}$ | what leads from $x$ to $y$ | `space.vector(x, y)` |
# | $d(x \to y)$ (Eq. 3) | $x$ deformed towards $y$ | `space.deform(x, y)` |
# | $z \oplus \overrightarrow{xy}$ | do to $z$ what turned $x$ into $y$ | `space.transfer(x, y, z)` |
# | $\mathcal{E}$, $\mathcal{F}$, $A_x$ | the two networks; the dictionary | `space.encode(x)`, `space.dictionary(x)` |
# | $\mathrm{Ch}(x, y)$ | Chamfer distance | `dsn_lite.chamfer(x, y)` |
#
# Next: **01** shapes as points, and what is lost without correspondences; **02** the laws of such a space, by hand; **03** the case with correspondences, PCA; **05** a DeformSyncNet from scratch, trained live; **06** what its dictionary says, and which sliders to read off it.
#
# ## 5 Exercises
#
# **1.** The vector that leads from `x` to `y`, and `z` deformed by it. One line each.

# %%
# solution
v = space.vector(x, y)
moved = space.act(z, v)

# %%
checks.array(v, space.vector(x, y), "v")
checks.array(moved, space.transfer(x, y, z), "moved")

# %% [markdown]
# **2.** Go only halfway from `x` to `y`.

# %%
# solution
halfway = space.act(x, 0.5 * space.vector(x, y))

# %%
checks.array(halfway, x + 0.5 * (space.deform(x, y) - x), "halfway")

# %% [markdown]
# **3.** Read an error. The next line gives the network points in the wrong layout. What does the sentence say must hold, what came, and what is the cure?

# %%
lessons.error_of(lambda: dsn_lite.chamfer(x.mT, y))

# %%
# solution
cured = dsn_lite.chamfer(x, y)

# %%
checks.number(cured, dsn_lite.chamfer(x, y), "cured")

# %% [markdown]
# ## Take-away
#
# - A deformation is a vector in a space that all shapes share; each shape has its own dictionary that says what the vector means to it.
# - Learning needs points and no labels. Using it needs a mesh and no points.
#
# ## What the paper does not say
#
# - How a mesh gets into and out of the network. The authors' code works on 2048 points only; evaluating $\mathcal{F}$ at other points than those it read is our reading of
#   Section 3.3, where every three rows of $A_x$ move one point independently of the others.
# - That $\mathcal{F}$, read point by point, cannot tell two parts apart where they touch. With samples one hardly sees it; with meshes one does.
# - With columns of unit *length*, as in the paper, the same points move less when more of them are given. Ours have unit root mean square, so a mesh of 80 vertices
#   and one of 80 000 deform alike.
