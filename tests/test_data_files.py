"""Sample files: what is saved is loaded, and what is no sample file is refused in a sentence."""

from dataclasses import fields

import numpy as np
import pytest
import torch
from worlds import randn, shapes_of

import data_gen
from dsn_lite.data import Shapes
from dsn_lite.files import as_shapes, load_shapes, save_shapes

both = pytest.mark.parametrize("sampling", ["fresh", "shared"])


def same(one, other):
    """Assert that two collections hold the same, bit for bit."""
    for f in fields(Shapes):
        a, b = getattr(one, f.name), getattr(other, f.name)
        if isinstance(a, torch.Tensor):
            assert a.dtype == b.dtype
            np.testing.assert_array_equal(a.numpy(), b.numpy(), err_msg=f.name)  # NaN is NaN
        else:
            assert a == b, f.name


@both
@pytest.mark.parametrize("family", ["table/shelf", "carton/two_flaps", ("table/shelf", "carton/two_flaps")])
def test_what_is_saved_is_loaded(family, sampling, tmp_path):
    shapes = shapes_of(family, 4, 32, sampling=sampling)
    save_shapes(shapes, tmp_path / "some tables.npz")
    same(load_shapes(tmp_path / "some tables.npz"), shapes)


def test_points_are_all_a_file_needs(tmp_path):
    points = randn(0, 4, 5, 3, dtype=torch.float32)
    np.savez(tmp_path / "plain.npz", points=points.numpy())
    same(load_shapes(tmp_path / "plain.npz"), Shapes(points=points))
    save_shapes(points.numpy(), tmp_path / "saved.npz")
    same(load_shapes(tmp_path / "saved.npz"), Shapes(points=points))


def test_a_crash_while_saving_leaves_the_old_file_and_nothing_beside_it(tmp_path, monkeypatch):
    path, shapes = tmp_path / "shapes.npz", shapes_of("box/one", 4, 32)
    save_shapes(shapes, path)

    def crash(file, **arrays):
        file.write(b"half a fi")
        raise OSError("disk full")

    monkeypatch.setattr(np, "savez", crash)
    with pytest.raises(OSError, match=r"disk full"):
        save_shapes(shapes_of("box/one", 5, 32), path)
    same(load_shapes(path), shapes)
    assert [file.name for file in tmp_path.iterdir()] == ["shapes.npz"]


def stored(tmp_path, **arrays):
    path = tmp_path / "shapes.npz"
    np.savez(path, **arrays)
    return path


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"load_shapes: .*none\.npz: there is no such file; make one with"):
        load_shapes(tmp_path / "none.npz")


@pytest.mark.parametrize("share", [0.0, 0.001, 0.5, 0.99])
def test_a_truncated_file(share, tmp_path):
    path = tmp_path / "shapes.npz"
    save_shapes(shapes_of("box/one", 4, 64), path)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(
        ValueError, match=r"load_shapes: .*: must be a whole \.npz sample file, got \(.*; write it again"
    ):
        load_shapes(path)


def test_a_damaged_file(tmp_path):
    path = tmp_path / "shapes.npz"
    np.savez_compressed(path, points=randn(0, 4, 64, 3).numpy())
    whole = bytearray(path.read_bytes())
    for i in range(200, 400):
        whole[i] ^= 255
    path.write_bytes(whole)
    with pytest.raises(ValueError, match=r"must be a whole \.npz sample file"):
        load_shapes(path)


@pytest.mark.parametrize("content", [b"v 0 0 0\nf 1 2 3\n", b"\x93NUMPY", b"PK\x05\x06"])
def test_a_file_of_another_kind(content, tmp_path):
    path = tmp_path / "shapes.npz"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"must be a whole \.npz sample file"):
        load_shapes(path)


def test_a_bare_array_is_another_kind(tmp_path):
    np.save(tmp_path / "array.npy", np.zeros((4, 5, 3)))
    with pytest.raises(ValueError, match=r"must be a whole \.npz sample file"):
        load_shapes(tmp_path / "array.npy")


def test_a_file_without_points(tmp_path):
    with pytest.raises(ValueError, match=r"must hold an array named points \(N, n, 3\), it holds none"):
        load_shapes(stored(tmp_path, clouds=np.zeros((4, 5, 3))))


