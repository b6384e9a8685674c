"""data_gen writes, dsn_lite reads, and the other way round: the sample file is all they share."""

from dataclasses import replace

import numpy as np
import pytest
from worlds import FAMILIES

import data_gen
import dsn_lite.files
from data_gen.sample import KEYS, NAMES, STORED
from dsn_lite.files import as_shapes, load_shapes, save_shapes

MIXED = ("table/four_legs", "table/shelf", "carton/two_flaps")
MADE = pytest.mark.parametrize("family", [*FAMILIES, "carton/two_flaps", MIXED])


def same(held, made):
    """Assert that two collections, of either package, hold the same, bit for bit."""
    for key in STORED:
        one, other = getattr(held, key), getattr(made, key)
        assert (one is None) == (other is None), key
        if other is not None:
            assert np.asarray(one).dtype == STORED[key]
            np.testing.assert_array_equal(np.asarray(one), np.asarray(other), err_msg=key)
    assert {key: getattr(held, key) for key in NAMES} == {key: getattr(made, key) for key in NAMES}
    assert held.about == made.about


def test_both_know_the_same_keys():
    assert set(dsn_lite.files.KEYS) == set(KEYS)


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@MADE
def test_every_field_arrives(family, sampling, tmp_path):
    made = data_gen.generate(family, count=5, points=16, seed=1, sampling=sampling)
    data_gen.save(made, tmp_path / "made.npz")
    data_gen.save_shards([made[:2], made[2:]], tmp_path / "made")
    for held in (load_shapes(tmp_path / "made.npz"), load_shapes(tmp_path / "made"), as_shapes(made)):
        same(held, made)
        assert held.corresponds is (sampling == "shared" and family != MIXED)
        assert held.truth_is_known is (family in FAMILIES)


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@MADE
def test_what_dsn_lite_writes_data_gen_reads_and_samples_again(family, sampling, tmp_path):
    made = data_gen.generate(family, count=3, points=16, sampling=sampling)
    save_shapes(made, tmp_path / "saved.npz")
    back = data_gen.load(tmp_path / "saved.npz")
    same(back, made)
    np.testing.assert_array_equal(data_gen.resample(back, 5).points, data_gen.resample(made, 5).points)


def test_a_split_written_by_one_is_that_of_the_other(tmp_path):
    made = data_gen.generate("box/one", count=9, points=8)
    about = {**made.about, "split": {"train": [0, 5], "validation": [5, 7], "test": [7, 9]}}
    data_gen.save(replace(made, about=about), tmp_path / "a.npz")
    assert [part.names for part in load_shapes(tmp_path / "a.npz").split()] == [
        made.names[:5],
        made.names[5:7],
        made.names[7:],
    ]


def test_plain_points_pass_both_ways(tmp_path):
    points = np.random.default_rng(0).random((3, 4, 3), np.float32)
    save_shapes(points, tmp_path / "plain.npz")
    np.testing.assert_array_equal(data_gen.load(tmp_path / "plain.npz").points, points)
    data_gen.save(data_gen.Collection(points), tmp_path / "plain.npz")
    np.testing.assert_array_equal(load_shapes(tmp_path / "plain.npz").points, points)


@pytest.mark.parametrize(
    "told", [("table/four_legs",), ("desk_lamp/bracket",), (*MIXED, "cabinet/nightstand", "desk_lamp/balanced")]
)
def test_what_about_says_of_rigs_is_what_the_rigs_are(told, tmp_path):
    data_gen.save(data_gen.generate(told, count=len(told), points=4), tmp_path / "a.npz")
    rigs = load_shapes(tmp_path / "a.npz").about["rigs"]
    assert set(rigs) == set(told)
    for name, said in rigs.items():
        rig = data_gen.family(name)
        assert said["parts"] == list(rig.part_names)
        assert said["symmetric_pairs"] == [list(pair) for pair in rig.symmetric]
        assert said["contacts"] == [[one.first, one.second, one.kind] for one in rig.contacts]
        assert said["units"] == {one.name: one.unit for one in rig.parameters}
        assert said["ranges"] == {one.name: [one.low, one.high] for one in rig.parameters}
        tree = [(one["name"], one["kind"], one["on"], one["parts"]) for one in said["joint_tree"]]
        assert tree == [(one.name, one.kind, one.on, list(one.parts)) for one in rig.joint_list]
        for one in said["joint_tree"]:
            carrying = [i for i, other in enumerate(said["joint_tree"]) if one["on"] in other["parts"]]
            assert [one["parent"]] == (carrying or [-1])
        turning = any(joint.kind == "hinge" for joint in rig.joint_list)
        assert (said["linear"], said["by_boxes"]) == (not turning, not turning and rig.fixed_rest)


def test_what_about_says_of_a_desk_lamp():
    said = data_gen.generate("desk_lamp/bracket", count=1, points=4).about["rigs"]["desk_lamp/bracket"]
    assert [one["parent"] for one in said["joint_tree"]] == [-1, 0, 1]
    assert said["units"]["head_angle"] == "rad"
    assert said["units"]["head_width"] == "length"
