"""Collections: what is drawn and how, several families in one, pieces, and new samples of the same shapes."""

import tracemalloc
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import arrays_differ, bytes_of, tables

import data_gen
from data_gen import draw
from data_gen.points import blocks

SEEDS = st.integers(0, 2**32 - 1)
MIXED = ("table/four_legs", "table/shelf")


def mixed(**options):
    """A few small tables of two families."""
    return data_gen.generate(MIXED, **{"count": 3, "points": 16, **options})


def areas_of(rig, parameters):
    """Areas (N, F) of all triangles, by a loop."""
    found = np.zeros((len(parameters), len(rig.triangles)))
    for shape, vertices in enumerate(rig.vertices(parameters)):
        for face, (a, b, c) in enumerate(vertices[rig.triangles]):
            found[shape, face] = np.linalg.norm(np.cross(b - a, c - a)) / 2
    return found


@pytest.mark.parametrize("name", ["table/shelf", "carton/two_flaps"])
@given(seed=SEEDS, points=st.integers(2, 60), count=st.integers(1, 5))
def test_fresh_samples_equal_a_slow_loop(name, seed, points, count):
    rig = data_gen.family(name)
    parameters = rig.draw(count, np.random.default_rng(seed))
    faces, weights = draw.fresh(rig, parameters, points, [np.random.default_rng((seed, i)) for i in range(4)])
    which, order, first, second = (np.random.default_rng((seed, i)) for i in range(4))
    for shape, areas in enumerate(areas_of(rig, parameters)):
        reached = (np.cumsum(areas) / areas.sum()).astype(np.float32)
        wanted = sorted(which.random(dtype=np.float32) for _ in range(points))
        found = [np.searchsorted(reached[:-1], one, side="right") for one in wanted]
        np.testing.assert_array_equal(faces[shape], order.permuted(np.array(found, np.int16)))
        for point in range(points):
            u, v = first.random(dtype=np.float32), second.random(dtype=np.float32)
            expected = (1 - u, 1 - v) if u + v > 1 else (u, v)
            np.testing.assert_array_equal(weights[shape, point], expected)


@pytest.mark.parametrize("name", ["table/four_legs", "carton/two_flaps"])
@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_points_are_spread_by_area(name, sampling):
    rig, n = data_gen.family(name), 40_000
    shapes = data_gen.generate(name, count=2, points=n, seed=1, sampling=sampling)
    of = rig.middle if sampling == "shared" else shapes.parameters
    for shape, areas in enumerate(areas_of(rig, of)):
        expected = n * areas / areas.sum()
        faces, weights = shapes.samples(shape)
        assert (np.abs(np.bincount(faces, minlength=len(areas)) - expected) < 5 * np.sqrt(expected)).all()
        np.testing.assert_allclose(weights.mean(axis=0), 1 / 3, atol=5 / np.sqrt(18 * n))  # variance 1/18 in a triangle


def test_the_start_of_a_cloud_is_a_sample_of_the_whole():
    labels = data_gen.generate("table/four_legs", count=50, points=1000).labels
    first, last = np.bincount(labels[:, :500].ravel()), np.bincount(labels[:, 500:].ravel())
    assert (np.abs(first - last) < 5 * np.sqrt(first + last)).all()


def test_fresh_samples_are_independent_and_shared_ones_the_same():
    fresh, shared = tables(points=500), tables(points=500, sampling="shared")
    assert fresh.labels.shape == (3, 500)
    assert not (fresh.rest[0] == fresh.rest[1]).all(axis=1).any()
    for key, shape in (("labels", (500,)), ("rest", (500, 3)), ("faces", (500,)), ("weights", (500, 2))):
        assert getattr(shared, key).shape == shape
    assert fresh.about["corresponds"] is False
    assert shared.about["corresponds"] is True


def test_shapes_depend_neither_on_the_points_nor_on_the_sampling_nor_on_the_count():
    one = tables(count=5)
    for other in (tables(count=5, points=99), tables(count=5, sampling="shared"), tables(count=9, dtype="float64")):
        np.testing.assert_array_equal(one.parameters, other.parameters[:5])
    np.testing.assert_array_equal(one.points, tables(count=9).points[:5])


