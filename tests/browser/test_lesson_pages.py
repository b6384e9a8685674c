"""Every lesson runs in JupyterLab in a real browser, without an error in a cell or on the page."""

import shutil
from pathlib import Path

import pytest

LESSONS = sorted((Path(__file__).resolve().parents[2] / "notebooks").glob("*.ipynb"))


@pytest.mark.skipif(not LESSONS, reason="there are no lessons in notebooks/")
@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_lesson_runs(lesson, lab, notebook):
    shutil.copy(lesson, lab.folder / lesson.name)  # JupyterLab saves what it opens
    opened = notebook(lesson.name)
    opened.run_all()
    assert opened.errors() == []
