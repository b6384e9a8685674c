# %% [markdown]
# # 01 Shapes as points
#
# **Objectives.** By the end you can
# 1. turn a surface into points evenly, and say what goes wrong when it is done unevenly,
# 2. show what two shapes lose when their points no longer correspond,
# 3. compute the Chamfer distance, name its convention, its floor, and what it does not see,
# 4. write a family of shapes whose true deformations are known.
#
# **Time.** 45 minutes. &nbsp; **Prerequisites.** Lesson 00; vectors and a little probability. &nbsp; **Paper.** Sections 3.1, 3.3 (Eq. 9) and 4.1.

# %%
import numpy as np
import torch

import data_gen
from dsn_lite import chamfer, checks, judges, lessons, plots, widgets

lessons.begin()

# %% [markdown]
# ## 1 From a surface to points
#
# The paper's networks read a shape as $n$ points on its surface, $x \in \mathbb{R}^{n \times 3}$. Here is a surface: a table of parts, each closed by triangles.

# %%
rig = data_gen.family("table/farmhouse")
table = data_gen.mesh(rig.name, rig.middle[0])
plots.meshes([table], titles=[rig.name])

# %% [markdown]
# The turned legs need many small triangles, the top is made of a few large ones: of all triangles, and of all area, what share is the top's?

# %%
vertices = rig.vertices(rig.middle)[0]
a, b, c = vertices[rig.triangles].swapaxes(0, 1)
area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
top = rig.triangle_part == rig.part_names.index("top")
print(f"{top.mean():.0%} of the triangles, {area[top].sum() / area.sum():.0%} of the area")

# %% [markdown]
# To put a point on a triangle, mix its corners: three weights, drawn evenly among those that add up to 1, land anywhere on it. (In exercise 1 you make them yourself.)

# %%
generator = np.random.default_rng(0)


def on_triangles(which):
    """A random point on each of these triangles."""
    w = generator.dirichlet([1, 1, 1], len(which))
    return w[:, :1] * a[which] + w[:, 1:2] * b[which] + w[:, 2:] * c[which]


# %% [markdown]
# Three ways to get 1000 points: take vertices at random; take triangles at random, and a point on each; take triangles *with probability proportional to their area*, and a point on each.

# %%
some_vertices = vertices[generator.choice(len(vertices), 1000)]
any_triangle = on_triangles(generator.choice(len(area), 1000))
by_area = on_triangles(generator.choice(len(area), 1000, p=area / area.sum()))
plots.shapes([some_vertices, any_triangle, by_area], titles=["vertices", "any triangle", "by area"])

# %% [markdown]
# What has no points does not exist for a network, or for a distance between clouds: the first two tables are legs without a top. Only sampling by area describes the *surface*
# and not how somebody cut it into triangles.
#
# **Fresh or shared.** `generate` samples by area, in one of two ways. *Fresh* samples are drawn anew for every shape. *Shared* samples are drawn once, on the family's middle shape, and
# carried along: point 17 stays at its place on its part. The price: carried along, they are even no longer. The share of points on the top of the first three tables:

# %%
options = {"count": 100, "points": 512, "seed": 3}
fresh = data_gen.generate("table/four_legs", **options)
shared = data_gen.generate("table/four_legs", **options, sampling="shared")
(fresh.labels == 0).mean(1)[:3].round(2), (shared.labels == 0).mean().round(2)

# %% [markdown]
# ## 2 More than a hundred families
#
# Where do shapes come from? Collections of real ones may not be given away with a course, and nobody knows their true deformations. Ours are made: a *family* turns a few named numbers
# into parts. One of each (it takes a few seconds):

# %%
from data_gen.catalogue import overview

names = data_gen.families()
plots.picture(overview(names), f"One shape of each of {len(names)} families: {', '.join(data_gen.categories())}.")

