"""What the tests share: the command, which is compared with the package, and made-up records."""

import os
import shutil
import subprocess

import pytest


@pytest.fixture(scope="session")
def command():
    """Runs the command `topple` of TOPPLE_COMMAND, or of the path."""
    binary = os.environ.get("TOPPLE_COMMAND") or shutil.which("topple")
    if binary is None:
        pytest.skip("no command to compare with: set TOPPLE_COMMAND to the binary topple")

    def run(*flags):
        done = subprocess.run([binary, *map(str, flags)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


@pytest.fixture(scope="session")
def records(command, tmp_path_factory):
    """The synthetic pair as files, in a folder of its own with a list of two motions."""
    folder = tmp_path_factory.mktemp("records")
    out = tmp_path_factory.mktemp("out")
    command("seismic", "--object", 1, "--t-h", 1, "--t-v", 0.4, "--verify", "none", "--out", out)
    for name in ("synthetic_h.at2", "synthetic_v.at2"):
        shutil.copy(out / name, folder / name)
    # Motions that share no file are two recordings.
    shutil.copy(out / "synthetic_h.at2", folder / "other_h.at2")
    lines = [
        "id,horizontal,vertical,scale,weight",
        "one,synthetic_h.at2,synthetic_v.at2,1,1",
        "two,other_h.at2,,1.7,2",
        "three,synthetic_v.at2,synthetic_h.at2,2.5,1",
    ]
    (folder / "list.csv").write_text("\n".join(lines) + "\n")
    return folder
