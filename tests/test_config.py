import json
from dataclasses import asdict, replace

import pytest
import torch
from worlds import randn

from dsn_lite.config import Config, network
from dsn_lite.data import Shapes


def test_it_survives_as_json():
    config = Config(k=5, steps=7, features=(8, 16, 32), columns="unit")
    assert Config.from_json(json.loads(json.dumps(asdict(config)))) == config


@pytest.mark.parametrize("name", ["k", "batch", "learning_rate", "seconds", "steps"])
@pytest.mark.parametrize("value", [0, -1])
def test_it_refuses_what_is_not_positive(name, value):
    value = float(value) if name in ("learning_rate", "seconds") else value
    with pytest.raises(ValueError, match=rf"Config: {name} must be more than 0, got {value}; leave it out"):
        Config(**{name: value})


def test_it_refuses_a_learning_rate_that_is_no_number():
    with pytest.raises(ValueError, match=r"Config: learning_rate must be more than 0, got nan"):
        Config(learning_rate=float("nan"))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"batch": 1}, "Config: batch must be at least 2, since a batch is paired within itself, got 1"),
        ({"columns": "max"}, 'Config: columns must be "rms" or "unit", got \'max\'; keep "rms"'),
        ({"features": (8,)}, "Config: features needs at least two widths and head one"),
        ({"head": ()}, "Config: features needs at least two widths and head one"),
    ],
)
def test_it_refuses_what_no_network_can_be_made_of(change, words):
    with pytest.raises(ValueError, match=words):
        Config(**change)


def test_steps_take_the_place_of_seconds():
    assert Config(steps=5, seconds=-1.0).steps == 5


@pytest.mark.parametrize(
    ("N", "k", "words"),
    [
        (20, 13, r"train: k must be at most 3n = 12 for shapes of 4 points, got 13; lower k"),
        (7, 12, "train: at least 8 shapes are needed to train and to hold some out, got 7; bring more shapes"),
    ],
)
def test_it_refuses_shapes_that_cannot_be_trained_on(N, k, words):
    with pytest.raises(ValueError, match=words):
        Config(k=k).check(Shapes(points=torch.zeros(N, 4, 3)))
    Config(k=12).check(Shapes(points=torch.zeros(20, 4, 3)))


def test_the_network_is_that_of_the_configuration_and_its_seed():
    config = Config(k=5, features=(8, 16, 32), head=(12,), columns="unit")
    space, x = network(config), randn(0, 2, 6, 3, dtype=torch.float32)
    assert space.encode(x).shape == (2, 5)
    assert space.dictionary(x).square().sum((-3, -2)).allclose(torch.ones(2, 5))
    assert torch.equal(network(config).encode(x), space.encode(x))
    assert not torch.equal(network(replace(config, seed=1)).encode(x), space.encode(x))


def test_a_device_that_is_not_there():
    shapes = Shapes(points=torch.zeros(10, 8, 3))
    with pytest.raises(ValueError, match=r"device: must be one that torch can use here, got 'abacus'; use \"cpu\""):
        Config(k=2, device="abacus").check(shapes)


def test_points_that_were_never_brought_to_a_scale():
    shapes = Shapes(points=torch.full((10, 8, 3), 700.0))
    with pytest.raises(ValueError, match=r"train: points .* must not lie beyond 10, got 700; scale all shapes alike"):
        Config(k=2).check(shapes)


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ({"symmetry": -1.0}, r"Config: symmetry must be a weight, 0 or more, got -1"),
        ({"symmetry": float("nan")}, r"Config: symmetry must be a weight, 0 or more, got nan"),
        ({"mirror": "q"}, r"Config: mirror must be \"x\" or \"y\" or \"z\", got 'q'"),
        ({"dense": 1.5}, r"Config: dense must be a share from 0 to 1, got 1.5"),
        ({"waves": 11}, r"Config: waves must be from 0 to 10, got 11"),
        ({"seed": -1}, r"Config: seed must be 0 or more, got -1"),
        ({"points": 0}, r"Config: points must be more than 0, got 0"),
        ({"head": (16, 0)}, r"each 1 or more, got .* and \(16, 0\)"),
    ],
)
def test_what_a_config_refuses(told, words):
    with pytest.raises(ValueError, match=words):
        Config(**told)
