"""Sweeps: a network for each family, in processes of their own, of which one may fail, be killed or be stopped."""

import io
import json
import os
import re
import shutil
import signal
import sys
import threading
import time
from concurrent.futures import CancelledError
from contextlib import nullcontext, redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import torch
import tyro
from joblib import cpu_count
from worlds import TINY, shapes_of, weights

import data_gen
from dsn_lite import Config, load_run, load_shapes, metrics, train
from dsn_lite.__main__ import main
from dsn_lite.checkpoints import load_history
from dsn_lite.runs import fingerprint
from dsn_lite.sweep import STOP, SUMMARY, child, cluster, sweep, table
from dsn_lite.sweep.child import Outcome
from dsn_lite.sweep.networks import SOURCE, Network, networks, words

SMALL = Config(k=4, batch=4, steps=3, features=(8, 16), head=(8,), seed=2)
FAMILIES = ("box/one", "table/four_legs")


@dataclass
class Swept:
    """A sweep over two families in one file, and a file of too few shapes."""

    files: tuple[Path, Path]
    runs: Path
    code: int
    said: str


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    mixed, few = folder / "mixed.npz", folder / "few.npz"
    data_gen.save(data_gen.generate(FAMILIES, count=80, points=32, seed=0), mixed)
    data_gen.save(data_gen.generate("box/one", count=5, points=32, seed=0), few)
    with redirect_stdout(io.StringIO()) as said:
        told = ["sweep", str(mixed), str(few), "--out", str(folder / "runs"), "--jobs", "2", *words(SMALL)]
        code = main(told)
    return Swept((mixed, few), folder / "runs", code, said.getvalue())


@pytest.fixture
def several(tmp_path):
    """Files of one family each, a.npz, b.npz and c.npz, which nobody reads but for their family."""
    files = [tmp_path / f"{name}.npz" for name in "abc"]
    for file in files:
        data_gen.save(data_gen.generate("box/one", count=8, points=8, seed=0), file)
    return files


def instead(monkeypatch, **codes):
    """Each network runs a line of Python instead, in which `run` is its folder; finished is what holds a file `end`."""

    def command(network, config, *, resume):
        line = codes.get(network.run.name, "(run / 'end').touch()")
        begin = f"import os, pathlib, sys, time; run = pathlib.Path({str(network.run)!r}); run.mkdir(exist_ok=True)"
        return [sys.executable, "-c", f"{begin}; {line}"]

    monkeypatch.setattr(Network, "command", command)
    monkeypatch.setattr(child, "finished", lambda run: (run / "end").exists())


# what a sweep makes


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_gets_the_network_that_train_gives(swept, family):
    space = load_run(swept.runs / family.replace("/", "_"))
    expected = train(load_shapes(swept.files[0]).of_family(family), SMALL)
    torch.testing.assert_close(weights(space), weights(expected), rtol=0, atol=1e-5)


def test_what_fails_is_reported_in_its_own_words(swept):
    sentence = "train: at least 8 shapes are needed to train and to hold some out, got 5; bring more shapes"
    rows = {line.split()[0]: line for line in swept.said.splitlines() if re.search(" (done|failed) ", line)}
    assert swept.code == 1
    assert rows["few"].split(maxsplit=5)[1:] == ["failed", "-", "-", "-", sentence]
    assert f"few failed: {sentence}" in swept.said
    assert rows.keys() == {"box_one", "table_four_legs", "few"}


def test_the_summary_is_what_the_histories_say(swept):
    summary = json.loads((swept.runs / SUMMARY).read_text(encoding="utf-8"))
    assert Config.from_json(summary["config"]) == SMALL
    assert [network["state"] for network in summary["networks"]] == ["done", "done", "failed"]
    for network in summary["networks"][:2]:
        looks = load_history(swept.runs / network["name"])
        assert (network["steps"], network["seconds"]) == (3, looks[-1]["seconds"])
        assert network["validation_cd"] == min(look["validation_cd"] for look in looks)


