"""The sample file: what is drawn, what is written, what is refused."""

import dataclasses
import json
import zipfile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import data_gen
from data_gen import draw
from data_gen.part import Box
from data_gen.points import blocks
from data_gen.sample import KEYS

SEEDS = st.integers(0, 2**32 - 1)


def tables(**options):
    return data_gen.generate("table/four_legs", **{"count": 3, "points": 16, **options})


def arrays_differ(one, two):
    return [
        key
        for key in KEYS
        if key != "about" and not np.array_equal(getattr(one, key), getattr(two, key), equal_nan=key not in NAMED)
    ]


NAMED = ("parameter_names", "part_names", "names")


@given(seed=SEEDS, points=st.integers(2, 60), count=st.integers(1, 5))
def test_fresh_samples_equal_a_slow_loop(seed, points, count):
    rig = data_gen.family("table/shelf")
    parameters = rig.draw(count, np.random.default_rng(seed))
    labels, rest = draw.fresh(rig, parameters, points, np.random.SeedSequence(seed))
    which, u, v = (np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(3))
    for shape, box in enumerate(rig.boxes(parameters)):
        x, y, z = box[:, 12], box[:, 13], box[:, 14]
        faces = np.stack([2 * y * z, 2 * z * x, 2 * x * y], axis=1).ravel()
        reached = (np.cumsum(faces) / faces.sum()).astype(np.float32)
        for point in range(points):
            patch = int(np.searchsorted(reached[:-1], which.random(dtype=np.float32), side="right"))
            a, b = float(u.random(dtype=np.float32)), float(v.random(dtype=np.float32))
            expected = np.roll([-0.5 if b < 0.5 else 0.5, a - 0.5, 2 * b % 1 - 0.5], patch % 3)
            assert labels[shape, point] == patch // 3
            np.testing.assert_array_equal(rest[shape, point], expected)


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_points_are_spread_by_area(sampling):
    rig = data_gen.family("table/four_legs")
    n = 40_000
    shapes = data_gen.generate(rig.name, count=2, points=n, seed=1, sampling=sampling)
    of = rig.middle if sampling == "shared" else shapes.parameters
    for shape, areas in enumerate(Box.areas(rig.boxes(of)[:, :, 12:]).sum(-1)):
        labels = shapes.labels if sampling == "shared" else shapes.labels[shape]
        expected = n * areas / areas.sum()
        assert (np.abs(np.bincount(labels, minlength=5) - expected) < 5 * np.sqrt(expected)).all()


def test_the_start_of_a_cloud_is_a_sample_of_the_whole():
    labels = data_gen.generate("table/four_legs", count=50, points=1000).labels
    first, last = np.bincount(labels[:, :500].ravel()), np.bincount(labels[:, 500:].ravel())
    assert (np.abs(first - last) < 5 * np.sqrt(first + last)).all()


def test_fresh_samples_are_independent_and_shared_ones_the_same():
    fresh, shared = tables(points=500), tables(points=500, sampling="shared")
    assert fresh.labels.shape == (3, 500)
    assert not (fresh.rest[0] == fresh.rest[1]).all(axis=1).any()
    assert shared.labels.shape == (500,)
    assert shared.rest.shape == (500, 3)
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


def test_block_size_changes_nothing(monkeypatch):
    expected = tables(count=40)
    one_by_one = lambda shapes, points: [slice(i, i + 1) for i in range(shapes)]
    monkeypatch.setattr("data_gen.draw.blocks", one_by_one)
    monkeypatch.setattr("data_gen.points.blocks", one_by_one)
    assert not arrays_differ(expected, tables(count=40))


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
    assert {*arrays_differ(shapes, again)} == {"points", "labels", "rest"}
    assert again.points.dtype == shapes.points.dtype
    assert not np.isin(again.rest, shapes.rest[:, :, 1][np.abs(shapes.rest[:, :, 1]) < 0.5]).mean() > 0.01
    assert arrays_differ(again, data_gen.resample(shapes, 8))
    assert not arrays_differ(again, data_gen.resample(shapes, 7))


def test_resample_of_a_plain_cloud_is_refused():
    with pytest.raises(
        ValueError, match=r"resample: a collection must hold its family and parameters, got points only"
    ):
        data_gen.resample(data_gen.Collection(np.zeros((1, 2, 3))), 0)


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_a_file_gives_back_what_was_saved(tmp_path, sampling):
    shapes = tables(sampling=sampling)
    data_gen.save(shapes, tmp_path / "a.npz")
    read = data_gen.load(tmp_path / "a.npz")
    assert not arrays_differ(shapes, read)
    assert read.about == shapes.about
    assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]


