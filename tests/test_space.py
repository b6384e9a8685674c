import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from sklearn.decomposition import PCA
from worlds import (
    FAMILIES,
    K,
    autoencoder,
    deform_sync_net,
    linear_space,
    near,
    randn,
    shapes_of,
    unchecked,
    worlds,
)

from dsn_lite import axioms
from dsn_lite.byhand import translations
from dsn_lite.config import Config, network
from dsn_lite.dictionary import column_rms, coordinates, matrix, offsets
from dsn_lite.networks import DictionaryPredictor, PairEncoder, reset
from dsn_lite.space import ConcatSpace, DeformSyncNet, DoNothing, LinearSpace


def test_the_smallest_space_by_hand():
    """E = centroid and F = identity: xy is where the middle of y is from that of x, and the action is translation."""
    space = translations()
    x = torch.tensor([[0.0, 0, 0], [2, 0, 0]])
    y = torch.tensor([[5.0, 1, 0], [5, 3, 0], [5, 2, 6]])  # three points: no correspondence is needed
    z = torch.tensor([[9.0, 9, 9]])
    assert space.vector(x, y).tolist() == [4, 2, 2]
    assert space.vector(y, x).tolist() == [-4, -2, -2]
    assert space.act(x, torch.tensor([1.0, 2, 3])).tolist() == [[1, 2, 3], [3, 2, 3]]
    assert space.deform(x, y).tolist() == [[4, 2, 2], [6, 2, 2]]
    assert space.transfer(x, y, z).tolist() == [[13, 11, 11]]


@given(world=worlds())
def test_deform_sync_net_is_equations_2_and_3(world):
    x, y, z, _, v = world
    space = deform_sync_net()
    near(space.act(x, v), x + offsets(space.dictionary(x), v), scale=x.abs().max())
    assert torch.equal(space.vector(x, y), space.encode(y) - space.encode(x))
    assert torch.equal(space.deform(x, y), space.act(x, space.vector(x, y)))
    assert torch.equal(space.transfer(x, y, z), space.act(z, space.vector(x, y)))


def test_the_vector_does_not_need_as_many_points():
    space = deform_sync_net()
    assert space.deform(randn(0, 2, 5, 3), randn(1, 2, 9, 3)).shape == (2, 5, 3)


def test_gradients_reach_encoder_and_dictionary():
    space, x = deform_sync_net(), randn(0, 2, 5, 3)
    space.deform(x, x.flip(0)).square().sum().backward()
    assert all(parameter.grad.abs().sum() > 0 for name, parameter in space.named_parameters() if "weight" in name)


@given(st.integers(0, 99), st.integers(1, 4))
def test_linear_space_is_scikit_learns_pca(seed, k):
    points = randn(seed, 9, 6, 3)
    oracle = PCA(k).fit(points.flatten(1).numpy())
    space = LinearSpace.fit(points, k)
    axes = matrix(space.A).numpy().T / np.sqrt(6)  # columns have unit rms over 6 points
    signs = np.sign((axes * oracle.components_).sum(1, keepdims=True))
    np.testing.assert_allclose(axes * signs, oracle.components_, atol=1e-9)
    rebuilt = oracle.inverse_transform(oracle.transform(points.flatten(1).numpy()))
    mean = points.mean(0).expand_as(points)
    np.testing.assert_allclose(space.deform(mean, points).flatten(1), rebuilt, atol=1e-9)


def test_linear_vectors_are_least_squares():
    space, x, y = linear_space(), randn(1, 4, 7, 3), randn(2, 4, 7, 3)
    near(space.vector(x, y), coordinates(space.dictionary(x), y - x))
    near(space.dictionary(x)[2], space.A)


@pytest.mark.parametrize("family", FAMILIES)
def test_principal_axes_have_unit_rms_whatever_n_is(family):
    points = shapes_of(family, 30, 128, sampling="shared", dtype="float64").points
    near(column_rms(LinearSpace.fit(points, 3).A), torch.ones(3).double())


def test_more_axes_than_the_shapes_have_do_no_harm():
    """The axes beyond the rank of the data are orthonormal too: they do not blow up, and no shape needs them."""
    points = shapes_of("box/one", 20, 64, sampling="shared", dtype="float64").points
    enough, more = LinearSpace.fit(points, 3), LinearSpace.fit(points, 20)
    x, y = points[:10], points[10:]
    near(more.deform(x, y), enough.deform(x, y))
    near(more.deform(x, y), y)
    near(more.vector(x, y)[:, 3:], torch.zeros(10, 17).double())


def test_shuffled_points_are_not_linear():
    shapes = shapes_of("box/one", 20, 64, sampling="shared", dtype="float64").points
    rng = np.random.default_rng(0)
    shuffled = torch.stack([cloud[rng.permutation(64)] for cloud in shapes])
    space = LinearSpace.fit(shuffled, 3)
    assert (space.deform(shuffled[:10], shuffled[10:]) - shuffled[10:]).abs().max() > 0.1


def test_an_autoencoder_redraws_the_shape():
    space, x, v = autoencoder(), randn(0, 2, 7, 3), randn(1, 2, K)
    assert torch.equal(space.act(x, v), space.decode(space.encode(x) + v))
    y = randn(2, 2, 7, 3)
    assert torch.equal(space.vector(x, y), space.encode(y) - space.encode(x))
    near(space.deform(x, y), space.decode(space.encode(y)))
    assert not torch.allclose(space.act(x, 0 * v), x)


