# %% [markdown]
# # 06 Reading the dictionary
#
# **Objectives.** By the end you can
# 1. read a column of $A_x$ as a slider, as a heat map, and as numbers scored against true part labels,
# 2. say what a change of basis $A R$, $R^{-1} v$ leaves as it was and what it changes, and use it to find the sliders you want,
# 3. tell a number that shows learning from one that an untrained network reaches too,
# 4. see the resolution trap before you fall into it.
#
# **Time.** 50 minutes. &nbsp; **Prerequisites.** Lessons 03 and 05. &nbsp; **Paper.** Sections 3.1, 3.3 and 4.1 (*Deformation Dictionaries*).

# %%
import copy

import torch

import data_gen
import dsn_lite
from dsn_lite import axioms, checks, lessons, metrics, modes, plots, widgets
from dsn_lite.data import triplets

lessons.begin()

# %% [markdown]
# ## 1 One $v$ on six tables
#
# The network that ships with the course was trained on tables like these, which six numbers make. It knows neither the numbers nor the parts, and has more columns than that, $k$ of them.

# %%
torch.set_grad_enabled(False)  # we only look
drawn = data_gen.generate("table/four_legs", count=120, points=512, seed=7)
tables = dsn_lite.as_shapes(drawn)
x, y = tables[:60], tables[60:]
tables.parameter_names, tables.part_names

# %% [markdown]
# What is each column *used* for? Over pairs $x \to y$, column $j$ moves the points by $A_j v_j$.

# %%
space = dsn_lite.load("table_four_legs")
k = space.dictionary.k
A, v = space.dictionary(x.points), space.vector(x.points, y.points)
moved = modes.moved_by_columns(A, v)
plots.bars(dict(enumerate(moved.tolist())), x="column", y="moves points by, rms")

# %% [markdown]
# All of them are at work, some more than others.
#
# **Predict first.** Six tables take the same $v$, each through its own $A_x$. Drag the first sliders: will they do the same to all six? And will one of them be "wider", another
# "higher", or will each do a little of everything?

# %%
widgets.DictionarySliders(space, tables.points[:6], labels=tables.labels[:6], vectors=v)

# %% [markdown]
# The same to all six, and a little of everything. The paper calls the first *synchronized*, and it is what the transfer of lesson 05 lives on.
# The second is what this lesson is about: **what can we say of a single column?**
#
# ## 2 Which parts, and where
#
# The labels of the parts, which the network never saw, turn a column into numbers: the share of its squared motion that lies in each part.

# %%
reading = modes.read(space, tables)
plots.mode_heat(reading.energy.mean(0), reading.part_names)

# %% [markdown]
# The top has most of the points, so it takes a good half of most columns, and no leg has a column of its own. On the shapes themselves, for the column that is used most:

# %%
most = int(moved.argmax())
plots.mode_on_shapes(x.points[:6], A[:6, ..., most], titles=[f"table {i}" for i in range(6)])

# %% [markdown]
# Two numbers for locality. How many parts a mode moves (1 where it moves one, 5 where all five move alike), and, after the paper's figure on sparsity, the share
# of the elements of $B^+ A_x$, the motion of the parts' box handles, that is quiet: below 1 % of the shape's largest.

# %%
reading.parts_moved.mean().item(), modes.quiet_share(reading)

# %% [markdown]
# ## 3 A basis is a choice
#
# Take any invertible matrix $R$. The columns $A_x R$ with the coordinates $R^{-1} v$ make the same deformation, for every shape and every $v$:
# $$(A_x R)\,(R^{-1} v) = A_x v .$$

# %%
R = torch.randn(k, k, generator=torch.Generator().manual_seed(1))
mixed = modes.change_of_basis(space, R)
(mixed.deform(x.points, y.points) - space.deform(x.points, y.points)).abs().max()

# %% [markdown]
# So nothing that is said of deformations changes. Every law of lesson 02 is one of those things:

# %%
three = triplets(tables, 10)
before, after = axioms.residuals(space, *three), axioms.residuals(mixed, *three)
for law in before:
    print(f"{law:>22}  {before[law]:.5f}  {after[law]:.5f}")

# %% [markdown]
# But what is said of columns changes. Locality is one of those things:

