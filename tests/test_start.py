"""start.py's parts, one by one; the real first start, offline start and interrupted start are tried by hand."""

import ast
import errno
import json
import socket
import subprocess
import sys
import time
from collections import namedtuple
from pathlib import Path

import pytest

import start

LOCK = "# header\n\n# --- the course\nnumpy==2.0\ntorch==2.6\n\n# --- for the tests only\npytest==8.0\n"
PIP_WITHOUT_NETWORK = """\
WARNING: Retrying (Retry(total=0)) after connection broken by 'NewConnectionError: Temporary failure in name resolution'
ERROR: Could not find a version that satisfies the requirement torch==2.6 (from versions: none)
ERROR: No matching distribution found for torch==2.6
"""


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A repository of its own, with a .venv that was never made."""
    (tmp_path / "requirements.lock").write_text(LOCK, encoding="utf-8")
    venv = tmp_path / ".venv"
    places = {"ROOT": tmp_path, "VENV": venv, "PYTHON": venv / "python", "LOG": venv / "start.log"}
    for name, path in (places | {"MARKER": venv / "complete.json"}).items():
        monkeypatch.setattr(start, name, path)
    monkeypatch.setattr(start, "check_platform", lambda: None)
    return tmp_path


@pytest.fixture
def steps(home, monkeypatch):
    """The titles of the steps taken; `.venv` is "made" with this Python."""
    taken = []

    def make_venv():
        taken.append("environment")
        home.joinpath(".venv").mkdir(exist_ok=True)
        home.joinpath(".venv", "start.log").touch()
        monkeypatch.setattr(start, "PYTHON", Path(sys.executable))

    monkeypatch.setattr(start, "make_venv", make_venv)
    monkeypatch.setattr(start, "step", lambda title, command, patience=None: taken.append(title))
    return taken


# --- the sentences


@pytest.mark.parametrize(
    ("version", "fine"),
    [((3, 6, 15), False), ((3, 10, 9), False), ((3, 11, 0), True), ((3, 13, 2), True), ((3, 14, 0), False)],
)
def test_python_trouble(version, fine):
    says = start.python_trouble(version)
    assert says is None if fine else f"needs Python 3.11, 3.12 or 3.13, this is {version[0]}.{version[1]}" in says


def test_an_old_python_can_read_the_file():
    source = Path(start.__file__).read_text(encoding="utf-8")
    ast.parse(source, feature_version=(3, 6))
    asked = source.index("if python_trouble(sys.version_info):")
    before = [type(node) for node in ast.parse(source[:asked]).body]
    runs_first = {ast.Expr, ast.Import, ast.ImportFrom, ast.FunctionDef}  # nothing that an old Python cannot run
    assert set(before) == runs_first
    assert before.count(ast.FunctionDef) == 1


@pytest.mark.parametrize(
    ("computer", "sentence"),
    [
        (("Linux", "x86_64"), None),
        (("Linux", "aarch64"), None),
        (("Windows", "AMD64"), None),
        (("Darwin", "arm64", "14.1"), None),
        (("Darwin", "x86_64", "14.1"), "no longer has a version for Intel Macs; use another computer"),
        (("Darwin", "arm64", "13.6"), "needs macOS 14 or later, this is 13.6; update"),
        (("Windows", "ARM64"), "needs a 64-bit Python, this is 64-bit ARM64; install x86-64"),
        (("Windows", "AMD64", "", 32), "needs a 64-bit Python, this is 32-bit"),
    ],
)
def test_platform_trouble(computer, sentence):
    says = start.platform_trouble(*computer)
    assert says is None if sentence is None else sentence in says


@pytest.mark.parametrize(
    ("said", "sentence"),
    [
        ("ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device", "the disk is full"),
        ("OSError: [WinError 112] There is not enough space on the disk", "the disk is full"),
        (
            "not created successfully because ensurepip is not\navailable.  On Debian/Ubuntu systems",
            "apt install python3-venv",
        ),
        ("/usr/bin/python3: No module named venv", "apt install python3-venv"),
        ("PermissionError: [WinError 5] Access is denied: 'torch.dll'", "in use or not yours to write"),
        (PIP_WITHOUT_NETWORK, "there is no network"),
        ("pip._vendor.urllib3.exceptions.ReadTimeoutError: Read timed out.", "there is no network"),
        ("ERROR: No matching distribution found for scipy==1.17.1", "no wheel of scipy for this system and Python 3."),
    ],
)
def test_troubles_are_recognised(said, sentence):
    assert sentence in start.recognise(said)


def test_what_is_not_known_is_not_guessed():
    assert start.recognise("Segmentation fault") is None


@pytest.mark.parametrize("name", ["OUT_OF_SPACE", "NO_VENV", "NO_NETWORK", "NO_WHEEL", "IN_USE"])
def test_a_trouble_is_one_sentence_with_a_cure(name):
    sentence = getattr(start, name)
    assert "\n" not in sentence
    assert any(cure in sentence for cure in ("start again", "must be packed"))


def test_too_small_a_disk_is_told_before(home, monkeypatch):
    usage = namedtuple("usage", "total used free")
    monkeypatch.setattr(start.shutil, "disk_usage", lambda path: usage(9e9, 8.5e9, 0.5e9))
    with pytest.raises(start.Trouble, match=r"needs 2 GB of disk, 0\.5 GB are free; make room"):
        start.check_room()


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (start.Trouble("what to do"), "start.py: what to do\n"),
        (OSError(errno.ENOSPC, "No space left on device"), "start.py: the disk is full"),
        (KeyboardInterrupt(), "start.py: stopped; the next start makes it good"),
    ],
)
def test_each_trouble_ends_with_its_sentence_and_code_1(error, sentence, monkeypatch, capsys):
    def fails(options):
        raise error

    monkeypatch.setattr(start, "run", fails)
    assert start.main([]) == 1
    assert sentence in capsys.readouterr().err


def test_from_a_folder_that_is_none(tmp_path, capsys):
    assert start.main(["--from", str(tmp_path / "none")]) == 1
    assert "--from needs a folder made by `start.py pack`" in capsys.readouterr().err


# --- what is installed, and when


def test_sections():
    assert start.sections(LOCK) == (["numpy==2.0", "torch==2.6"], ["pytest==8.0"])


@pytest.mark.parametrize(("tests", "lines"), [(False, ["numpy==2.0"]), (True, ["numpy==2.0", "pytest==8.0"])])
def test_torch_has_its_own_step(home, tests, lines):
    (home / ".venv").mkdir()
    assert start.requirements(tests).read_text(encoding="utf-8").splitlines() == lines
    assert start.torch_pin() == "torch==2.6"


def test_first_start_makes_everything_and_the_second_nothing(steps):
    start.prepare()
    assert steps[0] == "environment"
    assert steps[-1] == "dsn_lite itself"
    steps.clear()
    start.prepare()
    assert steps == []


def test_an_interrupted_start_is_made_anew(steps, monkeypatch):
    def interrupted(folder, tests):
        raise KeyboardInterrupt

    with monkeypatch.context() as during:
        during.setattr(start, "install", interrupted)
        with pytest.raises(KeyboardInterrupt):
            start.prepare()
    steps.clear()
    start.prepare()
    assert steps[0] == "environment"


def test_the_marker_goes_first_and_comes_last(steps, monkeypatch):
    start.prepare()
    with monkeypatch.context() as during:
        during.setattr(start, "install", lambda folder, tests: steps.append(start.MARKER.exists()))
        start.prepare(tests=True)
    assert steps[-1] is False
    assert json.loads(start.MARKER.read_text(encoding="utf-8"))["tests"] is True


STAMP = {"lock": "a", "python": "3.11", "repository": "/x", "tests": False}


@pytest.mark.parametrize(
    ("found", "now"),
    [
        (STAMP, "complete"),
        ({}, "unusable"),
        (STAMP | {"lock": "b"}, "behind"),
        (STAMP | {"tests": True}, "behind"),
        (STAMP | {"python": "3.10"}, "unusable"),
        (STAMP | {"repository": "/y"}, "unusable"),
    ],
)
def test_state(found, now):
    assert start.state(found, STAMP) == now


def test_the_tests_part_stays_when_the_lock_moves_on(steps, home):
    start.prepare(tests=True)
    steps.clear()
    (home / "requirements.lock").write_text(LOCK.replace("2.0", "2.1"), encoding="utf-8")
    start.prepare()
    assert "environment" not in steps
    assert start.marker()["tests"] is True


def test_a_broken_marker_is_as_good_as_none(home):
    (home / ".venv").mkdir()
    start.MARKER.write_text("{", encoding="utf-8")
    assert start.marker() == {}
    assert start.python_of_venv() is None


def test_a_second_start_at_the_same_time_waits_its_turn(home):
    with start.alone(), pytest.raises(start.Trouble, match=r"another start\.py is at work"), start.alone():
        pass


# --- a step, with this Python in pip's place


def run_step(home, code, patience=None):
    (home / ".venv").mkdir(exist_ok=True)
    start.step("a step", [sys.executable, "-c", code], patience)


def test_step_shows_one_line_and_keeps_the_output(home, capsys):
    run_step(home, "print('Collecting numpy')")
    shown = capsys.readouterr().out
    assert shown.startswith("  a step")
    assert shown.endswith(" s\n")
    assert "Collecting numpy" in start.LOG.read_text(encoding="utf-8")


def test_step_shows_the_tail_of_what_is_not_known(home):
    with pytest.raises(start.Trouble, match=r"(?s)a step failed.*line 29") as trouble:
        run_step(home, "for i in range(30): print('line', i)\nraise SystemExit(3)")
    assert "line 2\n" not in str(trouble.value)


def test_step_reads_only_its_own_words(home):
    with pytest.raises(start.Trouble, match="disk is full"):
        run_step(home, "raise SystemExit('No space left on device')")
    with pytest.raises(start.Trouble, match="a step failed"):
        run_step(home, "raise SystemExit('something else')")


def test_step_loses_its_patience_with_a_silent_index(home):
    with pytest.raises(start.Unanswered, match="no network"):
        run_step(home, "import time; time.sleep(60)", patience=0.1)


@pytest.mark.parametrize(
    ("said", "patience", "over"),
    [
        ("Collecting torch", 20, True),
        ("Collecting torch\n  Downloading it", 20, False),
        ("Collecting torch", None, False),
    ],
)
def test_patience_is_for_the_index_not_for_the_download(home, said, patience, over):
    (home / ".venv").mkdir()
    start.LOG.write_text(said, encoding="utf-8")
    assert start.overdue(time.monotonic() - 21, 0, patience) is over


def test_a_broken_download_is_no_reason_to_download_more(home):
    with pytest.raises(start.Trouble, match="no network") as trouble:
        run_step(home, "raise SystemExit('Downloading torch\\nRead timed out')", patience=5)
    assert not isinstance(trouble.value, start.Unanswered)


@pytest.mark.parametrize("system", ["Linux", "Darwin", "Windows"])
@pytest.mark.parametrize("answers", [True, False])
def test_where_torch_comes_from(home, monkeypatch, system, answers):
    asked = []

    def step(title, command, patience=None):
        asked.append(" ".join(map(str, command)))
        if patience and not answers:
            raise start.Unanswered

    monkeypatch.setattr(start, "step", step)
    monkeypatch.setattr(start.platform, "system", lambda: system)
    start.get_torch(["pip"], [])
    cpu = [start.CPU_WHEELS in command for command in asked]
    assert cpu == ([False] if system != "Linux" else [True] if answers else [True, False])
    assert all(command.endswith("torch==2.6") for command in asked)


def test_from_a_folder_no_index_is_asked(home, monkeypatch):
    asked = []
    (home / ".venv").mkdir()
    monkeypatch.setattr(start, "step", lambda title, command, patience=None: asked.append(command))
    start.install(home / "wheels", tests=False)
    assert all("--no-index" in command for command in asked)
    assert [home / "wheels" in command for command in asked] == [True, True, False]
    settings = home / ".venv" / "share" / "jupyter" / "lab" / "settings" / "overrides.json"
    assert json.loads(settings.read_text(encoding="utf-8")) == start.QUIET  # JupyterLab goes to no network either


# --- JupyterLab


def test_a_port_in_use(capsys):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(start.Trouble, match=f"port {port} is in use or not allowed; choose another"):
            start.choose_port(port)
    assert start.choose_port(port) == port


def test_a_port_that_is_none():
    with pytest.raises(start.Trouble, match="port 99999 is in use or not allowed"):
        start.choose_port(99999)


def test_the_next_free_port_is_taken(monkeypatch):
    monkeypatch.setattr(start, "port_is_free", lambda port: port == 8890)
    assert start.choose_port(None) == 8890


class Kernel:
    """Answers every request as a Jupyter kernel would, with what it is given in between."""

    def __init__(self, *answers):
        self.answers = answers

    def send(self, text):
        request = {"msg_id": json.loads(text)["header"]["msg_id"]}
        messages = [{"msg_type": kind, "parent_header": request, "content": content} for kind, content in self.answers]
        foreign = {"msg_type": "status", "parent_header": {}, "content": {"execution_state": "idle"}}
        self.queue = [b"a buffer", json.dumps(foreign), *map(json.dumps, messages)]

    def recv(self):
        return self.queue.pop(0)


END = [("execute_reply", {"status": "ok"}), ("status", {"execution_state": "idle"})]


def test_execute_reads_until_both_ends():
    kernel = Kernel(("status", {"execution_state": "busy"}), ("stream", {"text": "one "}), *END[::-1])
    assert start.execute(kernel, "print('one')") == ("", "one ")
    assert kernel.queue == []


def test_execute_reports_an_error_and_a_dead_kernel():
    error = ("error", {"ename": "ValueError", "evalue": "no"})
    assert start.execute(Kernel(error, *END), "fail()") == ("ValueError: no", "")
    assert start.execute(Kernel(("status", {"execution_state": "restarting"})), "exit()")[0] == "its kernel died"


# --- the tests' summary

REPORT = """<testsuites><testsuite><testcase classname="tests.a" name="one"/><testcase classname="tests.a" name="two">
<failure message="no"/></testcase><testcase classname="tests.a" name="three"><error message="no"/></testcase>
<testcase classname="tests.a" name="four"><skipped type="pytest.skip" message="no browser"/></testcase>
</testsuite></testsuites>"""


def test_counts_are_those_of_pytest():
    expected = {"passed": 1, "failed": 2, "skipped": 1, "reasons": ["tests.a::four: no browser"]}
    assert start.read_counts(REPORT) == expected


def test_a_stage_without_a_report_has_failed():
    assert start.read_counts(None)["failed"] == 1


@pytest.mark.parametrize(("lint", "failed", "code"), [(True, 0, 0), (False, 0, 1), (True, 2, 1)])
def test_summary(lint, failed, code, capsys):
    stage = {
        "stage": "tests",
        "ok": not failed,
        "seconds": 2,
        "passed": 5,
        "failed": failed,
        "skipped": 1,
        "reasons": ["a: b"],
    }
    assert start.report([{"stage": "lint", "ok": lint, "seconds": 1}, stage]) == code
    *_, reason, last = capsys.readouterr().out.splitlines()
    assert reason == "skipped a: b"
    assert last == f"5 passed, {failed} failed, 1 skipped"


def test_browsers_are_found_on_the_path_and_at_home(monkeypatch, tmp_path):
    monkeypatch.setattr(start.shutil, "which", lambda name: None)
    assert start.find_browser("Linux") is None
    edge = tmp_path / "Microsoft" / "Edge" / "Application" / "msedge.exe"
    edge.parent.mkdir(parents=True)
    edge.touch()
    monkeypatch.setenv("PROGRAMFILES", str(tmp_path))
    assert start.find_browser("Windows") == str(edge)
    monkeypatch.setattr(start.shutil, "which", lambda name: str(edge) if name == "microsoft-edge" else None)
    assert start.find_browser("Linux") == str(edge)


@pytest.mark.parametrize("browser", [None, "/usr/bin/chromium"])
def test_student_notebooks_run_in_the_browser_or_where_there_is_none_without(browser, home, monkeypatch):
    home.joinpath("notebooks").mkdir()
    home.joinpath("notebooks", "00_start.ipynb").touch()
    monkeypatch.setattr(start, "find_browser", lambda: browser)
    told = start.lessons()
    assert told[-1] == "tests/test_notebooks.py"
    assert (str(Path("notebooks", "00_start.ipynb")) in told) == ("--nbmake" in told) == (browser is None)


def test_help_tells_of_every_door():
    said = subprocess.run([sys.executable, start.__file__, "--help"], capture_output=True, text=True, check=True).stdout
    for door in ("--no-browser", "--port", "--check", "--from", "test", "pack"):
        assert door in said