def test_blocks_cover_everything_once():
    for shapes, points in ((1, 2), (7, 2**15), (100, 1000), (5, 2**20)):
        covered = np.concatenate([np.arange(shapes)[rows] for rows in blocks(shapes, points)])
        np.testing.assert_array_equal(covered, np.arange(shapes))


@pytest.mark.parametrize("family", ["table/four_legs", "carton", MIXED])
@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_how_many_are_made_at_once_changes_nothing(monkeypatch, family, sampling):
    expected = data_gen.generate(family, count=20, points=16, sampling=sampling)
    one_by_one = lambda shapes, points: [slice(i, i + 1) for i in range(shapes)]
    monkeypatch.setattr("data_gen.draw.blocks", one_by_one)
    monkeypatch.setattr("data_gen.rig.blocks", one_by_one)
    monkeypatch.setattr("data_gen.assemble.AT_ONCE", 1)
    assert not arrays_differ(expected, data_gen.generate(family, count=20, points=16, sampling=sampling))


@pytest.mark.parametrize(("points", "count"), [(64, 3000), (5000, 40), (100_000, 4)])
@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@pytest.mark.parametrize("family", ["table/four_legs", "carton/two_flaps", MIXED, "vase", ("box", "oven")])
def test_memory_stays_below_three_times_what_is_returned(family, sampling, points, count):
    data_gen.generate(family, count=2, points=2)  # what a family keeps of itself
    tracemalloc.start()
    shapes = data_gen.generate(family, count=count, points=points, sampling=sampling)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 3 * bytes_of(shapes)


# several families


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_mixed_shapes_are_those_of_their_families_by_name(sampling):
    mixed = data_gen.generate([*MIXED, "carton/two_flaps"], count=30, points=40, sampling=sampling, dtype="float64")
    assert mixed.labels.shape == (30, 40)
    for i, name in enumerate(mixed.names):
        rig = data_gen.family(mixed.family(i))
        assert name == f"{rig.name}/{i:05d}"
        own = [mixed.parameter_names.index(one) for one in rig.parameter_names]
        parts = [mixed.part_names.index(one) for one in rig.part_names]
        given, samples = mixed.parameters[i, own][None], mixed.samples(i)
        np.testing.assert_allclose(mixed.points[i], rig.place(samples, given)[0], atol=1e-12)
        np.testing.assert_allclose(mixed.rest[i], rig.sampled(samples, given)[1].reshape(40, 3), atol=1e-12)
        np.testing.assert_allclose(mixed.boxes[i, parts], rig.boxes(given)[0], atol=1e-12)
        np.testing.assert_allclose(mixed.joints[i, : len(rig.joint_list)], rig.joints(given)[0], atol=1e-12)
        assert [mixed.part_names[label] for label in mixed.labels[i]] == [
            rig.part_names[part] for part in rig.triangle_part[samples.faces]
        ]
        for value, kept in (
            (mixed.parameters[i], own),
            (mixed.boxes[i], parts),
            (mixed.joints[i], np.arange(len(rig.joint_list))),
        ):
            assert np.isnan(np.delete(value, kept, axis=0)).all(), "what the family lacks is NaN"


def test_a_category_is_all_its_families():
    shapes = data_gen.generate("table", count=5, points=8)
    assert shapes.family_names == data_gen.families("table")
    assert not arrays_differ(shapes, data_gen.generate(["table"], count=5, points=8))
    assert not arrays_differ(shapes, data_gen.generate(data_gen.families("table"), count=5, points=8))


def test_a_category_of_one_family_is_that_family():
    assert data_gen.generate("box", count=2, points=8).about == data_gen.generate("box/one", count=2, points=8).about


def test_families_are_drawn_uniformly():
    count = 20_000
    drawn = np.bincount(data_gen.generate([*MIXED, "box/one"], count=count, points=2).families)
    assert (np.abs(drawn - count / 3) < 5 * np.sqrt(count / 3)).all()