# %%
modes.quiet_share(reading), modes.quiet_share(modes.read(mixed, tables))

# %% [markdown]
# The loss $\mathcal{L}_F$ sees deformations only, so the columns that training leaves are one basis out of very many, and by luck. (That they have unit rms on every
# shape rules most $R$ out, but says nothing of parts.) *How many* columns are needed is a better question, because
# its answer does not depend on the basis: in how many directions do the vectors $\overrightarrow{xy}$ really move anything?

# %%
local = modes.local_basis(space, x, y.points)
plots.spectrum(local.share[:12].sqrt())

# %% [markdown]
# A cliff after six, as in lesson 03, although these shapes have no correspondences: six numbers make a table, and the network found six directions.
# All the columns move something, and all but six of them are to spare.
#
# `local_basis` then rotates those six until the fewest handles move in each: factor analysis calls it *varimax*. It looks at parts, not at parameters.
#
# **Predict first.** Six sliders that move as few handles as possible. What will they be?

# %%
tuned = modes.change_of_basis(space, local.R)
six = range(local.used)
widgets.DictionarySliders(tuned, x.points[:6], six, labels=x.labels[:6], vectors=tuned.vector(x.points, y.points))

# %% [markdown]
# Height, depth, width. Then two that shape the legs, and one for the top alone. Not one deformation of the space has changed.
# `data_gen` knows the true columns, one a parameter; for each, the cosine with the column most like it:

# %%
true = torch.from_numpy(data_gen.valid_space(drawn)).float()


def alike(A):
    a, b = (each.flatten(0, 2) / each.square().sum((0, 1, 2)).sqrt() for each in (A, true))
    return (a.mT @ b).abs()


# %%
spaces = {"a column as trained": space, "a mode of the local basis": tuned}
best = {name: alike(one.dictionary(tables.points)).amax(0).tolist() for name, one in spaces.items()}
names = [name.replace("_", "<br>") for name in tables.parameter_names]
plots.paired_bars({p: {name: each[i] for name, each in best.items()} for i, p in enumerate(names)}, y="cosine")

# %% [markdown]
# Three parameters are found as they are, and nobody named them. The others are not, and for good reasons. The family thickens a leg from the table's corner inwards,
# which moves the leg too; the
# basis thickens it more about its own middle, which fewer handles notice. A thicker top *at the same height* shortens all legs, so it resembles the mode of the height most;
# the mode that moves the top alone thickens it upwards, *on the same legs*. **Local and meant by the designer are two things.**
#
# ## 4 Six chairs, and a dictionary trained to be local
#
# Fourteen families of chairs in one network, trained with the $l_1$ sparsity loss of Eq. 11. It wants the elements of $B^+ A_x$ to be 0, and lesson 08 is about how.

# %%
chairs = dsn_lite.as_shapes(data_gen.generate("chair", count=96, points=512, seed=7))
chair = dsn_lite.load("chair")
p, q = chairs[:48], chairs[48:]
rows = [p.about["families"].index(f"chair/{f}") for f in ("four_legs", "arms", "bent", "sled", "swivel", "rocking")]
few = p[torch.tensor([p.families.tolist().index(row) for row in rows])]
titles = [p.about["families"][row] for row in rows]

# %%
loaded, random = modes.read(chair, chairs), modes.read(chair.untrained(), chairs)
one = {"parts moved": lambda r: r.parts_moved.mean().item(), "quiet": modes.quiet_share}
{of: {"trained": count(loaded), "untrained": count(random)} for of, count in one.items()}

# %% [markdown]
# Few parts a mode, and several times as many quiet elements as untrained. The most local dictionary so far, by both numbers, and by eye too: the column that is used most, and one that
# moves the fewest parts.

# %%
A, v = chair.dictionary(p.points), chair.vector(p.points, q.points)
alone, on_few = modes.moved_by_columns(A, v), chair.dictionary(few.points)
plots.mode_on_shapes(few.points, on_few[..., int(alone.argmax())], titles=titles)

# %%
plots.mode_on_shapes(few.points, on_few[..., int(loaded.parts_moved.mean(0).argmin())], titles=titles)

