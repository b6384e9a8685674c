"""MMD-CD and Cov-CD against slow twins, and where they are known."""

import pytest
import torch
from worlds import near, randn, unchecked

from dsn_lite.chamfer import chamfer
from dsn_lite.coverage import chamfer_table, coverage_cd, mmd_cd


def test_the_table_is_that_of_one_chamfer_distance_after_the_other():
    generated, references = randn(0, 4, 7, 3) + 5, randn(1, 3, 9, 3) + 5
    slow = torch.stack([torch.stack([chamfer(x, y) for y in references]) for x in generated])
    near(chamfer_table(generated, references), slow)


def test_far_from_the_origin_single_precision_suffices():
    x, y = randn(0, 2, 50, 3, scale=0.1) + 10, randn(1, 2, 50, 3, scale=0.1) + 10
    assert (chamfer_table(x.float(), y.float()) - chamfer_table(x, y)).abs().max() < 1e-6


def test_many_references_are_taken_in_blocks(monkeypatch):
    generated, references = randn(0, 3, 7, 3), randn(1, 5, 9, 3)
    whole = chamfer_table(generated, references)
    monkeypatch.setattr("dsn_lite.coverage.BLOCK", 2 * 7 * 9)
    near(chamfer_table(generated, references), whole)


def test_each_reference_waits_for_the_nearest_generated_shape():
    table = torch.tensor([[1.0, 8.0, 3.0], [2.0, 7.0, 4.0]])
    assert mmd_cd(table) == pytest.approx((1 + 7 + 3) / 3)


def test_a_reference_is_covered_where_it_is_the_nearest_of_some_generated_shape():
    assert coverage_cd(torch.tensor([[1.0, 8.0, 3.0], [2.0, 7.0, 4.0]])) == pytest.approx(1 / 3)
    assert coverage_cd(torch.tensor([[1.0, 8.0, 3.0], [2.0, 0.5, 4.0]])) == pytest.approx(2 / 3)


def test_the_references_themselves_match_and_cover_perfectly():
    shapes = randn(0, 6, 20, 3)
    table = chamfer_table(shapes, shapes)
    assert mmd_cd(table) < 1e-12
    assert coverage_cd(table) == 1


def test_what_is_no_batch_of_clouds_is_refused():
    with pytest.raises(
        ValueError, match=r"chamfer_table: shapes must be \(G, n, 3\) and \(R, p, 3\), got .*; stack them"
    ):
        unchecked(chamfer_table)(randn(0, 5, 3), randn(1, 2, 5, 3))
