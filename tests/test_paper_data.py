"""The counterparts of the paper's data sets: its counts and splits, what varies in each, what the data sheet says."""

import hashlib
from collections import Counter

import numpy as np
import pytest

import data_gen
from data_gen import paper_data
from dsn_lite.files import load_shapes

SETS = {one.name: one for one in paper_data.data_sets()}


@pytest.fixture
def few(monkeypatch):
    """Sparse clouds, which are made at once."""
    monkeypatch.setattr(paper_data, "POINTS", 64)


def test_the_sets_are_those_of_the_paper():
    assert Counter(one.group for one in SETS.values()) == {
        "categories": 5,
        "normalised": 5,
        "parametric": 74,
        "tables": 1,
        "poses": 3,
    }
    counts = {name.split("/")[1]: one.count for name, one in SETS.items() if one.group == "categories"}
    assert counts == {"airplane": 2390, "car": 1200, "chair": 1927, "sofa": 947, "table": 1857}
    assert {one.count for one in SETS.values() if one.group in ("parametric", "poses")} == {1000}
    assert SETS["tables/four_legs"].count == 5000
    assert paper_data.POINTS == 2048


def test_parametric_models_hold_still_and_take_eight_of_each_group_of_the_user_study():
    models = paper_data.parametric_models()
    assert len(set(models)) == len(models)
    assert not any(data_gen.family(name).joint_list for name in models)
    assert all(len(data_gen.family(name).part_names) > 1 for name in models)
    by_category = Counter(name.split("/")[0] for name in models)
    assert all(by_category[category] >= 8 for category in ("airplane", "chair", "table"))
    assert list(models) == sorted(models, key=data_gen.families().index)


@pytest.mark.parametrize("name", SETS)
def test_every_set_can_be_made(few, name):
    one = SETS[name]
    shapes = one.made(9)
    assert shapes.points.shape == (9, 64, 3)
    assert shapes.about["split"] == {"train": [0, 6], "validation": [6, 8], "test": [8, 9]}
    assert shapes.about["corresponds"] is (one.group == "parametric")
    assert (shapes.families is not None) is (one.group in ("categories", "normalised"))
    limit = 1 if one.group == "normalised" else 0.5
    assert np.abs(shapes.points).max() <= limit + 1e-6


def test_no_two_sets_have_the_same_shapes():
    assert len({one.seed for one in SETS.values()}) == len(SETS)


@pytest.mark.parametrize(
    ("count", "test", "sizes"), [(2390, 0.1, (2031, 120, 239)), (1000, 0.128, (822, 50, 128)), (8, 0.128, (5, 2, 1))]
)
def test_a_split_parts_all_shapes(count, test, sizes):
    rows = paper_data.split(count, test)
    assert tuple(stop - start for start, stop in rows.values()) == sizes
    assert sorted(row for start, stop in rows.values() for row in range(start, stop)) == list(range(count))


@pytest.mark.parametrize("name", [name for name in SETS if name.startswith("poses")])
def test_in_poses_only_angles_vary(few, name):
    shapes, rig = SETS[name].made(400), data_gen.family(SETS[name].family)
    for column, parameter in zip(shapes.parameters.T, rig.parameters, strict=True):
        if parameter.unit == "rad":
            share = (column - parameter.low) / (parameter.high - parameter.low)
            np.testing.assert_allclose([share.mean(), share.std()], [1 / 2, 12**-0.5], atol=0.08)  # uniform
        else:
            np.testing.assert_allclose(column, (parameter.low + parameter.high) / 2, rtol=1e-6)
    assert any(parameter.unit == "rad" for parameter in rig.parameters)


def test_normalised_clouds_fill_a_cube_of_size_2(few):
    extents = np.ptp(SETS["normalised/table"].made(20).points, axis=1)
    np.testing.assert_allclose(extents.max(axis=1), 2, atol=1e-6)


def test_a_folder_holds_files_that_both_packages_read_with_their_split(few, tmp_path):
    data_gen.paper(tmp_path / "data", only="categories/table", lite=True)
    read = data_gen.load(tmp_path / "data" / "categories" / "table.npz")
    assert read.points.shape == (19, 64, 3)
    parts = load_shapes(tmp_path / "data" / "categories" / "table.npz").split()
    assert [part.names for part in parts] == [read.names[:15], read.names[15:17], read.names[17:]]


def test_the_data_sheet_tells_of_every_file_that_lies_there(few, tmp_path):
    for only in ("poses", "tables"):
        data_gen.paper(tmp_path, only=only, lite=True)
    files = sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.npz"))
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    assert files == ["poses/carton.npz", "poses/eyeglasses.npz", "poses/swing.npz", "tables/four_legs.npz"]
    for file in files:
        content = (tmp_path / file).read_bytes()
        assert f"{hashlib.sha256(content).hexdigest()}  {file}" in text
    seed = SETS["tables/four_legs"].seed
    assert f"| tables/four_legs.npz | table/four_legs | 50 | 5000 | 43 / 2 / 5 | 64 | fresh | {seed} |" in text
    assert "Section 4.4" in text
    assert "Section 4.6" in text
    assert "Section 4.1" not in text
    assert "MIT" in text


def test_the_same_bytes_are_made_again(few, tmp_path):
    for out in ("one", "two"):
        data_gen.paper(tmp_path / out, only="poses/carton", lite=True)
    for file in ("poses/carton.npz", "README.md"):
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes()


def test_progress_sees_every_set(few, tmp_path):
    seen = []
    data_gen.paper(
        tmp_path, only="poses", lite=True, progress=lambda sets: map(lambda one: seen.append(one) or one, sets)
    )
    assert [one.name for one in seen] == ["poses/carton", "poses/eyeglasses", "poses/swing"]


def test_an_unknown_set_is_refused(tmp_path):
    words = r"paper: only must name a data set, such as poses/carton, or one of categories, .*, got 'piano'; check it"
    with pytest.raises(ValueError, match=words):
        data_gen.paper(tmp_path / "data", only="piano")
    assert not (tmp_path / "data").exists()