# %% [markdown]
# **Predict first.** So a network of this kind has a slider for the seat, one for the back, ... How many different ones are there among its $k = 64$? The cosine of each column with each other:


# %%
def cosines(A):
    columns = A.flatten(0, -2)
    lengths = columns.norm(dim=0)
    return (columns.mT @ columns / (lengths * lengths[:, None])).abs()


between = cosines(A)
(between.fill_diagonal_(0).amax(1) > 0.95).sum().item()

# %% [markdown]
# That many of the 64 have a near copy among the others. Each column is local, and most are local in the same few ways: the loss counts elements column by column, and nothing in it asks that columns differ.
# What chairs need lies in the small differences. One can watch the copies cancel: each column's motion $A_j v_j$ on its own, squared and added up, against that of their sum:

# %%
alone.square().sum().sqrt().item(), metrics.rms(chair.deform(p.points, q.points) - p.points)

# %% [markdown]
# Local modes were asked for and delivered, one at a time. (And honestly: handles see where a part is and how large it is, and a column can also move points where *no handle sees it*. Exercise 4 makes
# such a motion; lesson 08 shows a dictionary that hides in them. The ready-made spaces of mixed categories were trained so that hiding gains nothing.) For each of them,
# the share of the columns that handles see, and the quiet elements:

# %%
names = ("table", "chair", "sofa", "lamp", "airplane", "car")
shapes = {name: dsn_lite.as_shapes(data_gen.generate(name, count=24, points=512, seed=9)) for name in names}
every = {name: modes.read(dsn_lite.load(name), shapes[name]) for name in names}
both = {n: {"seen by handles": r.inside.mean().item(), "quiet": modes.quiet_share(r)} for n, r in every.items()}
plots.paired_bars(both, y="share")

# %% [markdown]
# A change of basis throws the copies out, since *the vectors of real deformations fill few directions*, and `local_basis` keeps those:

# %%
basis = modes.local_basis(chair, p, q.points)
sliders = modes.change_of_basis(chair, basis.R)
used = modes.read(sliders, chairs).only(range(basis.used))
between = cosines(sliders.dictionary(p.points)[..., : basis.used]).fill_diagonal_(0)
basis.used, between.max().item(), used.inside.mean().item(), modes.quiet_share(used)

# %%
plots.mode_heat(used.energy_by_kind.mean(0), used.kinds)

# %% [markdown]
# A dozen directions or so instead of 64, and none a copy of another (the second number is the largest cosine). By `quiet_share` this basis is *worse* than the columns as trained: what is different from all others must move more. Judge for yourself which sliders
# you would rather have.
#
# **Predict first.** One of these modes moves the arms, another the back. What will the first do to a chair that has no arms: nothing?

# %%
colours = torch.tensor([used.kinds.index(modes.kind(name)) for name in chairs.part_names])[few.labels.long()]
v = sliders.vector(p.points, q.points)
widgets.DictionarySliders(sliders, few.points, range(basis.used), labels=colours, titles=titles, vectors=v)

# %%
arms = modes.silence(used, "arm")
plots.mode_on_shapes(few.points, sliders.dictionary(few.points)[..., arms.mode], titles=titles)

# %% [markdown]
# Not nothing: where the second chair and the last have arms, the others move the rim of the seat. On chairs without arms the mode moves the handles `handles` times as much as on
# those with; beside it the most
# arm-like mode of the untrained network. The paper says of a mode for swivel legs that it "does not affect" other chairs; our mode for arms is quieter there, not silent.

# %%
arms, modes.silence(modes.read(sliders.untrained(), chairs), "arm")

# %% [markdown]
# ## 5 Does a mode do the same to every shape?
#
# Everyone's first idea: take what mode $j$ does to each kind of part (how far it moves it along $x, y, z$ and how far it stretches it), on shape $x$ and on shape
# $y$; their cosine is the **consistency**
# of the mode. For comparison, mode $i$ of one shape against mode $j$ of the other. Before you run the next cell: what will the *untrained* network score?

# %%
blank = modes.read(space.untrained(), tables)
readings = {"tables": modes.read(tuned, tables).only(six), "tables,<br>untrained": blank}
readings |= {"chairs": used, "chairs,<br>untrained": random}
score = {name: (modes.consistency(r).mean().item(), modes.shuffled(r)) for name, r in readings.items()}
plots.paired_bars({name: {"same mode": s[0], "another": s[1]} for name, s in score.items()}, y="consistency")