def test_a_sweep_that_is_repeated_does_only_what_is_left(swept, monkeypatch):
    begun = []

    def noted(network, config, *, resume):
        begun.append(network.run.name)
        return [sys.executable, "-c", "raise SystemExit(3)"]

    monkeypatch.setattr(Network, "command", noted)
    outcomes = sweep(swept.files, swept.runs, SMALL)
    assert [outcome.state for outcome in outcomes] == ["skipped", "skipped", "failed"]
    assert (begun, outcomes[0].steps) == (["few"], 3)
    assert outcomes[2].trouble == "its process ended with code 3 and said nothing"


def test_a_run_of_another_config_is_refused(swept):
    words = r"sweep: .*box_one must hold a run of the same Config, its k is 4 instead of 5; sweep into another folder"
    with pytest.raises(ValueError, match=words):
        sweep(swept.files, swept.runs, replace(SMALL, k=5))


def test_a_family_is_measured_on_what_was_held_out_of_it(swept, capsys):
    run, mixed = swept.runs / "table_four_legs", swept.files[0]
    assert main(["evaluate", str(run), str(mixed), "--family", "table/four_legs", "--pairs", "5"]) == 0
    held_out = load_shapes(mixed).of_family("table/four_legs").split(SMALL.seed)[2]
    expected = metrics.evaluate(load_run(run), held_out, pairs=5)
    assert capsys.readouterr().out == f"{len(held_out)} shapes of {mixed}\n{expected}\n"


def test_a_run_of_shapes_that_are_others_now_is_refused(swept, tmp_path):
    mixed, runs = tmp_path / "mixed.npz", tmp_path / "runs"
    shutil.copytree(swept.runs, runs)
    shutil.copy(swept.files[0], mixed)
    assert [outcome.state for outcome in sweep([mixed], runs, SMALL)] == [
        "skipped",
        "skipped",
    ]  # it only lies elsewhere
    data_gen.save(data_gen.generate(FAMILIES, count=80, points=32, seed=1), mixed)
    words = (
        r"sweep: .*box_one must hold a run of the shapes that .* holds now, it was trained on others \(of .*\); sweep"
    )
    with pytest.raises(ValueError, match=words):
        sweep([mixed], runs, SMALL)
    (runs / "box_one" / SOURCE).write_text("{", encoding="utf-8")
    with pytest.raises(
        ValueError, match=r"sweep: .*source\.json must tell what a run was trained on, it is broken; take"
    ):
        sweep([mixed], runs, SMALL)


def test_a_run_of_which_nothing_tells_its_shapes_is_taken_as_it_is(swept, tmp_path):
    runs = shutil.copytree(swept.runs, tmp_path / "runs")
    for source in runs.glob(f"*/{SOURCE}"):
        told = json.loads(source.read_text(encoding="utf-8"))
        source.write_text(json.dumps({"file": told["file"], "family": told["family"]}), encoding="utf-8")
    assert [outcome.state for outcome in sweep(swept.files[:1], runs, SMALL)] == ["skipped", "skipped"]


def test_shapes_that_nothing_was_trained_on_may_change(several, tmp_path, monkeypatch):
    instead(monkeypatch, a="sys.exit('few')")
    assert sweep(several[:1], tmp_path / "runs", SMALL)[0].state == "failed"
    data_gen.save(data_gen.generate("box/one", count=9, points=8, seed=0), several[0])
    instead(monkeypatch)
    assert sweep(several[:1], tmp_path / "runs", SMALL)[0].state == "done"
    told = json.loads((tmp_path / "runs" / "a" / SOURCE).read_text(encoding="utf-8"))
    assert told == {"file": str(several[0]), "family": None, "fingerprint": fingerprint(load_shapes(several[0]))}


# what goes wrong on the way


