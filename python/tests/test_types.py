"""Types: the package by mypy, the stub of the compiled module by stubtest, the keywords by the library's tables."""

import subprocess
import sys
from pathlib import Path

import pytest
import write_keywords

import topple

PYTHON = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """Where mypy keeps what it knows of other packages."""
    return tmp_path_factory.mktemp("mypy")


def checked(folder, *command):
    pytest.importorskip("mypy", reason="mypy is not installed: types are not checked")
    done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_package_is_typed(cache):
    checked(PYTHON, "mypy", "--cache-dir", str(cache), "--strict", "--ignore-missing-imports", "-p", "topple")


def test_the_stub_is_the_module(tmp_path):
    # Of the installed package: the sources have no compiled module.
    checked(tmp_path, "mypy.stubtest", "topple._topple")


def test_types_of_keywords_are_those_of_the_tables():
    committed = (PYTHON / "topple" / "_keywords.py").read_text(encoding="utf-8")
    assert committed == write_keywords.text(), "run python python/tests/write_keywords.py"


def test_a_wrong_keyword_is_an_error_of_types(tmp_path, cache):
    script = tmp_path / "script.py"
    script.write_text("import topple\ntopple.pulse(object=1, t_h=1.75, th=2.0)\n")
    pytest.importorskip("mypy", reason="mypy is not installed: types are not checked")
    done = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", str(cache), script], capture_output=True, text=True, cwd=tmp_path)
    assert 'Unexpected keyword argument "th"' in done.stdout, done.stdout


def test_help_lists_every_keyword():
    for entry in topple.parameters():
        where = topple.seismic if entry["section"] == "record" else topple.pulse
        assert f"    {entry['key']} : " in where.__doc__
