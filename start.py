"""Starts the course: makes .venv by requirements.lock, opens JupyterLab at lesson 00. Needs only Python 3.11 to 3.13.

python3 start.py (Windows: py -3 start.py) opens the course, python3 start.py test tests it, --help tells the rest.
This file must still be readable for Python 3.6, so that an old Python says in one sentence what is wrong with it.
"""

import argparse
import contextlib
import errno
import hashlib
import json
import os
import platform
import re
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import time
import urllib.request
import uuid
from pathlib import Path
from xml.etree import ElementTree


def python_trouble(version):
    """What is wrong with this version of Python, or None."""
    if (3, 11) <= tuple(version[:2]) <= (3, 13):
        return None
    here = ".".join(str(number) for number in version[:3])
    return (
        f"dsn-lite needs Python 3.11, 3.12 or 3.13, this is {here}; install Python 3.12 from "
        "https://www.python.org/downloads/ and run start.py with it"
    )


if python_trouble(sys.version_info):
    sys.exit(f"start.py: {python_trouble(sys.version_info)}")

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
LOG = VENV / "start.log"
MARKER = VENV / "complete.json"  # written last: an environment without it was interrupted
LESSON = "notebooks/00_start_here.ipynb"
CPU_WHEELS = "https://download.pytorch.org/whl/cpu"
PATIENCE = 20  # seconds for the CPU wheels' index to answer; a download that has begun may take its time
ROOM = 2e9  # bytes: .venv, and the wheels while they are unpacked
WORKERS = min(4, os.cpu_count() or 1)  # test processes side by side; each needs a core, and up to 1 GB of memory
HERE = urllib.request.build_opener(urllib.request.ProxyHandler({}))  # no proxy leads to this computer itself
FOUND = re.compile(r"^\s*(Downloading|Using cached|Processing|Installing|Requirement already)", re.M)
# JupyterLab's own settings: no question about news on top of the lesson, and no calls to the network
QUIET = {"@jupyterlab/apputils-extension:notification": {"fetchNews": "false", "checkForUpdates": False}}

OUT_OF_SPACE = f"the disk is full; make {ROOM / 1e9:.0f} GB of room and start again"
NO_VENV = (
    "this Python cannot make environments, its venv module is missing; on Debian or Ubuntu run "
    "`sudo apt install python3-venv`, elsewhere install Python from https://www.python.org/downloads/, and start again"
)
NO_NETWORK = (
    "the packages cannot be downloaded, there is no network; connect and start again, or run `start.py pack FOLDER` on "
    "a like machine that has one and here `start.py --from FOLDER`"
)
NO_WHEEL = "no wheel of {} for this system and Python {}; with --from, FOLDER must be packed on a like machine"
IN_USE = "a file of .venv is in use or not yours to write; close JupyterLab and other programs that use it, start again"
SIGNS = [  # in this order: pip says "no matching distribution" also where there is no network
    (r"No space left on device|Errno 28|WinError 112|not enough space on the disk", OUT_OF_SPACE),
    (r"ensurepip is not\s+available|No module named '?(venv|ensurepip)", NO_VENV),
    (r"WinError (5|32)\b|Permission denied|Access is denied", IN_USE),
    (r"name resolution|NameResolution|NewConnection|ConnectTimeout|ReadTimeout|Network is unreachable", NO_NETWORK),
    (r"getaddrinfo|Read timed out|ProxyError|Connection (refused|reset|broken)|IncompleteRead|SSLError", NO_NETWORK),
]


class Trouble(Exception):
    """One sentence for the reader: what is wrong and what to do."""


class Unanswered(Trouble):
    """An index of packages that did not answer in time."""


# --- what may be wrong


def platform_trouble(system, machine, mac_version="", bits=64):
    """What keeps PyTorch from running on this computer, or None."""
    if system == "Darwin" and machine == "x86_64":
        return "PyTorch no longer has a version for Intel Macs; use another computer (Apple silicon: an arm64 Python)"
    if system == "Darwin" and mac_version and int(mac_version.split(".")[0]) < 14:
        return f"PyTorch needs macOS 14 or later, this is {mac_version}; update macOS or use another computer"
    if bits == 32 or (system == "Windows" and machine != "AMD64"):
        return f"PyTorch needs a 64-bit Python, this is {bits}-bit {machine}; install x86-64 Python from www.python.org"
    return None


