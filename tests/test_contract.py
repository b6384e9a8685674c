"""data_gen writes, dsn_lite reads, and the other way round: the sample file is all they share."""

import numpy as np
import pytest
import torch
from worlds import FAMILIES

import data_gen
from data_gen.sample import STORED
from dsn_lite.files import as_shapes, load_shapes, save_shapes

ARRAYS = ("points", "labels", "rest", "boxes", "parameters")
NAMES = ("parameter_names", "part_names", "names")


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
@pytest.mark.parametrize("family", FAMILIES)
def test_every_field_arrives(family, sampling, tmp_path):
    made = data_gen.generate(family, count=3, points=16, seed=1, sampling=sampling)
    data_gen.save(made, tmp_path / "made.npz")
    read = load_shapes(tmp_path / "made.npz")
    for name in ARRAYS:
        array = getattr(made, name)
        np.testing.assert_array_equal(getattr(read, name).numpy(), array)
        assert getattr(read, name).dtype == torch.from_numpy(np.zeros(1, STORED[name])).dtype
    assert {name: getattr(read, name) for name in NAMES} == {name: getattr(made, name) for name in NAMES}
    assert read.about == made.about
    assert read.corresponds is (sampling == "shared")
    assert read.truth_is_known


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_a_file_and_a_collection_in_memory_are_the_same_shapes(sampling, tmp_path):
    made = data_gen.generate("table/shelf", count=3, points=16, sampling=sampling)
    data_gen.save(made, tmp_path / "made.npz")
    read, held = load_shapes(tmp_path / "made.npz"), as_shapes(made)
    for name in ARRAYS:
        assert torch.equal(getattr(read, name), getattr(held, name))
    assert (read.names, read.about) == (held.names, held.about)


@pytest.mark.parametrize("sampling", ["fresh", "shared"])
def test_what_dsn_lite_writes_data_gen_reads_and_samples_again(sampling, tmp_path):
    made = data_gen.generate("chair/four_legs", count=3, points=16, sampling=sampling)
    save_shapes(made, tmp_path / "saved.npz")
    back = data_gen.load(tmp_path / "saved.npz")
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(back, name), getattr(made, name))
    assert (back.names, back.part_names, back.about) == (made.names, made.part_names, made.about)
    np.testing.assert_array_equal(data_gen.resample(back, 5).points, data_gen.resample(made, 5).points)


def test_plain_points_pass_both_ways(tmp_path):
    points = np.random.default_rng(0).random((3, 4, 3), np.float32)
    save_shapes(points, tmp_path / "plain.npz")
    np.testing.assert_array_equal(data_gen.load(tmp_path / "plain.npz").points, points)
    data_gen.save(data_gen.Collection(points), tmp_path / "plain.npz")
    np.testing.assert_array_equal(load_shapes(tmp_path / "plain.npz").points, points)
