"""Overturning and rocking maps of rigid blocks on an isolated base.

Every call takes the keywords of a scene: the keys of the parameter table (``topple.parameters()``), each a number, a
sequence of numbers, or a range ``"start:stop:count"``. What has several values is an axis. SI units.

>>> import topple
>>> map = topple.pulse(object=1, eccentricity=0.2, t_h=1.75, t_v=0.75, omega="1:9:5", a_h=[2.0, 6.0, 10.0])
>>> map["outcome"].shape
(3, 5)
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from . import _topple
from ._dataset import dataset, described, of_leaves, of_map
from ._dataset import Arrays as Arrays
from ._progress import Bar, Progress, listener
from ._records import taken
from ._tables import of_cells, of_fragility, of_suite

__version__: str = _topple.__version__
__all__ = [
    "envelope", "fragility", "history", "open", "parameters", "pulse", "run", "seismic", "suite",
]


def _finished(hears: Progress | None) -> None:
    if isinstance(hears, Bar):
        hears.close()


def _map(recorded: bool, keywords: dict[str, Any], progress: bool | Progress | None) -> Any:
    hears = listener(progress)
    try:
        columns, about = _topple.sweep(recorded, keywords, hears)
    finally:
        _finished(hears)
    if about is None:
        return None
    if columns is None:
        return open(keywords["out"]).assign_attrs(_attributes(about))
    return of_map(columns, json.loads(about))


def _attributes(about: str) -> dict[str, Any]:
    from ._dataset import attributes

    return attributes(json.loads(about))


def pulse(*, progress: bool | Progress | None = None, **keywords: Any) -> Any:
    """Map the outcomes of pulses.

    Parameters
    ----------
    omega, a_h, ... : float, sequence of float, or str
        Parameters of the scene by their keys; what has several values is an axis.
    object : int, optional
        A block of the paper's Table 1: 1 caryatid, 2 server cabinet, 3 hospital cabinet.
    backend : {"auto", "gpu", "cpu", "reference"}, optional
    precision : {"f32", "f64"}, optional
    step : float, optional
        Largest step, s.
    verify : int or None, optional
        Cells that the reference runs again; 0 for none.
    out : path, optional
        A directory: the map is written there as map.zarr, and opened lazily.
    progress : bool or callable, optional
        False shows nothing; a function is called with (phase, done, total).

    Returns
    -------
    xarray.Dataset
        A variable a column, a dimension an axis, the first axis last: ``[a_h, omega]``. Outcomes and statuses are
        codes with ``flag_meanings``. Without xarray a `topple.Arrays`.

    Raises
    ------
    ValueError
        A keyword that makes no sense, in one line that begins with it.
    OSError
        A directory that cannot be written.

    Examples
    --------
    >>> map = pulse(object=1, t_h=1.75, t_v=0.75, omega=6.0, a_h="2:12:6", verify=0)
    >>> map["zeta"].shape
    (6, 1)
    """
    return _map(False, keywords, progress)


def seismic(*, progress: bool | Progress | None = None, **keywords: Any) -> Any:
    """Map the response to a record of ground motion.

    Parameters
    ----------
    horizontal, vertical : path, array_like, or a trace as obspy's, optional
        Accelerations; of arrays ``units`` is needed and, of arrays that are no traces, ``dt``. Without a record a
        synthetic pair.
    dt : float, optional
        Time between samples, s.
    units : {"g", "m/s2", "cm/s2"}, optional
    **keywords
        As of `pulse`, but for a pulse's own.

    Returns
    -------
    xarray.Dataset
        As of `pulse`.

    Examples
    --------
    >>> map = seismic(object=1, t_h="1:3:3", t_v=[0.2, 0.4], verify=0)
    >>> map["max_u"].dims
    ('t_v', 't_h')
    """
    return _map(True, taken(keywords), progress)


def run(scene: str | os.PathLike[str], *, progress: bool | Progress | None = None, **keywords: Any) -> Any:
    """Run a scene of a TOML file.

    Parameters
    ----------
    scene : path
        The file, as of ``topple run``. Records are looked for beside it.
    **keywords
        How it is run, and parameters in the place of the file's.

    Returns
    -------
    xarray.Dataset
        As of `pulse`.
    """
    path = Path(scene)
    return _map(False, {**keywords, "scene": (path.read_text(encoding="utf-8"), str(path.parent))}, progress)


def history(**keywords: Any) -> Any:
    """Integrate the motion of one cell: every parameter a single number.

    Returns
    -------
    xarray.Dataset
        Variables u, du, v, dv, z, phi, dphi and mode over the dimension ``row``: a row for each step and each switch,
        with its time ``t`` in s. An uplift has two rows of the same time.

    Examples
    --------
    >>> motion = history(object=1, t_h=1.75, t_v=0.75, omega=6.0, a_h=8.0)
    >>> float(abs(motion["phi"]).max()) > 0.01
    True
    """
    recorded = any(key in keywords for key in ("horizontal", "vertical"))
    columns, about = _topple.history(recorded, taken(keywords))
    units = {"u": "m", "du": "m/s", "v": "m", "dv": "m/s", "z": "", "phi": "rad", "dphi": "rad/s", "mode": ""}
    time = columns.pop("t")
    data_vars = {
        name: (("row",), values, {"units": units[name]} if units[name] else {}) for name, values in columns.items()
    }
    return dataset(data_vars, {"t": (("row",), time, {"units": "s"})}, _attributes(about))


def suite(path: str | os.PathLike[str], *, strict: bool = False) -> Any:
    """Read a set of records as one suite.

    Parameters
    ----------
    path : path
        A folder, a zip or a list (CSV) of records.
    strict : bool
        Refuse a suite in which anything is missing or ambiguous.

    Returns
    -------
    xarray.Dataset
        The table of ``topple suite`` over the dimension ``id``: measures, and notes on what was decided.
    """
    os.stat(path)
    return of_suite(_topple.suite(os.fspath(path), strict))


def envelope(suite: str | os.PathLike[str], *, progress: bool | Progress | None = None, **keywords: Any) -> Any:
    """Sweep a scene under every motion of a suite: where the block stands, within which strokes.

    Parameters
    ----------
    suite : path
        A folder, a zip or a list (CSV) of records.
    standing : float, optional
        Share of the motions under which the block must stand.
    limit_u, limit_v : float, optional
        Room for max |u| and the stroke of v, m.
    both_directions, strict : bool, optional
    **keywords
        The scene, as of `pulse`; ``u_y`` or ``yield_force`` in the place of ``alpha_y``.

    Returns
    -------
    xarray.Dataset
        The columns of envelope.csv and zeta.csv; a dimension an axis.
    """
    os.stat(suite)
    hears = listener(progress)
    try:
        tables, about = _topple.envelope({**keywords, "suite": os.fspath(suite)}, hears)
    finally:
        _finished(hears)
    return of_cells([tables["envelope"], tables["zeta"]], json.loads(about))


def fragility(suite: str | os.PathLike[str], *, progress: bool | Progress | None = None, **keywords: Any) -> Any:
    """How likely a block falls under the motions of a suite, by their intensity.

    Parameters
    ----------
    suite : path
        A folder, a zip or a list (CSV) of records.
    im : str, optional
        Intensity measure: pga, pgv, arias, cav, sa:T, avg-sa:T, pga*, pgv*.
    levels : sequence of float or str, optional
        Levels of it that each motion is scaled to, SI units.
    limit_zeta, limit_u, limit_v : float or sequence of float, optional
        Further limit states.
    estimator : str or sequence of str, optional
        stripes, ida, cloud.
    vary : str or sequence of str, optional
        Numbers that are not known: ``"eccentricity=normal(0.1,0.02)"``.
    hazard : path, optional
        A CSV ``level,rate``.
    bootstrap, seed, samples, target, both_directions, strict : optional
    **keywords
        The scene, as of `envelope`.

    Returns
    -------
    dict of xarray.Dataset
        The tables of the command by their names: ``fragility``, ``fits``, ``capacities``, ``rates``, ``sensitivity``.
    """
    os.stat(suite)
    hears = listener(progress)
    try:
        tables, about = _topple.fragility({**keywords, "suite": os.fspath(suite)}, hears)
    finally:
        _finished(hears)
    return of_fragility(tables, json.loads(about))


def open(path: str | os.PathLike[str]) -> Any:
    """Open a map that was written: lazily from map.zarr, else from map.npz; or the leaves of a refined one.

    Parameters
    ----------
    path : path
        A directory of results, or one of these files; leaves.npz for the leaves.

    Returns
    -------
    xarray.Dataset
        As of `pulse`. Of leaves a variable a column over the dimension ``leaf``, with the numbers of their first cells
        (``cell``), ``level``, ``width`` and ``height``; the finest grid's axes are coordinates.
    """
    import numpy as np

    place = Path(path)
    if place.is_dir() and place.suffix != ".zarr":
        names = [name for name in ("map.zarr", "map.npz") if (place / name).exists()]
        if not names:
            raise FileNotFoundError(f"{place}: neither map.zarr nor map.npz is there")
        place = place / names[0]
    if place.suffix == ".zarr":
        import xarray

        return xarray.open_zarr(place, consolidated=False)
    with np.load(place) as arrays:
        about = json.loads(str(arrays["about"]))
        about["coordinates"] = {key: arrays[key] for key in about["axes"]}
        if "counts" in about:
            return of_leaves({name: arrays[name] for name in [*about["counts"], *about["columns"], "proved"]}, about)
        return of_map({name: arrays[name] for name in [*about["columns"], "proved"]}, about)


def parameters() -> list[dict[str, Any]]:
    """The parameters of a scene: key, symbol, unit, meaning, legal and plausible range, default, section."""
    found: list[dict[str, Any]] = json.loads(_topple.parameters())
    return found