def recognise(said):
    """The sentence for what venv or pip said, or None where it is nothing known."""
    for sign, sentence in SIGNS:
        if re.search(sign, said):
            return sentence
    missing = re.search(r"No matching distribution found for ([\w.-]+)", said)
    python = "{}.{}".format(*sys.version_info)
    return NO_WHEEL.format(missing.group(1), python) if missing else None


def check_platform():
    """Raises Trouble where the course cannot run."""
    bits = 64 if sys.maxsize > 2**32 else 32
    trouble = platform_trouble(platform.system(), platform.machine(), platform.mac_ver()[0], bits)
    if trouble:
        raise Trouble(trouble)


def check_room():
    """Raises Trouble where the disk has no room for the environment."""
    free = shutil.disk_usage(str(ROOT)).free
    if free < ROOM:
        needed = f"{ROOM / 1e9:.0f} GB of disk, {free / 1e9:.1f} GB are free"
        raise Trouble(f"the course needs {needed}; make room and start again")


# --- the environment


def sections(lock):
    """The lock's lines for the course, and those for the tests only."""
    course, _, tests = lock.partition("# --- for the tests only")
    return tuple([line for line in part.splitlines() if line and line[0] != "#"] for part in (course, tests))


def stamp(tests):
    """What a complete environment was made of and for."""
    digest = hashlib.sha256((ROOT / "requirements.lock").read_bytes().replace(b"\r", b"")).hexdigest()
    return {"lock": digest, "python": python_of_venv(), "repository": str(ROOT), "tests": tests}