# %% [markdown]
# Name a category instead of a family, and you get what the paper trains on: shapes of one kind that differ in *structure*, not only in size. Parts that are the same carry the same name in
# all families of a category, `leg_1`, `leg_2` and so on where there are several of a kind.

# %%
from data_gen.colours import colours, kind

chairs = data_gen.generate("chair", count=6, points=1024, seed=2)
kinds = ["seat", "back", "leg"]
labels = np.array([kinds.index(kind(part)) if kind(part) in kinds else -1 for part in chairs.part_names])[chairs.labels]
titles = [name.split("/")[1].replace("_", " ") for name in chairs.names]
plots.shapes(chairs.points, labels=labels, part_names=kinds, titles=titles)

# %% [markdown]
# **Predict first.** Which parameters of a chair will move *almost all* of its points, and which only a few? Then choose a chair of another structure: does `seat height` mean the same thing to it?

# %%
chairs_first = (*data_gen.families("chair"), *names)
widgets.FamilySliders({name: data_gen.family(name) for name in chairs_first}, colours)

# %% [markdown]
# ## 3 Points that correspond
#
# With shared samples, row $i$ of $x$ and row $i$ of $y$ are the same spot of the same part. So $y - x$ is a deformation: it says where each point goes. Shuffle the rows of $y$. As a *set*
# it is the same table, and $y - x$ is nonsense.

# %%
small, large = shared.parameters[:, 0].argsort()[[0, -1]]
x, y = shared.points[small], shared.points[large]
order = generator.permutation(512)
titles = ["row i to row i", "rows of y shuffled"]
plots.offsets(x, [y - x, y[order] - x], titles=titles)

# %% [markdown]
# **Predict first.** What is halfway between the two tables, $x + \tfrac12 (y - x)$, when the rows of $y$ are shuffled? And the mean of a hundred shuffled tables?

# %%
shuffled = np.stack([generator.permutation(cloud) for cloud in shared.points])
halfway = [x + (y - x) / 2, x + (y[order] - x) / 2]
means = [shared.points.mean(0), shuffled.mean(0)]
plots.shapes([*halfway, *means], titles=["halfway", "halfway, shuffled", "mean", "mean, shuffled"])

# %% [markdown]
# Differences, means, directions of greatest spread: all that is *linear* counts on correspondence. In order, a hundred tables differ in six directions, one a parameter.
# Shuffled, they differ in as many as there are tables (less one, for the mean).

# %%
exact = data_gen.generate("table/four_legs", **options, sampling="shared", dtype="float64").points
mixed = np.stack([generator.permutation(cloud) for cloud in exact])
[int(np.linalg.matrix_rank((each - each.mean(0)).reshape(100, -1), tol=1e-9)) for each in (exact, mixed)]

# %% [markdown]
# Fresh samples are worse than shuffled ones: point 17 has no partner anywhere. That is the honest setting, and the paper's. What can still be compared is sets.
#
# ## 4 The Chamfer distance
#
# Each point looks for the nearest point of the other cloud, and we average the squared distances, both ways:
# $$\mathrm{Ch}(x, y) = \frac1n \sum_i \min_j |x_i - y_j|^2 + \frac1n \sum_j \min_i |x_i - y_j|^2.$$
# For a tall, narrow table $x$ and a low, wide one $y$, step by step, and by the library:

# %%
tall = dict(zip(fresh.parameter_names, [0.55, 0.95, 0.5, 0.05, 0.1, 0.1], strict=True))
low = dict(zip(fresh.parameter_names, [1.0, 0.45, 0.8, 0.05, 0.05, 0.05], strict=True))
options = {"count": 1, "points": 512}
source = data_gen.generate("table/four_legs", **options, fixed=tall, seed=1)
target = data_gen.generate("table/four_legs", **options, fixed=low, seed=2)
x, y = torch.from_numpy(source.points[0]), torch.from_numpy(target.points[0])

# %%
distances = torch.cdist(x, y)  # of every point to every other
there, back = distances.min(1).values, distances.min(0).values
there.square().mean() + back.square().mean(), chamfer(x, y)