def test_doing_nothing_does_nothing():
    space, x, y = DoNothing(), randn(0, 2, 7, 3), randn(1, 2, 5, 3)
    assert torch.equal(space.deform(x, y), x)
    assert space.vector(x, y).dtype == x.dtype


@pytest.mark.parametrize("make", [deform_sync_net, linear_space, autoencoder])
def test_untrained_is_the_same_space_with_other_numbers(make):
    space, x, y = make(), randn(0, 2, 7, 3), randn(1, 2, 7, 3)
    before = space.deform(x, y)
    fresh = space.untrained(7)
    assert [tensor.shape for tensor in fresh.state_dict().values()] == [t.shape for t in space.state_dict().values()]
    assert not torch.allclose(fresh.deform(x, y), before)
    assert torch.equal(fresh.deform(x, y), space.untrained(7).deform(x, y))
    assert torch.equal(space.deform(x, y), before)


def test_the_untrained_linear_space_has_columns_of_unit_rms():
    near(column_rms(linear_space().untrained().A), torch.ones(K).double())


@pytest.mark.parametrize("shape", [(5, 3), (4, 5, 2)])
def test_fit_refuses_what_is_not_a_stack_of_clouds(shape):
    with pytest.raises(ValueError, match=r"LinearSpace\.fit: points must be \(N, n, 3\), got .*; stack the shapes"):
        unchecked(LinearSpace.fit.__func__)(LinearSpace, torch.zeros(shape), 1)


@pytest.mark.parametrize("k", [0, 5, 7])
def test_fit_refuses_more_axes_than_there_can_be(k):
    with pytest.raises(ValueError, match=rf"k must be between 1 and the smaller of N = 4 and 3n = 6, got {k}; lower k"):
        LinearSpace.fit(randn(0, 4, 2, 3), k)


# the public doors

CLOUD = torch.rand(9, 3, generator=torch.Generator().manual_seed(0))
NAN = CLOUD.clone().index_fill_(0, torch.tensor([4]), float("nan"))


@pytest.mark.parametrize(
    ("wrong", "error", "words"),
    [
        (CLOUD.mT, ValueError, r"must be \(\.\.\., n, 3\) points with n > 0, got \(3, 9\); transpose with \.mT"),
        (CLOUD[:0], ValueError, r"must be \(\.\.\., n, 3\) points with n > 0, got \(0, 3\)"),
        (NAN, ValueError, r"must be finite, got NaN or infinity; clean the points first"),
        (CLOUD.double(), ValueError, r"must be torch.float32 as the weights, got torch.float64"),
        (CLOUD.numpy(), TypeError, r"must be a tensor, got ndarray; use torch.as_tensor"),
    ],
)
def test_clouds_that_are_none_are_refused_at_every_door(wrong, error, words):
    space = network(Config(k=3))
    doors = {
        "deform: y": lambda: unchecked(DeformSyncNet.deform)(space, CLOUD, wrong),
        "transfer: z": lambda: unchecked(DeformSyncNet.transfer)(space, CLOUD, CLOUD, wrong),
        "vector: x": lambda: unchecked(DeformSyncNet.vector)(space, wrong, CLOUD),
        "act: x": lambda: unchecked(DeformSyncNet.act)(space, wrong, torch.zeros(3)),
    }
    for door, enter in doors.items():
        with pytest.raises(error, match=f"{door} {words}"):
            enter()


def test_a_vector_of_another_space_is_refused():
    with pytest.raises(ValueError, match=r"act: v must have the k = 3 numbers of this space, got 4; see vector"):
        network(Config(k=3)).act(CLOUD, torch.zeros(4))


def test_a_linear_space_refuses_points_that_do_not_correspond():
    space = LinearSpace.fit(torch.rand(5, 9, 3), 2)
    with pytest.raises(ValueError, match=r"act: x must have the 9 corresponding points of this LinearSpace, got 8"):
        space.act(CLOUD[:8], torch.zeros(2))


# the Concat ablation


def concat_space(seed=0):
    encoder, predictor = PairEncoder(K, (8, 16), (8,)), DictionaryPredictor(K, (8,), (16,), (16,))
    return reset(ConcatSpace(encoder, predictor), seed).double()


def test_concat_keeps_the_identity_of_nothing_and_breaks_the_laws_of_vectors():
    space, (x, y, z) = concat_space(), randn(0, 3, 2, 9, 3)
    assert axioms.zero_acts_trivially(space, x) == 0
    for residual in (
        axioms.self_vector_is_zero(space, x),
        axioms.reversal_negates(space, x, y),
        axioms.triangle_closes(space, x, y, z),
    ):
        assert residual > 1e-3
    assert space.by_construction == {"zero_acts_trivially"}


def test_concat_reads_each_shape_once_and_joins_what_was_read():
    space, (x, y) = concat_space(), randn(0, 2, 2, 9, 3)
    g = [space.encode.features.points(cloud).amax(-2) for cloud in (x, y)]
    near(space.vector(x, y), space.encode.head(torch.cat(g, dim=-1)))
    near(space.vector(x[0], y), torch.stack([space.vector(x[0], y[0]), space.vector(x[0], y[1])]))
