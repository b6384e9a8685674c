"""Structure discovery: edits by the paper's rule, ratios, what is taken for plausible; truths come from data_gen."""

from dataclasses import replace
from itertools import combinations

import pytest
import torch
from worlds import shapes_of

import data_gen
from dsn_lite import LinearSpace, as_shapes, structure
from dsn_lite.handles import BoxHandles
from dsn_lite.structure.completing import moved_boxes
from dsn_lite.structure.ratios import extents, faces

TABLE = "table/four_legs"


@pytest.fixture(scope="module")
def tables():
    """Tables, and data_gen's collection of them."""
    made = data_gen.generate(TABLE, count=16, points=96, seed=0)
    return as_shapes(made), made


@pytest.fixture(scope="module")
def edits(tables):
    return structure.random_edits(tables[0], 60, seed=1)


@pytest.fixture(scope="module")
def exact(tables):
    return structure.moved_by_boxes(structure.box_slopes(tables[0]))


def test_edits_keep_to_the_papers_rule(tables):
    drawn = structure.random_edits(tables[0], 300, seed=0)
    reached = {"scale": [], "translation": []}
    for edit in drawn:
        handles = BoxHandles.of(tables[0], edit.shape)
        value = handles.z0[handles.names.index(edit.handle)].item()
        kind = edit.handle.split(".")[1]
        reached[kind].append(edit.value / value - 1 if kind == "scale" else edit.value - value)
    for found in reached.values():
        assert max(map(abs, found)) <= 0.5 + 1e-6
        assert max(found) > 0.4
        assert min(found) < -0.4
    assert {edit.shape for edit in drawn} == set(range(16))
    assert {edit.handle for edit in drawn} == set(BoxHandles.of(tables[0]).names)


def test_edits_are_drawn_from_their_seed(tables):
    drawn = [structure.random_edits(tables[0], 5, seed) for seed in (0, 0, 1)]
    assert drawn[0] == drawn[1] != drawn[2]


def test_no_edits_are_refused(tables):
    with pytest.raises(ValueError, match="random_edits: count must be 1 or more, got 0; the paper makes 2000"):
        structure.random_edits(tables[0], 0)


@pytest.mark.parametrize("family", [TABLE, "chair/four_legs"])
def test_slopes_of_boxes_are_the_jacobian_of_the_rig(family):
    made = data_gen.generate(family, count=24, points=400, seed=0)  # fewer may leave a thin part no spread
    shapes, truth = as_shapes(made), torch.from_numpy(data_gen.valid_space(made))
    plausible = structure.moved_by_boxes(structure.box_slopes(shapes))
    found = torch.cat([plausible(shapes[i]) for i in range(3)])
    torch.testing.assert_close(found, truth[:3], rtol=0, atol=2e-5)


def test_a_family_without_slopes_does_not_move(tables):
    A = structure.moved_by_boxes({})(tables[0][0])
    assert A.shape == (1, 96, 3, 1)
    assert not A.any()


def test_the_exact_dictionary_keeps_the_structure_where_no_bound_is_met(tables, edits, exact):
    shapes = tables[0]
    done = structure.complete(exact, shapes, edits)
    assert 0 < done.bounded.double().mean() < 0.5
    for name, values in structure.leg_ratios(shapes, edits, done).items():
        assert values[~done.bounded].max() < 1e-5, name
    for name, values in structure.pair_ratios(shapes, edits, done).items():
        # the top may have been moved sideways, which no table does: then that one handle is off and nothing else
        pinned = torch.tensor(["top.translation.x" == edit.handle for edit in edits])
        assert values[~done.bounded & ~pinned].max() < 1e-5, name


def test_what_is_not_completed_is_off_by_the_edit_alone(tables, edits):
    shapes = tables[0]
    done = structure.uncompleted(shapes, edits)
    changed = (done.boxes - shapes.boxes.double()[[edit.shape for edit in edits]]).abs() > 1e-6
    assert (changed.sum((1, 2)) <= 1).all()
    assert not done.bounded.any()
    broken = structure.leg_ratios(shapes, edits, done)
    assert all(values.max() > 0.01 for values in broken.values())