def test_the_file_holds_exactly_the_keys_shapes_and_types_of_the_contract(tmp_path):
    data_gen.save(tables(dtype="float64"), tmp_path / "a.npz")
    with np.load(tmp_path / "a.npz") as file:
        kinds = {key: (file[key].shape, file[key].dtype.str) for key in file}
        about = json.loads(str(file["about"]))
    assert {key: kind for key, kind in kinds.items() if "U" not in kind[1]} == {
        "points": ((3, 16, 3), "<f4"),
        "labels": ((3, 16), "<i2"),
        "rest": ((3, 16, 3), "<f4"),
        "boxes": ((3, 5, 15), "<f4"),
        "parameters": ((3, 6), "<f4"),
        "joints": ((3, 0, 8), "<f4"),
    }
    texts = {key: kind[0] for key, kind in kinds.items() if "U" in kind[1]}
    assert texts == {"parameter_names": (6,), "part_names": (5,), "names": (3,), "about": ()}
    assert about["family"] == "table/four_legs"
    assert about["rigs"]["table/four_legs"]["ranges"]["width"] == [0.5, 1.0]
    assert ["leg_1", "top", "face_y"] in about["rigs"]["table/four_legs"]["contacts"]
    assert (about["up"], about["front"], about["mirror"], about["sampling"]) == ("y", "+z", "x=0", "fresh")


def test_the_file_holds_nothing_of_the_time_and_place_it_was_written(tmp_path):
    data_gen.save(tables(), tmp_path / "a.npz")
    with zipfile.ZipFile(tmp_path / "a.npz") as archive:
        marks = {(entry.date_time, entry.create_system, entry.external_attr >> 16) for entry in archive.infolist()}
    assert marks == {((1980, 1, 1, 0, 0, 0), 3, 0o644)}


def test_float64_keeps_full_precision_of_the_same_shapes():
    single, double = tables(), tables(dtype="float64")
    assert double.points.dtype == double.boxes.dtype == double.parameters.dtype == np.float64
    np.testing.assert_array_equal(single.rest, double.rest)
    np.testing.assert_allclose(single.points, double.points, atol=1.2e-7)
    assert (double.points != double.points.astype(np.float32)).any()


def test_a_file_with_only_points_is_a_collection(tmp_path):
    np.savez(tmp_path / "plain.npz", points=np.ones((2, 5, 3), np.float32), licence="CC0")
    plain = data_gen.load(tmp_path / "plain.npz")
    assert plain.points.shape == (2, 5, 3)
    assert plain.labels is None
    assert plain.about == {}
    data_gen.save(plain, tmp_path / "again.npz")
    np.testing.assert_array_equal(data_gen.load(tmp_path / "again.npz").points, plain.points)


@pytest.mark.parametrize("key", [key for key in KEYS if key not in ("points", "about")])
def test_a_wrong_shape_is_refused_on_writing_and_reading(tmp_path, key):
    shapes = tables()
    value = getattr(shapes, key)
    if key in ("parameter_names", "part_names"):  # then it is the array they name that does not fit
        wrong, blamed = value[:-1], {"parameter_names": "parameters", "part_names": "boxes"}[key]
    else:
        wrong, blamed = value[:-1] if key == "names" else value[:-1, :-1], key
    with pytest.raises(ValueError, match=f"save: {blamed} must be .*, got .*; it has to fit the points"):
        data_gen.save(dataclasses.replace(shapes, **{key: wrong}), tmp_path / "a.npz")
    assert not list(tmp_path.iterdir()), "nothing half written"
    np.savez(tmp_path / "b.npz", **{k: np.asarray(getattr(shapes, k)) for k in KEYS[:-1]} | {key: np.asarray(wrong)})
    with pytest.raises(ValueError, match=f"load: b.npz: {blamed} must be"):
        data_gen.load(tmp_path / "b.npz")


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        (np.zeros((2, 1, 3)), r"points must hold a shape of two points or more, got \(2, 1, 3\); sample more"),
        (np.zeros((0, 9, 3)), r"points must hold a shape of two points or more, got \(0, 9, 3\)"),
        (np.zeros((2, 0, 3)), r"points must hold a shape of two points or more, got \(2, 0, 3\)"),
        (np.zeros((9, 3)), r"points must be \(N, n, 3\) floats, got \(9, 3\) float64; stack the clouds"),
        (np.zeros((2, 3, 9)), r"points must be \(N, n, 3\) floats, got \(2, 3, 9\)"),
        (np.zeros((2, 9, 3), int), r"points must be \(N, n, 3\) floats, got \(2, 9, 3\) int64"),
        (np.full((2, 9, 3), np.nan), "points must be finite, got NaN or infinity in row 0; leave that shape out"),
        (np.array([[[0, 0, 0]] * 2, [[0, 0, np.inf]] * 2]), "points must be finite, got NaN or infinity in row 1"),
    ],
)
def test_points_that_are_no_clouds_are_refused(tmp_path, points, sentence):
    np.savez(tmp_path / "a.npz", points=points)
    with pytest.raises(ValueError, match=f"load: a.npz: {sentence}"):
        data_gen.load(tmp_path / "a.npz")


