from dataclasses import replace

import numpy as np
import pytest
import torch
from worlds import FAMILIES, near, randn, shapes_of

import data_gen
from data_gen.families import family as rig_of
from data_gen.points import Samples
from dsn_lite.data import Frame, Shapes, triplets, true_deformation, true_transfer
from dsn_lite.files import as_shapes

MIXED = ("table/four_legs", "table/shelf")
both = pytest.mark.parametrize("sampling", ["fresh", "shared"])


# collections


def test_as_shapes_takes_collections_arrays_tensors_and_shapes():
    made = data_gen.generate("box/one", count=3, points=8, dtype="float64")
    shapes = as_shapes(made)
    assert torch.equal(as_shapes(shapes).points, shapes.points)
    for source in (made.points, torch.from_numpy(made.points), list(made.points)):
        assert torch.equal(as_shapes(source).points, shapes.points)
    assert as_shapes(made.points.astype(np.float16)).points.dtype == torch.float32


@both
def test_an_index_takes_everything_of_its_shapes(sampling):
    shapes, index = shapes_of("table/four_legs", 6, 32, sampling=sampling), torch.tensor([4, 1])
    taken = shapes[index]
    assert len(taken) == 2
    assert taken.names == (shapes.names[4], shapes.names[1])
    for name in ("points", "boxes", "parameters", "joints"):
        assert torch.equal(getattr(taken, name), getattr(shapes, name)[index])
    for name in ("labels", "rest", "faces", "weights"):
        assert torch.equal(getattr(taken, name), getattr(shapes, name)[slice(None) if sampling == "shared" else index])


def test_an_index_takes_the_families_of_mixed_shapes():
    shapes, index = shapes_of(MIXED, 8, 16), torch.tensor([3, 1])
    assert torch.equal(shapes[index].families, shapes.families[index])


def test_a_slice_copies_nothing():
    shapes = shapes_of(count=6)
    assert shapes[2:4].points.data_ptr() == shapes.points[2].data_ptr()


def test_all_that_is_real_takes_the_precision_of_a_space():
    shapes = shapes_of(MIXED, 4, 16).like(torch.nn.Linear(1, 1, dtype=torch.float64))
    for name in ("points", "rest", "weights", "boxes", "parameters", "joints"):
        assert getattr(shapes, name).dtype == torch.float64
    for name in ("labels", "faces", "families"):
        assert getattr(shapes, name).dtype == torch.int16


@pytest.mark.parametrize(("N", "sizes"), [(200, (170, 10, 20)), (8, (5, 2, 1)), (4, (1, 2, 1))])
def test_a_split_parts_the_shapes(N, sizes):
    points = torch.arange(N).float()[:, None, None].expand(N, 2, 3)
    parts = Shapes(points=points).split(1)
    assert tuple(len(part) for part in parts) == sizes
    together = torch.cat([part.points[:, 0, 0] for part in parts])
    assert sorted(together.tolist()) == list(range(N))
    again, other = Shapes(points=points).split(1), Shapes(points=points).split(2)
    assert torch.equal(torch.cat([part.points for part in again])[:, 0, 0], together)
    assert not torch.equal(torch.cat([part.points for part in other])[:, 0, 0], together)


def test_three_shapes_cannot_be_split():
    with pytest.raises(ValueError, match=r"split: at least 4 shapes are needed .*, got 3; add shapes"):
        shapes_of(count=3).split()


def of_rows(N, split):
    """N shapes whose points are their numbers, and the split that their file tells."""
    return Shapes(points=torch.arange(N).float()[:, None, None].expand(N, 2, 3), about={"split": split})


def test_a_split_that_the_file_tells_is_taken_whatever_the_seed():
    rows = {"train": [3, 9], "validation": [0, 3], "test": [9, 10]}
    for seed in (0, 1):
        parts = of_rows(10, rows).split(seed)
        assert [part.points[:, 0, 0].tolist() for part in parts] == [[3, 4, 5, 6, 7, 8], [0, 1, 2], [9]]
    assert parts[0].about == {"split": None}
    assert sorted(len(part) for part in parts[0].split()) == [1, 2, 3], "a part of them is shuffled anew"


@pytest.mark.parametrize(
    "split",
    [
        {"train": [0, 5], "validation": [5, 8]},
        {"train": [0, 6], "validation": [5, 8], "test": [8, 10]},
        {"train": [0, 5], "validation": [5, 8], "test": [8, 11]},
        {"train": [0, 7], "validation": [7, 8], "test": [8, 10]},
        {"train": [-2, 5], "validation": [5, 8], "test": [8, 10]},
        {"train": "all", "validation": [5, 8], "test": [8, 10]},
        [0.85, 0.05, 0.1],
    ],
)
def test_a_split_that_is_none(split):
    words = (
        r"split: the file must give \[start, stop\] rows of its 10 shapes for train, .*, got .*; write the file again"
    )
    with pytest.raises(ValueError, match=words):
        of_rows(10, split).split()


