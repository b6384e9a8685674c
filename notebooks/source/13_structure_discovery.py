# %% [markdown]
# # 13 Structure discovery
#
# **Objectives.** By the end you can
# 1. measure whether a space knows that legs are alike and carry the top, by the paper's rule and its four ratios,
# 2. say what such a number is worth, by what doing nothing and the exact answer score,
# 3. read from a spectrum how many ways to vary a space has found, and say what its other columns do to an edit.
#
# **Time.** 45 minutes. &nbsp; **Prerequisites.** Lessons 03, 06 and 07. &nbsp; **Paper.** Section 4.4, with Sections 3.2 and 4.1.

# %%
import torch

import data_gen
import dsn_lite
from dsn_lite import checks, lessons, plots, structure, widgets
from dsn_lite.handles import BoxHandles, corners
from dsn_lite.projection import EditProjector, Prior

lessons.begin()

# %% [markdown]
# ## 1 What nobody told it
#
# A table of this family has a rectangular top and four legs at its corners. It has 30 handles, six a part, and six parameters: most of what handles can do makes no table.
# The network saw point clouds of such tables. It was told no part, no leg, no top.

# %%
torch.set_grad_enabled(False)
tables = dsn_lite.as_shapes(data_gen.generate("table/four_legs", count=400, points=1024, seed=13))
seen, shapes = tables[:300], tables[300:]
space = dsn_lite.load("table_four_legs")
handles = BoxHandles.of(shapes, 0)
len(handles.names), tables.parameter_names

# %% [markdown]
# Each slider moves one *handle*, a column of $B$.
#
# **Predict first.** Move one: which symmetry or which contact breaks?

# %%
chosen = [handles.names.index(name) for name in ("leg_2.scale.y", "leg_2.scale.x", "top.translation.y")]
boxes = dsn_lite.LinearSpace(handles.B)
widgets.DictionarySliders(boxes, shapes.points[0], chosen, span=0.3, labels=shapes.labels[0])

# %% [markdown]
# Now one leg is made half as long, and the edit is completed (Eqs. 4 to 7, lesson 07): before, edited, completed.

# %%
projector = EditProjector.of(space, shapes, 0)
half = handles.z0[handles.names.index("leg_2.scale.y")].item() / 2
snapped = projector({"leg_2.scale.y": half})
broken = handles.z0.clone()
broken[handles.names.index("leg_2.scale.y")] = half

# %%
labels, titles = shapes.labels[0], ["before", "edited", "completed"]
clouds = [shapes.points[0], snapped.edited, snapped.points]
outlines = [corners(handles), corners(handles, broken), corners(handles, snapped.z_hat)]
plots.shapes(clouds, labels=labels, titles=titles, boxes=outlines)

# %% [markdown]
# The other legs follow, and the top comes down with them. If that happens for every edit, the space has *discovered* the structure. "Every" and "happens" want numbers.
#
# ## 2 The paper's numbers
#
# The paper takes a random handle, moves it by at most 0.5 where it is a translation and stretches it to between 0.5 and 1.5 where it is an edge length, completes that, and does so 2000 times. We make a few hundred.

# %%
edits = structure.random_edits(shapes, lessons.steps(300), seed=0)
edits[:3]

# %% [markdown]
# Four ratios: how much the $x$, $y$ and $z$ edges of two legs differ (mean over the pairs of legs), as shares of the table's width, height and depth; and how far the top is from the legs, as a share of the height. All in thousandths.

# %%
done = structure.complete(structure.learned(space), shapes, edits)
ratios = structure.leg_ratios(shapes, edits, done)
means = {name: 1000 * values.mean().item() for name, values in ratios.items()}
paper = {"x": 9.60, "y": 6.94, "z": 9.60, "gap": 31.7}
plots.paired_bars({"this space": means, "paper": paper}, y="mean ratio, 10⁻³")

# %% [markdown]
# Is that good? A number needs two others beside it: what the *best* answer scores, and what *no* answer scores.
#
# **Predict first.** Leave every edit as it is, complete nothing. What are the four means then, compared with the paper's?