def test_a_file_of_clouds_of_mixed_sizes(tmp_path):
    mixed = np.array([np.zeros((5, 3)), np.zeros((6, 3))], dtype=object)
    with pytest.raises(ValueError, match=r"all clouds must have the same n, got mixed sizes; resample them to one n"):
        load_shapes(stored(tmp_path, points=mixed))


def test_a_file_whose_about_is_not_json(tmp_path):
    with pytest.raises(ValueError, match=r"about must be JSON, got 'a table'"):
        load_shapes(stored(tmp_path, points=np.zeros((4, 5, 3)), about="a table"))


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (np.zeros((4, 5)), r"points must be \(N, n, 3\) with N, n > 0, got \(4, 5\); stack the clouds"),
        (np.zeros((4, 3, 5)), r"points must be \(N, n, 3\) with N, n > 0, got \(4, 3, 5\)"),
        (np.zeros((0, 5, 3)), r"points must be \(N, n, 3\) with N, n > 0, got \(0, 5, 3\)"),
        (np.zeros((4, 1, 3)), "a shape needs at least 2 points, got 1; sample the surfaces more densely"),
        (np.full((4, 5, 3), np.nan), "points must be finite, shape 0 holds NaN or infinity; clean or drop it"),
        (np.where(np.arange(60).reshape(4, 5, 3) == 50, np.inf, 0), "points must be finite, shape 3 holds NaN"),
    ],
)
def test_points_that_are_no_collection(points, words, tmp_path):
    with pytest.raises(ValueError, match=rf"as_shapes: {words}"):
        as_shapes(points)
    with pytest.raises(ValueError, match=rf"load_shapes: .*shapes\.npz: {words}"):
        load_shapes(stored(tmp_path, points=points))


def test_a_list_of_clouds_of_mixed_sizes():
    with pytest.raises(ValueError, match=r"as_shapes: all clouds must have the same n, got mixed sizes"):
        as_shapes([np.zeros((5, 3)), np.zeros((6, 3))])


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("labels", np.zeros((4, 6), np.int16)),
        ("labels", np.zeros(4, np.int16)),
        ("rest", np.zeros((5, 4, 3))),
        ("boxes", np.zeros((3, 2, 15))),
        ("parameters", np.zeros((5, 2))),
        ("joints", np.zeros((5, 0, 8))),
        ("faces", np.zeros((4, 6), np.int16)),
        ("weights", np.zeros((4, 2))),
        ("families", np.zeros(5, np.int16)),
    ],
)
def test_truth_of_other_shapes(name, value, tmp_path):
    with pytest.raises(ValueError, match=rf"{name} must go with 4 shapes of 5 points, got "):
        load_shapes(stored(tmp_path, points=np.zeros((4, 5, 3)), **{name: value}))


def test_labels_of_parts_that_have_no_box(tmp_path):
    truth = {"labels": np.full((4, 5), 2), "boxes": np.zeros((4, 2, 15))}
    with pytest.raises(ValueError, match=r"labels must be parts 0 to 1 or -1, got 2"):
        load_shapes(stored(tmp_path, points=np.zeros((4, 5, 3)), **truth))


def test_about_survives_as_json(tmp_path):
    shapes = Shapes(points=torch.zeros(2, 3, 3), about={"family": "stühle", "corresponds": True})
    save_shapes(shapes, tmp_path / "a.npz")
    assert load_shapes(tmp_path / "a.npz").about == shapes.about


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"points": np.full((3, 4, 3), "a")}, r"points must be real numbers, got <U1"),
        ({"points": np.zeros((3, 4, 3), complex)}, r"points must be real numbers, got complex128"),
        ({"labels": np.zeros((3, 4))}, r"labels must be whole numbers, got float64"),
        ({"boxes": np.zeros((3, 2, 7))}, r"boxes must go with 3 shapes of 4 points, got \(3, 2, 7\)"),
        (
            {"parameters": np.full((3, 2), np.nan)},
            r"parameters must be finite, shape 0 holds NaN or infinity; clean or",
        ),
        ({"rest": np.full((3, 4, 3), np.inf)}, r"rest must be finite, shape 0 holds NaN or infinity; clean or drop it"),
        ({"joints": np.zeros((3, 2, 7))}, r"joints must go with 3 shapes of 4 points, got \(3, 2, 7\)"),
        ({"faces": np.zeros((3, 4))}, r"faces must be whole numbers, got float64"),
        ({"weights": np.zeros((3, 4, 3))}, r"weights must go with 3 shapes of 4 points, got \(3, 4, 3\)"),
        ({"families": np.zeros((3, 1), int)}, r"families must go with 3 shapes of 4 points, got \(3, 1\)"),
        ({"families": np.zeros(3, int)}, r"families must be rows of the 0 that about names, got 0; write it again"),
        ({"about": "[1, 2]"}, r"about must be a JSON object, got '\[1, 2\]'"),
    ],
)
def test_a_file_that_breaks_the_contract(wrong, words, tmp_path):
    path = tmp_path / "shapes.npz"
    np.savez(path, **{"points": np.zeros((3, 4, 3)), **wrong})
    with pytest.raises(ValueError, match=words):
        load_shapes(path)


