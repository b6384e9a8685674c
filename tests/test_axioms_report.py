"""The laws on collections of shapes, and the report that puts them in one table."""

import pytest
import torch
from worlds import FAMILIES, autoencoder, deform_sync_net, randn, shapes_of

from dsn_lite import axioms
from dsn_lite.data import Shapes, triplets
from dsn_lite.files import load_shapes, save_shapes
from dsn_lite.space import DoNothing, LinearSpace

# the laws on shapes


@pytest.mark.parametrize(("family", "k"), FAMILIES.items())
def test_pca_of_corresponding_shapes_keeps_every_law(family, k, tmp_path):
    shapes = shapes_of(family, 60, 128, sampling="shared", dtype="float64")
    report = axioms.report(LinearSpace.fit(shapes.points, k), shapes)
    assert max(row.residual for row in report.rows) < 1e-9
    assert (report.k, report.rank) == (k, k)
    save_shapes(shapes_of(family, 60, 128, sampling="shared"), tmp_path / "stored.npz")
    stored = load_shapes(tmp_path / "stored.npz")
    assert stored.points.dtype == torch.float32
    report = axioms.report(LinearSpace.fit(stored.points, k), stored)
    assert max(row.residual for row in report.rows) < 1e-6


def test_one_axis_too_few_is_seen():
    shapes = shapes_of("table/four_legs", 60, 128, sampling="shared", dtype="float64")
    assert axioms.report(LinearSpace.fit(shapes.points, 5), shapes)["target_is_reached"] > 1e-4


def test_the_target_is_the_true_deformation_where_samples_are_not_shared():
    x, y, z = triplets(shapes_of("box/one", 12, 64, dtype="float64"), 8)

    class Truth(DoNothing):
        def act(self, points, v):
            return x.at_boxes(y.boxes)

    assert axioms.residuals(Truth(), x, y, z)["target_is_reached"] < 1e-12
    assert axioms.residuals(DoNothing(), x, y, z)["target_is_reached"] > 0.05


def test_the_gap_of_shapes_without_correspondence_is_the_rms_to_the_nearest():
    x = torch.zeros(1, 3, 3).double()
    assert axioms.gap(x, x + torch.tensor([3.0, 4, 0]).double(), corresponds=True) == 5
    assert axioms.gap(x, x[:, :2] + torch.tensor([3.0, 4, 0]).double(), corresponds=False) == 5


# the report


def test_the_report_splits_construction_and_learning():
    rows = {row.law: row for row in axioms.report(deform_sync_net(), shapes_of(dtype="float64")).rows}
    assert list(rows) == list(axioms.LAWS)
    learned = [law for law, row in rows.items() if row.kind == "learning"]
    assert learned == ["actions_add", "target_is_reached", "parallelogram_closes"]
    assert all(row.residual < 1e-9 for row in rows.values() if row.kind == "construction")
    assert all(row.do_nothing == 0 for row in rows.values() if row.law not in learned)


def test_the_report_stands_beside_the_untrained_space_and_doing_nothing():
    shapes = shapes_of("box/one", 20, 64, sampling="shared", dtype="float64")
    report = axioms.report(LinearSpace.fit(shapes.points, 3), shapes)
    row = next(row for row in report.rows if row.law == "target_is_reached")
    assert row.residual < 1e-9 < 0.05 < row.untrained
    assert row.do_nothing == report.spread > 0.05


def test_an_autoencoder_is_told_that_its_parallelogram_is_trivial_and_its_identity_law_fails():
    report = axioms.report(autoencoder(64), shapes_of(dtype="float64"))
    assert report["parallelogram_closes"] < 1e-9
    assert report["zero_acts_trivially"] > 1e-2
    assert "trivially closed" in str(report)
    assert "identity law fails" in str(report)
    assert report.k is None


def test_a_dictionary_without_full_rank_is_told():
    A = randn(0, 64, 3, 1).expand(64, 3, 2)
    report = axioms.report(LinearSpace(A), shapes_of(sampling="shared", dtype="float64"))
    assert (report.k, report.rank) == (2, 1)
    assert "vectors are not unique" in str(report)


def test_the_report_is_a_table_as_text_and_as_html():
    report = axioms.report(deform_sync_net(), shapes_of(dtype="float64"))
    text, html = str(report), report._repr_html_()
    for row in report.rows:
        assert f"{row.residual:.2e}" in text
        assert f"{row.residual:.1e}" in html
    assert html.count("<tr>") == 1 + 7


def test_the_report_takes_a_plain_array_and_the_same_seed_gives_the_same():
    points = randn(0, 5, 7, 3).numpy()
    one, again, other = (axioms.report(deform_sync_net(), points, seed=seed) for seed in (0, 0, 1))
    assert one == again != other
    assert "share no samples" in str(one)


def test_the_report_needs_three_shapes():
    with pytest.raises(
        ValueError, match=r"triplets: 64 triplets of different shapes were asked, 0 found among 2 shapes"
    ):
        axioms.report(deform_sync_net(), Shapes(points=randn(0, 2, 7, 3)))