def test_the_first_shapes_of_a_large_mixed_collection_are_those_of_a_small_one():
    assert not arrays_differ(mixed(count=7), mixed(count=25)[:7])


@pytest.mark.parametrize("family", ["table/four_legs", "carton/two_flaps", MIXED])
@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_pieces_are_what_generate_makes(family, sampling):
    options = {"count": 11, "points": 16, "seed": 3, "sampling": sampling}
    whole, start = data_gen.generate(family, **options), 0
    for piece in data_gen.pieces(family, **options, size=4):
        assert not arrays_differ(piece, whole[start : start + 4])
        assert piece.about == whole.about
        start += len(piece)
    assert start == 11


def test_what_is_fixed_is_the_same_in_all_shapes_and_the_rest_as_without_it():
    free, tied = mixed(count=20), mixed(count=20, fixed={"shelf_height": 0.1, "width": 0.7})
    named = [free.parameter_names.index(name) for name in ("shelf_height", "width")]
    there = np.isfinite(free.parameters)
    expected = free.parameters.copy()
    expected[:, named] = np.where(there[:, named], np.float32([0.1, 0.7]), np.nan)
    np.testing.assert_array_equal(tied.parameters, expected)
    assert tied.about["fixed"] == {"shelf_height": 0.1, "width": 0.7}
    assert free.about["fixed"] == {}


def test_what_numpy_counts_with_can_be_saved_too(tmp_path):
    given = {"seed": np.int64(3), "count": np.int32(3), "fixed": {"width": np.float32(0.7)}}
    shapes = data_gen.noisy(data_gen.resample(tables(**given), np.uint8(5)), np.float32(0.5), np.int16(7))
    data_gen.save(data_gen.seen_from(shapes, np.float32([0, 0, 1]), np.int64(1)), tmp_path / "view.npz")
    data_gen.save(shapes, tmp_path / "a.npz")
    read = data_gen.load(tmp_path / "a.npz").about
    assert (read["seed"], read["resampled"], read["noise"]) == (3, [5], {"deviation": 0.5, "seed": 7})
    assert read["fixed"] == {"width": np.float32(0.7)}
    assert not arrays_differ(tables(**given), tables(seed=3, fixed={"width": np.float32(0.7)}))


def test_equal_seeds_do_not_tie_families_together():
    names = ("table/four_legs", "table/pedestal", "chair/four_legs", "lamp/arc")
    alone = [data_gen.generate(name, count=500, points=2).parameters[:, 0] for name in names]
    assert (np.abs(np.corrcoef(alone) - np.eye(len(names))) < 5 / np.sqrt(500)).all()
    codes = {zlib.crc32(name.encode()) for name in data_gen.families()}
    assert len(codes) == len(data_gen.families()), "no two names have the same number"


def test_a_family_has_the_same_shapes_whatever_it_is_mixed_with():
    alone = data_gen.generate("table/shelf", count=30, points=16, seed=2)
    for names in (MIXED, MIXED[::-1], ("box/one", "carton", "table/shelf")):
        shapes = data_gen.generate(names, count=30, points=16, seed=2)
        own = shapes.families == shapes.family_names.index("table/shelf")
        np.testing.assert_array_equal(shapes.points[own], alone.points[: own.sum()])
        assert own.any()


@settings(max_examples=5)
@given(seed=SEEDS)
def test_the_same_seed_gives_the_same_bytes_and_another_seed_others(tmp_path_factory, seed):
    folder = tmp_path_factory.mktemp("bytes")
    for name, used in (("one", seed), ("same", seed), ("other", seed + 1)):
        data_gen.save(tables(seed=used), folder / f"{name}.npz")
    one, same, other = ((folder / f"{name}.npz").read_bytes() for name in ("one", "same", "other"))
    assert one == same
    assert one != other
    assert {"points", "labels", "rest", "boxes", "parameters"} <= {
        *arrays_differ(tables(seed=seed), tables(seed=seed + 1))
    }


