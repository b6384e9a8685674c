import pytest
import torch

from dsn_lite import axioms, byhand
from dsn_lite.data import triplets


@pytest.fixture(scope="module")
def triangles():
    return byhand.copies(12)


def test_translation_keeps_all_seven_laws(triangles):
    found = axioms.residuals(byhand.translations(), *triplets(triangles, 32))
    assert list(found) == list(axioms.LAWS)
    assert max(found.values()) < 1e-12


def test_translation_is_what_one_computes_by_hand():
    x = torch.tensor([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    y, space = x + torch.tensor([2.0, -1.0, 0.5]), byhand.translations()
    assert torch.allclose(space.encode(x), torch.tensor([1 / 3, 1 / 3, 0.0]))
    assert torch.allclose(space.vector(x, y), torch.tensor([2.0, -1.0, 0.5]))
    assert torch.allclose(space.act(x, torch.tensor([0.0, 0.0, 3.0])), x + torch.tensor([0.0, 0.0, 3.0]))
    assert torch.allclose(space.transfer(x, y, 2 * x), 2 * x + torch.tensor([2.0, -1.0, 0.5]))


@pytest.mark.parametrize("law", axioms.LAWS)
def test_each_broken_space_fails_its_law(law, triangles):
    assert axioms.residuals(byhand.BROKEN[law], *triplets(triangles, 32))[law] > 0.05


# what lesson 02 says of them beyond the law they are filed under
KEPT = [
    ("zero_acts_trivially", "actions_add"),
    ("reversal_negates", "self_vector_is_zero"),
    ("triangle_closes", "reversal_negates"),
    ("parallelogram_closes", "target_is_reached"),
]


@pytest.mark.parametrize(("broken", "kept"), KEPT)
def test_a_broken_space_keeps_what_the_lesson_says(broken, kept, triangles):
    assert axioms.residuals(byhand.BROKEN[broken], *triplets(triangles, 32))[kept] < 1e-12


def test_who_breaks_what_has_a_row_a_space_and_a_column_a_law(triangles):
    table = byhand.who_breaks_what({"translation": byhand.translations(), **byhand.BROKEN}, triangles)
    assert table.shape == (8, 7)
    assert table[0].max() < 1e-12
    assert (table[1:].diagonal() > 0.05).all()


def test_the_dictionary_can_be_read_elsewhere():
    x, at = torch.randn(5, 3), torch.randn(2, 3)
    assert byhand.translations().dictionary(x, at=at).shape == (2, 3, 3)