@pytest.mark.parametrize("key", ["rest", "parameters"])
def test_nan_elsewhere_is_refused(tmp_path, key):
    shapes = tables()
    value = getattr(shapes, key).copy()
    value[2] = np.nan
    with pytest.raises(ValueError, match=f"save: {key} must be finite, got NaN or infinity in row 2"):
        data_gen.save(dataclasses.replace(shapes, **{key: value}), tmp_path / "a.npz")


@pytest.mark.parametrize("labels", [np.full(16, 5, np.int16), np.full(16, -2, np.int16), np.zeros(16)])
def test_labels_that_are_no_parts_are_refused(tmp_path, labels):
    with pytest.raises(ValueError, match=r"save: labels must be integers from -1 to 4, one a part, got .*; number"):
        data_gen.save(dataclasses.replace(tables(), labels=labels), tmp_path / "a.npz")


def test_points_of_no_part_are_kept(tmp_path):
    labels = np.full((3, 16), -1, np.int16)
    data_gen.save(dataclasses.replace(tables(), labels=labels), tmp_path / "a.npz")
    np.testing.assert_array_equal(data_gen.load(tmp_path / "a.npz").labels, labels)


def test_clouds_of_mixed_n_are_refused(tmp_path):
    mixed = np.array([np.zeros((4, 3)), np.zeros((5, 3))], dtype=object)
    np.savez(tmp_path / "a.npz", points=mixed, allow_pickle=True)
    with pytest.raises(
        ValueError, match=r"load: a.npz must hold plain arrays, .* clouds of mixed n become; sample all"
    ):
        data_gen.load(tmp_path / "a.npz")


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"load: .*none.npz must be a sample file, got no file of that name; check"):
        data_gen.load(tmp_path / "none.npz")


@pytest.mark.parametrize("content", [b"", b"v 0 0 0\n", b"\x93NUMPY\x01\x00"])
def test_a_file_of_another_kind_is_refused(tmp_path, content):
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(
        ValueError, match=r"load: a.npz must be a sample file \(.npz\), got another kind; write it with"
    ):
        data_gen.load(tmp_path / "a.npz")


def test_an_archive_of_something_else_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        archive.writestr("points", "not an array")
    with pytest.raises(
        ValueError, match=r"load: a.npz must hold an array called points, got nothing we know; name the clouds so"
    ):
        data_gen.load(tmp_path / "a.npz")
    np.savez(tmp_path / "b.npz", clouds=np.zeros((2, 5, 3)), labels=np.zeros((2, 5)))
    with pytest.raises(ValueError, match=r"load: b.npz must hold an array called points, got labels; name"):
        data_gen.load(tmp_path / "b.npz")


@pytest.mark.parametrize("kept", [0.1, 0.5, 0.95, 0.999])
def test_a_truncated_file_is_refused(tmp_path, kept):
    data_gen.save(tables(), tmp_path / "a.npz")
    whole = (tmp_path / "a.npz").read_bytes()
    (tmp_path / "a.npz").write_bytes(whole[: int(kept * len(whole))])
    with pytest.raises(ValueError, match=r"load: a.npz must be whole, got a truncated or damaged file; copy it again"):
        data_gen.load(tmp_path / "a.npz")


def test_a_damaged_file_is_refused(tmp_path):
    data_gen.save(tables(), tmp_path / "a.npz")
    content = bytearray((tmp_path / "a.npz").read_bytes())
    content[300] ^= 255
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(ValueError, match=r"load: a.npz must be whole, got a truncated or damaged file"):
        data_gen.load(tmp_path / "a.npz")


@pytest.mark.parametrize("about", ["{not json", "[1, 2]"])
def test_about_that_is_no_json_object_is_refused(tmp_path, about):
    np.savez(tmp_path / "a.npz", points=np.zeros((2, 5, 3)), about=about)
    with pytest.raises(
        ValueError, match=r"load: a.npz must hold a JSON object in about, got .*; write the file with save"
    ):
        data_gen.load(tmp_path / "a.npz")


def test_a_folder_that_does_not_exist_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"a.npz: its folder must exist, got .*nowhere; make the folder first"):
        data_gen.save(tables(), tmp_path / "nowhere" / "a.npz")


def test_a_failed_write_leaves_the_old_file_alone(tmp_path, monkeypatch):
    data_gen.save(tables(), tmp_path / "a.npz")
    before = (tmp_path / "a.npz").read_bytes()
    monkeypatch.setattr(np.lib.format, "write_array", lambda *_, **__: (_ for _ in ()).throw(OSError("disk full")))
    with pytest.raises(OSError, match="disk full"):
        data_gen.save(tables(seed=1), tmp_path / "a.npz")
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("a.npz", before)]


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
    ],
)
def test_what_cannot_be_generated_is_refused(options, sentence):
    with pytest.raises(ValueError, match=f"generate: {sentence}"):
        tables(**options)


def test_resample_refuses_a_bad_seed():
    with pytest.raises(ValueError, match=r"resample: seed must be a whole number >= 0, got -3; choose one"):
        data_gen.resample(tables(), -3)