def test_a_killed_training_of_another_config_fails_in_its_own_words(swept, tmp_path):
    run = tmp_path / "runs" / "few"
    train(load_shapes(swept.files[0]), SMALL, out=run)
    (run / "config.json").unlink()  # written at the end
    shutil.copy(swept.files[0], tmp_path / "few.npz")
    (outcome,) = sweep([tmp_path / "few.npz"], tmp_path / "runs", replace(SMALL, learning_rate=1e-3), whole=True)
    assert outcome.state == "failed"
    assert re.match(r"train: the checkpoint in .*few must fit this Config, its learning_rate is", outcome.trouble)


def test_a_process_that_cannot_start_fails_alone(several, tmp_path, monkeypatch):
    instead(monkeypatch)
    begin = child.subprocess.Popen

    def scarce(command, **given):
        if "b'" in command[-1]:
            raise OSError(12, "Cannot allocate memory")
        return begin(command, **given)

    monkeypatch.setattr(child.subprocess, "Popen", scarce)
    outcomes = sweep(several, tmp_path / "runs", SMALL)
    assert [outcome.state for outcome in outcomes] == ["done", "failed", "done"]
    assert re.match(r"sweep: its process must start and .* \(.*Cannot allocate memory\); train", outcomes[1].trouble)


def test_half_a_line_of_history_fails_alone(several, tmp_path, monkeypatch):
    instead(monkeypatch, b="""(run / 'history.jsonl').write_text('{"step": 5, "sec'); (run / 'end').touch()""")
    outcomes = sweep(several, tmp_path / "runs", SMALL)
    assert [outcome.state for outcome in outcomes] == ["done", "failed", "done"]
    assert re.match(r"sweep: .*history\.jsonl must be a JSON object a line, it is broken; take", outcomes[1].trouble)


def test_a_killed_process_loses_only_its_own_network(several, tmp_path, monkeypatch):
    instead(monkeypatch, b="os.kill(os.getpid(), 9)")
    outcomes = sweep(several, tmp_path / "runs", SMALL, jobs=2)
    assert [outcome.state for outcome in outcomes] == ["done", "failed", "done"]
    assert re.match("its process (was killed by signal|ended with code) 9", outcomes[1].trouble)


def test_the_last_line_of_a_failure_is_kept(several, tmp_path, monkeypatch):
    instead(monkeypatch, a="sys.exit('one\\ntwo: it must be é')")
    outcomes = sweep(several[:1], tmp_path / "runs", SMALL)
    assert outcomes == [Outcome("a", "failed", trouble="two: it must be é")]


