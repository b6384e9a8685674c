import pytest
import torch
from hypothesis import given
from torch import nn
from worlds import TOL, K, autoencoder, deform_sync_net, linear_space, randn, worlds

from dsn_lite import axioms, byhand
from dsn_lite.data import triplets
from dsn_lite.space import ActionSpace, DeformSyncNet, DoNothing, LinearSpace

SPACES = {"deform_sync_net": deform_sync_net, "linear": linear_space, "autoencoder": autoencoder, "nothing": DoNothing}
CLAIMS = [(name, law) for name, make in SPACES.items() for law in axioms.LAWS if law in make().by_construction]
modes = pytest.mark.parametrize("mode", ["train", "eval"])


def residual(space, law, world):
    """One law on given shapes and vectors, as if they corresponded."""
    x, y, z, u, v = world
    if law == "zero_acts_trivially" or law == "self_vector_is_zero":
        return getattr(axioms, law)(space, x)
    if law == "actions_add":
        return axioms.actions_add(space, x, u, v)
    if law == "target_is_reached":
        return axioms.target_is_reached(space, x, y, corresponds=True)
    if law == "reversal_negates":
        return axioms.reversal_negates(space, x, y)
    if law == "triangle_closes":
        return axioms.triangle_closes(space, x, y, z)
    return axioms.parallelogram_closes(space, x, y, z, corresponds=True)


def of_size(space, world):
    """The world with as many points as a space that has its own n works on."""
    n = {LinearSpace: 7}.get(type(space), world[0].shape[-2])
    x, y, z, u, v = world
    return *(cloud.repeat(1, n, 1)[:, :n] for cloud in (x, y, z)), u, v


@modes
@pytest.mark.parametrize(("name", "law"), CLAIMS)
@given(world=worlds())
def test_a_law_that_holds_by_construction_holds_for_any_weights(name, law, mode, world):
    space = SPACES[name]() if name != "autoencoder" else autoencoder(n=world[0].shape[-2])
    world = of_size(space.train(mode == "train"), world)
    scale = max(1.0, *(float(part.abs().max()) for part in world))
    assert residual(space, law, world) < TOL[torch.float64] * scale


@modes
@pytest.mark.parametrize("name", SPACES)
@given(world=worlds())
def test_self_vector_and_reversal_hold_bitwise(name, mode, world):
    space = SPACES[name]().train(mode == "train")
    x, y, *_ = of_size(space, world)
    assert torch.equal(space.vector(x, x), torch.zeros_like(space.vector(x, x)))
    assert torch.equal(space.vector(x, y), -space.vector(y, x))


@given(world=worlds())
def test_the_triangle_closes_within_a_few_roundings(world):
    space, (x, y, z, *_) = deform_sync_net(), world
    left = space.vector(x, y) + space.vector(y, z) + space.vector(z, x)
    size = max(space.encode(shape).abs().max() for shape in (x, y, z))
    assert left.abs().max() <= 4 * torch.finfo(torch.float64).eps * size


@given(world=worlds())
def test_a_linear_space_keeps_all_laws_on_shapes_it_can_make(world):
    space, (x, *_, u, v) = linear_space(), of_size(linear_space(), world)
    world = x, space.act(x, u), space.act(x, v), u, v
    for law in axioms.LAWS:
        assert residual(space, law, world) < TOL[torch.float64] * max(1.0, float(x.abs().max()))


# teeth: each law must be failed by a space that breaks it


@pytest.mark.parametrize("law", axioms.LAWS)
def test_a_law_is_failed_by_its_broken_space_and_kept_by_translations(law):
    drawn = triplets(byhand.copies(), 32)
    assert axioms.residuals(byhand.BROKEN[law], *drawn)[law] > 1e-2
    assert axioms.residuals(byhand.translations(), *drawn)[law] < TOL[torch.float64]


class Concat(ActionSpace):
    """xy from a layer on [E(x); E(y)] instead of E(y) - E(x)."""

    def __init__(self):
        super().__init__()
        self.inner, self.mix = deform_sync_net(), nn.Linear(2 * K, K).double()

    def act(self, x, v):
        return self.inner.act(x, v)

    def vector(self, x, y):
        return self.mix(torch.cat([self.inner.encode(x), self.inner.encode(y)], dim=-1))


class Shifted(Concat):
    """x (+) v = A v + x and a little to the side."""

    def act(self, x, v):
        return self.inner.act(x, v) + 0.1

    def vector(self, x, y):
        return self.inner.vector(x, y)


def with_dropout():
    """E with dropout, as in the authors' code."""
    space = deform_sync_net()
    return DeformSyncNet(nn.Sequential(space.encode, nn.Dropout(0.3)), space.dictionary)


@pytest.mark.parametrize(
    ("make", "law"),
    [
        (Concat, "self_vector_is_zero"),
        (Concat, "reversal_negates"),
        (Concat, "triangle_closes"),
        (Shifted, "zero_acts_trivially"),
        (Shifted, "actions_add"),
        (with_dropout, "self_vector_is_zero"),
        (with_dropout, "reversal_negates"),
        (with_dropout, "triangle_closes"),
        (deform_sync_net, "actions_add"),
        (deform_sync_net, "target_is_reached"),
        (deform_sync_net, "parallelogram_closes"),
        (autoencoder, "zero_acts_trivially"),
        (DoNothing, "parallelogram_closes"),
    ],
)
def test_a_law_sees_what_breaks_it(make, law):
    torch.manual_seed(0)
    world = *randn(0, 3, 2, 7, 3), *randn(1, 2, 2, K)
    assert residual(make().train(), law, world) > 1e-3


def test_dropout_is_seen_only_while_training():
    world = *randn(0, 3, 2, 7, 3), *randn(1, 2, 2, K)
    assert residual(with_dropout().eval(), "self_vector_is_zero", world) == 0