# %% [markdown]
# The untrained networks win. With random weights $\mathcal{F}$ is one smooth field of *places*, nearly the same for all shapes, and seats are in the middle of all
# chairs. Consistency is necessary and
# shows nothing of learning; neither does a row of pictures in which a mode looks alike on all shapes.
#
# So ask a question that a field of places must answer wrongly. Take a point of $x$. On $y$ there is the point at the same spot of the same **part**, and the point
# at the same **place**.
# With which of the two does column $j$ agree?

# %%
alike_chairs = dsn_lite.as_shapes(data_gen.generate("chair/four_legs", count=48, points=512, seed=8))
pairs = {"tables": (tuned, x, y, local.used), "tables,<br>untrained": (space.untrained(), x, y, k)}
pairs |= {"chairs,<br>one family": (sliders, alike_chairs[:24], alike_chairs[24:], basis.used)}
pairs |= {"chairs,<br>mixed": (sliders, p, q, basis.used), "chairs,<br>untrained": (chair.untrained(), p, q, 64)}

# %%
found = {name: (modes.following(s, a, b), first) for name, (s, a, b, first) in pairs.items()}
means = {name: [each[:first].mean().item() for each in f] for name, (f, first) in found.items()}
plots.paired_bars({name: {"by part": m[0], "by place": m[1]} for name, m in means.items()}, y="cosine")

# %% [markdown]
# Now the networks are apart. Untrained, both cosines are 1: the field is so smooth that it hardly tells the two points apart. On tables, training made columns
# follow parts and not places. On chairs of one
# family they do so too, less clearly. Across the families the difference is small: what makes modes look alike on an armchair and a swivel chair is as
# much where things are as what they are.
# The paper argues that training makes the dictionaries consistent "even when the shapes are dissimilar"; here is how far that goes for this network, on these chairs.
#
# ## 6 The resolution trap
#
# The paper scales columns to unit *length* over all $3n$ numbers, ours have unit root mean square over the $n$ points: $\sqrt n$ times as large. A network trained
# with the first at $n = 2048$ learns vectors
# $\sqrt{2048}$ times as long to make up for it. Give it the same shape with more points, and every number of $A_x$ shrinks; the vector does not.
# Below, the *same* tables with the same $v$; only the number of points varies. Guess the slope.

# %%
dense = dsn_lite.as_shapes(data_gen.generate("table/four_legs", count=4, points=8192, seed=5)).points
start, v = dense[:2], space.vector(dense[:2], dense[2:])
unit = copy.deepcopy(space)
unit.dictionary.columns = "unit"

# %%
counts = (128, 512, 2048, 8192)
rms = {n: metrics.rms(space.act(start[:, :n], v) - start[:, :n]) for n in counts}
length = {n: metrics.rms(unit.act(start[:, :n], 2048**0.5 * v) - start[:, :n]) for n in counts}
plots.lines({"unit length": length, "unit rms": rms}, x="points n", y="moves points by, rms", log=True)

# %% [markdown]
# At four times the points, half the motion. Only at the $n$ of the training do the two agree. The picture is the first table on its way to the target, always the
# same 512 of its points, when the network of
# unit length is given 512, 2048 or 8192 of them:

# %%
several = [unit.act(start[0, :n], 2048**0.5 * v[0])[:512] for n in counts[1:]]
plots.shapes([start[0, :512], *several, dense[2, :512]], titles=["x", *(f"n = {n}" for n in counts[1:]), "target y"])

# %% [markdown]
# ## 7 Exercises
#
# **1.** For the table `t`, the share of each column's squared motion that lies in the top (label 0): $k$ numbers.

# %%
t, labels = tables.points[0], tables.labels[0]
A_t = space.dictionary(t)
# solution
top = A_t[labels == 0].square().sum((0, 1)) / A_t.square().sum((0, 1))

# %%
lengths = A_t.norm(dim=1)
wrong = {"these are shares of lengths: square them": lengths[labels == 0].sum(0) / lengths.sum(0)}
checks.array(top, modes.read(space, tables[:1]).energy[0, 0], "top", hints=wrong)