# %%
left = structure.uncompleted(shapes, edits)
idle = {name: 1000 * values.mean().item() for name, values in structure.leg_ratios(shapes, edits, left).items()}
plots.paired_bars({"this space": means, "paper": paper, "nothing completed": idle}, y="mean ratio, 10⁻³")

# %% [markdown]
# Doing nothing does well! Of 30 handles, only four are a leg's edge along $x$; an edit of any other leaves the $x$ edges of the legs alike, as long as nothing else moves. The ratio does not ask whether the result is a table.
# What it asks is: *how much do you break of what was whole, and mend of what was broken?* So look at both kinds of edits:

# %%
pulled = torch.tensor([edit.handle.startswith("leg") and edit.handle.endswith("scale.y") for edit in edits])
kinds = {"a leg's edge y was edited": pulled, "another handle was": ~pulled}
shown = {"completed": ratios["y"], "left": structure.leg_ratios(shapes, edits, left)["y"]}
bars = {
    how: {kind: 1000 * y[own].nanmean().nan_to_num().item() for kind, own in kinds.items()} for how, y in shown.items()
}
plots.paired_bars(bars, y="mean ratio y, 10⁻³")

# %% [markdown]
# The space mends most of the one kind, and breaks a little of the other. A median would tell you only of the second kind, a mean is ruled by a few bad edits: the paper gives means.
#
# ## 3 The best answer
#
# These tables are linear in their parameters, so the boxes' handles are, too: $z = z_0 + W\,\Delta p$ with one matrix $W$ for all tables, found by least squares. Then $A = B W$ is the dictionary of all tables and nothing else.

# %%
slopes = structure.box_slopes(seen)["table/four_legs"]
exact = structure.moved_by_boxes({"table/four_legs": slopes})
best = structure.complete(exact, shapes, edits)
found = structure.leg_ratios(shapes, edits, best)
slopes.shape, {name: 1000 * values.mean().item() for name, values in found.items()}

# %% [markdown]
# Not all is 0: an edit may ask for more than a table can do, edges have to stay longer than 0, and then even the best answer gives up a contact. How often is a bound met, and what is left where it is not?

# %%
free = ~best.bounded
(
    best.bounded.double().mean().item(),
    {name: 1000 * values[free].max().item() for name, values in found.items() if free.any()},
)

# %% [markdown]
# ## 4 How many directions
#
# The space has more columns than tables have parameters. What do the others do? The motion of pairs of tables, in principal directions of what vectors use, largest first:

# %%
pairs = seen.points[:150], seen.points[150:]
used = structure.used_directions(space, *pairs)
spread = {i + 1: max(share.item(), 1e-12) for i, share in enumerate(used.share[:12])}
plots.lines({"share of the squared motion": spread}, x="direction", y="share", log=True)

# %% [markdown]
# A cliff: vectors between tables fill few directions. Nothing was ever asked of the others, but Eq. 4 offers all columns to the edit.
#
# **Predict first.** Keep the first $r$ directions and complete the same edits. Which $r$ is best, and what happens with fewer?


# %%
directions = dsn_lite.modes.principal(space, *pairs)[0]


def mean_ratios(r):
    completed = structure.complete(structure.learned(space, directions[:, :r]), shapes, edits[:100])
    return structure.leg_ratios(shapes, edits[:100], completed)


sizes = range(2, 11, 2)
by_size = {r: {name: 1000 * values.mean().item() for name, values in mean_ratios(r).items()} for r in sizes}

# %%
series = {name: {r: values[name] for r, values in by_size.items()} for name in paper}
plots.lines(series, x="directions kept", y="mean ratio, 10⁻³")

# %% [markdown]
# With too few, parts that should vary apart are tied together; the ratios hardly punish that, for who can do little breaks little. With too many, an edit finds directions in which no table varies, and uses them: they close a gap, and leave legs that differ.
# The rule of `used_directions` keeps what makes all but 0.01 % of the motion. It reads codes and motions, no part and no parameter.

