"""The sample file: what is written, what is read, what is refused."""

import dataclasses
import json
import zipfile

import numpy as np
import pytest
from tables import arrays_differ, tables

import data_gen
from data_gen.sample import KEYS
from dsn_lite.files import as_shapes


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@pytest.mark.parametrize("rows", [2, slice(1, None), [2, 0], np.array([True, False, True])])
def test_an_index_takes_everything_of_its_shapes(sampling, rows):
    shapes = tables(sampling=sampling)
    kept, taken = np.atleast_1d(np.arange(3)[rows]), shapes[rows]
    assert len(taken) == len(kept)
    assert taken.names == tuple(shapes.names[i] for i in kept)
    for key in ("points", "boxes", "parameters", "joints"):
        np.testing.assert_array_equal(getattr(taken, key), getattr(shapes, key)[kept])
    for key in ("labels", "rest", "faces", "weights"):
        whole = getattr(shapes, key)
        np.testing.assert_array_equal(getattr(taken, key), whole if sampling == "shared" else whole[kept])


def test_some_shapes_do_not_have_the_split_of_all():
    shapes = dataclasses.replace(tables(), about={"split": {"train": [0, 3]}, "family": "table/four_legs"})
    assert shapes[:2].about == {"split": None, "family": "table/four_legs"}


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
        "faces": ((3, 16), "<i2"),
        "weights": ((3, 16, 2), "<f4"),
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


def test_a_file_with_only_points_is_a_collection(tmp_path):
    np.savez(tmp_path / "plain.npz", points=np.ones((2, 5, 3), np.float32), licence="CC0")
    plain = data_gen.load(tmp_path / "plain.npz")
    assert plain.points.shape == (2, 5, 3)
    assert plain.labels is None
    assert plain.about == {}
    data_gen.save(plain, tmp_path / "again.npz")
    np.testing.assert_array_equal(data_gen.load(tmp_path / "again.npz").points, plain.points)


@pytest.mark.parametrize("key", [key for key in KEYS if key not in ("points", "families", "about")])
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
    held = {k: np.asarray(getattr(shapes, k)) for k in KEYS if k not in ("families", "about")}
    np.savez(tmp_path / "b.npz", **held | {key: np.asarray(wrong)})
    with pytest.raises(ValueError, match=f"load: b.npz: {blamed} must be"):
        data_gen.load(tmp_path / "b.npz")


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        (np.zeros((2, 1, 3)), r"points must hold a shape of two points or more, got \(2, 1, 3\); sample more"),
        (np.zeros((0, 9, 3)), r"points must hold a shape of two points or more, got \(0, 9, 3\)"),
        (np.zeros((2, 0, 3)), r"points must hold a shape of two points or more, got \(2, 0, 3\)"),
        (np.zeros((9, 3)), r"points must be \(N, n, 3\), got \(9, 3\); stack the clouds"),
        (np.zeros((2, 3, 9)), r"points must be \(N, n, 3\), got \(2, 3, 9\); stack the clouds"),
        (np.zeros((2, 9, 3), complex), "points must be real numbers, got complex128; write the file with save"),
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


@pytest.mark.parametrize("labels", [np.full(16, 5, np.int16), np.full(16, -2, np.int16)])
def test_labels_that_are_no_parts_are_refused(tmp_path, labels):
    with pytest.raises(ValueError, match=r"save: labels must be from -1 to 4, one a part, got .*; number the parts"):
        data_gen.save(dataclasses.replace(tables(), labels=labels), tmp_path / "a.npz")


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("labels", "whole numbers, got float32"),
        ("weights", "real numbers, got complex64"),
        ("boxes", "real numbers, got <U1"),
    ],
)
def test_numbers_of_another_kind_are_refused(tmp_path, key, words):
    kind = {"labels": np.float32, "weights": np.complex64, "boxes": "U1"}[key]
    wrong = dataclasses.replace(tables(), **{key: getattr(tables(), key).astype(kind)})
    with pytest.raises(ValueError, match=f"save: {key} must be {words}; write the file with save"):
        data_gen.save(wrong, tmp_path / "a.npz")


