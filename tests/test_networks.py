import pytest
import torch
from hypothesis import given
from torch import nn
from worlds import K, deform_sync_net, near, randn, worlds

from dsn_lite.dictionary import column_rms, matrix
from dsn_lite.networks import DictionaryPredictor, Encoder, Waves, perceptron, reset

net = deform_sync_net()
modes = pytest.mark.parametrize("mode", ["train", "eval"])


@modes
@given(world=worlds())
def test_encoder_ignores_the_order_of_points_and_repeated_points(world, mode):
    x, encode = world[0], net.encode.train(mode == "train")
    near(encode(x.flip(-2)), encode(x))
    near(encode(torch.cat([x, x[:, :1], x], dim=-2)), encode(x))


@modes
@given(world=worlds())
def test_dictionary_follows_the_order_of_points(world, mode):
    x, F = world[0], net.dictionary.train(mode == "train")
    near(F(x.flip(-2)), F(x).flip(-3))


@modes
@given(world=worlds())
def test_a_shape_does_not_feel_what_else_is_in_its_batch(world, mode):
    x, y = world[:2]
    space = net.train(mode == "train")
    near(space.encode(torch.cat([x, y]))[: len(x)], space.encode(x))
    near(space.dictionary(torch.cat([x, y]))[: len(x)], space.dictionary(x))


@given(world=worlds())
def test_columns_have_unit_rms_or_unit_length(world):
    x = world[0]
    one = torch.ones(len(x), K).double()
    near(column_rms(net.dictionary(x)), one)
    near(torch.linalg.vector_norm(matrix(deform_sync_net(columns="unit").dictionary(x)), dim=-2), one)


def test_every_row_feels_a_far_point():
    x = randn(0, 1, 20, 3)
    far = x.clone()
    far[:, 7] = 50.0
    moved = (net.dictionary(far) - net.dictionary(x)).abs().amax((-1, -2))
    assert (moved > 1e-3).all()


@given(world=worlds())
def test_at_a_subset_the_rows_are_the_same(world):
    x = world[0]
    near(net.dictionary(x, at=x[:, 1:]), net.dictionary(x)[:, 1:])


def test_at_takes_features_and_scales_from_x_and_not_from_the_points():
    x, at = randn(0, 1, 20, 3), randn(1, 1, 5, 3)
    together = net.dictionary(x, at=at)
    assert torch.allclose(net.dictionary(x, at=at[:, :1]), together[:, :1])
    assert not torch.allclose(net.dictionary(at), together)


def test_the_split_product_is_that_of_the_repeated_feature():
    """W_g g + W_p p against W [g; p] with g repeated over the points, in value and gradient."""
    F, x = DictionaryPredictor(K, (8,), (16,), (16,)).double(), randn(0, 2, 6, 3)

    def slow():
        here = F.local(x)
        g = F.features.points(here).amax(-2, keepdim=True).expand(-1, 6, -1)
        W = torch.cat([F.from_global.weight, F.from_local.weight], dim=1)
        A = F.head(torch.cat([g, here], dim=-1) @ W.mT + F.from_local.bias).unflatten(-1, (3, K))
        return A / A.square().sum(-2).mean(-2).sqrt()[..., None, None, :]

    near(F(x), slow())
    weight = randn(1, 2, 6, 3, K)
    fast, twin = (torch.autograd.grad((A * weight).sum(), list(F.parameters())) for A in (F(x), slow()))
    for one, other in zip(fast, twin, strict=True):
        near(one, other, scale=other.abs().max())


def test_waves_are_sines_and_cosines_of_the_places_written_out():
    x = randn(0, 2, 5, 3)
    found = Waves(2).double()(x)
    expected = [x]
    for turned in (torch.sin, torch.cos):
        expected += [torch.stack([turned(2**j * torch.pi * x[..., axis]) for j in (0, 1)], -1) for axis in range(3)]
    near(found, torch.cat(expected, -1))
    assert Waves(0)(x) is x


