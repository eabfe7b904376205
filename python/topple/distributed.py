"""Maps on several machines: shards as futures of dask.distributed.

Each worker runs shards of the grid, the client joins them. The arrays are those of a single run, byte for byte. A shard
whose worker dies is run again by another one, as dask does with any future. Workers need this package, and the files of
a record, if it comes in files.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import topple

from . import _topple
from ._help import SECTIONS, known
from ._progress import Progress, heard
from ._records import scene_file, taken

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["pulse", "run", "seismic"]

#: Shards for each thread of the cluster, so that no worker waits long for the last one.
SHARDS = 4


def pulse(client: Client | None = None, **keywords: Any) -> Any:
    """`topple.pulse` on a cluster.

    Parameters
    ----------
    client : distributed.Client, optional
        The cluster; by default the current client.
    tiles : int, optional
        Shards of the grid; by default four for each thread of the cluster.
    out : path, optional
        A directory of this machine: the map is written there as map.zarr, and opened lazily.
    **keywords
        As for `topple.pulse`.

    Returns
    -------
    xarray.Dataset
        As for `topple.pulse`.
    """
    return _map(client, "pulse", False, keywords)


def seismic(client: Client | None = None, **keywords: Any) -> Any:
    """`topple.seismic` on a cluster; see `pulse`."""
    return _map(client, "seismic", True, keywords)


def run(scene: str | os.PathLike[str], client: Client | None = None, **keywords: Any) -> Any:
    """`topple.run` on a cluster; see `pulse`."""
    return _map(client, "run", False, {**keywords, "scene": scene_file(scene)})


def _shard(recorded: bool, keywords: dict[str, Any], shard: str, threads: int) -> dict[str, bytes]:
    """Runs a shard on a worker: its files by their names."""
    with tempfile.TemporaryDirectory(prefix="topple-") as folder:
        # As many threads as the worker was given.
        _topple.sweep(recorded, {"threads": threads, **keywords, "out": folder, "tile": shard}, None)
        files = [path for path in Path(folder).rglob("*") if path.is_file()]
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def _map(client: Client | None, call: str, recorded: bool, keywords: dict[str, Any]) -> Any:
    from distributed import as_completed, get_client

    client = get_client() if client is None else client
    keywords = dict(keywords)
    progress: bool | Progress | None = keywords.pop("progress", None)
    out, tiles = keywords.pop("out", None), keywords.pop("tiles", None)
    verify, sharpness = keywords.pop("verify", None), keywords.pop("sharpness", None)
    for key in ("tile", "resume"):
        if key in keywords:
            raise ValueError(f"{key}: the shards are the cluster's here; leave it out")
    for key in ("refine", "smooth", "vary", "pixel", "samples", "seed"):
        if keywords.get(key) is not None and keywords[key] is not False:
            raise ValueError(f"{key}: not on a cluster; leave it out, or call topple.{call}")
    # What is wrong with the scene is said here, before anything is sent.
    known(call, keywords, SECTIONS[call], "scene")
    keywords = taken(keywords)
    _topple.check(recorded, {**keywords, "verify": verify, "sharpness": sharpness})
    threads = [worker["nthreads"] for worker in client.scheduler_info(n_workers=-1)["workers"].values()]
    count = SHARDS * max(sum(threads), 1) if tiles is None else tiles
    if not isinstance(count, int) or isinstance(count, bool) or count < 1:
        raise ValueError(f"tiles: {tiles} must be a whole number, 1 at least")
    shards = [f"{number}/{count}" for number in range(1, count + 1)]
    one = max(min(threads, default=1), 1)
    place = out and _made(out)
    with tempfile.TemporaryDirectory(prefix="topple-", dir=place, ignore_cleanup_errors=True) as folder:
        # pure=False: a shard that was asked for before is not taken from there, its files are gone.
        futures = client.map(
            lambda shard: _shard(recorded, keywords, shard, one), shards, pure=False, key="topple-tile", batch_size=1
        )
        try:
            with heard(progress) as hears:
                ended = as_completed(futures)  # type: ignore[no-untyped-call, unused-ignore]
                for done, future in enumerate(ended, start=1):
                    for name, content in future.result().items():
                        file = Path(folder, name)
                        file.parent.mkdir(parents=True, exist_ok=True)
                        file.write_bytes(content)
                    future.release()
                    if hears is not None:
                        hears("tiles", done, count)
            return topple.merge([folder], out=out, verify=verify, sharpness=bool(sharpness), progress=progress)
        finally:
            client.cancel(futures)  # type: ignore[no-untyped-call, unused-ignore]


def _made(out: str | os.PathLike[str]) -> Path:
    place = Path(out)
    place.mkdir(parents=True, exist_ok=True)
    return place