def test_shapes_with_nan_are_not_written(tmp_path):
    with pytest.raises(ValueError, match=r"points must be finite, shape 0 holds NaN"):
        save_shapes(Shapes(points=torch.full((2, 4, 3), float("nan"))), tmp_path / "deep" / "shapes.npz")
    assert not (tmp_path / "deep").exists()
    save_shapes(Shapes(points=torch.zeros(2, 4, 3)), tmp_path / "deep" / "shapes.npz")
    assert len(load_shapes(tmp_path / "deep" / "shapes.npz")) == 2


# folders


@pytest.fixture
def folder(tmp_path):
    """A folder of shards of seven tables of two families."""
    data_gen.save_shards(
        data_gen.pieces(("table/four_legs", "table/shelf"), count=7, points=16, size=3), tmp_path / "a"
    )
    return tmp_path / "a"


@both
@pytest.mark.parametrize("family", ["table/shelf", "carton/two_flaps", ("table/shelf", "carton/two_flaps")])
def test_a_folder_holds_the_same_shapes_as_a_file(family, sampling, tmp_path):
    options = {"count": 7, "points": 16, "sampling": sampling}
    data_gen.save_shards(data_gen.pieces(family, **options, size=3), tmp_path / "a")
    read = load_shapes(tmp_path / "a")
    same(read, as_shapes(data_gen.generate(family, **options)))
    same(as_shapes(read), read)


def test_a_folder_is_not_read_before_it_is_used_and_never_written_to(folder):
    points = np.lib.format.open_memmap(folder / "points.npy", mode="r+")
    points[2] = np.nan  # which would be refused by who reads it
    points.flush()
    shapes = load_shapes(folder)
    assert shapes[:2].points.data_ptr() == shapes.points.data_ptr()
    shapes.points[0] = 5
    del points
    assert np.load(folder / "points.npy")[0].max() < 1
    with pytest.raises(
        ValueError, match=r"as_shapes: points must be finite, shape 2 holds NaN or infinity; clean or drop"
    ):
        as_shapes(shapes)


def test_a_collection_of_mapped_arrays_is_taken(folder):
    same(as_shapes(data_gen.load(folder)), load_shapes(folder))


def test_a_shape_far_back_that_is_not_finite_is_named():
    points = np.zeros((2500, 2, 3), np.float32)
    points[2222, 1, 2] = np.nan
    with pytest.raises(ValueError, match=r"points must be finite, shape 2222 holds NaN or infinity; clean or drop it"):
        as_shapes(points)


def test_a_folder_of_something_else(tmp_path):
    with pytest.raises(
        ValueError, match=r"a folder must hold about.json, it holds none; write it with data_gen.save_sh"
    ):
        load_shapes(tmp_path)


def test_a_folder_without_points(folder):
    (folder / "about.json").write_text('{"arrays": ["labels"]}', encoding="utf-8")
    with pytest.raises(ValueError, match=r"must hold an array named points \(N, n, 3\), it holds none"):
        load_shapes(folder)


@pytest.mark.parametrize(
    ("text", "words"), [("a table", "must be JSON, got 'a table'"), ("[1]", "must be a JSON object")]
)
def test_a_folder_whose_about_is_none(folder, text, words):
    (folder / "about.json").write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=f"about {words}"):
        load_shapes(folder)


def test_a_folder_that_lacks_an_array(folder):
    (folder / "boxes.npy").unlink()
    with pytest.raises(ValueError, match=r"must hold boxes.npy, it holds none; copy the folder again"):
        load_shapes(folder)