def test_resample_keeps_the_shapes_and_draws_new_points():
    shapes = tables(count=4, points=300, seed=7)
    again = data_gen.resample(shapes, 7)
    assert {*arrays_differ(shapes, again)} == {"points", "labels", "rest", "faces", "weights"}
    assert again.points.dtype == shapes.points.dtype
    assert not np.isin(again.rest, shapes.rest[:, :, 1][np.abs(shapes.rest[:, :, 1]) < 0.5]).mean() > 0.01
    assert arrays_differ(again, data_gen.resample(shapes, 8))
    assert not arrays_differ(again, data_gen.resample(shapes, 7))


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@pytest.mark.parametrize("family", ["table/four_legs", "table", (*MIXED, "box/one")])
def test_new_samples_are_independent_even_for_equal_seeds(family, sampling):
    shapes = data_gen.generate(family, count=60, points=50, sampling=sampling, seed=7)
    one = data_gen.resample(shapes, 7)
    two = data_gen.resample(one, 7)
    three, other = data_gen.resample(two, 7), data_gen.resample(data_gen.resample(shapes, 8), 7)
    assert shapes.families is None or len(np.unique(shapes.families)) == len(shapes.family_names)
    drawn = np.concatenate([made.weights.reshape(-1, 2) for made in (shapes, one, two, three, other)])
    times = 60 if sampling == "fresh" else len(shapes.family_names)
    assert len(np.unique(drawn, axis=0)) == 5 * times * 50, "no point of any shape or family has the weights of another"
    assert three.about["resampled"] == [7, 7, 7]
    assert not arrays_differ(three, data_gen.resample(two, 7))


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_resample_of_mixed_shapes_keeps_all_but_the_samples(sampling):
    shapes = data_gen.generate(MIXED, count=9, points=50, sampling=sampling)
    again = data_gen.resample(shapes, 0)
    assert {*arrays_differ(shapes, again)} == {"points", "labels", "rest", "faces", "weights"}
    assert again.about == {**shapes.about, "resampled": [0]}


def test_resample_of_shapes_that_only_say_what_they_were_made_from():
    shapes = tables()
    bare = data_gen.Collection(
        shapes.points,
        parameters=shapes.parameters,
        parameter_names=shapes.parameter_names,
        about={"family": "table/four_legs"},
    )
    np.testing.assert_array_equal(data_gen.resample(bare, 3).points, data_gen.resample(shapes, 3).points)


def test_resample_of_some_rows_keeps_their_families():
    shapes = mixed(count=12)[5:]
    assert not {*arrays_differ(shapes, data_gen.resample(shapes, 1))} & {"boxes", "parameters", "names", "families"}


@pytest.mark.parametrize("points", [4, 300])
def test_resample_to_another_number_of_points(points):
    shapes = mixed(count=6)
    more = data_gen.resample(shapes, 5, points=points)
    assert more.points.shape == (6, points, 3)
    np.testing.assert_array_equal(more.parameters, shapes.parameters)


def test_resample_of_a_plain_cloud_is_refused():
    with pytest.raises(
        ValueError, match=r"resample: a collection must hold its family and parameters, got points only"
    ):
        data_gen.resample(data_gen.Collection(np.zeros((1, 2, 3))), 0)


def test_float64_keeps_full_precision_of_the_same_shapes():
    single, double = tables(), tables(dtype="float64")
    assert double.points.dtype == double.boxes.dtype == double.parameters.dtype == np.float64
    np.testing.assert_array_equal(single.faces, double.faces)
    np.testing.assert_array_equal(single.weights, double.weights)
    np.testing.assert_allclose(single.rest, double.rest, atol=1.2e-7)
    np.testing.assert_allclose(single.points, double.points, atol=1.8e-7)
    assert (double.points != double.points.astype(np.float32)).any()


