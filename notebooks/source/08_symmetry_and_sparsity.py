# %% [markdown]
# # 08 Symmetry and sparsity
#
# **Objectives.** By the end you can
# 1. say what the mirror loss asks for, what it costs, and for which shapes it is wrong,
# 2. tell from the geometry of the two sparsity losses which zeros they make, and hold that against trained networks,
# 3. compute $B^+\mathcal{F}(x)$ by hand, and say why a normalised column cannot vanish in it, where it hides all the same, and what closes the hole.
#
# **Time.** 60 minutes, one of them training. &nbsp; **Prerequisites.** Lesson 05. &nbsp; **Paper.** Sections 3.3 and 4.1, Eqs. 10 to 13.

# %%
import torch

import data_gen
import dsn_lite
from dsn_lite import Config, checks, lessons, losses, metrics, modes, plots, widgets
from dsn_lite.data import triplets
from dsn_lite.dictionary import offsets

lessons.begin()

# %% [markdown]
# ## 1 The mirror loss
#
# Most furniture is its own mirror image, and should stay so when it is deformed. Let $R$ flip the sign of $x$ and $d = d(x \to y)$; Eq. 10 asks that $d$ lies on its mirror image:
# $$\mathcal{L}_R = \mathrm{Ch}(d, R\,d).$$
# A thousand chairs of fourteen kinds:

# %%
torch.set_grad_enabled(False)  # we mostly look; training switches gradients on by itself
chairs = dsn_lite.as_shapes(data_gen.generate("chair", count=1000, points=512, seed=1))
test = chairs.split(seed=0)[2]
losses.symmetry(test.points, "x").item(), losses.symmetry(test.points, "z").item()

# %% [markdown]
# These chairs *are* symmetric in $x$, and the number is not 0: a cloud and its mirror image are two samplings of one surface. Like $\mathcal{L}_F$, this loss has a sampling floor.
# Across $z$, where a chair is not symmetric, it is many times larger.
#
# **Predict first.** Eleven kinds of sofas follow. Are they all symmetric in $x$?

# %%
sofas = dsn_lite.as_shapes(data_gen.generate("sofa", count=200, points=512, seed=1))
found = {name: losses.symmetry(sofas.of_family(name).points).item() for name in sofas.family_names}
plots.bars({name.removeprefix("sofa/"): value for name, value in found.items()}, x="sofa", y="Ch(x, R x)")

# %% [markdown]
# The chaise has its long seat on one side, and $\mathcal{L}_R$ would rather not have it there. The paper uses the loss "when a global reflection symmetry axis is given for the source
# shape": someone has to know. (Desks with drawers on one side are another such kind, and an arc lamp mirrors at $z = 0$ where a tripod mirrors at $x = 0$.)
#
# ## 2 With and without
#
# What does the loss cost? $\mathcal{L}_F$ has a search tree of the deformed shape already; $\mathcal{L}_R$ asks it once more, for the mirror image, and not twice (exercise 1). In milliseconds a step,
# without it and with it, the fastest of twenty, taken in turns:

# %%
import time

from dsn_lite.training import Training


def milliseconds(training):
    start = time.perf_counter()
    training.take_step()
    return 1000 * (time.perf_counter() - start)


# %%
pair = [Training(chairs, Config(k=64, symmetry=weight)) for weight in (0, 1)]
turns = [[milliseconds(each) for each in pair] for _ in range(lessons.steps(20))]
[min(times) for times in zip(*turns, strict=True)]

# %% [markdown]
# And what does it buy? Two trainings of as many steps, that differ in nothing else:


# %%
def trained(symmetry):
    return dsn_lite.train(chairs, Config(k=64, steps=lessons.steps(240), symmetry=symmetry))


free, mirrored = trained(0), trained(1)

# %% [markdown]
# The Chamfer distance hides the difference under its floor, but $\mathcal{F}$ can be asked at *any* place, also at the mirror image of a point. A deformation that keeps the symmetry moves the image as the image of how it moves the point.