def python_of_venv():
    """The version of .venv's own Python, or None where it does not run (any more)."""
    ask = [str(PYTHON), "-c", "import sys; print(*sys.version_info[:2], sep='.')"]
    try:
        return subprocess.run(ask, check=True, capture_output=True, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None


def marker():
    """What .venv says it is complete for; {} where it says nothing."""
    try:
        return json.loads(MARKER.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def state(found, wanted):
    """`complete`, `behind` (another lock, or the tests' part is missing: add to it), or `unusable` (make it anew)."""
    if not found or any(found[key] != wanted[key] for key in ("python", "repository")):
        return "unusable"
    return "complete" if found == wanted else "behind"


def prepare(folder=None, tests=False):
    """Make or complete .venv; where it is complete nothing is done."""
    with alone():
        found = marker()
        tests = tests or found.get("tests", False)
        now = state(found, stamp(tests))
        if now == "complete":
            return
        check_platform()
        MARKER.unlink(missing_ok=True)
        if now == "unusable":
            make_venv()
            check_room()
        install(folder, tests)
        write(MARKER, json.dumps(stamp(tests)))


@contextlib.contextmanager
def alone():
    """Keep a second start from working on the same .venv; the system releases this even after a crash."""
    with (ROOT / ".start.lock").open("a") as held:
        try:
            if os.name == "nt":
                import msvcrt

                msvcrt.locking(held.fileno(), msvcrt.LK_NBLCK, 1)
            else:
                import fcntl

                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise Trouble("another start.py is at work on .venv; wait until it is done, and start again") from None
        yield


def make_venv():
    """An empty environment in place of whatever .venv holds."""
    print("dsn-lite: making .venv, which takes minutes the first time; details go to .venv/start.log", flush=True)
    began = time.monotonic()
    base = getattr(sys, "_base_executable", sys.executable)  # not .venv's own Python, which is about to go
    done = subprocess.run([base, "-m", "venv", "--clear", str(VENV)], capture_output=True, text=True)
    said = done.stdout + done.stderr
    if done.returncode:
        raise Trouble(recognise(said) or f"the environment .venv could not be made\n{tail(said)}")
    write(LOG, said)
    show("environment", began, end="\n")


def install(folder, tests):
    """Everything in the lock, exactly, then this repository itself."""
    pip = [PYTHON, "-m", "pip", "install", "--only-binary", ":all:"]
    source = ["--no-index", "--find-links", folder] if folder else []
    rest = requirements(tests)
    get_torch(pip, source)
    step("JupyterLab and the rest", [*pip, *source, "--no-deps", "-r", rest])
    step("dsn_lite itself", [*pip[:4], "--no-deps", "--no-build-isolation", "--no-index", "-e", ROOT])
    settings = VENV / "share" / "jupyter" / "lab" / "settings"
    settings.mkdir(parents=True, exist_ok=True)
    write(settings / "overrides.json", json.dumps(QUIET))


def requirements(tests):
    """A file with the lock's lines except torch's, which has its own step."""
    course, only_tests = sections((ROOT / "requirements.lock").read_text(encoding="utf-8"))
    lines = [line for line in course + (only_tests if tests else []) if not line.startswith("torch==")]
    return write(VENV / "requirements.txt", "\n".join(lines))


def torch_pin():
    """The lock's line for torch."""
    course, _ = sections((ROOT / "requirements.lock").read_text(encoding="utf-8"))
    return next(line for line in course if line.startswith("torch=="))


def get_torch(pip, source):
    """Fetch torch: on Linux its small CPU build where that can be had, or else what PyPI has, with what it needs."""
    if platform.system() == "Linux" and "--no-index" not in source:
        hurry = ["--timeout", "10", "--retries", "0", "--index-url", CPU_WHEELS]
        try:
            return step("torch, CPU build", [*pip, *source, *hurry, "--no-deps", torch_pin()], patience=PATIENCE)
        except Unanswered:
            print(f"  {CPU_WHEELS} has no answer: torch comes from PyPI, which may bring 4 GB of GPU libraries")
    return step("torch", [*pip, *source, torch_pin()])


def step(title, command, patience=None):
    """Run a command: one line with its seconds on the screen, its output in the log.

    Raises:
        Trouble: it failed. Unanswered: nothing was found, or not within `patience` seconds.
    """
    settings = dict(os.environ, PIP_DISABLE_PIP_VERSION_CHECK="1", PIP_NO_INPUT="1", PIP_USER="0", PYTHONUTF8="1")
    with LOG.open("ab") as log:
        began, begin = time.monotonic(), log.tell()
        words = [str(part) for part in command]
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, cwd=str(ROOT), env=settings)
        with ended(process):
            while process.poll() is None and not overdue(began, begin, patience):
                show(title, began, last_line(begin))
                time.sleep(0.2)
    show(title, began, end="\n")
    if process.returncode:
        failed(begin, patience)


@contextlib.contextmanager
def ended(process):
    """No process outlives what it was started for."""
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()


def overdue(began, begin, patience):
    """Whether the patience is over and pip has still not found what it looks for."""
    return bool(patience) and time.monotonic() - began > patience and not FOUND.search(said_since(begin))


def failed(begin, patience):
    """Raise the sentence for a step that failed."""
    said = said_since(begin)
    if patience and not FOUND.search(said):
        raise Unanswered(NO_NETWORK)
    raise Trouble(recognise(said) or f"a step failed, its last words are below, all of them in {LOG}\n{tail(said)}")


def said_since(begin):
    """What was written to the log after its first `begin` bytes."""
    return LOG.read_bytes()[begin:].decode("utf-8", "replace")


def last_line(begin):
    """The newest line of the log, to show that something moves."""
    return (said_since(begin).strip().splitlines() or [""])[-1].strip()


def tail(text):
    """The last lines of a long output."""
    return "\n".join(text.strip().splitlines()[-15:])


def show(title, began, now="", end="\r"):
    """One line of progress; only a terminal sees it change."""
    if end == "\n" or sys.stdout.isatty():
        line = f"  {title:<28}{time.monotonic() - began:4.0f} s  {now}"
        width = shutil.get_terminal_size().columns - 1
        print(line[:width].ljust(width) if sys.stdout.isatty() else line.rstrip(), end=end, flush=True)


def write(path, text):
    """Write beside and rename, so that no half file is ever found."""
    beside = path.with_name(path.name + ".part")
    beside.write_text(text, encoding="utf-8")
    beside.replace(path)
    return path


# --- the commands


def pack(folder):
    """Download the lock's wheels for this system and Python."""
    prepare()
    folder.mkdir(parents=True, exist_ok=True)
    pip = [PYTHON, "-m", "pip", "download", "--only-binary", ":all:", "--dest", folder]
    get_torch(pip, [])
    step("JupyterLab and the rest", [*pip, "--no-deps", "-r", requirements(tests=False)])
    wheels = list(folder.glob("*.whl"))
    size = sum(wheel.stat().st_size for wheel in wheels) / 1e6
    print(f"{len(wheels)} wheels, {size:.0f} MB, in {folder}; without a network: python3 start.py --from {folder}")


def open_course(port, browser):
    """JupyterLab at lesson 00 until it is stopped."""
    token = secrets.token_hex(16)
    port = choose_port(port)
    print(f"JupyterLab: http://127.0.0.1:{port}/lab/tree/{LESSON}?token={token} (Ctrl-C stops it)", flush=True)
    with ended(jupyterlab(port, token, browser)) as server:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches JupyterLab too, which then ends by itself
        if server.wait():
            raise Trouble(f"JupyterLab ended with exit code {server.returncode}; what it said is above")


def jupyterlab(port, token, browser, output=None):
    """Start JupyterLab's server in the repository, to open at lesson 00."""
    options = {
        "ServerApp.root_dir": ROOT,
        "ServerApp.ip": "127.0.0.1",
        "ServerApp.port": port,
        "ServerApp.port_retries": 0,
        "ServerApp.open_browser": browser,
        "ServerApp.answer_yes": True,
        "ServerApp.allow_root": True,
        "ServerApp.log_level": "ERROR",
        "LabApp.log_level": "ERROR",
        "LabApp.default_url": f"/lab/tree/{LESSON}",
    }
    command = [str(PYTHON), "-m", "jupyterlab", *(f"--{name}={value}" for name, value in options.items())]
    settings = dict(os.environ, JUPYTER_TOKEN=token)  # not on the command line, where other users could read it
    return subprocess.Popen(command, cwd=str(ROOT), env=settings, stdout=output, stderr=output)


def choose_port(wanted):
    """The port asked for, or the first free one from 8888 on.

    Raises:
        Trouble: the port asked for is in use.
    """
    for port in [wanted] if wanted else range(8888, 8988):
        if port_is_free(port):
            return port
    taken = wanted or "8888 to 8987"
    raise Trouble(f"port {taken} is in use or not allowed; choose another with --port, or leave --port out")


def port_is_free(port):
    """Whether nothing on this computer listens there, or keeps it."""
    with socket.socket() as probe, contextlib.suppress(OSError, OverflowError):
        if os.name != "nt":  # on Windows this option would let two programs share a port
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        probe.bind(("127.0.0.1", port))
        return True
    return False


def check():
    """Open lesson 00 through JupyterLab's server, run it, and say what was found."""
    token, port = secrets.token_hex(16), choose_port(None)
    with (VENV / "jupyterlab.log").open("wb") as log, ended(jupyterlab(port, token, False, log)) as server:
        wait_for(server, f"http://127.0.0.1:{port}/api/status?token={token}")
        settings = dict(os.environ, DSN_LITE_TOKEN=token)
        command = [str(PYTHON), str(Path(__file__).resolve()), "run-lesson", "--port", str(port)]
        if subprocess.run(command, env=settings).returncode:
            raise Trouble(f"lesson 00 does not run; JupyterLab's own words are in {log.name}")


def wait_for(server, url):
    """Wait until a server answers.

    Raises:
        Trouble: it ended, or is silent for two minutes.
    """
    deadline = time.monotonic() + 120
    while server.poll() is None and time.monotonic() < deadline:
        with contextlib.suppress(OSError):
            return HERE.open(url, timeout=5).close()
        time.sleep(0.2)
    raise Trouble(f"JupyterLab does not answer; its own words are in {VENV / 'jupyterlab.log'}")


# --- inside the check: this part runs with .venv's Python


def run_lesson(port):
    """Be the browser: fetch the lesson, start its kernel, run its cells in order; returns the exit code."""
    import websocket

    ask = Server(port, os.environ["DSN_LITE_TOKEN"])
    ask.page(f"/lab/tree/{LESSON}")
    cells = [cell for cell in ask.json(f"/api/contents/{LESSON}")["content"]["cells"] if cell["cell_type"] == "code"]
    wanted = {"path": LESSON, "name": "", "type": "notebook", "kernel": {"name": "python3"}}
    began, session = time.monotonic(), ask.json("/api/sessions", wanted)
    url = f"ws://127.0.0.1:{port}/api/kernels/{session['kernel']['id']}/channels?token={ask.token}"
    link = websocket.create_connection(url, timeout=600, http_no_proxy=["127.0.0.1"])
    with contextlib.closing(link) as kernel:
        print(execute(kernel, VERSIONS)[1].strip())
        for number, cell in enumerate(cells, 1):
            error, _ = execute(kernel, "".join(cell["source"]))
            if error:
                print(f"{LESSON}: code cell {number} of {len(cells)} fails: {error}", file=sys.stderr)
                return 1
    print(f"{LESSON}: {len(cells)} code cells ran through JupyterLab in {time.monotonic() - began:.1f} s")
    return 0


VERSIONS = """\
import importlib.metadata, sys
names = ["torch", "numpy", "plotly", "jupyterlab", "dsn-lite"]
print("python", sys.version.split()[0], *(f"{name} {importlib.metadata.version(name)}" for name in names))
"""


class Server:
    """JupyterLab's own HTTP interface."""

    def __init__(self, port, token):
        self.base, self.token = f"http://127.0.0.1:{port}", token

    def page(self, path, content=None):
        """The body at `path`; with content, what the server answers to it."""
        headers = {"Authorization": f"token {self.token}"}
        body = None if content is None else json.dumps(content).encode()
        request = urllib.request.Request(self.base + path, body, headers)
        with HERE.open(request, timeout=120) as answer:
            return answer.read()

    def json(self, path, content=None):
        """The same, decoded."""
        return json.loads(self.page(path, content))


def execute(kernel, code):
    """Run code in a kernel over its websocket; returns its error ("" for none) and what it printed."""
    request = uuid.uuid4().hex
    content = {"code": code, "silent": False, "store_history": True, "user_expressions": {}, "allow_stdin": False}
    header = {"msg_id": request, "msg_type": "execute_request", "username": "", "session": request, "version": "5.3"}
    message = {"header": header, "parent_header": {}, "metadata": {}, "content": content, "channel": "shell"}
    kernel.send(json.dumps(message))
    error, printed, open_ends = "", "", {"execute_reply", "idle"}
    while open_ends:
        answer = kernel.recv()
        if isinstance(answer, bytes):
            continue  # a widget's buffers, meant for its view
        answer = json.loads(answer)
        content = answer["content"]
        if content.get("execution_state") in ("restarting", "dead"):
            return "its kernel died", printed
        if answer["parent_header"].get("msg_id") != request:
            continue
        open_ends -= {answer["msg_type"], content.get("execution_state")}
        printed += content.get("text", "") if answer["msg_type"] == "stream" else ""
        error = f"{content['ename']}: {content['evalue']}" if answer["msg_type"] == "error" else error
    return error, printed


# --- the tests


def test():
    """Lint, tests, notebooks, browser; prints a table, reasons of skips and the counts; returns the exit code."""
    prepare(tests=True)
    # a file of tests stays in one process, which makes once what they share; lessons share nothing
    own, lone = ["--ignore=tests/browser", "--ignore=tests/test_notebooks.py", "--dist=loadfile"], "--dist=worksteal"
    # a browser that draws keeps two cores busy by itself
    stages = {"tests": ["tests", *own], "notebooks": [*lessons(), lone], "browser": ["tests/browser", "-n0"]}
    return report([lint(), *(pytest_stage(stage, arguments) for stage, arguments in stages.items())])


def lessons():
    """What runs the lessons without a browser: their solutions, and where there is no browser, what students open."""
    if find_browser():  # tests/browser runs each student notebook in JupyterLab
        return ["tests/test_notebooks.py"]
    notebooks = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "notebooks").glob("*.ipynb"))
    return ["--nbmake", "--nbmake-timeout=300", *notebooks, "tests/test_notebooks.py"]