@pytest.mark.parametrize("families", [np.array([0, 1, 2], np.int16), np.array([0, -1, 0], np.int16)])
def test_families_that_about_does_not_name_are_refused(tmp_path, families):
    about = {"families": ["table/four_legs", "table/shelf"]}
    mixed = dataclasses.replace(tables(), families=families, about=about)
    with pytest.raises(
        ValueError, match=r"save: families must be rows of the 2 in about, got -?\d to \d; name them there"
    ):
        data_gen.save(mixed, tmp_path / "a.npz")


def test_parameters_may_be_nan_only_where_families_are_mixed(tmp_path):
    mixed = data_gen.generate(["table/four_legs", "table/shelf"], count=9, points=8)
    assert np.isnan(mixed.parameters).any()
    data_gen.save(mixed, tmp_path / "a.npz")
    with pytest.raises(ValueError, match=r"save: parameters must be finite, got NaN or infinity in row \d; leave that"):
        data_gen.save(dataclasses.replace(mixed, families=None), tmp_path / "a.npz")


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
        ValueError, match=r"load: a.npz must hold a JSON object in about, got .*; write it with data_gen"
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


@pytest.mark.parametrize("kind", ["u1", "u2", "u8", "i8", ">i4"])
def test_whole_numbers_of_any_kind_are_read(tmp_path, kind):
    points = np.arange(24).reshape(2, 4, 3).astype(kind)
    labels = np.array([[0, 1, 1, 0], [1, 0, 0, 1]], kind)
    foreign = {"points": points, "labels": labels, "part_names": ["seat", "back"]}
    np.savez(tmp_path / "a.npz", **foreign)
    for read in (data_gen.load(tmp_path / "a.npz"), data_gen.Collection(**foreign)):
        data_gen.save(read, tmp_path / "b.npz")
        again = data_gen.load(tmp_path / "b.npz")
        assert (again.points.dtype, again.labels.dtype) == (np.float32, np.int16)
        np.testing.assert_array_equal(again.points, np.arange(24).reshape(2, 4, 3))
        np.testing.assert_array_equal(again.labels, labels)
    assert data_gen.load(tmp_path / "a.npz").points.dtype == np.float32, "so that they can be moved"
    assert data_gen.load(tmp_path / "a.npz").labels.dtype.kind == "i"


@pytest.mark.parametrize("most", [32768, 70000])
def test_numbers_that_a_file_has_no_room_for_are_refused(tmp_path, most):
    wide = dataclasses.replace(tables(), faces=np.full((3, 16), most))
    words = f"save: faces must be 32767 at most, got {most}; that is all a file has room for"
    with pytest.raises(ValueError, match=words):
        data_gen.save(wide, tmp_path / "a.npz")
    with pytest.raises(ValueError, match=words):
        data_gen.save_shards([wide], tmp_path / "a")
    assert not list(tmp_path.iterdir())
    data_gen.save(dataclasses.replace(wide, faces=np.full((3, 16), 32767)), tmp_path / "a.npz")
    assert data_gen.load(tmp_path / "a.npz").faces.max() == 32767


@pytest.mark.parametrize("said", [{"families": 5}, {"families": None}, {"families": [1]}, {"family": 5}])
def test_about_that_names_no_families_is_refused(tmp_path, said):
    np.savez(tmp_path / "a.npz", points=np.zeros((2, 5, 3)), about=json.dumps(said))
    words = "about must name its family, or list its families, as text, got .*; write it with save"
    with pytest.raises(ValueError, match=f"load: a.npz: {words}"):
        data_gen.load(tmp_path / "a.npz")
    with pytest.raises(ValueError, match=f"save: {words}"):
        data_gen.save(data_gen.Collection(np.zeros((2, 5, 3)), about=said), tmp_path / "b.npz")


@pytest.mark.parametrize("names", [np.array("ab"), np.array([1, 2]), np.array([["a"], ["b"]])])
def test_names_that_are_no_list_of_text_are_refused(tmp_path, names):
    np.savez(tmp_path / "a.npz", points=np.zeros((2, 5, 3)), names=names)
    with pytest.raises(ValueError, match=r"load: a.npz: names must be a list of text, got \(.*; write it with"):
        data_gen.load(tmp_path / "a.npz")