# %%
def lopsided(space, x, y):
    v, image = space.vector(x, y), losses.mirror(x, "x")
    here, there = (offsets(space.dictionary(x, at=at), v) for at in (x, image))
    return there - losses.mirror(here, "x")


x, y, _ = triplets(test, 60)
p, q = x.points, y.points
[metrics.rms(lopsided(each, p, q)) / metrics.rms(each.deform(p, q) - p) for each in (free, mirrored)]

# %% [markdown]
# That is the lopsided share of the motion, without the loss and with it. Fitting suffers little or not at all:

# %%
[metrics.evaluate(each, test).fitting_cd for each in (free, mirrored)]

# %% [markdown]
# Where is a deformation lopsided? The pair for which it was worst without the loss, painted by how far a point's motion is from its image's:

# %%
worst = int(lopsided(free, p, q).square().sum((1, 2)).argmax())
a, b = p[worst], q[worst]
both = [each.deform(a, b) for each in (free, mirrored)], [lopsided(each, a, b) for each in (free, mirrored)]
plots.mode_on_shapes(*both, titles=["without", "with the mirror loss"])

# %% [markdown]
# ## 3 What a column does to the handles
#
# The sparsity losses do not look at $\mathcal{F}(x)$ but at $B^+\mathcal{F}(x)$: what each column does to the **handles**. Here a handle is a number of a part's box: where its centre is, and how
# long it is, along three axes; six numbers a part. Points follow their box, $p = R\,(c + s\,r)$ with $r$ the place in the unit box, so $x = B z_0$ is linear.
#
# $B^+u$ asks for the handles' motion that comes nearest to offsets $u$. Points belong to one part, axes do not mix, so it falls apart into regressions of *two* numbers: for each part
# and axis the shift $t$ and the stretch $s$ of
# $$\min_{t,\,s} \sum_{i \,\in\, \text{part}} (u_i - t - s\, r_i)^2.$$
# Neither $B$ ($3n \times m$) nor $BB^+$ ($3n \times 3n$) is needed for it. You will do one by hand (exercise 2).

# %%
from dsn_lite.handles import BoxHandles

stored = dsn_lite.load("chair")
one = BoxHandles(test.labels[0], test.rest[0], test.boxes[0], test.part_names)
Z = one.coordinates(stored.dictionary(test.points[0]))
Z.shape, one.names[:6]

# %% [markdown]
# One row a handle, one column a mode. Chairs differ in parts, so batches are padded, and the padding must be rows of zeros: anything else would be part of the norm.
#
# ## 4 Two norms, two kinds of zeros
#
# $$\mathcal{L}_{S1} = \frac{1}{k} \sum_{j} \sum_i |Z_{ij}|, \qquad \mathcal{L}_{S2,1} = \frac{1}{k} \sum_j \Big( \sum_i Z_{ij}^2 \Big)^{1/2}, \qquad Z = B^+\mathcal{F}(x).$$
# Take a column of two elements. A least-squares answer lies outside of the unit ball of the norm; which point of the ball is nearest to it?

# %%
angle = torch.linspace(0, 2 * torch.pi, 401)
around = torch.stack([angle.cos(), angle.sin()], 1)
balls = {"l1": around / around.abs().sum(1, keepdim=True), "l2,1": around / around.norm(dim=1, keepdim=True)}
answer = torch.tensor([1.6, 0.5])
nearest = {f"{name}: nearest": ball[(ball - answer).norm(dim=1).argmin()] for name, ball in balls.items()}
plots.plane(balls, {"answer": answer} | nearest, x="element 1", y="element 2")

# %% [markdown]
# The ball of $l_1$ has corners on the axes, and corners catch: the second element is exactly 0. Within a column, $l_{2,1}$ is the circle: it shortens, and makes no zero.
# Between columns it is a sum again. For *one element each of two columns* its ball is the left one's diamond: whole **columns** become 0.
#
# The same in gradients. A long column with one large, one middling, one tiny element and a zero:

# %%
z_column = torch.tensor([[1.0], [0.1], [0.001], [0.0]], requires_grad=True)
with torch.enable_grad():
    pulls = {name: torch.autograd.grad(loss(z_column), z_column)[0].flatten() for name, loss in losses.SPARSITY.items()}
pulls

# %% [markdown]
# $l_1$ pulls at the tiny element as hard as at the large one, all the way to 0. $l_{2,1}$ pulls at it a thousand times less: the direction of a column is of no interest to it, only its length.
# (At 0 itself neither has a gradient, it has a kink; torch says 0.)
#
# The paper trains with $l_{2,1}$ and reports that it "also plays the role of $l1$-loss, sparsifying each column". **Predict first:** will it, here?
#
# ## 5 The sweep
#
# `python -m dsn_lite reproduce sparsity` trained networks of chairs with each norm and several weights, three times each. What counts as zero? That is a choice, so it is a slider.
#
# **Predict first.** On the left, the share of elements above the threshold (as a share of the shape's largest). On the right the same numbers against what was paid, the fitting
# distance of held-out chairs. Which norm makes more zeros for the same price, and does the answer depend on the threshold? And how many of 64 columns will vanish?

# %%
from dsn_lite.experiments import report, sparsity

sweep = report.stored("sparsity")
arms = {sparsity.label(arm): arm for arm in sweep.arms}
curve = lambda arm, figure: dict(zip(sparsity.THRESHOLDS, sweep.curve(arm, figure), strict=True))
elements, columns = ({said: curve(arm, of) for said, arm in arms.items()} for of in ("elements", "columns"))
price = {said: 1000 * sweep.mean(arm, "fitting_cd") for said, arm in arms.items()}
shown = {"non-zero elements, %": elements, "non-zero columns": columns}
widgets.ThresholdSlider(shown, price, cost="fitting CD, 10⁻³")

# %% [markdown]
# The curves of $l_{2,1}$ lie close together: it costs fitting and makes few zeros *within* columns, as the circle said. $l_1$ makes many for about the same price, at any threshold but the largest.
# And no column vanishes with either (press *non-zero columns*): they only begin to go where the threshold is a sizeable share of the longest. Section 7 says why.
#
# ## 6 Live: $l_1$
#
# **Predict first.** The chairs that ship were trained with an $l_1$ loss too, with a larger weight and for longer (the line below says how; section 7 what `--unit seen` is). Here is plain $l_1$ with $w = 1$,
# for 40 seconds. It will fit worse than they do. Will it be less sparse?

# %%
live = widgets.LiveTraining(chairs, Config(k=64, symmetry=1, sparsity=1, norm="l1", seconds=lessons.seconds(40)))
local = live.run()

# %%
spaces = {"w = 0": mirrored, "l1, w = 1": local, "shipped": stored, "untrained": stored.untrained()}
readings = {said: modes.read(space, test) for said, space in spaces.items()}
print("shipped:", dsn_lite.zoo.RECIPES["chair"].train)
{said: metrics.evaluate(space, test).fitting_cd for said, space in spaces.items()}

# %%
quiet = {said: modes.quiet_share(reading) for said, reading in readings.items()}
plots.bars(quiet, x="trained with", y="elements below 1 %, share")

# %% [markdown]
# Where the most local column of each moves one chair ("local": the fewest parts, over all chairs):

# %%
chosen = {said: int(readings[said].parts_moved.mean(0).argmin()) for said in list(spaces)[:3]}
chair = test.points[0]
fields = [spaces[said].dictionary(chair)[..., j] for said, j in chosen.items()]
plots.mode_on_shapes([chair] * 3, fields, titles=[f"{said}: column {j}" for said, j in chosen.items()])

# %% [markdown]
# Is what $l_1$ found more local than what no loss at all did? And what did the longer training add?
#
# ## 7 Why a normalised column cannot vanish, and how it does
#
# Every column of $\mathcal{F}(x)$ has length 1 *before* it is projected. The paper's footnote concludes that the length of $B^+A_j$ "can still be minimized (but cannot be zero)". How short
# can it get? Ask the singular values of $B$: of all motions that handles make, the cheapest is the first left singular vector, and it costs $1 / \sigma_1$.