def lint():
    """ruff's two opinions."""
    began = time.monotonic()
    print("== lint", flush=True)
    ruff = [str(PYTHON), "-m", "ruff"]
    verbs = ["check"], ["format", "--check"]
    codes = [subprocess.run([*ruff, *verb, "."], cwd=str(ROOT)).returncode for verb in verbs]
    return {"stage": "lint", "ok": not any(codes), "seconds": time.monotonic() - began}


def pytest_stage(stage, arguments):
    """Run pytest; its counts and skip reasons come from its own report."""
    print(f"== {stage}", flush=True)
    began, xml = time.monotonic(), VENV / f"report-{stage}.xml"
    xml.unlink(missing_ok=True)
    settings = dict(os.environ, JUPYTER_PLATFORM_DIRS="1")
    settings.update(dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"))
    settings.update({"DSN_LITE_SMOKE": "1"} if stage == "notebooks" else {})
    command = [str(PYTHON), "-m", "pytest", "-q", f"-n{WORKERS}", f"--junitxml={xml}", *arguments]
    code = subprocess.run(command, cwd=str(ROOT), env=settings).returncode
    counts = read_counts(xml.read_text(encoding="utf-8") if xml.exists() else None)
    return {"stage": stage, "ok": code == 0, "seconds": time.monotonic() - began, **counts}


def read_counts(xml):
    """Counts and skip reasons of a JUnit report; a missing one is a failure."""
    if xml is None:
        return {"passed": 0, "failed": 1, "skipped": 0, "reasons": []}
    cases = list(ElementTree.fromstring(xml).iter("testcase"))
    failed = sum(case.find("failure") is not None or case.find("error") is not None for case in cases)
    skips = [(case, case.find("skipped")) for case in cases if case.find("skipped") is not None]
    reasons = [f"{case.get('classname')}::{case.get('name')}: {skip.get('message')}" for case, skip in skips]
    return {"passed": len(cases) - failed - len(skips), "failed": failed, "skipped": len(skips), "reasons": reasons}


def report(results):
    """Print the table and the counts; returns the exit code."""
    print(f"\n{'stage':<12}{'passed':>8}{'failed':>8}{'skipped':>8}{'seconds':>9}")
    for result in results:
        counts = "".join(f"{result.get(count, '-'):>8}" for count in ("passed", "failed", "skipped"))
        print(f"{result['stage']:<12}{counts}{result['seconds']:>9.0f}  {'ok' if result['ok'] else 'FAILED'}")
    for reason in [reason for result in results for reason in result.get("reasons", [])]:
        print(f"skipped {reason}")
    totals = {count: sum(result.get(count, 0) for result in results) for count in ("passed", "failed", "skipped")}
    print("{passed} passed, {failed} failed, {skipped} skipped".format(**totals), flush=True)
    return int(not all(result["ok"] for result in results))


def find_browser(system=None):
    """The path of an installed Chromium, Chrome or Edge, or None."""
    names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "microsoft-edge"]
    folders = [os.environ.get(name, "") for name in ("PROGRAMFILES", "PROGRAMFILES(X86)", "LOCALAPPDATA")]
    windows = ["Google/Chrome/Application/chrome.exe", "Microsoft/Edge/Application/msedge.exe"]
    apps = ["Google Chrome", "Chromium", "Microsoft Edge"]
    places = {
        "Windows": [Path(folder, program) for program in windows for folder in folders if folder],
        "Darwin": [Path("/Applications", f"{app}.app", "Contents", "MacOS", app) for app in apps],
    }
    found = [shutil.which(name) for name in names] + places.get(system or platform.system(), [])
    return next((str(path) for path in found if path and Path(path).exists()), None)


