"""Shards on a cluster give the map of a single run."""

import filecmp
import os
import signal
import sys
import threading
import time

import numpy as np
import pytest

import topple

distributed = pytest.importorskip("distributed", reason="distributed is not installed: no cluster")
import topple.distributed  # noqa: E402

SCENE = {"object": 1, "eccentricity": 0.2, "t_h": 1.75, "t_v": 0.75, "omega": "0.2:15:120", "a_h": "0.1:15:110", "backend": "cpu"}


@pytest.fixture(scope="module")
def client():
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1")
    with cluster, distributed.Client(cluster) as client:
        yield client


def equal(one, other):
    for name in one.data_vars:
        a, b = one[name].values, other[name].values
        assert a.dtype == b.dtype and a.tobytes() == b.tobytes(), name
    assert one.attrs["scene"] == other.attrs["scene"]


@pytest.mark.parametrize("precision", ["f32", "f64"])
def test_shards_are_the_map(client, precision):
    whole = topple.pulse(**SCENE, precision=precision, verify=16)
    told = []
    joined = topple.distributed.pulse(
        client, **SCENE, precision=precision, tiles=7, verify=16, progress=lambda *now: told.append(now)
    )
    equal(whole, joined)
    assert ("tiles", 7, 7) in told
    assert joined.attrs["verification"].split('"seconds"')[0] == whole.attrs["verification"].split('"seconds"')[0]


def test_on_disk_they_are_the_files_of_a_single_run(client, tmp_path):
    whole = topple.pulse(**SCENE, verify=0, out=tmp_path / "whole")
    joined = topple.distributed.pulse(client, **SCENE, verify=0, out=tmp_path / "joined")
    equal(whole, joined)
    files = [path.relative_to(tmp_path / "whole") for path in (tmp_path / "whole").rglob("*") if path.is_file()]
    found = [path.relative_to(tmp_path / "joined") for path in (tmp_path / "joined").rglob("*") if path.is_file()]
    assert len(files) > 10 and sorted(files) == sorted(found)
    # The chunks' files carry the mark of the run that wrote them; what they hold is compared above.
    for file in files:
        if file.name == "zarr.json":
            assert filecmp.cmp(tmp_path / "whole" / file, tmp_path / "joined" / file, shallow=False), file


def test_a_record_in_arrays(client):
    t = np.arange(0.0, 8.0, 0.01)
    ground = 4.0 * np.sin(6.0 * t) * np.exp(-(((t - 3.0) / 1.5) ** 2))
    record = {"horizontal": ground, "vertical": 0.4 * ground, "dt": 0.01, "units": "m/s2"}
    scene = {"object": 1, "t_h": "0.5:4:20", "t_v": "0.2:2:20", "backend": "cpu", "verify": 0}
    equal(topple.seismic(**record, **scene), topple.distributed.seismic(client, **record, **scene, tiles=3))


@pytest.mark.skipif(sys.platform == "win32", reason="no signal kills a worker there")
def test_the_shard_of_a_killed_worker_is_run_again(client):
    # The reference takes some seconds for these, so that the worker dies in the middle of a shard.
    scene = SCENE | {"omega": "0.2:15:60", "a_h": "0.1:15:60", "backend": "reference"}
    pid = next(iter(client.run(os.getpid).values()))
    killed = threading.Timer(0.5, os.kill, (pid, signal.SIGKILL))
    began = time.perf_counter()
    killed.start()
    joined = topple.distributed.pulse(client, **scene, verify=0, tiles=4)
    assert time.perf_counter() - began > 0.5, "the map was done before the worker was killed"
    assert pid not in client.run(os.getpid).values()
    equal(topple.pulse(**scene, verify=0), joined)


def test_what_is_wrong_is_said_before_anything_is_sent(client):
    with pytest.raises(ValueError, match="^t_h: -1 must be"):
        topple.distributed.pulse(client, **(SCENE | {"t_h": -1}))
    with pytest.raises(ValueError, match="^tile: "):
        topple.distributed.pulse(client, **SCENE, tile="1/2", out="x")
    with pytest.raises(ValueError, match="^tiles: 0"):
        topple.distributed.pulse(client, **SCENE, tiles=0)