# %%
B = one.B.flatten(0, 1)
U, sigma, _ = torch.linalg.svd(B, full_matrices=False)
cheapest = U[:, 0].unflatten(0, (512, 3))
B.shape, one.coordinates(cheapest).norm(), 1 / sigma[0], 1 / sigma[-1]

# %% [markdown]
# It is the shift of the part with the most points, as a whole: many points, one number. The dearest is the stretch of a small part. So among the handles $l_{2,1}$ does not empty a column;
# it makes every column push the seat about.
#
# But the footnote forgets what handles *cannot* make. $B$ has $m$ columns and $3n$ rows; of $3n$ directions all but $m$ are invisible to $B^+$. Take noise, and take from it what handles can make:

# %%
noise = torch.randn(512, 3, generator=torch.Generator().manual_seed(0))
ripple = noise - one.project(noise)
ripple = ripple / ripple.norm()
one.coordinates(ripple).norm()

# %% [markdown]
# A column of length 1 that costs nothing. No deformation wants it, and none needs to have it: give *all* columns the same ripple, and let the numbers of $v$ add up to 0. Each column is then
# mostly ripple, the rest of it is as short as you like, $v$ is long to make up for that, and $d$ has not changed at all (exercise 5).
#
# Does gradient descent find this? Leave the network out: sixteen columns for one chair, free numbers, and a vector for each of sixty targets. They start as motions that handles make, and must make the targets
# at a small $\mathcal{L}_{S2,1}$. Once columns have length 1 as a *whole*, as in the paper; once they have length 1 as handles *see* them, $|BB^+A_j| = 1$.

# %%
others = test.points[1:61]
targets = (stored.deform(chair.expand(len(others), -1, -1), others) - chair).flatten(1).mT


def objective(raw, v, w, seen):
    A = raw / (one.project(raw) if seen else raw).flatten(0, 1).norm(dim=0)
    misses = (A.flatten(0, 1) @ v - targets).square().sum() / targets.square().sum()
    return misses + w * losses.sparsity_l21(one.coordinates(A)[None])


# %%
def start():
    noise = torch.randn(512, 3, 16, generator=torch.Generator().manual_seed(0))
    return one.project(noise).requires_grad_(), torch.zeros(16, len(others)).requires_grad_()


# %%
@torch.enable_grad()
def search(w, seen):
    raw, v = start()
    descent = torch.optim.Adam([raw, v], lr=0.01)
    for _ in range(lessons.steps(300)):
        raw.grad, v.grad = torch.autograd.grad(objective(raw, v, w, seen), (raw, v))
        descent.step()
    return raw.detach()


# %% [markdown]
# How much of the columns do handles see in the end, by the weight of the loss?

# %%
seen_of = lambda raw: (one.project(raw).square().sum((0, 1)) / raw.square().sum((0, 1))).mean().item()
visible = {
    f"length 1 {said}": {w: seen_of(search(w, seen)) for w in (0, 1, 3)}
    for said, seen in (("as a whole", False), ("as seen", True))
}
plots.lines(visible, x="weight w of the sparsity loss", y="share of the columns that handles see")

# %% [markdown]
# The more the loss weighs, the more columns of unit length hide, and those whose length is what handles see have no reason to.
#
# And networks? The stored sweep says what handles see of the columns of each. (A thousand steps are short. `train shapes.npz --k 64 --sparsity 10 --symmetry 1 --steps 8000`, on 4000 chairs of 2048 points,
# left them 4 % to see.)

# %%
plots.bars({said: sweep.mean(arm, "inside") for said, arm in arms.items()}, x="trained with", y="seen by handles, %")

# %% [markdown]
# For the networks of this lesson, how much of the *columns'* motion handles can make, and how much of the motion of the *deformations* that are made of them:

# %%
from dsn_lite.handles import BatchHandles

moves = {said: space.deform(p, q) - p for said, space in spaces.items()}
kept = {said: BatchHandles.of(x).project(u).square().sum() / u.square().sum() for said, u in moves.items()}
columns = {said: reading.inside.mean().item() for said, reading in readings.items()}
parts = {"of columns": columns, "of deformations": {said: share.item() for said, share in kept.items()}}
plots.paired_bars(parts, y="share that handles can make")

# %% [markdown]
# In an honest space the two are not far apart. Where columns are far below deformations, they are filled with what no handle sees and no vector uses. The chairs that ship were trained with `--unit seen`.
# Here is what is cheap, what is free, and one of their columns taken apart:

# %%
j = int(modes.moved_by_columns(stored.dictionary(p), stored.vector(p, q)).argmax())
column = stored.dictionary(chair)[..., j]
made = one.project(column)
fields = [cheapest * 512**0.5, ripple * 512**0.5, made, column - made]
titles = ["cheapest for the handles", "free: a ripple", f"shipped column {j}, seen by handles", "and not seen"]
plots.mode_on_shapes([chair] * 4, fields, titles=titles)

# %% [markdown]
# The loss is a number about columns, and columns are not what is used. There are ways out, though none in the paper:
#
# - measure a column's length as the handles see it, $|BB^+A_j|$, and divide by that: what hides gains nothing (`Config(unit="seen")`);
# - penalise what is used, $|B^+A_j|\,|v_j|$, not what is there;
# - leave the loss, and turn the basis after training, which changes no deformation (*varimax*; lesson 06).
#
# The first closes the hole, and says nothing about columns being *different*: lesson 06 asks that. The first and the last are in the sweep. Here is all of it, with words that are made from its figures:

# %%
from IPython.display import Markdown

Markdown(sweep.experiment.section(sweep))

# %% [markdown]
# ## 8 Exercises
#
# **1.** The mirror loss for the cloud `d`, with *one* search for neighbours: the mean squared distance from each point of $R\,d$ to its nearest in $d$, and what follows from $R = R^{-1}$.

# %%
d = mirrored.deform(p[0], q[0])
# solution
_image = d * torch.tensor([-1.0, 1.0, 1.0])
one_way = torch.cdist(_image, d).min(1).values.square().mean()
mirror_loss = 2 * one_way

# %%
checks.number(mirror_loss, losses.symmetry(d[None]), "mirror_loss", tolerance=1e-2)

# %% [markdown]
# **2.** One regression of $B^+$ by hand: the shift `t` and the stretch `s` of the seat along its box's first axis for the offsets `u`; `r` are the rest coordinates along that axis.

# %%
seat = test.labels[0] == test.part_names.index("seat")
box_axes = test.boxes[0][test.part_names.index("seat"), 3:12].unflatten(0, (3, 3))
u, r = (column[seat] @ box_axes)[:, 0], test.rest[0][seat, 0]
# solution
s = ((u - u.mean()) * (r - r.mean())).sum() / (r - r.mean()).square().sum()
t = u.mean() - s * r.mean()

# %%
by_name = dict(zip(one.names, one.coordinates(column), strict=True))
forgot = {"it is the mean of u; take off s times the mean of r": u.mean()}
checks.number(t, by_name["seat.translation.x"], "t", hints=forgot)
checks.number(s, by_name["seat.scale.x"], "s")

# %% [markdown]
# **3.** One step of shrinking. Which column $z$ minimises $\frac12 |z - c|^2 + 0.2\,|z|_1$, and which $\frac12 |z - c|^2 + 0.2\,|z|_2$? Both have a closed form: the first treats each element
# alone, the second keeps the direction of $c$.

# %%
c = torch.tensor([1.0, -0.5, 0.15, -0.1, 0.0])
# solution
by_l1 = c.sign() * (c.abs() - 0.2).clamp_min(0)
by_l2 = c * (1 - 0.2 / c.norm()).clamp_min(0)