# %% [markdown]
# **Conventions.** The same two tables, and numbers that all go by this name. The authors train with 100 times the distance and print 1000 times the distance; of the methods they compare
# with, one multiplies by 10 000, and one takes distances that are *not* squared, one way only. And since it is a squared length, a shape twice as large has four times the distance:
# the paper's ShapeNet shapes fill a cube of edge 2, ours one of edge 1. Never compare two Chamfer distances before you know all this of both.

# %%
one_way, other_way = there.square().mean(), back.square().mean()
both = one_way + other_way
named = {"here": both, "halved": both / 2, "x to y only": one_way, "y to x only": other_way}
named |= {"not squared": there.mean() + back.mean(), "sums, not means": 512 * both}
named |= {"100 times": 100 * both, "1000 times": 1000 * both, "in a cube of edge 2": 4 * both}
{name: round(float(value), 3) for name, value in named.items()}

# %% [markdown]
# **It is no metric.** Going by way of $y$ can be *shorter* than going straight. Three clouds of one point each, at 0, 1 and 2; in exercise 3 you show that the square is not to blame.

# %%
at = [torch.tensor([[place, 0.0, 0.0]]) for place in (0, 1, 2)]
chamfer(at[0], at[2]), chamfer(at[0], at[1]) + chamfer(at[1], at[2])

# %% [markdown]
# **Its floor.** Two samplings of *one* table are not at distance 0, since no point meets its like. Nothing that is fitted to fresh samples can honestly get below that. How low is it?
# With $n$ points on an area $a$, no point falls into a circle of radius $r$ with a chance of about $e^{-\pi r^2 n / a}$; so the squared distance to the nearest is $a / (\pi n)$ on average,
# and both ways together make $2a / (\pi n)$.

# %%
rig = data_gen.family("table/four_legs")
middle = dict(zip(rig.parameter_names, rig.middle[0], strict=True))


def samplings(n, count=16, seed=0):
    """The table in the middle of the ranges, sampled again and again: (count, n, 3)."""
    return torch.from_numpy(data_gen.generate(rig.name, count=count, points=n, seed=seed, fixed=middle).points)


# %%
a, b, c = rig.vertices(rig.middle)[0][rig.triangles].swapaxes(0, 1)
surface = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
sizes = [64, 128, 256, 512, 1024, 2048, 4096]
measured = {n: chamfer(*samplings(n).chunk(2)).mean().item() for n in sizes}
told = {n: 2 * surface / (np.pi * n) for n in sizes}
plots.lines({"measured": measured, "2a / (π n)": told}, x="points n", y="sampling floor", log=True)

# %% [markdown]
# So a Chamfer distance means nothing without its $n$. In this course we give it in multiples of the floor, of fresh samples: with shared ones the true deformation would score 0.
# (With few points the formula is a little too high: it takes the surface for flat, but the other sides of a thin leg are near, too.)
#
# **It does not see density.** Put 80 % of the points on the left half of the table. Every point still has somebody near, and many may choose the same one. A distance that pairs points off,
# one to one, is another matter. By how much will either grow?


# %%
def leaning(cloud, k):
    """512 points of a cloud, k of them from its left half."""
    left = cloud[:, 0] < 0
    return torch.cat([cloud[left][:k], cloud[~left][: 512 - k]])


# %%
from scipy.optimize import linear_sum_assignment

dense, others = samplings(4096, 8, seed=1), samplings(512, 8, seed=2)
for k in (256, 410):
    clouds = torch.stack([leaning(cloud, k) for cloud in dense])
    squares = torch.cdist(clouds, others).square().numpy()
    paired = np.mean([d[linear_sum_assignment(d)].mean() for d in squares])
    print(f"{k / 512:.0%} on the left: Chamfer {chamfer(clouds, others).mean():.4f}, one to one {paired:.4f}")

