"""Collections in folders: they equal those in memory, need the memory of a piece, and are read as they are used."""

import dataclasses
import itertools
import json
import tracemalloc

import numpy as np
import pytest
from tables import arrays_differ, bytes_of, tables

import data_gen
from data_gen.sample import STORED

MIXED = ("table/four_legs", "table/shelf", "carton/two_flaps")


@pytest.fixture
def folder(tmp_path):
    """A folder of shards of seven tables."""
    data_gen.save_shards(data_gen.pieces("table/four_legs", count=7, points=16, size=3), tmp_path / "tables")
    return tmp_path / "tables"


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@pytest.mark.parametrize("family", ["table/four_legs", "carton/two_flaps", MIXED])
def test_shards_are_what_generate_makes(tmp_path, family, sampling):
    options = {"count": 8, "points": 16, "seed": 5, "sampling": sampling}
    data_gen.save_shards(data_gen.pieces(family, **options, size=3), tmp_path / "shapes")
    read, whole = data_gen.load(tmp_path / "shapes"), data_gen.generate(family, **options)
    assert not arrays_differ(read, whole)
    assert read.about == whole.about
    assert [path.name for path in tmp_path.iterdir()] == ["shapes"]


def test_a_folder_holds_plain_arrays_of_the_types_of_the_contract(folder):
    about = json.loads((folder / "about.json").read_text(encoding="utf-8"))
    assert {f"{key}.npy" for key in about["arrays"]} | {"about.json"} == {path.name for path in folder.iterdir()}
    for key in set(STORED) & set(about["arrays"]):
        assert np.load(folder / f"{key}.npy").dtype == STORED[key]
    assert np.load(folder / "points.npy").shape == (7, 16, 3)
    assert np.load(folder / "names.npy").tolist() == [f"table/four_legs/{i:05d}" for i in range(7)]


def test_pieces_in_double_precision_are_stored_in_single(tmp_path):
    double = data_gen.generate("box/one", count=4, points=8, dtype="float64")
    data_gen.save_shards([double[:3], double[3:]], tmp_path / "boxes")
    np.testing.assert_array_equal(data_gen.load(tmp_path / "boxes").points, double.points.astype(np.float32))


def test_points_alone_are_enough(tmp_path):
    clouds = [data_gen.Collection(np.full((2, 5, 3), value, np.float32)) for value in (1, 2, 3)]
    data_gen.save_shards(clouds, tmp_path / "plain")
    np.testing.assert_array_equal(
        data_gen.load(tmp_path / "plain").points, np.concatenate([one.points for one in clouds])
    )
    (tmp_path / "plain" / "about.json").write_text("{}", encoding="utf-8")  # as one's own folder of one array
    assert data_gen.load(tmp_path / "plain").points.shape == (6, 5, 3)


def test_arrays_are_mapped_and_not_read(folder):
    points = np.lib.format.open_memmap(folder / "points.npy", mode="r+")
    points[:] = np.nan  # which would be refused by who reads it
    points.flush()
    del points
    shapes = data_gen.load(folder)
    for key in set(STORED) - {"families"}:
        assert isinstance(getattr(shapes, key), np.memmap)
        assert not getattr(shapes, key).flags.writeable
    assert isinstance(shapes[2:5].points, np.memmap)
    assert np.isnan(shapes.points).all()


def test_writing_needs_the_memory_of_a_piece(tmp_path):
    options = {"points": 500, "size": 50}
    piece = bytes_of(next(data_gen.pieces("table/shelf", count=50, **options)))
    tracemalloc.start()
    data_gen.save_shards(data_gen.pieces("table/shelf", count=1000, **options), tmp_path / "tables")
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 3 * piece, "of 20 pieces"


def test_degraded_pieces_make_the_degraded_whole(tmp_path):
    options, size = {"count": 8, "points": 16, "seed": 5}, 3
    rows = itertools.count(0, size)
    pieces = (data_gen.noisy(one, 0.01, 5, first=next(rows)) for one in data_gen.pieces(MIXED, **options, size=size))
    data_gen.save_shards(pieces, tmp_path / "noisy")
    read, whole = data_gen.load(tmp_path / "noisy"), data_gen.noisy(data_gen.generate(MIXED, **options), 0.01, 5)
    assert not arrays_differ(read, whole)
    assert read.about == whole.about


# what is refused