# --- the command line


def parser():
    """The command line."""
    top = argparse.ArgumentParser(
        prog="start.py",
        description="Makes the course's environment in .venv (the first time) and opens it in JupyterLab.",
        epilog="Without a command the course opens. An interrupted start is made good by the next; to begin anew, "
        "delete .venv.",
    )
    top.add_argument("--no-browser", action="store_true", help="print the address instead of opening a browser")
    top.add_argument("--port", type=int, help="the port of JupyterLab; without it, the first free one from 8888 on")
    top.add_argument("--check", action="store_true", help="run lesson 00 through JupyterLab's server without a browser")
    top.add_argument("--from", dest="folder", type=Path, help="install from a folder made by `pack`, with no network")
    commands = top.add_subparsers(dest="command", metavar="COMMAND")
    commands.add_parser("test", help="lint, tests, notebooks and browser tests, with a summary")
    packing = commands.add_parser("pack", help="download all packages for this system and Python into a folder")
    packing.add_argument("target", type=Path, metavar="FOLDER")
    return top


def run(options):
    """Do what was asked; returns the exit code."""
    if options.folder and not options.folder.is_dir():
        raise Trouble(f"--from needs a folder made by `start.py pack`, {options.folder} is none; check its name")
    if options.command == "test":
        return test()
    if options.command == "pack":
        return pack(options.target.resolve())
    prepare(options.folder and options.folder.resolve())
    return check() if options.check else open_course(options.port, not options.no_browser)


def main(arguments):
    """The exit code; each trouble is one sentence on stderr."""
    if arguments[:2] == ["run-lesson", "--port"]:
        return run_lesson(int(arguments[2]))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that nothing we started is left behind
    try:
        return run(parser().parse_args(arguments)) or 0
    except Trouble as trouble:
        print(f"start.py: {trouble}", file=sys.stderr)
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        print(f"start.py: {OUT_OF_SPACE}", file=sys.stderr)
    except KeyboardInterrupt:
        print("\nstart.py: stopped; the next start makes it good", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