def test_names_that_are_python_objects_are_refused_as_such(tmp_path):
    np.savez(tmp_path / "a.npz", points=np.zeros((2, 5, 3)), names=np.array(["a", None], object))
    with pytest.raises(ValueError, match=r"load: a.npz must hold plain arrays, got Python objects in names; write it"):
        data_gen.load(tmp_path / "a.npz")


def test_a_file_packed_in_a_way_that_nobody_knows_is_damaged(tmp_path):
    data_gen.save(tables(), tmp_path / "a.npz")
    content = bytearray((tmp_path / "a.npz").read_bytes())
    content[content.index(b"PK\1\2") + 10] = 99  # the way the first array is packed
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(ValueError, match=r"load: a.npz must be whole, got a truncated or damaged file; copy it again"):
        data_gen.load(tmp_path / "a.npz")


@pytest.fixture
def folder(tmp_path):
    data_gen.save_shards([tables()], tmp_path / "a")
    return tmp_path / "a"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b'{"arrays": null}', "a must list the names of its arrays in about, got None; write it with data_gen"),
        (b'{"arrays": [5]}', r"a must list the names of its arrays in about, got \[5\]; write it"),
        (b'{"family": "\xff"}', "a must hold UTF-8 text in about.json, got other bytes; copy it again"),
        (b"[" * 100_000, r"a must hold a JSON object in about, got '\[\["),
        (b'{"arrays": ["points"], "families": 5}', "a: about must name its family, or list its families, as text"),
    ],
)
def test_a_folder_whose_about_is_none_is_refused(folder, text, words):
    (folder / "about.json").write_bytes(text)
    with pytest.raises(ValueError, match=f"load: {words}"):
        data_gen.load(folder)


def test_arrays_of_a_folder_that_the_contract_does_not_know_are_left_out(folder):
    about = json.loads((folder / "about.json").read_text(encoding="utf-8"))
    (folder / "about.json").write_text(json.dumps(about | {"arrays": ["points", "licence", "about"]}), encoding="utf-8")
    for key in ("licence", "about"):
        np.save(folder / f"{key}.npy", np.zeros(2))
    read = data_gen.load(folder)
    np.testing.assert_array_equal(read.points, tables().points)
    assert read.about == tables().about


def test_an_archive_in_a_folder_is_refused(folder):
    with (folder / "points.npy").open("wb") as file:
        np.savez(file, points=np.zeros((3, 16, 3)))
    with pytest.raises(ValueError, match=r"load: a: points must be an array, got an archive of arrays; write it with"):
        data_gen.load(folder)


@pytest.mark.parametrize("given", [np.zeros((2, 5, 3)), as_shapes(np.zeros((2, 5, 3))), None])
def test_what_is_no_collection_is_refused(tmp_path, given):
    said = rf"shapes must be a Collection of data_gen, got {type(given).__name__}; take what generate or load gives"
    doors = {
        "save": lambda: data_gen.save(given, tmp_path / "a.npz"),
        "save_shards": lambda: data_gen.save_shards([given], tmp_path / "a"),
        "true_deformation": lambda: data_gen.true_deformation(tables(), given),
        "true_transfer": lambda: data_gen.true_transfer(given, given, given),
        "valid_space": lambda: data_gen.valid_space(given),
        "handles": lambda: data_gen.handles(given, 0),
    }
    for where, door in doors.items():
        with pytest.raises(ValueError, match=f"{where}: {said}"):
            door()


@pytest.mark.parametrize(("key", "value"), [("points", [[[0, 0, 0], [1, 1, 1]]]), ("labels", [0] * 16)])
def test_lists_in_place_of_arrays_are_refused(tmp_path, key, value):
    with pytest.raises(ValueError, match=f"save: {key} must be an array, got list; wrap it in numpy.asarray"):
        data_gen.save(dataclasses.replace(tables(), **{key: value}), tmp_path / "a.npz")


def test_about_that_is_no_dict_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"save: about must be a dict, got str; take that of the collection"):
        data_gen.save(dataclasses.replace(tables(), about="tables"), tmp_path / "a.npz")