# %% [markdown]
# **Its gradient goes to the nearest neighbour,** who is held fixed, and not to the true partner. On the left, where each point of $x$ truly goes as $x$ becomes $y$ (`data_gen` knows);
# on the right, to the nearest point of $y$: along these arrows the first sum falls fastest.

# %%
truth = torch.from_numpy(data_gen.true_deformation(source, target)[0]).float()
partner = distances.argmin(1)
plots.offsets(x, [truth - x, y[partner] - x], titles=["to the truth", "to the nearest"])

# %% [markdown]
# Let every point follow the gradient of both sums until it rests. How near do we come, and how near does the truth come? The floor here is another sampling of $y$.

# %%
free, again = x.clone().requires_grad_(), torch.from_numpy(data_gen.resample(target, seed=1).points[0])
optimizer = torch.optim.Adam([free], lr=0.01)
for _ in range(200):
    optimizer.zero_grad()
    chamfer(free, y).backward()
    optimizer.step()
free = free.detach()
{"free": chamfer(free, y).item(), "truth": chamfer(truth, y).item(), "floor": chamfer(again, y).item()}

# %% [markdown]
# The points that moved freely fit $y$ five times better than the truth does, and far below the floor. **Predict first.** Does that table look better, too? The colours are those of $x$.

# %%
plots.shapes([free, truth], labels=source.labels[0], part_names=source.part_names, titles=["free", "truth"])

# %% [markdown]
# Legs have become top. Of all points, the share that came to lie on the part of $y$ that they belong to:

# %%
from dsn_lite.chamfer import nearest

[(target.labels[0][nearest(each, y)] == source.labels[0]).mean().round(2) for each in (free, truth)]

# %% [markdown]
# A Chamfer distance near 0 says that two sets cover each other. It does not say that legs stayed legs. This is why the paper does not move points freely: they move along a few directions that
# belong to the shape, $x + A_x v$, the same $v$ for all shapes. The rest of the course is about these directions.
#
# ## 5 The truth
#
# What are the right directions? For our families we know: one a parameter, $\partial x / \partial p_j$. `valid_space` gives them as a dictionary $A_x$. What 0.15 more of each parameter does:

# %%
A = data_gen.valid_space(source)[0]
A.shape

# %%
titles = [name.replace("_", " ") for name in source.parameter_names]
plots.offsets(x, [0.15 * A[..., j] for j in range(A.shape[-1])], titles=titles)

# %% [markdown]
# A table is *linear* in its parameters: $x + A_x (p_y - p_x)$ is the true deformation, exactly. A carton is not, since its flaps turn: there $A_x$ is the tangent, and a long step along it misses.
# What is missed, as a share of the way the points go, over ten pairs of each (single precision leaves some $10^{-7}$):


# %%
def missed(family):
    """How far x + A (p_y - p_x) is from the true y, as a share of how far it is from x."""
    shapes = data_gen.generate(family, count=20, points=512, seed=1)
    x, y = shapes[:10], shapes[10:]
    guess = x.points + np.einsum("bnck,bk->bnc", data_gen.valid_space(x), y.parameters - x.parameters)
    truth = data_gen.true_deformation(x, y)
    return np.linalg.norm(guess - truth) / np.linalg.norm(x.points - truth)


print(f"table {missed('table/four_legs'):.0e}, carton {missed('carton/two_flaps'):.0%}")

# %% [markdown]
# **True transfer.** Do to $z$ what turned $x$ into $y$: add the change of the parameters. Those that mean the same carry the same name in all families of a category, so there is a true
# answer even where $z$ is built otherwise. Taller, wider, thinner:

# %%
sizes = [{"width": 0.6, "height": 0.5, "top_thickness": 0.05}, {"width": 0.85, "height": 0.75, "top_thickness": 0.03}]
x, y = (data_gen.generate("table/four_legs", count=1, points=512, fixed=size) for size in sizes)
z = data_gen.generate("table/pedestal", count=1, points=512, fixed=sizes[0])
w = data_gen.true_transfer(x, y, z)
plots.shapes([x.points[0], y.points[0], z.points[0], w[0]], titles=["x", "y", "z", "z, transferred"])