def test_a_folder_that_holds_something_is_left_alone(folder):
    before = sorted(path.name for path in folder.iterdir())
    with pytest.raises(
        ValueError, match=r"save_shards: .*tables must be new or an empty folder, got one that is not; cho"
    ):
        data_gen.save_shards([tables()], folder)
    assert sorted(path.name for path in folder.iterdir()) == before


def test_an_empty_folder_is_filled(tmp_path):
    (tmp_path / "tables").mkdir()
    data_gen.save_shards([tables()], tmp_path / "tables")
    assert len(data_gen.load(tmp_path / "tables")) == 3


def test_a_file_in_the_place_of_the_folder_is_left_alone(tmp_path):
    (tmp_path / "tables").write_text("mine", encoding="utf-8")
    with pytest.raises(ValueError, match=r"save_shards: .*tables must be new or an empty folder"):
        data_gen.save_shards([tables()], tmp_path / "tables")
    assert (tmp_path / "tables").read_text(encoding="utf-8") == "mine"


def test_a_folder_in_a_folder_that_does_not_exist(tmp_path):
    with pytest.raises(ValueError, match=r"save_shards: its folder must exist, got .*nowhere; make the folder first"):
        data_gen.save_shards([tables()], tmp_path / "nowhere" / "tables")


def test_a_crash_leaves_nothing(tmp_path):
    def crash():
        yield tables()
        raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        data_gen.save_shards(crash(), tmp_path / "tables")
    assert not list(tmp_path.iterdir())


def test_no_pieces_are_refused(tmp_path):
    with pytest.raises(
        ValueError, match=r"save_shards: there must be a piece or more, got none; take them from pieces"
    ):
        data_gen.save_shards([], tmp_path / "tables")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("other", "key"),
    [
        (tables(points=9), "points"),
        (tables(sampling="shared"), "labels"),
        (dataclasses.replace(tables(), names=None), "names"),
        (dataclasses.replace(tables(), joints=None), "joints"),
        (dataclasses.replace(tables(), part_names=("top", "a", "b", "c", "d")), "part_names"),
        (tables(seed=1), "about"),
        (data_gen.generate("table/shelf", count=3, points=16), "boxes"),
    ],
)
def test_pieces_of_another_collection_are_refused(tmp_path, other, key):
    words = (
        f"save_shards: all pieces must be of one collection, got another {key} from row 3 on; take them from one call"
    )
    with pytest.raises(ValueError, match=words):
        data_gen.save_shards([tables(), other], tmp_path / "tables")


def test_samples_that_pieces_do_not_share_are_refused(tmp_path):
    one, other = tables(sampling="shared"), tables(sampling="shared", seed=1)
    with pytest.raises(ValueError, match=r"got another labels from row 3 on"):
        data_gen.save_shards([one, dataclasses.replace(other, about=one.about)], tmp_path / "tables")


def test_a_piece_that_breaks_the_contract_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"save_shards: points must be finite, got NaN or infinity in row 0"):
        data_gen.save_shards([data_gen.Collection(np.full((2, 5, 3), np.nan))], tmp_path / "tables")


def test_a_missing_array_is_refused(folder):
    (folder / "labels.npy").unlink()
    with pytest.raises(ValueError, match=r"load: tables must hold labels.npy, got none; copy the folder again"):
        data_gen.load(folder)


def test_a_folder_of_something_else_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"load: .* must hold about.json, got none; write the folder with save_shards"):
        data_gen.load(tmp_path)


def test_about_that_is_no_json_object_is_refused(folder):
    (folder / "about.json").write_text("[1, 2]", encoding="utf-8")
    with pytest.raises(
        ValueError, match=r"load: tables must hold a JSON object in about, got '\[1, 2\]'; write it with"
    ):
        data_gen.load(folder)


@pytest.mark.parametrize("kept", [0, 5, 100, -1])
@pytest.mark.parametrize("key", ["points", "boxes", "names"])
def test_a_truncated_array_is_refused(folder, key, kept):
    file = folder / f"{key}.npy"
    file.write_bytes(file.read_bytes()[:kept])
    with pytest.raises(
        ValueError, match=f"load: tables/{key}.npy must be whole, got a truncated or damaged file; copy it"
    ):
        data_gen.load(folder)


def test_arrays_that_do_not_fit_the_points_are_refused(folder):
    np.save(folder / "labels.npy", np.zeros((7, 15), np.int16))
    with pytest.raises(
        ValueError, match=r"load: tables: labels must be \(7, 16\) or \(16,\), got \(7, 15\); it has to fit"
    ):
        data_gen.load(folder)