# what is refused


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"count": 0}, "count must be whole and >= 1, points >= 2, got 0 and 16; ask for more"),
        ({"count": 1e3}, "count must be whole and >= 1, points >= 2, got 1000.0 and 16"),
        ({"points": 1}, "count must be whole and >= 1, points >= 2, got 3 and 1; ask for more"),
        ({"sampling": "even"}, "sampling must be fresh or shared, got 'even'; fresh is the default"),
        ({"dtype": "float16"}, "dtype must be float32 or float64, got 'float16'; files hold float32"),
        ({"seed": -1}, "seed must be a whole number >= 0, got -1; choose one"),
        ({"seed": 0.5}, "seed must be a whole number >= 0, got 0.5; choose one"),
        ({"seed": True}, "seed must be a whole number >= 0, got True; choose one"),
        ({"count": True}, "count must be whole and >= 1, points >= 2, got True and 16; ask for more"),
    ],
)
def test_what_cannot_be_generated_is_refused(options, sentence):
    with pytest.raises(ValueError, match=f"generate: {sentence}"):
        tables(**options)


@pytest.mark.parametrize(
    ("family", "sentence"),
    [
        ([], 'generate: family must name a family or more, got none; say "table/four_legs" or "table"'),
        ("table/six_legs", "family: a family must be one of table/four_legs, .*, got 'table/six_legs'; check"),
        (
            ["table", "piano"],
            "family: .* one of the families of table, chair, [a-z_, ]*, got 'piano'; check the spelling",
        ),
        (["table/shelf", ["box"]], r"family: a family must be one of .*, got \['box'\]; check the spelling"),
        (None, 'generate: family must name a family or more, got None; say "table/four_legs" or "table"'),
        (5, 'generate: family must name a family or more, got 5; say "table/four_legs" or "table"'),
    ],
)
def test_unknown_names_are_refused(family, sentence):
    with pytest.raises(ValueError, match=sentence):
        data_gen.generate(family, count=3, points=16)


@pytest.mark.parametrize(
    ("fixed", "sentence"),
    [
        ({"length": 1}, "generate: fixed must name parameters, one of depth, .*, width, got 'length'; see list"),
        (["width"], r"generate: fixed must map names to numbers, got \['width'\]; write {\"width\": 0.5}"),
        ({"width": "a"}, r"generate: fixed must map names to numbers, got {'width': 'a'}; write {\"width\": 0.5}"),
        ({"width": 9}, r"generate: width of table/four_legs must be in \[0.5, 1\], got 9 in row 0; keep it inside"),
    ],
)
def test_parameters_that_cannot_be_fixed_are_refused(fixed, sentence):
    with pytest.raises(ValueError, match=sentence):
        tables(fixed=fixed)


def test_pieces_refuses_before_the_first_is_asked_for():
    with pytest.raises(
        ValueError, match=r"pieces: size must be whole and >= 1, got 0; a thousand shapes are a good piece"
    ):
        data_gen.pieces("table", count=3, points=16, size=0)


@pytest.mark.parametrize("seed", [-3, 0.5, None])
def test_resample_refuses_a_bad_seed(seed):
    with pytest.raises(ValueError, match=rf"resample: seed must be a whole number >= 0, got {seed}; choose one"):
        data_gen.resample(tables(), seed)


@pytest.mark.parametrize("points", [1, 2.5, True])
def test_resample_refuses_a_bad_number_of_points(points):
    with pytest.raises(ValueError, match=rf"resample: points must be whole and >= 2, got {points}; ask for more"):
        data_gen.resample(tables(), 0, points=points)


def test_resample_refuses_no_shapes():
    with pytest.raises(ValueError, match=r"resample: a collection must hold a shape or more, got none; choose other"):
        data_gen.resample(tables()[:0], 0)


def test_resample_refuses_what_does_not_list_its_seeds():
    shapes = tables()
    odd = data_gen.Collection(**{**vars(shapes), "about": {**shapes.about, "resampled": "often"}})
    with pytest.raises(ValueError, match=r"resample: about must list seeds under resampled, got 'often'; write it"):
        data_gen.resample(odd, 0)