# %%
kept = structure.complete(structure.learned(space, used.basis), shapes, edits)
middle = structure.leg_ratios(shapes, edits, kept)
medians = {"directions in use": middle, "all columns": ratios}
table = {said: {name: 1000 * v.median().item() for name, v in each.items()} for said, each in medians.items()}
plots.paired_bars(table, y="median ratio, 10⁻³")

# %% [markdown]
# The worst of them, before, edited, completed. What do these edits have in common?

# %%
worst = torch.stack(list(middle.values())).amax(0).argsort(descending=True)[:3].tolist()
[(edits[t].handle, round(edits[t].value, 2)) for t in worst]

# %%
t, i = worst[0], edits[worst[0]].shape
own = BoxHandles.of(shapes, i)
again = EditProjector.of(space, shapes, i, Prior(used.basis))({edits[t].handle: edits[t].value})
clouds = [shapes.points[i], again.edited, again.points]
plots.shapes(clouds, labels=shapes.labels[i], titles=titles, boxes=[corners(own), None, corners(own, again.z_hat)])

# %% [markdown]
# Some handles no table moves: its top is always above the origin. A space that learned this *exactly* leaves such an edit alone; one that learned it *nearly* finds a tiny motion of the top and takes a hundred times of it.
#
# ## 5 As far as it agrees with itself
#
# How far off is the dictionary? No truth is needed to tell. Where actions add, $\mathcal{F}(x)$ is $\mathcal{F}(x \oplus v)$, all along a deformation; by how much the two differ, one of them must be off:

# %%
used.noise

# %% [markdown]
# That is how far a point is misled, in units of the table's size, for each unit of $w$, $v = W w$, and along $W$ real tables vary by about 1. A hundred times of a tiny motion is misled a hundred times as far. So let the projection pay for it:
# $|B\,\delta z - \mathcal{F}(x) W w|^2 + n\,\mathrm{noise}^2\,|w|^2$.

# %%
trusted = structure.complete(structure.learned(space, used.basis), shapes, edits, used.noise)
cured = structure.leg_ratios(shapes, edits, trusted)
means = {"directions in use": middle, "as far as they agree": cured}
plots.paired_bars(
    {said: {name: 1000 * v.mean().item() for name, v in each.items()} for said, each in means.items()},
    y="mean ratio, 10⁻³",
)

# %% [markdown]
# The edit of before, once more:

# %%
careful = EditProjector.of(space, shapes, i, used.prior)({edits[t].handle: edits[t].value})
clouds = [shapes.points[i], again.points, careful.points]
named = {"before": corners(own), "trusting": corners(own, again.z_hat), "careful": corners(own, careful.z_hat)}
plots.shapes(clouds, labels=shapes.labels[i], titles=list(named), boxes=list(named.values()))

# %% [markdown]
# It costs a little where the dictionary was right, and helps most where it only seemed to know.
#
# ## 6 A rival that needs names
#
# PCA of the handles' values (lesson 03) finds the same six directions from 300 tables, if someone says which box is which leg:

# %%
components = structure.handle_components(seen, used.basis.shape[1])
by_names = structure.complete(structure.moved_by_boxes(components), shapes, edits)
{name: 1000 * values.mean().item() for name, values in structure.leg_ratios(shapes, edits, by_names).items()}

# %% [markdown]
# As good as the exact dictionary. The network's place is where names do not reach: fourteen kinds of chairs, with and without arms, columns, rockers, in one space. There the ratios are of mirrored pairs and of contacts, which each family tells:

# %%
chairs = dsn_lite.as_shapes(data_gen.generate("chair", count=120, points=1024, seed=13))
mixed = dsn_lite.load("chair")
of_chairs = structure.random_edits(chairs, lessons.steps(60), seed=0)
basis = structure.used_directions(mixed, chairs.points[:60], chairs.points[60:]).basis
completed = structure.complete(structure.learned(mixed, basis), chairs, of_chairs)

# %%
two = {"completed": completed, "left": structure.uncompleted(chairs, of_chairs)}
told = {how: structure.pair_ratios(chairs, of_chairs, each) for how, each in two.items()}
plots.paired_bars(
    {how: {n: 1000 * v.nanmean().item() for n, v in each.items()} for how, each in told.items()}, y="mean ratio, 10⁻³"
)

