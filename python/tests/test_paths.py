"""Paths that are no text, which Linux allows, and files of somebody else in the way."""

import json
import os
import sys
from pathlib import Path

import numpy as np
import pytest

import topple

BASE = {"object": 1, "t_h": "1:3:3", "t_v": "0.1:0.4:3", "backend": "cpu", "verify": 0}
PULSE = {"object": 1, "t_h": 1.75, "t_v": 0.75, "omega": "3:9:4", "a_h": "2:6:4", "backend": "cpu", "verify": 0}


@pytest.mark.skipif(sys.platform != "linux", reason="names of any bytes")
def test_paths_that_are_no_text(tmp_path):
    folder = Path(os.fsdecode(os.fsencode(tmp_path) + b"/caf\xe9"))
    folder.mkdir()
    t = 0.02 * np.arange(150)
    np.savetxt(folder / "mine.txt", np.column_stack([t, 0.6 * np.sin(12 * t) * np.exp(-t)]))
    (folder / "list.csv").write_text("id,horizontal,units\na,mine.txt,g\n")
    record = {"horizontal": folder / "mine.txt", "units": "g"}
    found = topple.seismic(**BASE, **record)
    path = json.loads(found.attrs["record"])["horizontal"]["path"]
    assert path.startswith("file:/") and path.endswith("/caf%E9/mine.txt")
    # The motion of a cell reads the record again.
    assert found.topple.history(t_h=1, t_v=0.1)["u"].size > 10
    saved = topple.seismic(**BASE, **record, out=folder / "out")
    assert np.array_equal(saved["zeta"].values, found["zeta"].values, equal_nan=True)
    assert (folder / "out" / "map.zarr").is_dir()
    for k in (1, 2):
        assert topple.seismic(**BASE, **record, out=str(folder / "parts"), tile=f"{k}/2") is None
    whole = topple.merge([folder / "parts"], verify=0)
    assert np.array_equal(whole["zeta"].values, found["zeta"].values, equal_nan=True)
    scene = folder / "scene.toml"
    scene.write_text('[block]\nobject = 1\n[base]\nt_h = "1:3:3"\nt_v = 0.5\n[record]\nhorizontal = "mine.txt"\nunits = "g"\n')
    assert topple.run(scene, backend="cpu", verify=0).sizes["t_h"] == 3
    assert topple.suite(folder / "list.csv")["id"].values.tolist() == ["a"]
    asked = {"object": 1, "t_h": "1:3:2", "t_v": 0.5, "u_y": 0.01, "backend": "cpu", "verify": 0}
    topple.envelope(folder / "list.csv", **asked, out=folder / "envelope")


@pytest.mark.parametrize("mine", ["unfinished/thesis", "map.zarr/thesis", "unfinished/zarr.json"])
def test_what_no_run_wrote_is_refused_and_stays(tmp_path, mine):
    path = tmp_path / mine
    path.parent.mkdir()
    path.write_text("mine")
    with pytest.raises(OSError, match="was written by no run and is in the way"):
        topple.pulse(**PULSE, out=tmp_path)
    assert [found for found in tmp_path.rglob("*") if found.is_file()] == [path]
    assert path.read_text() == "mine"