def test_every_completion_keeps_the_edit(tables, edits, exact):
    shapes = tables[0]
    done, kept = structure.complete(exact, shapes, edits), structure.uncompleted(shapes, edits)
    for edit, after, pinned in zip(edits, done.boxes, kept.boxes, strict=True):
        own = (pinned - shapes.boxes[edit.shape].double()).abs() > 1e-6
        assert torch.allclose(after[own], pinned[own], atol=1e-6)


def test_leg_ratios_are_what_the_words_say(tables):
    shapes, edits = tables[0], structure.random_edits(tables[0], 3)
    boxes = shapes.boxes[:3].double() + 0.05 * torch.rand(3, 5, 15, generator=torch.Generator().manual_seed(0))
    boxes[..., 3:12] = torch.eye(3).flatten()
    found = structure.leg_ratios(shapes, edits, structure.Completed(boxes, torch.zeros(3, dtype=torch.bool)))
    for t, edit in enumerate(edits):
        points = shapes.boxes[edit.shape].double()
        size = [
            (points[:, a] + points[:, 12 + a] / 2).max() - (points[:, a] - points[:, 12 + a] / 2).min()
            for a in range(3)
        ]
        for a, name in enumerate("xyz"):
            apart = [abs(boxes[t, i, 12 + a] - boxes[t, j, 12 + a]) for i, j in combinations(range(1, 5), 2)]
            assert found[name][t].item() == pytest.approx((sum(apart) / 6 / size[a]).item())
        under = boxes[t, 0, 1] - boxes[t, 0, 13] / 2
        gaps = [abs(under - boxes[t, leg, 1] - boxes[t, leg, 13] / 2) for leg in range(1, 5)]
        assert found["gap"][t].item() == pytest.approx((sum(gaps) / 4 / size[1]).item())


def test_leg_ratios_are_of_tables():
    chairs = shapes_of("box/one", 1, 8)
    edits = structure.random_edits(chairs, 1)
    with pytest.raises(ValueError, match=r"leg_ratios: shapes must have a top and legs leg_1, leg_2 .*use pair_ratios"):
        structure.leg_ratios(chairs, edits, structure.uncompleted(chairs, edits))


@pytest.mark.parametrize("category", ["chair", "sofa", "airplane"])
def test_shapes_as_they_are_keep_their_structure(category):
    shapes = as_shapes(data_gen.generate(category, count=30, points=32, seed=0))
    edits = [structure.Edit(i, "", 0.0) for i in range(30)]
    as_they_are = structure.Completed(shapes.boxes.double(), torch.zeros(30, dtype=torch.bool))
    for name, values in structure.pair_ratios(shapes, edits, as_they_are).items():
        assert values.nan_to_num().max() < 1e-5, name


def test_pair_ratios_see_each_kind_of_fault(tables):
    shapes, edit = tables[0][:1], [structure.Edit(0, "", 0.0)]
    width = extents(shapes.boxes.double())[0, 0].item()

    def ratios(part, number, by):
        boxes = shapes.boxes.double().clone()
        boxes[0, shapes.part_names.index(part), number] += by
        found = structure.pair_ratios(shapes, edit, structure.Completed(boxes, torch.zeros(1, dtype=torch.bool)))
        return {name: value.item() for name, value in found.items()}

    rig = shapes.about["rigs"][TABLE]
    pairs, alone = (
        [p for p in rig["symmetric_pairs"] if p[0] != p[1]],
        [p for p in rig["symmetric_pairs"] if p[0] == p[1]],
    )
    wider = ratios("leg_1", 12, 0.03)
    assert wider["scale"] == pytest.approx(0.03 / width / (3 * len(pairs)), rel=1e-4)
    assert max(wider["place"], wider["gap"]) < 1e-6
    aside = ratios("top", 0, 0.03)
    assert aside["place"] == pytest.approx(2 * 0.03 / width / (3 * (len(pairs) + len(alone))), rel=1e-4)
    higher = ratios("top", 1, 0.03)
    height = extents(shapes.boxes.double())[0, 1].item()
    assert higher["gap"] == pytest.approx(0.03 / height, rel=1e-4)


