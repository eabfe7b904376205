"""The lines of the page on Python run as they stand, and so do the examples."""

import re
import runpy
import shlex
from pathlib import Path

import matplotlib
import pytest
import write_notebooks

pytest.importorskip("xarray", reason="the page's lines need xarray")
matplotlib.use("agg")

ROOT = Path(__file__).parent.parent.parent
PAGE = ROOT / "docs" / "python.md"
EXAMPLES = sorted(path for path in (ROOT / "python" / "examples").glob("*.py") if path.stem != "motions")


def test_the_page(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```(python|sh)\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    assert sum(kind == "python" for kind, _ in blocks) > 8
    names = {"__name__": "page"}
    for kind, text in blocks:
        if kind == "python":
            exec(compile(text, str(PAGE), "exec"), names)  # noqa: S102
        else:
            for line in text.replace("\\\n", " ").splitlines():
                program, *flags = shlex.split(line)
                assert program == "topple"
                command(*flags)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_notebooks_have_the_cells_of_the_scripts(example):
    committed = example.with_suffix(".ipynb").read_text(encoding="utf-8")
    assert committed == write_notebooks.text(example.stem), "run python python/tests/write_notebooks.py"


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example(example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(example.parent)
    runpy.run_path(str(example), run_name="example")
    assert (tmp_path / f"{example.stem}.png").stat().st_size > 10_000
