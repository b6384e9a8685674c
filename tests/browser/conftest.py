"""A JupyterLab on this machine and a browser that opens notebooks in it.

Without a browser, or without playwright, these tests are skipped with the reason; DSN_LITE_REQUIRE_BROWSER=1, which
.ci/run sets, makes that a failure.
"""

import importlib.util
import json
import os
import secrets
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import suppress
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 180_000  # milliseconds; software WebGL on a busy machine is slow
# WebGL without a graphics card; no sandbox, since continuous integration runs as root in a container
FLAGS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
SETTINGS = {
    "@jupyterlab/apputils-extension/notification": {"fetchNews": "false", "checkForUpdates": False},
    "@jupyterlab/notebook-extension/tracker": {"windowingMode": "none"},
}
ERRORS = """() => jupyterapp.shell.currentWidget.content.model.sharedModel.cells
    .filter(cell => cell.cell_type === 'code')
    .flatMap((cell, index) => cell.toJSON().outputs.map(output => [index + 1, output]))
    .filter(([index, output]) => output.output_type === 'error')
    .map(([index, output]) => `code cell ${index}: ${output.ename}: ${output.evalue}`)"""
READY = """async () => {
    await jupyterapp.restored;
    const panel = jupyterapp.shell.currentWidget;
    await panel.context.ready;
    await panel.sessionContext.ready;
    await panel.sessionContext.session.kernel.info;
}"""
ASK = """async (code) => {
    const kernel = jupyterapp.shell.currentWidget.sessionContext.session.kernel;
    const reply = await kernel.requestExecute({code: '', user_expressions: {asked: code}}).done;
    const asked = reply.content.user_expressions.asked;
    return asked.status === 'ok' ? asked.data['text/plain'] : `${asked.ename}: ${asked.evalue}`;
}"""

# anywidget gives up on a widget whose script has not run after two seconds; a busy machine may need longer
UNHURRIED = "(timeout => AbortSignal.timeout = ms => timeout(Math.max(ms, %d)))(AbortSignal.timeout.bind(AbortSignal))"


def unavailable(reason):
    """Skips the test, or fails it where a browser is required."""
    (pytest.fail if os.environ.get("DSN_LITE_REQUIRE_BROWSER") == "1" else pytest.skip)(reason)


def find_browser():
    """The browser that start.py finds, so that there is one finder."""
    spec = importlib.util.spec_from_file_location("start", ROOT / "start.py")
    start = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(start)
    return start.find_browser()


@pytest.fixture(scope="session")
def browser():
    """A headless Chromium, Chrome or Edge of this machine."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        unavailable("playwright is not installed; start.py test installs it")
    path = os.environ.get("DSN_LITE_BROWSER") or find_browser()
    if not path:
        unavailable("no Chromium, Chrome or Edge was found; install one")
    sandbox = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=[*FLAGS, *sandbox])
        yield browser
        browser.close()


class Lab:
    """A JupyterLab server; its folder holds the notebooks that tests put there."""

    def __init__(self, folder, base, token):
        self.folder, self.base, self.token = folder, base, token

    def write(self, name, *cells):
        """A notebook with these code cells."""
        code = [
            {"cell_type": "code", "id": f"c{i}", "metadata": {}, "source": c, "outputs": [], "execution_count": None}
            for i, c in enumerate(cells)
        ]
        kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
        content = {"cells": code, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}
        (self.folder / name).write_text(json.dumps(content), encoding="utf-8")
        return name

    def end_kernels(self):
        """Ends the kernels of all notebooks."""
        with self._answer("GET", "/api/sessions") as answer:
            sessions = json.load(answer)
        for session in sessions:
            self._answer("DELETE", f"/api/sessions/{session['id']}").close()

    def _answer(self, method, path):
        asked = urllib.request.Request(
            self.base + path, method=method, headers={"Authorization": f"token {self.token}"}
        )
        return urllib.request.urlopen(asked, timeout=60)


@pytest.fixture(scope="session")
def lab(browser, tmp_path_factory):
    """JupyterLab on loopback with settings of its own, so that a reader's are neither used nor changed."""
    own, folder = tmp_path_factory.mktemp("jupyter"), tmp_path_factory.mktemp("notebooks")
    for name, settings in SETTINGS.items():
        path = own / "settings" / f"{name}.jupyterlab-settings"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(settings), encoding="utf-8")
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    lab = Lab(folder, f"http://127.0.0.1:{port}", secrets.token_hex(16))
    with (own / "log.txt").open("wb") as log:
        server = subprocess.Popen(_command(lab, port), cwd=folder, env=_environment(own), stdout=log, stderr=log)
        try:
            _wait_for(server, lab, own / "log.txt")
            yield lab
        finally:
            server.terminate()
            server.wait(30)