# truth


@both
@pytest.mark.parametrize("family", FAMILIES)
def test_points_on_their_own_boxes_are_the_points(family, sampling):
    shapes = shapes_of(family, 5, 64, sampling=sampling, dtype="float64")
    near(shapes.at_boxes(shapes.boxes), shapes.points)


def samples_of(shapes):
    """The triangles and weights of its points, as a rig takes them."""
    return Samples(shapes.faces.numpy(), shapes.weights.numpy())


@both
@pytest.mark.parametrize("family", FAMILIES)
def test_true_deformation_and_transfer_are_those_of_the_rig(family, sampling):
    rig, shapes = rig_of(family), shapes_of(family, 40, 16, sampling=sampling, dtype="float64")
    x, y, z = triplets(shapes, 10, with_truth=True)
    deformed = rig.place(samples_of(x), y.parameters.numpy())
    near(true_deformation(x, y), torch.from_numpy(deformed))
    p_x, p_y, p_z = (each.parameters.numpy() for each in (x, y, z))
    moved = rig.place(samples_of(z), p_z + p_y - p_x)  # refuses what leaves a range
    near(true_transfer(x, y, z), torch.from_numpy(moved))


def test_at_boxes_by_loops_on_rotated_boxes():
    boxes = torch.cat([randn(0, 2, 3, 3), torch.linalg.qr(randn(1, 2, 3, 3, 3)).Q.flatten(2), randn(2, 2, 3, 3)], -1)
    labels, rest = torch.tensor([[0, 2, 1, 2], [1, 1, 0, 2]]), randn(3, 2, 4, 3)
    placed = Shapes(points=rest, labels=labels, rest=rest, boxes=boxes).at_boxes(boxes)
    for b in range(2):
        for i in range(4):
            box = boxes[b, labels[b, i]]
            near(placed[b, i], box[:3] + box[3:12].reshape(3, 3) @ torch.diag(box[12:]) @ rest[b, i])


def test_truth_is_unknown_where_a_point_has_no_part():
    shapes = shapes_of(count=3)
    assert shapes.truth_is_known
    assert not as_shapes(shapes.points).truth_is_known
    shapes.labels[1, 2] = -1
    assert not shapes.truth_is_known


@both
def test_shared_parts_of_which_each_shape_has_a_form_of_its_own(sampling):
    shapes = shapes_of(count=3, sampling=sampling, dtype="float64")
    labels, rest = shapes.labels.expand(3, -1), shapes.rest.expand(3, -1, -1)
    for one in (replace(shapes, labels=labels[0], rest=rest), replace(shapes, labels=labels, rest=rest)):
        near(one.at_boxes(one.boxes), shapes.points)
        near(one[2].at_boxes(one.boxes[2:]), shapes.points[2:])


UNKNOWN = {
    "mixed": lambda: shapes_of(MIXED, 20, 16),
    "turned": lambda: shapes_of("carton/two_flaps", 20, 16),
    "points": lambda: as_shapes(shapes_of(count=20).points),
}


@pytest.mark.parametrize(
    ("which", "said"), [("mixed", "2 families"), ("turned", "carton/two"), ("points", "an unknown family")]
)
def test_where_boxes_do_not_tell_the_truth_is_unknown_and_refused(which, said):
    shapes = UNKNOWN[which]()
    assert not shapes.truth_is_known
    words = rf"shapes must be of one family whose parts keep their form, every point in a part, got {said}.*; take such"
    with pytest.raises(ValueError, match=f"triplets: {words} a family, or ask data_gen.true_transfer"):
        triplets(shapes, 3, with_truth=True)
    x, y, z = triplets(shapes, 3)
    with pytest.raises(ValueError, match=f"true_transfer: {words}"):
        true_transfer(x, y, z)
    with pytest.raises(ValueError, match=f"true_deformation: {words}"):
        true_deformation(x, y)


def test_two_families_of_equal_parts_have_no_true_deformation():
    one, other = shapes_of("table/four_legs", 3, 16), shapes_of("table/four_legs", 3, 16)
    near(true_deformation(one, one), one.points)
    with pytest.raises(ValueError, match=r"true_deformation: shapes must be of one family .*, got table/else; take"):
        true_deformation(one, replace(other, about={**other.about, "family": "table/else"}))