@pytest.mark.parametrize(("jobs", "share"), [(1, 1), (2, 2), (10**6, 10**6)])
def test_each_process_has_its_share_of_the_cores(jobs, share, several, tmp_path, monkeypatch):
    instead(monkeypatch, **dict.fromkeys("abc", "sys.exit(os.environ['OMP_NUM_THREADS'])"))
    outcomes = sweep(several[:2], tmp_path / "runs", SMALL, jobs=jobs)
    assert {outcome.trouble for outcome in outcomes} == {str(max(1, cpu_count() // min(share, 2)))}


def test_a_training_that_was_stopped_is_resumed(several, tmp_path, monkeypatch):
    (tmp_path / "runs" / "a").mkdir(parents=True)
    (tmp_path / "runs" / "a" / "checkpoint.safetensors").touch()
    asked = {}

    def command(network, config, *, resume):
        asked[network.run.name] = resume
        return [sys.executable, "-c", ""]

    monkeypatch.setattr(Network, "command", command)
    outcomes = sweep(several[:2], tmp_path / "runs", SMALL)
    assert asked == {"a": True, "b": False}
    assert {outcome.state for outcome in outcomes} == {"stopped"}  # they ended well, but not at their end


@pytest.mark.skipif(os.name != "posix", reason="a Windows console interrupts its processes itself")
def test_ctrl_c_keeps_the_best_weights_of_what_runs_and_begins_nothing_more(swept, tmp_path):
    runs, before = tmp_path / "runs", signal.getsignal(signal.SIGINT)
    first, second = (runs / family.replace("/", "_") for family in FAMILIES)

    def interrupt():
        for _ in range(600):
            if (first / "history.jsonl").exists():
                break
            time.sleep(0.1)
        if signal.getsignal(signal.SIGINT) is not before:  # else the sweep is over, and it would stop the tests
            os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    outcomes = sweep(swept.files[:1], runs, replace(SMALL, steps=1500), jobs=1)
    thread.join()
    assert [outcome.state for outcome in outcomes] == ["stopped", "stopped"]
    assert 0 < outcomes[0].steps < 1500
    assert load_run(first).dictionary.k == 4
    assert not second.exists()
    assert (runs / SUMMARY).exists()
    assert not (runs / STOP).exists()
    assert signal.getsignal(signal.SIGINT) is before


# which networks, and what they are told


def test_files_of_several_families_are_divided_unless_they_are_whole(swept, several, tmp_path):
    files = [swept.files[0], several[0]]
    assert networks(files, tmp_path) == [
        Network(tmp_path / "box_one", files[0], "box/one"),
        Network(tmp_path / "table_four_legs", files[0], "table/four_legs"),
        Network(tmp_path / "a", files[1]),
    ]
    whole = [Network(tmp_path / "mixed", files[0]), Network(tmp_path / "a", files[1])]
    assert networks(files, tmp_path, whole=True) == whole


def test_a_folder_of_shards_is_a_file(tmp_path):
    data_gen.save_shards(data_gen.generate("box/one", count=8, points=8, seed=0), tmp_path / "some.boxes")
    assert networks([tmp_path / "some.boxes"], tmp_path)[0].run.name == "some.boxes"


def test_the_command_line_says_what_the_config_says():
    config = Config(k=5, steps=7, sparsity=0.25, norm="l1", project=True, features=(8, 16), learning_rate=1e-5)
    assert tyro.cli(Config, args=words(config)) == config
    assert words(Config()) == []


def test_two_networks_of_one_name_are_refused(several, tmp_path):
    other = tmp_path / "other" / "A.npz"
    other.parent.mkdir()
    other.write_bytes(several[0].read_bytes())
    with pytest.raises(
        ValueError, match=r"sweep: each network must have a name of its own, .*a\.npz and .*A\.npz both"
    ):
        sweep([several[0], other], tmp_path / "runs")


def test_no_file_is_refused(tmp_path):
    with pytest.raises(ValueError, match="sweep: there must be a file to train on, got none; make one with"):
        sweep([], tmp_path / "runs")


@pytest.mark.parametrize("jobs", [0, -1])
def test_fewer_than_one_job_is_refused(jobs, several, tmp_path, capsys):
    assert main(["sweep", str(several[0]), "--out", str(tmp_path / "runs"), "--jobs", str(jobs)]) == 2
    sentence = f"sweep: jobs must be 1 or more, got {jobs}; leave it out to train on every core\n"
    assert capsys.readouterr().err == sentence


def test_the_table_has_a_row_for_each():
    said = table([Outcome("a", "done", 30, 1.25, 1.23456e-3), Outcome("long", "failed", trouble="why: so")])
    assert [line.split(maxsplit=5) for line in said.splitlines()[1:]] == [
        ["a", "done", "30", "1.2", "0.001235"],
        ["long", "failed", "-", "-", "-", "why: so"],
    ]


# a family of a mixed file


def mixed_shapes():
    return shapes_of(FAMILIES, 40, 16)


def test_a_family_holds_its_own_shapes_and_no_others():
    shapes = mixed_shapes()
    parts = [shapes.of_family(name) for name in FAMILIES]
    assert shapes.family_names == FAMILIES
    assert [part.family_names for part in parts] == [(name,) for name in FAMILIES]
    assert sum(map(len, parts)) == len(shapes)
    for row, part in enumerate(parts):
        assert torch.equal(part.points, shapes.points[shapes.families == row])
    only = shapes_of("box/one", 8, 16)
    assert only.of_family("box/one") is only


def test_the_split_of_a_file_stays_that_of_its_families():
    shapes = mixed_shapes()
    shapes = replace(
        shapes, about=shapes.about | {"split": {"train": [0, 20], "validation": [20, 30], "test": [30, 40]}}
    )
    for row, name in enumerate(FAMILIES):
        for part, whole in zip(shapes.of_family(name).split(), shapes.split(), strict=True):
            assert torch.equal(part.points, whole.points[whole.families == row])


@pytest.mark.parametrize("name", FAMILIES)
def test_a_family_that_lacks_parts_of_the_others_can_be_trained(name, tmp_path):
    shapes = mixed_shapes().of_family(name)
    assert shapes.boxes.isnan().any()
    config = replace(TINY, steps=2, sparsity=1.0, project=True)
    assert weights(train(shapes, config, out=tmp_path)).isfinite().all()
    assert np.isfinite([look["loss"] for look in load_history(tmp_path)]).all()


def test_a_family_that_is_not_there():
    with pytest.raises(
        ValueError, match=r"of_family: shapes of 'chair' must be among these, they are box/one, table/f"
    ):
        mixed_shapes().of_family("chair")
    with pytest.raises(ValueError, match="of_family: these shapes must tell their families, got none; leave --family"):
        replace(mixed_shapes(), families=None).of_family("chair")


# clusters; one with workers is tried by hand, as CONTRIBUTING.md says


class Client:
    """Stands for a Dask client whose workers see the folder of the runs."""

    sees, threads = True, 2

    def __init__(self, address, timeout):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *trouble):
        pass

    def submit(self, function, *given, pure):
        return self

    def result(self, timeout):
        return self.sees

    def nthreads(self):
        return {"worker": self.threads}


def fail(trouble):
    def raising(*given, **named):
        raise trouble

    return raising


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        ({"__init__": fail(TimeoutError("in vain"))}, "a Dask scheduler must answer at tcp://a:1, none does (in vain)"),
        (
            {"result": fail(TimeoutError())},
            "the scheduler at tcp://a:1 must have workers, none answered; start dask worker",
        ),
        ({"threads": 1}, "the workers of tcp://a:1 must have 2 threads together, they have 1, and joblib would"),
        (
            {"result": fail(RuntimeError("Error during deserialization"))},
            "the scheduler at tcp://a:1 and its workers must be able to import dsn_lite as it is here, they cannot;",
        ),
        ({"sees": False}, "workers must see the files and the folder of the runs, .*runs is not there; share it"),
    ],
)
def test_a_cluster_that_will_not_do(parts, sentence, several, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", SimpleNamespace(Client=type("Client", (Client,), parts)))
    monkeypatch.setattr(cluster, "parallel_config", lambda backend: nullcontext())
    with pytest.raises((ValueError, ImportError), match=f"sweep: {sentence.replace('(', '[(]').replace(')', '[)]')}"):
        sweep(several, tmp_path / "runs", SMALL, dask="tcp://a:1")


def test_a_cluster_that_is_lost(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", SimpleNamespace(Client=Client))
    monkeypatch.setattr(cluster, "parallel_config", lambda backend: nullcontext())
    with (
        pytest.raises(
            ConnectionError, match="the scheduler at tcp://a:1 must stay up until the end, it was lost; start"
        ),
        cluster.backend(None, "tcp://a:1", tmp_path),
    ):
        raise CancelledError


def test_without_dask_the_sentence_says_what_to_install(several, tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["sweep", str(several[0]), "--out", str(tmp_path / "runs"), "--dask", "tcp://a:1"]) == 2
    sentence = "sweep: --dask needs the packages dask and distributed, they are not here; install dsn-lite[cluster]\n"
    assert capsys.readouterr().err == sentence
