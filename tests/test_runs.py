import json
from dataclasses import replace

import pytest
import torch
from safetensors.torch import load_file, save_file
from worlds import randn, shapes_of

from dsn_lite.config import Config, network
from dsn_lite.data import Frame, Shapes
from dsn_lite.driving import train
from dsn_lite.files import beside
from dsn_lite.runs import fingerprint, load_run, read_fingerprint, same_shapes, save_run, save_tensors

CONFIG = Config(k=3, features=(8, 16, 32), head=(12,), steps=1)


def written(run, config=CONFIG):
    """A run folder of an untrained space, and the space."""
    space = network(config, Frame.of(shapes_of()))
    save_run(space, config, run, shapes_of().points[:2])
    return space


def test_what_is_saved_is_loaded(tmp_path):
    space, x = written(tmp_path / "run"), randn(0, 2, 6, 3, dtype=torch.float32)
    loaded = load_run(tmp_path / "run")
    assert torch.equal(loaded.deform(x, x.flip(0)), space.deform(x, x.flip(0)))
    assert loaded.frame == space.frame
    assert not loaded.training
    assert {file.name for file in (tmp_path / "run").iterdir()} == {
        "config.json",
        "model.safetensors",
        "probe.safetensors",
    }


def test_the_files_are_plain_and_hold_no_pickle(tmp_path):
    written(tmp_path)
    about = json.loads((tmp_path / "config.json").read_text(encoding="utf-8"))
    assert about["config"]["k"] == 3
    probe = load_file(tmp_path / "probe.safetensors")
    assert set(probe) == {"x", "y", "deformed"}


def test_what_it_was_trained_on_is_kept_or_unknown(tmp_path):
    written(tmp_path)
    assert read_fingerprint(tmp_path) is None
    shapes = shapes_of()
    train(shapes, replace(CONFIG, batch=2), out=tmp_path / "trained")
    assert read_fingerprint(tmp_path / "trained") == fingerprint(shapes)


@pytest.mark.parametrize("count", [1, 7, 2500])
def test_a_fingerprint_tells_shapes_apart(count):
    points = randn(0, count, 8, 3, dtype=torch.float32)
    moved = points.clone()
    moved[0, 1, 2] += 1
    known = fingerprint(Shapes(points))
    assert same_shapes(known, fingerprint(Shapes(points.double() * (1 + 1e-9))))
    others = [moved, points * (1 + 1e-6), *([points.flip(0), points[1:]] if count > 1 else [])]
    assert not any(same_shapes(known, fingerprint(Shapes(other))) for other in others)


def test_a_fingerprint_is_the_slow_sum():
    points = randn(0, 2500, 4, 3)
    looked_at = points[::3]
    slow = sum(i * (x**2).mean().item() for i, x in enumerate(looked_at, start=1)) / len(looked_at)
    assert same_shapes(fingerprint(Shapes(points)), slow)


@pytest.mark.parametrize("name", ["config.json", "model.safetensors", "probe.safetensors"])
def test_a_missing_file(name, tmp_path):
    written(tmp_path)
    (tmp_path / name).unlink()
    with pytest.raises(FileNotFoundError, match=rf"load_run: .* must hold {name}, it does not; is it a run folder?"):
        load_run(tmp_path)


def test_no_folder_at_all(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"must hold config.json, it does not; is it a run folder?"):
        load_run(tmp_path / "none")


@pytest.mark.parametrize("name", ["model.safetensors", "probe.safetensors"])
@pytest.mark.parametrize("share", [0.0, 0.1, 0.9])
def test_a_truncated_file(name, share, tmp_path):
    written(tmp_path)
    whole = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(ValueError, match=rf"load_run: .*{name} must be a whole safetensors file \(.*\); copy the run"):
        load_run(tmp_path)