# %% [markdown]
# Where the answer would leave a range there is no such shape. Then the transfer is refused, or stopped at the end of the range if you say so (`clip=True`); it is never quietly wrong.

# %%
lessons.error_of(lambda: data_gen.true_transfer(x, y, y))

# %% [markdown]
# ## 6 Exercises
#
# **1.** A point on the triangle $a, b, c$ is $(1 - u - v)\,a + u\,b + v\,c$ with $u, v \ge 0$ and $u + v \le 1$. You have even random numbers $u, v \in [0, 1]$; half the pairs land beyond the
# edge $bc$. Make the points even on the triangle. (There are several ways; your points are counted, not compared.)


# %%
# solution
def in_triangle(a, b, c, u, v):
    """Points (m, 3) of the triangle with corners a, b, c (3,), evenly spread where u and v (m, 1) are."""
    beyond = u + v > 1
    u, v = torch.where(beyond, 1 - u, u), torch.where(beyond, 1 - v, v)
    return (1 - u - v) * a + u * b + v * c


# %%
checks.accepted(in_triangle, judges.triangle_sampler, "in_triangle")

# %% [markdown]
# **2.** The Chamfer distance in this course's convention: squared, mean over points, both ways, added. The clouds may differ in size.


# %%
# solution
def my_chamfer(x, y):
    """Ch(x, y) of clouds (n, 3) and (m, 3), one number."""
    d = torch.cdist(x, y).square()
    return d.min(1).values.mean() + d.min(0).values.mean()


# %%
clouds = samplings(300, 1, seed=3)[0], samplings(200, 1, seed=4)[0]
gone, come = (torch.cdist(*clouds).min(axis).values for axis in (1, 0))
hints = {"it goes one way only, from x to y": lambda x, y: gone.square().mean()}
hints["it goes one way only, from y to x"] = lambda x, y: come.square().mean()
hints["its distances are not squared"] = lambda x, y: gone.mean() + come.mean()
hints["it adds up over the points; take means"] = lambda x, y: gone.square().sum() + come.square().sum()
checks.function(my_chamfer, chamfer, [clouds], "my_chamfer", hints=hints)

# %% [markdown]
# **3.** Find clouds `x, y, z` (at least one point each, one row a point) that break $d(x, z) \le d(x, y) + d(y, z)$ although the distances below are *not* squared. A hint: many may choose the same.


# %%
def unsquared(x, y):
    """Mean distance to the nearest point, both ways, added."""
    d = torch.cdist(x, y)
    return d.min(1).values.mean() + d.min(0).values.mean()


# solution
_near, _far = torch.zeros(1, 3), torch.ones(1, 3)
three_clouds = [_near, torch.cat([_near, _far]), _far]

# %%
checks.accepted(three_clouds, lambda clouds: judges.triangle_inequality(unsquared, *clouds), "three_clouds")

# %% [markdown]
# **4.** How many points does the table of section 4 (its area is `surface`) need for a floor of $10^{-4}$?

# %%
# solution
points_needed = 2 * surface / (np.pi * 1e-4)

# %%
wrong = {"that is for one way; there are two": surface / (np.pi * 1e-4)}
checks.number(points_needed, 2 * surface / (np.pi * 1e-4), "points_needed", hints=wrong)

# %% [markdown]
# **5. Write your own family.** A family is a `Rig`: parameters with their ranges, and a function that builds parts from them. Shapes stand on `FLOOR` and stay within $[-0.5, 0.5]$; `symmetric`
# says what mirrors across $x = 0$ (a part in the middle: itself), `contacts` what touches. Everything must be *linear* in the parameters; so the true deformations come for nothing. An example:

# %%
from data_gen.part import box, cylinder
from data_gen.rig import FLOOR, Contact, Parameter, Rig