# %%
unsigned = {"signs are lost": (c.abs() - 0.2).clamp_min(0)}
checks.array(by_l1, torch.nn.functional.softshrink(c, 0.2), "by_l1", hints=unsigned)
checks.array(by_l2, c - 0.2 * c / c.norm(), "by_l2")

# %% [markdown]
# **4.** Suppose columns were normalised after $B^+$, so that every column of $Z$ has length 1. What is $\mathcal{L}_{S2,1}$ then, whatever the network does? And between which two values does
# $\mathcal{L}_{S1}$ lie when there are $m = 54$ handles?

# %%
# solution
always = 1.0
least, most = 1.0, 54**0.5

# %%
even = torch.full((1, 54, 1), 54**-0.5)
checks.number(always, losses.sparsity_l21((Z / Z.norm(dim=0))[None]), "always")
checks.number(least, losses.sparsity_l1(torch.eye(54)[None]), "least")
checks.number(most, losses.sparsity_l1(even), "most")

# %% [markdown]
# So with columns of that length only $l_1$ is left to say something, and it says what was asked: few handles a column.

# %% [markdown]
# **5.** The way around. `A` has 32 columns of length 1, and `v` moves along them. Make `twins`, 64 columns of length 1: 32 times $g + \epsilon A_j$, then 32 times $g - \epsilon A_j$, each divided by its
# own length, where $g$ is the ripple; and `w`, 64 numbers with `twins` $w$ = `A` $v$.

# %%
A, g, epsilon = stored.dictionary(chair)[..., :32] / 512**0.5, ripple[..., None], 0.01
v = torch.randn(32, generator=torch.Generator().manual_seed(1))
# solution
_both = torch.cat([g + epsilon * A, g - epsilon * A], -1)
_lengths = _both.flatten(0, 1).norm(dim=0)
twins = _both / _lengths
w = torch.cat([v, -v]) * _lengths / (2 * epsilon)


# %%
def of_length_one(twins):
    if (twins.flatten(0, 1).norm(dim=0) - 1).abs().max() > 1e-4:
        yield "its columns must have length 1"


checks.accepted(twins, of_length_one, "twins")
checks.accepted(w, lambda w: [] if torch.allclose(twins @ w, A @ v, atol=1e-3) else ["twins w must be A v"], "w")

# %% [markdown]
# How do the two sparsity losses of `twins` depend on $\epsilon$, and what happens to `w`? Try 0.1 and 0.001.

# %% [markdown] tags=["solution"]
# $B^+$ sees only $\epsilon A_j$, so both losses are $\epsilon$ times those of `A` (over $\sqrt{1 + \epsilon^2}$), as small as one likes; $w$ grows as $1/\epsilon$, and no term of Eq. 13 asks about the length of
# $\mathcal{E}(y) - \mathcal{E}(x)$. Rounding ends it: at $\epsilon = 10^{-6}$ the ripple swamps what single precision can hold.

# %% [markdown]
# ## Take-away
#
# - The mirror loss has a floor, costs one search a step, and keeps deformations from leaning to one side. Whether a shape is symmetric it must be told.
# - $l_1$ makes zeros among elements, $l_{2,1}$ among columns. Columns that are normalised first cannot become zero, so of $l_{2,1}$ there remains a preference for cheap motions.
# - A loss on columns of $B^+\mathcal{F}(x)$ can be lowered without making one deformation different. Look at what is used, not at what is there.
#
# ## What the paper does not say
#
# - What its threshold of zero is relative to, and whether elements of padded handles were counted. Ours is a shape's own largest element or column, over real handles.
# - That Chamfer terms carry a factor of 100 in the authors' code. Without it $w = 10$ would drown the fit. (Their code has both sparsity losses, and calls neither.)
# - That handles see $m$ of $3n$ directions: its footnote holds for columns that handles can make, and training is free to choose others.
# - What $\mathcal{L}_R$ does to shapes that are not symmetric, and how large it is for shapes that are.
