"""Judges: every right answer is accepted, and every usual mistake has its sentence."""

import pytest
import torch

from dsn_lite import chamfer, judges


def plain(a, b, c, u, v):
    return (1 - u - v) * a + u * b + v * c


def folded(a, b, c, u, v):
    beyond = u + v > 1
    return plain(a, b, c, torch.where(beyond, 1 - u, u), torch.where(beyond, 1 - v, v))


def by_root(a, b, c, u, v):
    return (1 - u.sqrt()) * a + u.sqrt() * ((1 - v) * b + v * c)


@pytest.mark.parametrize("right", [folded, by_root, lambda *given: folded(*(each.float() for each in given))])
def test_every_even_sampler_is_accepted(right):
    assert judges.triangle_sampler(right) == []


WRONG = {
    "50% of its points lie outside the triangle, where u + v > 1": plain,
    "crowd at the corner a: 4.0 times": lambda a, b, c, u, v: (1 - u) * a + u * ((1 - v) * b + v * c),
    "crowd at the corner c": lambda a, b, c, u, v: (1 - u.sqrt()) * c + u.sqrt() * ((1 - v**3) * c + v**3 * a),
    "crowd in its middle": lambda a, b, c, u, v: (a + u * b + v * c) / (1 + u + v),
    "leave the plane of the triangle": lambda a, b, c, u, v: u * b + v * c,
    r"for u and v of shape (40000, 1) it must return points (40000, 3), not (40000, 1)": lambda a, b, c, u, v: u,
    "not NoneType": lambda a, b, c, u, v: None,
    "still open": lambda a, b, c, u, v: ...,
}


@pytest.mark.parametrize("words", WRONG)
def test_every_mistake_has_its_sentence(words):
    (said,) = judges.triangle_sampler(WRONG[words])
    assert words in said


def cloud(*places):
    return torch.tensor([[place, 0.0, 0.0] for place in places])


def test_three_clouds_must_break_the_inequality():
    assert judges.triangle_inequality(chamfer, cloud(0), cloud(1), cloud(2)) == []
    assert judges.triangle_inequality(chamfer, cloud(0), cloud(0, 1), cloud(1)) == []
    (said,) = judges.triangle_inequality(chamfer, cloud(0), cloud(2), cloud(1))
    assert said == "from x to z it is 2, by way of y 8 + 2, which is no shorter; bring y nearer to both"
    assert judges.triangle_inequality(lambda x, y: (x - y).norm(), cloud(0), cloud(1), cloud(2))