# %% [markdown]
# **2.** A colleague's columns are $A_x R$, with the `R` of section 3. Which vector `w` does for her what `u` does for you?

# %%
u = space.vector(t, tables.points[1])
# solution
w = torch.linalg.solve(R, u)

# %%
wrong = {"R u is the way back: her columns are A R": R @ u, "the transpose is the inverse only of a rotation": R.mT @ u}
checks.array(w, torch.linalg.inv(R) @ u, "w", hints=wrong, tolerance=1e-2)

# %% [markdown]
# **3.** A slider of your own. `meant[:60]` holds the true motion of the 60 tables `x` when their `leg_width` grows. Find the one vector `own` whose $A_x\,$`own` comes nearest
# to it, over all 60 tables together. (Double precision is safer.)

# %%
A_x, meant = space.dictionary(x.points).double(), true[..., tables.parameter_names.index("leg_width")].double()
# solution
own = torch.linalg.lstsq(A_x.flatten(0, 2), meant[:60].flatten()).solution

# %%
nearest = torch.linalg.lstsq(A_x.flatten(0, 2), meant[:60].flatten()).solution
checks.array(own, nearest, "own", tolerance=1e-2)
off = space.dictionary(y.points).double() @ nearest - meant[60:]
print(f"On the 60 tables y the best vector misses {metrics.rms(off) / metrics.rms(meant[60:]):.0%} of what is meant.")

# %% [markdown]
# So much? Leg thickness moves few points a little, and lesson 05 showed that it is learned last. For `"width"` it is far less: try it.
#
# **4.** What handles do not see, by hand: offsets `unseen` `(512, 3)` for the table `t`, of unit root mean square, that *no handle sees*. `handles.project(u)` is
# what the handles can make of `u`.

# %%
handles = dsn_lite.BoxHandles(labels, tables.rest[0], tables.boxes[0])
noise = torch.randn(512, 3, generator=torch.Generator().manual_seed(2))
# solution
_rest = noise - handles.project(noise)
unseen = _rest / _rest.square().sum(-1).mean().sqrt()


# %%
def judge(u):
    if u.shape != (512, 3) or abs(metrics.rms(u) - 1) > 1e-3:
        yield "it must be (512, 3) with a mean squared length of 1; divide by the root of the mean"
    if metrics.rms(handles.project(u)) > 1e-3:
        yield f"the handles see {metrics.rms(handles.project(u)):.2g} of it; take away what they can make"


checks.accepted(unseen, judge, "unseen")

# %% [markdown]
# **5.** A network with columns of unit length was trained at $n = 2048$. You give it a mesh of 80 vertices. By which `factor` must its vectors be multiplied so that
# the mesh moves as it should?

# %%
# solution
factor = (80 / 2048) ** 0.5

# %%
wrong = {"the other way round: with fewer points each moves farther": (2048 / 80) ** 0.5}
checks.number(factor, 80**0.5 / 2048**0.5, "factor", hints=wrong)

# %% [markdown]
# ## Take-away
#
# - Deformations, transfers and laws belong to the space. Locality, sparsity and what a slider does belong to a basis, and any invertible $R$ gives another.
# - The number of directions that vectors use does not depend on the basis: six for these tables, the number of their parameters.
# - A rotation alone, with part labels, turned mixed columns into sliders for height, depth and width. Compare what a sparsity loss gains with that.
# - A sparse dictionary has local columns, and they may be local in the same few ways. Ask how many are different, and look at a column on a shape before you believe a number.
# - Put the untrained network beside every claim. It is as consistent as any, because it hardly looks at the shape.
#
# ## What the paper does not say
#
# - That its pictures of modes show one basis of many. Nothing in $\mathcal{L}_F$ prefers it; only the sparsity loss does, and a rotation afterwards could.
# - How many of its sparse columns are different. Its losses look at one column at a time.
# - That the projected columns can all but vanish although columns are normalised. The footnote to Eq. 12 says that their norm "cannot be zero"; what handles do not
#   see is enough to bring it near (lesson 08).
# - What an untrained network scores in anything that is said of modes.
# - That with columns of unit length a vector means another motion at every number of points.