@pytest.mark.parametrize("kept", [0, 5, 100, -1])
def test_a_folder_with_a_truncated_array(folder, kept):
    (folder / "rest.npy").write_bytes((folder / "rest.npy").read_bytes()[:kept])
    with pytest.raises(ValueError, match=r"rest.npy must be a whole array, got \(.*\); write it again"):
        load_shapes(folder)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (
            {"parameters": np.zeros((3, 2)), "parameter_names": ["a"]},
            "parameter_names must name 2 parameters, got 1",
        ),
        (
            {"boxes": np.zeros((3, 2, 15)), "part_names": ["a", "b", "c"]},
            "part_names must name 2 boxes, got 3 names",
        ),
        ({"names": ["a", "b"]}, "names must name 3 shapes, got 2 names; write it again"),
        (
            {"labels": np.full((3, 4), 2), "part_names": ["a", "b"]},
            "labels must be parts 0 to 1 or -1, got 2; write",
        ),
        ({"parameters": np.zeros(3)}, r"parameters must go with 3 shapes of 4 points, got \(3,\); write it again"),
        ({"names": np.array("abc")}, "names must be a list of text, got 'abc'; write it again"),
        ({"names": np.array([1, 2, 3])}, r"names must be a list of text, got '\[1, 2, 3\]'; write it again"),
        ({"names": np.array(["a", "b", None])}, "names must be a plain array, got Python objects; write it again"),
        ({"about": '{"families": 5}'}, "about must name its family, or list its families, as text, got 5; write it"),
        ({"about": '{"families": null}'}, "about must name its family, or list its families, as text, got None; write"),
        ({"about": '{"family": 5}'}, "about must name its family, or list its families, as text, got 5; write it"),
        ({"about": '{"rigs": [1]}'}, r"about must hold a JSON object for each of its rigs, got \[1\]; write it again"),
        ({"about": '{"rigs": {"a": 1}}'}, "about must hold a JSON object for each of its rigs, got {'a': 1}; write it"),
        ({"about": '{"rigs": {"a": {"ranges": 1}}}'}, "about must hold a JSON object for each of its rigs, got "),
    ],
)
def test_what_is_known_must_fit_together(wrong, words, tmp_path):
    np.savez(tmp_path / "shapes.npz", points=np.zeros((3, 4, 3)), **wrong)
    with pytest.raises(ValueError, match=rf"load_shapes: .*shapes.npz: {words}"):
        load_shapes(tmp_path / "shapes.npz")


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.uint64, np.int64])
def test_whole_numbers_of_any_kind_are_taken(kind, tmp_path):
    labels, points = np.array([[0, 1], [1, 0]], kind), np.arange(12).reshape(2, 2, 3).astype(kind)
    np.savez(tmp_path / "a.npz", points=points, labels=labels, boxes=np.zeros((2, 2, 15), kind))
    shapes = load_shapes(tmp_path / "a.npz")
    assert shapes.labels.tolist() == labels.tolist()
    assert shapes.points.dtype == shapes.boxes.dtype == torch.float32


def test_numbers_that_a_file_has_no_room_for_are_not_written(tmp_path):
    shapes = Shapes(points=torch.zeros(2, 4, 3), faces=torch.full((2, 4), 70000))
    with pytest.raises(ValueError, match=r"save_shapes: faces must be 32767 at most, got 70000; that is all a file"):
        save_shapes(shapes, tmp_path / "a.npz")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b'{"arrays": null}', "about must list the names of the arrays, got None; write it again"),
        (b'{"arrays": "points"}', "about must list the names of the arrays, got 'points'; write it again"),
        (b'{"family": "\xff"}', "about.json must be UTF-8 text, got other bytes; write it again"),
        (b"[" * 100_000, r"about must be JSON, got '\[\["),
    ],
)
def test_a_folder_whose_about_does_not_list_its_arrays(folder, text, words):
    (folder / "about.json").write_bytes(text)
    with pytest.raises(ValueError, match=f"load_shapes: .*: {words}"):
        load_shapes(folder)


def test_an_archive_in_a_folder_is_no_array(folder):
    with (folder / "points.npy").open("wb") as file:
        np.savez(file, points=np.zeros((7, 16, 3)))
    with pytest.raises(ValueError, match=r"points.npy must be a whole array, got \(.*\); write it again"):
        load_shapes(folder)