def test_faces_of_turned_boxes():
    turn = torch.tensor([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]], dtype=torch.float64)
    low, high = faces(torch.cat([torch.ones(3).double(), turn.flatten(), torch.tensor([2.0, 4, 6]).double()]))
    assert torch.equal(high - low, torch.tensor([4.0, 2, 6], dtype=torch.float64))
    assert torch.equal(high + low, torch.full((3,), 2, dtype=torch.float64))


def test_boxes_move_as_the_handles_move_points():
    shapes = as_shapes(data_gen.generate("laptop", count=1, points=64, seed=0))
    handles = BoxHandles.of(shapes)
    change = 0.1 * torch.randn(len(handles.names), generator=torch.Generator().manual_seed(0))
    boxes = moved_boxes(shapes.boxes[0], handles, change)
    placed = replace(shapes, boxes=boxes[None].float()).at_boxes(boxes[None].float())
    torch.testing.assert_close(placed[0], shapes.points[0] + handles.offsets(change), rtol=0, atol=1e-5)


def test_a_space_uses_as_many_directions_as_shapes_have_parameters(tables):
    shapes = as_shapes(data_gen.generate(TABLE, count=40, points=48, seed=0, sampling="shared"))
    space = LinearSpace.fit(shapes.points.double(), 20)
    used = structure.used_directions(space, shapes.points[:20].double(), shapes.points[20:].double())
    assert used.basis.shape == (20, 6)
    assert used.share.shape == (20,)
    assert used.share[:6].sum() > 0.9999
    assert used.noise == 0  # one dictionary for all shapes


def test_a_dictionary_that_is_all_noise_completes_nothing_and_without_noise_all():
    shapes = shapes_of(TABLE, 12, 48)
    edits = structure.random_edits(shapes, 8, seed=0)
    exact = structure.moved_by_boxes(structure.box_slopes(shapes))
    plain, quiet, loud = (structure.complete(exact, shapes, edits, noise).boxes for noise in (0.0, 1e-9, 1e6))
    assert torch.allclose(quiet, plain, atol=1e-4)  # files hold single precision
    for t, edit in enumerate(edits):
        others = [not edit.handle.startswith(name) for name in shapes.part_names]
        before = shapes.boxes[edit.shape][others].double()
        assert torch.allclose(loud[t][others], before, atol=1e-6)
    assert (plain - loud).abs().max() > 1e-2


def test_what_is_learned_is_a_dictionary_in_the_basis(tables):
    shapes = shapes_of(TABLE, 12, 48)
    space = LinearSpace.fit(shapes.points, 4)
    basis = torch.eye(4)[:, :2]
    assert torch.equal(structure.learned(space)(shapes[0]), space.dictionary(shapes.points[:1]))
    assert torch.equal(structure.learned(space, basis)(shapes[0]), space.dictionary(shapes.points[:1])[..., :2])


def test_components_of_handles_find_a_linear_family(tables, edits, exact):
    shapes = tables[0]
    components = structure.handle_components(shapes, 9)
    assert components[TABLE].shape == (5, 2, 3, 6)
    assert structure.handle_components(shapes, 2)[TABLE].shape[-1] == 2
    done = [structure.complete(each, shapes, edits[:12]) for each in (exact, structure.moved_by_boxes(components))]
    torch.testing.assert_close(done[0].boxes, done[1].boxes, rtol=0, atol=1e-4)


def test_families_are_kept_apart():
    shapes = as_shapes(data_gen.generate("chair", count=40, points=16, seed=0))
    assert set(structure.box_slopes(shapes)) == set(shapes.family_names)
    many = [name for name in shapes.family_names if len(shapes.of_family(name)) > 1]
    assert set(structure.handle_components(shapes, 3)) == set(many)