def test_a_dictionary_with_waves_reads_places_elsewhere_by_them_too():
    F, x = DictionaryPredictor(K, (8,), (16,), (16,), waves=3).double(), randn(0, 1, 9, 3)
    near(F(x, at=x[:, 2:4]), F(x)[:, 2:4])
    assert F.local[0][0].weight.shape == (8, 3 + 18)


def test_with_waves_a_dictionary_bends_at_a_thin_part_where_without_it_cannot():
    """A sawtooth over a leg of width 0.05, as its width makes it: the same steps, and a third of the error."""
    x = torch.rand(4, 256, 3, generator=torch.Generator().manual_seed(0)) - 0.5
    wanted = ((x[..., 0] + 0.5) % 0.25 - 0.125) * 8
    errors = []
    for count in (0, 4):
        F = reset(DictionaryPredictor(1, (16,), (16,), (32,), waves=count), 0)
        adam = torch.optim.Adam(F.parameters(), lr=1e-2)
        for _ in range(300):
            adam.zero_grad()
            loss = (F.unscaled(x)[0][..., 0, 0] - wanted).square().mean()
            loss.backward()
            adam.step()
        errors.append(loss.item())
    assert errors[1] < errors[0] / 3


def test_a_zero_column_gives_no_nan_in_value_or_gradient():
    F = DictionaryPredictor(K, (8,), (16,), (16,)).double()
    with torch.no_grad():
        for parameter in F.head[1][-1].parameters():
            parameter[1::K] = 0  # column 1 of every row
    A = F(randn(0, 2, 6, 3))
    A.square().sum().backward()
    assert (A[..., 1] == 0).all()
    assert all(parameter.grad.isfinite().all() for parameter in F.parameters())


def test_batch_norm_would_feel_what_else_is_in_the_batch():
    """Teeth of the law above: the axioms do not see batch norm, since xx stays 0."""
    x, y = randn(0, 2, 2, 6, 3)
    encode = nn.Sequential(net.encode, nn.BatchNorm1d(K).double()).train()
    assert torch.equal(encode(x) - encode(x), torch.zeros(2, K).double())
    assert (encode(torch.cat([x, 2 * y]))[:2] - encode(x)).abs().max() > 1e-2


def test_nothing_in_the_networks_differs_between_training_and_use():
    kinds = {type(layer).__name__ for layer in net.modules()}
    assert not [kind for kind in kinds if "Dropout" in kind or "Norm" in kind]


def test_perceptron_ends_with_a_linear_layer():
    layers = perceptron((3, 5, 2))
    assert [type(layer).__name__ for layer in layers] == ["Linear", "LeakyReLU", "Linear"]


def test_reset_draws_from_its_seed_and_leaves_the_global_generator_alone():
    encoders = [Encoder(K, (8, 16), (8,)) for _ in range(3)]
    torch.manual_seed(5)
    expected = torch.rand(3)
    torch.manual_seed(5)
    weights = [reset(encoder, seed).head[-1].weight for encoder, seed in zip(encoders, (1, 1, 2), strict=True)]
    assert torch.equal(torch.rand(3), expected)
    assert torch.equal(weights[0], weights[1])
    assert not torch.equal(weights[0], weights[2])


def test_a_trained_encoder_can_be_differentiated_by_torch_func():
    """In eval mode, as spaces are returned; in training the pooled layer is one fused step of the same values."""
    E, x = reset(Encoder(K, (8, 16), (8,)), 0).double(), randn(0, 9, 3)
    fused = E(x)
    E.eval()
    near(E(x), fused)
    J = torch.func.jacrev(E)(x)
    v = randn(1, 9, 3)
    near((J * v).sum((-2, -1)), (E(x + 1e-7 * v) - E(x - 1e-7 * v)) / 2e-7, scale=1e3)