def test_files_that_say_nothing_of_their_rigs_are_taken_at_their_boxes():
    shapes = shapes_of(count=3)
    assert replace(shapes, about={}).truth_is_known
    near(true_deformation(*[replace(shapes, about={})] * 2), shapes.points)


def test_only_shared_samples_of_one_family_correspond():
    assert shapes_of(count=3, sampling="shared").corresponds
    assert not shapes_of(count=3).corresponds
    assert not shapes_of(MIXED, 5, 16, sampling="shared").corresponds


@pytest.mark.parametrize("family", FAMILIES)
def test_ranges_are_those_of_the_rig_in_the_order_of_the_parameters(family):
    rig, shapes = rig_of(family), shapes_of(family, 3)
    np.testing.assert_allclose(shapes.ranges, np.stack([rig.low, rig.high], axis=1), atol=1e-5)
    assert as_shapes(shapes.points).ranges is None


# triplets


def test_triplets_are_of_different_shapes_and_follow_their_seed():
    shapes = shapes_of(count=4)
    x, y, z = triplets(shapes, 50)
    assert all(len(set(names)) == 3 for names in zip(x.names, y.names, z.names, strict=True))
    assert triplets(shapes, 50)[2].names == z.names
    assert triplets(shapes, 50, 1)[2].names != z.names


def test_triplets_with_truth_stay_in_the_ranges_and_others_do_not():
    shapes = shapes_of("table/four_legs", 40, 8)
    low, high = shapes.ranges.T
    for with_truth in (True, False):
        x, y, z = triplets(shapes, 40, with_truth=with_truth)
        moved = (z.parameters + y.parameters - x.parameters).numpy()
        assert bool(((low - 1e-6 <= moved) & (moved <= high + 1e-6)).all()) is with_truth


def test_triplets_without_ranges_keep_every_edge_positive():
    shapes = shapes_of("table/four_legs", 40, 8)
    bare = Shapes(points=shapes.points, labels=shapes.labels, rest=shapes.rest, boxes=shapes.boxes)
    x, y, z = triplets(bare, 40, with_truth=True)
    assert ((z.boxes + y.boxes - x.boxes)[..., 12:] > 0).all()


def test_two_shapes_have_no_triplet():
    words = r"triplets: 5 triplets of different shapes were asked, 0 found among 2 shapes; bring more shapes"
    with pytest.raises(ValueError, match=words):
        triplets(shapes_of(count=2), 5)


def test_three_shapes_whose_true_transfers_all_leave_a_range():
    apart = torch.tensor([[0.65, 0.3, 0.3], [0.3, 0.65, 1.0], [1.0, 1.0, 0.65]])
    shapes = replace(shapes_of(count=3), parameters=apart)
    with pytest.raises(ValueError, match=r"different shapes with a true transfer were asked, 0 found among 3 shapes"):
        triplets(shapes, 5, with_truth=True)
    assert len(triplets(shapes, 5)[0]) == 5


# frames


def test_the_frame_finds_the_floor_and_the_middle():
    frame = Frame.of(shapes_of("table/four_legs", 50, 256, dtype="float64"))
    assert frame.share == (0.5, 0.0, 0.5)
    assert frame.n == 256
    np.testing.assert_allclose(frame.anchor, (0, -0.5, 0), atol=0.02)


def test_the_frame_by_hand():
    points = torch.tensor([[[0.0, 0, 0], [2, 1, 1]], [[0.0, -1, 0], [4, 1, 3]]])
    frame = Frame.of(Shapes(points=points))
    assert frame.size == (2 + 4) / 2
    assert frame.share == (0.0, 1.0, 0.0)
    assert frame.anchor == (0, 1, 0)


def test_ranges_that_do_not_tell_of_every_parameter_are_unknown():
    shapes = shapes_of("table/four_legs", 40, 8)
    told = dict(shapes.about["rigs"]["table/four_legs"])
    told["ranges"] = {name: ends for name, ends in told["ranges"].items() if name != "width"}
    lacking = replace(shapes, about=shapes.about | {"rigs": {"table/four_legs": told}})
    nameless = replace(shapes, parameter_names=())
    for one in (lacking, nameless):
        assert one.ranges is None
        x, y, z = triplets(one, 40, with_truth=True)
        assert ((z.boxes + y.boxes - x.boxes)[..., 12:] > 0).all()


def test_an_empty_list_of_families_is_an_unknown_family():
    shapes = replace(as_shapes(shapes_of(count=4).points), about={"families": []})
    with pytest.raises(ValueError, match=r"triplets: shapes must be of one family .*, got an unknown family; take"):
        triplets(shapes, 1, with_truth=True)
