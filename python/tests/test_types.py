"""Types: the package by mypy, and the stub of the compiled module by stubtest."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy", reason="mypy is not installed: types are not checked")

PYTHON = Path(__file__).parent.parent


def test_the_package_is_typed():
    run = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "-p", "topple"]
    done = subprocess.run(run, capture_output=True, text=True, cwd=PYTHON)
    assert done.returncode == 0, done.stdout


def test_the_stub_is_the_module():
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "topple._topple"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