# %% [markdown]
# Compare with what was left alone before you praise it: one network of many families may break more than it mends, of pairs that were whole.
#
# `python -m dsn_lite reproduce structure` makes 2000 edits with each of three trained networks, and as many chairs, sofas and airplanes as its page says. What follows is written from its figures.

# %%
from IPython.display import Markdown

from dsn_lite.experiments import report

stored = report.stored("structure")
Markdown(stored.experiment.section(stored) if stored.entries else "No run is done yet.")

# %% [markdown]
# ## 7 Exercises
#
# **1.** The ratio $y$ of one completed table, by hand: `edges` $(4,)$ are the heights of its legs, `height` is the table's.

# %%
edges, height = torch.tensor([0.62, 0.60, 0.60, 0.58]), 0.7
# solution
_apart = (edges[:, None] - edges).abs()
ratio_y = _apart.sum() / 12 / height

# %%
whole = (edges[:, None] - edges).abs().sum() / 16 / height
hints = {"a leg is no pair with itself": whole, "that is the largest difference": 0.04 / height}
checks.number(ratio_y, 0.12 / 6 / height, "ratio_y", hints=hints)

# %% [markdown]
# **2.** Leg 1 of one table under the top of another: their gap, as a share of `height`, from their boxes: centre in the numbers 0 to 2, edge lengths in 12 to 14.

# %%
top, leg, height = shapes.boxes[0, 0], shapes.boxes[1, 1], 0.7
# solution
_low, _high = top[1] - top[13] / 2, leg[1] + leg[13] / 2
gap = (_low - _high).abs() / height

# %%
from dsn_lite.structure.ratios import faces

under, over = faces(top)[0][1], faces(leg)[1][1]
checks.number(gap, (under - over).abs() / 0.7, "gap", hints={"centres": (top[1] - leg[1]) / 0.7})

# %% [markdown]
# **3.** The row of $W$ for the edge length $y$ of leg 1, as numbers $(6,)$: how does it change with width, height, depth, thickness of the top, width and depth of a leg? Think, then compare.

# %%
# solution
row = torch.tensor([0.0, 1.0, 0.0, -1.0, 0.0, 0.0])

# %%
checks.array(
    row, slopes[1, 1, 1].float(), "row", hints={"the top is above the legs": row.abs() if row is not ... else 0}
)

# %% [markdown]
# **4.** Name a handle that no table of this family moves: its row of $W$ is 0.

# %%
# solution
handle = "top.translation.x"


# %%
def of_a_table(handle):
    if handle not in handles.names:
        yield f"there is no handle {handle!r}; look at handles.names"
    elif slopes[handles.kept][handles.names.index(handle)].abs().max() > 1e-4:
        yield "some parameter moves it"


checks.accepted(handle, of_a_table, "handle")

# %% [markdown]
# **5.** The rule for directions in use, from `share` (largest first): the smallest number of directions that make at least 99.99 % of the motion.

# %%
share = used.share
# solution
count = int((share.cumsum(0) < 0.9999).sum()) + 1

# %%
checks.number(
    count, used.basis.shape[1], "count", hints={"one more: the sum must reach 99.99 %": used.basis.shape[1] - 1}
)

# %% [markdown]
# ## Take-away
#
# - Structure is what edits are completed to. It is in the span of the dictionary, and in how few directions that span has.
# - A dictionary that is nearly right is followed where it should not be; by how much it disagrees with itself along a deformation it tells how far to trust it, without any truth.
# - A ratio needs the exact answer and doing nothing beside it. Here doing nothing has a median of 0.
# - Where parts have names and families are apart, PCA of handles is exact and free. The network needs neither.
#
# ## What the paper does not say
#
# - How often an edit fails, and what the median is. Its four numbers are means, which a few edits rule.
# - What no projection scores; beside it, the ratios of symmetric edges say little.
# - Whether "difference" is between the largest and the smallest or the mean over pairs (ours), which table is "the default shape" (ours: each of those held out), and how edges are kept longer than 0.
# - How many columns its dictionary had here, and that columns that no table needs take part in every projection.