def _command(lab, port):
    told = {"ServerApp.ip": "127.0.0.1", "ServerApp.port": port, "ServerApp.port_retries": 0}
    told |= {"ServerApp.allow_root": True, "ServerApp.root_dir": lab.folder, "IdentityProvider.token": lab.token}
    told |= {"LabApp.expose_app_in_browser": True, "LabApp.extension_manager": "readonly", "LabApp.news_url": None}
    return [sys.executable, "-m", "jupyterlab", "--no-browser", *(f"--{name}={value}" for name, value in told.items())]


def _environment(own):
    folders = {"JUPYTER_CONFIG_DIR": "config", "JUPYTERLAB_SETTINGS_DIR": "settings", "IPYTHONDIR": "ipython"}
    folders |= {"JUPYTERLAB_WORKSPACES_DIR": "workspaces", "JUPYTER_RUNTIME_DIR": "runtime"}
    threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    packages = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    own_folders = {name: str(own / folder) for name, folder in folders.items()}
    return os.environ | own_folders | threads | {"DSN_LITE_SMOKE": "1", "PYTHONPATH": packages}


def _wait_for(server, lab, log):
    deadline = time.monotonic() + 120
    while server.poll() is None and time.monotonic() < deadline:
        with suppress(OSError):
            return urllib.request.urlopen(f"{lab.base}/api/status?token={lab.token}", timeout=5).close()
        time.sleep(0.2)
    pytest.fail(f"JupyterLab does not answer: {log.read_text(encoding='utf-8', errors='replace')[-2000:]}")


class Notebook:
    """A notebook open in the browser."""

    def __init__(self, page):
        self.page, self.page_errors = page, []
        page.on("pageerror", lambda error: self.page_errors.append(str(error)))
        page.set_default_timeout(PATIENCE)

    def open(self, lab, name):
        """Opens it and waits for its kernel."""
        self.page.goto(f"{lab.base}/lab/tree/{name}?token={lab.token}&reset")
        self.page.wait_for_selector(".jp-Notebook", state="attached")
        self.page.evaluate(READY)  # cells that are run earlier make JupyterLab ask for a kernel
        return self

    def start_all(self):
        """Asks for all cells to run, without waiting for them."""
        self.page.evaluate("() => { jupyterapp.commands.execute('notebook:run-all-cells'); }")

    def run_all(self):
        """Runs all cells and waits for the last."""
        self.page.evaluate("async () => { await jupyterapp.commands.execute('notebook:run-all-cells'); }")

    def errors(self):
        """What went wrong in cells and on the page."""
        return [*self.page.evaluate(ERRORS), *(f"page: {error}" for error in self.page_errors)]

    def ask(self, expression):
        """The repr of an expression in the kernel."""
        return self.page.evaluate(ASK, expression)


@pytest.fixture(scope="session")
def context(browser):
    """What the pages of all tests share: a cache, so that JupyterLab is fetched and compiled once."""
    context = browser.new_context(viewport={"width": 1280, "height": 1600})
    context.add_init_script(UNHURRIED % PATIENCE)
    yield context
    context.close()


@pytest.fixture
def notebook(context, lab):
    """Opens a notebook of the lab by name in a page of its own; page and kernel end with the test."""
    opened = Notebook(context.new_page())
    yield lambda name: opened.open(lab, name)
    opened.page.close()  # first, or the kernel's end waits for all that the page still has to draw
    lab.end_kernels()