def candle(p, gap=0.0):
    """A candle on a dish, or a gap above it."""
    dish = cylinder("dish", (0, FLOOR + 0.02, 0), (p.width, 0.04, p.width))
    middle = (0, FLOOR + 0.04 + gap + p.height / 2, 0)
    return dish, cylinder("wax", middle, (p.thickness, p.height, p.thickness))


# %%
from data_gen.families import RIGS
from data_gen.sheet import sheet

sizes = [Parameter("width", 0.3, 0.6, "of the dish"), Parameter("thickness", 0.05, 0.2, "of the wax")]
sizes.append(Parameter("height", 0.2, 0.7, "of the wax"))
touching = (Contact("dish", "wax", "face_y"),)
RIGS["candle/dish"] = Rig("candle/dish", tuple(sizes), candle, (("dish", "dish"), ("wax", "wax")), touching)
plots.picture(sheet("candle/dish"), "Twelve random candles, and what each parameter does.")

# %% [markdown]
# `faults` tries the laws that every family keeps, and says what is wrong. None in our candle; and then one that floats above its dish:

# %%
from dataclasses import replace

from data_gen.faults import faults

floating = replace(RIGS["candle/dish"], build=lambda p: candle(p, gap=0.01))
faults(RIGS["candle/dish"]), faults(floating)

# %% [markdown]
# Now yours: a thing of two parts or more, as `own = Rig("category/name", parameters, build, symmetric, contacts)`. A stool, a lamp, a bookend, a robot.
# There are `box`, `cylinder`, `ball` and, for what bends or tapers, `loft`; see `help("data_gen.part")`.


# %%
# solution
def mine(p):
    """The parts of a shape with parameters p."""
    foot = box("foot", (0, FLOOR + 0.02, 0), (p.width, 0.04, p.depth))
    return foot, box("wall", (0, FLOOR + 0.04 + p.height / 2, 0), (p.width, p.height, 0.04))


_sizes = [Parameter(name, 0.2, 0.6, "edge") for name in ("width", "height", "depth")]
_itself = (("foot", "foot"), ("wall", "wall"))
own = Rig("bookend/own", tuple(_sizes), mine, _itself, (Contact("foot", "wall", "face_y"),))

# %%
checks.accepted(own, faults, "own")

# %% [markdown]
# Once it has no faults, look at it. It is now a family as all others are: `data_gen.generate(own.name, count=1000, points=512)` is a collection to train on in lesson 05, its true transfers included.
# `CONTRIBUTING.md` says how it becomes part of the course.

# %%
if own is not ...:
    RIGS[own.name] = own
None if own is ... else plots.picture(sheet(own.name), f"Twelve random shapes of {own.name}.")

# %% [markdown]
# ## Take-away
#
# - Sample by area; what the triangles were must not matter.
# - Differences, means and principal axes need corresponding points. Sets have none, and the Chamfer distance compares sets.
# - It has many conventions, and a floor of about $2a / (\pi n)$. It is no metric, does not see density, and is content when legs become tops.
# - Where shapes are made, the right answer is known: dictionaries, deformations, transfers. Use that.
#
# ## What the paper does not say
#
# - *How* its points are sampled: "2K points randomly over each shape", by area or not, once or anew in each epoch. The authors' code takes them from clouds that were sampled beforehand, so
#   the same samples come again and again.
# - What the floor of its tables is. Its shapes fill a cube of edge 2. Ours, each enlarged to that, with 2048 points, have floors of $3.0 \cdot 10^{-3}$ (tables), $2.5 \cdot 10^{-3}$ (chairs) and
#   $0.8 \cdot 10^{-3}$ (airplanes); its fitting distances are 8.05, 5.90 and 1.95 $\cdot\, 10^{-3}$.
#   If its shapes are like ours, a good third of that is sampling.
# - That the authors' code takes the loss 100 times, which decides what the weight of every other term means.