@pytest.mark.parametrize(
    "content",
    [
        "",
        '{"config": {"k": 3',
        "[1, 2]",
        '{"name": "a package"}',
        '{"config": {"k": 3}, "frame": null}',
        '{"config": {"k": 3}, "frame": {}}',
        '{"config": [3], "frame": {}}',
        '{"config": {"k": -3}, "frame": {}}',
        '{"config": {"k": 3}, "frame": {"n": 4, "size": 1, "share": [0], "anchor": [0]}, "fingerprint": "none"}',
    ],
)
def test_the_config_of_something_else(content, tmp_path):
    written(tmp_path)
    (tmp_path / "config.json").write_text(content, encoding="utf-8")
    with pytest.raises(ValueError, match=r"load_run: .*config\.json must be the config of a run \(.*\); copy the run"):
        load_run(tmp_path)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"k": 5}, r"model\.safetensors has k = 5, config\.json says 3; files of two runs are mixed"),
        ({"head": (10,)}, r"dictionary\.\S+ is \(10.* instead of \(12.*; files of two runs are mixed"),
        ({"head": (12, 7)}, r"dictionary\.\S+ is .* instead of .*; files of two runs are mixed"),
    ],
)
def test_weights_of_another_run(change, words, tmp_path):
    written(tmp_path / "one")
    written(tmp_path / "other", replace(CONFIG, **change))
    (tmp_path / "other" / "model.safetensors").replace(tmp_path / "one" / "model.safetensors")
    with pytest.raises(ValueError, match=rf"load_run: .*{words}"):
        load_run(tmp_path / "one")


def test_weights_of_another_seed_do_not_give_the_probe_again(tmp_path):
    written(tmp_path / "one")
    written(tmp_path / "other", replace(CONFIG, seed=1))
    (tmp_path / "other" / "model.safetensors").replace(tmp_path / "one" / "model.safetensors")
    with pytest.raises(
        ValueError, match=r"must give its probe again within 0.0001, it is off by .*changed after training"
    ):
        load_run(tmp_path / "one")


@pytest.mark.parametrize("change", [1e-3, float("nan")])
def test_a_changed_probe(change, tmp_path):
    written(tmp_path)
    probe = load_file(tmp_path / "probe.safetensors")
    probe["deformed"][3, 1] += change
    save_file(probe, tmp_path / "probe.safetensors")
    with pytest.raises(ValueError, match=r"must give its probe again within 0.0001, it is off by"):
        load_run(tmp_path)


def test_a_probe_of_something_else(tmp_path):
    written(tmp_path)
    save_file({"x": torch.zeros(4, 3)}, tmp_path / "probe.safetensors")
    with pytest.raises(ValueError, match=r"probe\.safetensors must hold x, y and deformed, clouds .*, got x; take"):
        load_run(tmp_path)


def test_a_probe_of_another_layout_or_precision(tmp_path):
    written(tmp_path)
    probe = load_file(tmp_path / "probe.safetensors")
    for change in (lambda cloud: cloud.double(), lambda cloud: cloud.mT.contiguous()):
        save_file({name: change(cloud) for name, cloud in probe.items()}, tmp_path / "probe.safetensors")
        with pytest.raises(ValueError, match=r"must hold x, y and deformed, clouds \(n, 3\) in float32"):
            load_run(tmp_path)


def test_a_run_of_the_zoo_can_be_read_by_others(tmp_path):
    written(tmp_path)
    beside = tmp_path / "beside"
    beside.write_bytes(b"")
    assert (tmp_path / "model.safetensors").stat().st_mode == beside.stat().st_mode


def test_a_crash_while_writing_leaves_the_old_file_and_nothing_beside_it(tmp_path):
    path = tmp_path / "history.jsonl"
    path.write_text("old", encoding="utf-8")

    def crash(part):
        part.write_text("half", encoding="utf-8")
        raise OSError("disk full")

    with pytest.raises(OSError, match=r"disk full"):
        beside(path, crash)
    assert path.read_text(encoding="utf-8") == "old"
    assert [file.name for file in tmp_path.iterdir()] == ["history.jsonl"]


def test_tensors_are_written_whole_even_if_they_are_views(tmp_path):
    part = torch.arange(12.0).reshape(3, 4).mT[1:]
    save_tensors({"part": part}, tmp_path / "a.safetensors")
    assert torch.equal(load_file(tmp_path / "a.safetensors")["part"], part)
