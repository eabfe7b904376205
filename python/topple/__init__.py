"""Overturning and rocking maps of rigid blocks on an isolated base.

Every call takes the keywords of a scene: the keys of the parameter table (``topple.parameters()``), each a number, a
sequence of numbers, or a range ``"start:stop:count"``. A keyword with several values is an axis. Units are SI.

>>> import topple
>>> ds = topple.pulse(object=1, eccentricity=0.2, t_h=1.75, t_v=0.75, omega="1:9:5", a_h=[2.0, 6.0, 10.0])
>>> ds["outcome"].shape
(3, 5)
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Sequence

from . import _topple
from ._accessor import register
from ._dataset import attributes, dataset, described, nested, of_leaves, of_map, of_run
from ._dataset import Arrays as Arrays
from ._help import SECTIONS, known, listed
from ._mat import save_mat as save_mat
from ._print import checked_title
from ._progress import Progress, heard
from ._records import factor, scene_file, taken, uncertain
from ._tables import of_cells, of_fragility, of_rows, written

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import AnyCall, CellCall, PulseCall, RecordCall

__version__: str = _topple.__version__
__all__ = [
    "compare", "envelope", "fragility", "history", "merge", "open", "parameters", "pulse", "report", "run",
    "save_mat", "seismic", "suite",
]


#: The columns of a motion.
_MOTION = {
    "t": {"meaning": "time", "unit": "s"},
    "mode": {"meaning": "full_contact, rocking_left or rocking_right, from this time on", "unit": ""},
    "u": {"meaning": "horizontal displacement of the base", "unit": "m"},
    "du": {"meaning": "its velocity", "unit": "m/s"},
    "v": {"meaning": "vertical displacement of the base, from the unloaded spring; attrs have static_deflection", "unit": "m"},
    "dv": {"meaning": "its velocity", "unit": "m/s"},
    "z": {"meaning": "hysteretic variable", "unit": ""},
    "phi": {"meaning": "rocking angle, positive about the left corner", "unit": "rad"},
    "dphi": {"meaning": "its velocity", "unit": "rad/s"},
    "ground_h": {"meaning": "the ground's horizontal acceleration", "unit": "m/s^2"},
    "ground_v": {"meaning": "the ground's vertical acceleration", "unit": "m/s^2"},
    "acc_plate": {"meaning": "absolute horizontal acceleration of the upper plate", "unit": "m/s^2"},
    "acc_plate_v": {"meaning": "its vertical acceleration, without gravity", "unit": "m/s^2"},
    "acc_block": {"meaning": "absolute horizontal acceleration of the block's centre of mass", "unit": "m/s^2"},
    "acc_block_v": {"meaning": "its vertical acceleration, without gravity", "unit": "m/s^2"},
    "n": {"meaning": "normal force between block and base", "unit": "N"},
    "s": {"meaning": "horizontal force between block and base", "unit": "N"},
    "base_load": {"meaning": "vertical force that the base carries", "unit": "N"},
}

#: Numbers of a motion's outcome that its attributes have.
_OUTCOME = ("impacts", "uplifts", "t_end", "t_uplift", "zeta", "max_u", "max_v", "stroke_v", "min_contact", "status")

def _map(recorded: bool, keywords: Mapping[str, Any], progress: bool | Progress | None) -> Any:
    keywords = taken(keywords)
    if uncertain(keywords):
        with heard(progress) as hears:
            shares, told = _topple.probabilities(recorded, keywords, hears)
        return of_map(shares, json.loads(told))
    with heard(progress) as hears:
        columns, about = _topple.sweep(recorded, keywords, hears)
    return _returned(columns, about, keywords.get("out"))


def _returned(columns: Any, about: str | None, out: Any) -> Any:
    if about is None:
        return None
    if columns is None:
        return open(out).assign_attrs(_attributes(about))
    told = json.loads(about)
    return of_leaves(columns, told) if "counts" in told else of_map(columns, told)


def _attributes(about: str) -> dict[str, Any]:
    return attributes(json.loads(about))


@listed(*SECTIONS["pulse"])
def pulse(*, progress: bool | Progress | None = None, **keywords: Unpack[PulseCall]) -> Any:
    """Map the outcomes of pulses.

    Parameters
    ----------
    progress : bool or callable, optional
        False shows nothing; a function is called with (phase, done, total). By default a bar, if tqdm is installed.
    {keywords}

    Returns
    -------
    xarray.Dataset
        Each column is a variable, each axis a dimension, the first axis last: ``[a_h, omega]``. Outcomes and statuses are
        codes with ``flag_meanings``. Without xarray a `topple.Arrays`. With ``vary`` or ``pixel`` the variables are
        the outcomes, each with the share of the samples that has it.

    Raises
    ------
    ValueError
        An invalid keyword, in one line that begins with it.
    OSError
        A directory that cannot be written.

    Examples
    --------
    >>> ds = pulse(object=1, t_h=1.75, t_v=0.75, omega=6.0, a_h="2:12:6", verify=0)
    >>> ds["zeta"].shape
    (6, 1)

    The probability of each outcome where a number is not known:

    >>> unknown = {"eccentricity": "normal(0.1,0.02)"}
    >>> p = pulse(object=1, t_h=1.75, t_v=0.75, omega=6.0, a_h="2:12:6", verify=0, vary=unknown, samples=8)
    >>> p["overturned_left"].shape
    (6, 1)
    """
    known("pulse", keywords, SECTIONS["pulse"])
    return _map(False, keywords, progress)


@listed(*SECTIONS["seismic"])
def seismic(*, progress: bool | Progress | None = None, **keywords: Unpack[RecordCall]) -> Any:
    """Map the response to a record of ground motion.

    Records are files, arrays (which need ``units`` and ``dt``), or traces as obspy's (which need ``units``). Without
    one a synthetic pair shakes the base.

    Parameters
    ----------
    progress : bool or callable, optional
        As for `pulse`.
    {keywords}

    Returns
    -------
    xarray.Dataset
        As for `pulse`.

    Examples
    --------
    >>> ds = seismic(object=1, t_h="1:3:3", t_v=[0.2, 0.4], verify=0)
    >>> ds["max_u"].dims
    ('t_v', 't_h')
    """
    known("seismic", keywords, SECTIONS["seismic"])
    return _map(True, keywords, progress)


def run(scene: str | os.PathLike[str], *, progress: bool | Progress | None = None, **keywords: Unpack[AnyCall]) -> Any:
    """Run a scene of a TOML file.

    Parameters
    ----------
    scene : path
        The file, as for ``topple run``. Records are looked for in its folder.
    **keywords
        How it is run, and parameters that replace those of the file.

    Returns
    -------
    xarray.Dataset
        As for `pulse`.
    """
    known("run", keywords, SECTIONS["run"])
    return _map(False, {**keywords, "scene": scene_file(scene)}, progress)


def merge(
    parts: Sequence[str | os.PathLike[str]],
    *,
    out: str | os.PathLike[str] | None = None,
    verify: int | None = None,
    sharpness: bool = False,
    threads: int | None = None,
    progress: bool | Progress | None = None,
) -> Any:
    """Join the shards of a map that calls with ``tile`` left.

    Parameters
    ----------
    parts : sequence of path
        Their directories.
    out : path, optional
        A directory: the map is written there as map.zarr, and opened lazily.
    verify : int, optional
        Number of cells that the reference computes again; 0 for none.
    sharpness : bool, optional
        Put the sharpness of the boundaries into ``attrs``, as for `pulse`.
    threads : int, optional
        Threads of the CPU; by default as many as it has cores.

    Returns
    -------
    xarray.Dataset
        As for `pulse`.
    """
    if isinstance(parts, (str, os.PathLike)) or not all(isinstance(part, (str, os.PathLike)) for part in parts):
        raise ValueError("parts: give a sequence of the shards' directories")
    place = None if out is None else os.fspath(out)
    keywords = {"out": place, "verify": verify, "sharpness": sharpness, "threads": threads}
    with heard(progress) as hears:
        columns, about = _topple.merge([os.fspath(part) for part in parts], keywords, hears)
    return _returned(columns, about, out)


def report(
    runs: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    out: str | os.PathLike[str],
    *,
    title: str | None = None,
) -> None:
    """Write a report of runs of the command, as ``topple report`` does.

    Parameters
    ----------
    runs : path, or sequence of path
        Directories that commands of topple wrote with ``--out``. What calls of this package return is in no directory.
    out : path
        The report: a name that ends in .html or .pdf.
    title : str, optional
        Title of the report, in the place of that of its runs.

    Raises
    ------
    ValueError
        A directory that holds no run, or a name that is none of a report, in one line.
    OSError
        A place that cannot be written.
    """
    several = [runs] if isinstance(runs, (str, os.PathLike)) else list(runs)
    if not several or not all(isinstance(one, (str, os.PathLike)) for one in several):
        raise ValueError("runs: give the directory of a run, or a sequence of them")
    checked_title(title)
    _topple.report([os.fspath(one) for one in several], os.fspath(out), title)


@listed(*SECTIONS["history"])
def history(*, progress: bool | Progress | None = None, **keywords: Unpack[CellCall]) -> Any:
    """Compute the motion of one cell; every parameter has a single value.

    Parameters
    ----------
    progress : optional
        As for other calls; one cell takes little time.
    {keywords}

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
    known("history", keywords, SECTIONS["history"], "result")
    recorded = any(key in keywords for key in ("horizontal", "vertical"))
    with heard(progress):
        columns, about = _topple.history(recorded, taken(keywords))
    time = columns.pop("t")
    data_vars = {name: (("row",), values, described(_MOTION[name])) for name, values in columns.items()}
    outcome = json.loads(about)["outcome"]
    numbers = {key: outcome[key] for key in _OUTCOME if outcome.get(key) is not None}
    attrs = {**_attributes(about), "outcome": outcome["class"], **numbers}
    return dataset(data_vars, {"t": (("row",), time, described(_MOTION["t"]))}, attrs)


def suite(path: str | os.PathLike[str], *, strict: bool = False, baseline: str | None = None) -> Any:
    """Read a set of records as one suite.

    Parameters
    ----------
    path : path
        A folder, a zip or a list (CSV) of records.
    strict : bool
        Refuse a suite in which a file is missing, ambiguous or unused.
    baseline : str, optional
        none or line: what is subtracted from the velocities of components whose list says nothing of it.

    Returns
    -------
    xarray.Dataset
        The table of ``topple suite`` over the dimension ``id``: measures, with ``units``, and ``notes`` on what was
        decided; the attribute ``unused`` has in JSON why each file that is no part of it is not used.
    """
    table, about = _topple.suite(_suite_path(path), strict, baseline)
    return of_rows(table, json.loads(about), "id")


def envelope(suite: str | os.PathLike[str], *, progress: bool | Progress | None = None, **keywords: Any) -> Any:
    """Sweep a scene under every motion of a suite: find the cells in which the block stands within given strokes.

    Parameters
    ----------
    suite : path
        A folder, a zip or a list (CSV) of records.
    standing : float, optional
        Share of the motions under which the block must stand.
    limit_u, limit_v : float, optional
        Limits of max |u| and of the stroke of v, m.
    best : str, optional
        What makes a feasible cell the best: ``reserve`` (the most steps of the grid from a cell that fails; the default),
        ``stroke_u`` or ``stroke_v`` (the least).
    columns : str or sequence of str, optional
        Columns of a map whose 50, 84 and 100 % are told, too.
    vary : mapping, str or sequence of str, optional
        Numbers that are not known, as of `fragility`: shares are of the motions at all their points.
    samples, seed : int, optional
        How many points these have, and the seed of what is drawn.
    resample : str, optional
        What is drawn for the interval of the share that overturns: event, recording or motion.
    both_directions, strict : bool, optional
    baseline : str, optional
        As of `suite`.
    out : path, optional
        A directory in which each motion is saved when it is done, until the call returns.
    resume : bool, optional
        Go on from what an interrupted call, or calls with ``tile``, left in ``out``.
    tile : str, optional
        Run the shard ``k/n`` of the motions, and leave it in ``out``; the call returns None. The same call with
        ``resume=True`` in the place of ``tile`` joins the shards.
    **keywords
        The scene and how it is run, as of `pulse`; ``u_y`` or ``yield_force`` in the place of ``alpha_y``.

    Returns
    -------
    xarray.Dataset
        The columns of envelope.csv and zeta.csv, with ``units`` and ``long_name``; a dimension an axis. ``attrs["best"]``
        is JSON: the first 20 feasible cells in the order of the command, each its axes and strokes by name and unit.

    Examples
    --------
    >>> import json, pathlib, tempfile
    >>> import numpy as np
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.savetxt(pathlib.Path(folder, "quake.txt"), np.sin(6.0 * np.arange(0.0, 8.0, 0.02)))
    ...     lines = "id,horizontal,vertical,dt,units\\nmade-up,quake.txt,,0.02,m/s2\\n"
    ...     _ = pathlib.Path(folder, "list.csv").write_text(lines)
    ...     ds = envelope(folder, object=1, u_y=0.02, t_h=[1.0, 3.0], t_v=0.4, verify=0)
    >>> ds["max_u_100"].attrs["units"]
    'm'
    >>> list(json.loads(ds.attrs["best"])[0])
    ['t_h [s]', 't_v [s]', 'max_u_100 [m]', 'stroke_v_100 [m]']
    """
    keywords = {**keywords, "suite": _suite_path(suite)}
    with heard(progress) as hears:
        tables, about = _topple.envelope(keywords, hears)
    if tables is None or about is None:
        return None
    return of_cells([tables["envelope"], tables["zeta"]], json.loads(about))


def compare(
    devices: Any, suite: str | os.PathLike[str], *, progress: bool | Progress | None = None, **keywords: Any
) -> Any:
    """Compare devices under every motion of a suite, side by side.

    Parameters
    ----------
    devices : path, sequence of mapping, or DataFrame
        A list (CSV) of devices, or each device as a mapping, or as a row: ``device``, its name, and keys of a scene. What is
        None or not a number is left out.
    suite : path
        A folder, a zip or a list (CSV) of records.
    standing, limit_u, limit_v, both_directions, strict, baseline, resample, seed : optional
        As for `envelope`.
    scales : sequence of float or str, optional
        Factors on the motions for the reserve.
    columns : str or sequence of str, optional
        Columns of a map whose 50, 84 and 100 % are told, too.
    hazard, hazard_units, im, levels, units : optional
        As for `fragility`: gives annual rates of overturning.
    out, resume, tile : optional
        As for `envelope`.
    **keywords
        What all devices share of the scene, and how it is run, as of `pulse`.

    Returns
    -------
    xarray.Dataset
        The columns of compare.csv over the dimension ``device``, with ``units`` and ``long_name``.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import numpy as np
    >>> bases = [{"device": "soft", "t_h": 3.0}, {"device": "stiff", "t_h": 1.0, "xi_h": 0.2}]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.savetxt(pathlib.Path(folder, "quake.txt"), np.sin(6.0 * np.arange(0.0, 8.0, 0.02)))
    ...     lines = "id,horizontal,vertical,dt,units\\nmade-up,quake.txt,,0.02,m/s2\\n"
    ...     _ = pathlib.Path(folder, "list.csv").write_text(lines)
    ...     ds = compare(bases, folder, object=1, u_y=0.02, t_v=0.4, verify=0)
    >>> ds["device"].values.tolist()
    ['soft', 'stiff']
    >>> ds["max_u_100"].attrs["units"]
    'm'
    """
    keywords = {**keywords, "suite": _suite_path(suite), "devices": written(devices)}
    if keywords.get("units") is not None:
        keywords["units"] = factor(keywords["units"])
    with heard(progress) as hears:
        tables, about = _topple.compare(keywords, hears)
    if tables is None or about is None:
        return None
    return of_rows(tables["compare"], json.loads(about), "device")


def fragility(suite: str | os.PathLike[str], *, progress: bool | Progress | None = None, **keywords: Any) -> Any:
    """Estimate how likely a block falls under the motions of a suite, by their intensity.

    Parameters
    ----------
    suite : path
        A folder, a zip or a list (CSV) of records.
    im : str, optional
        Intensity measure: pga, pgv, arias, cav, sa:T, avg-sa:T, pga*, pgv*.
    levels : sequence of float or str, optional
        Levels of the measure to which each motion is scaled, in SI units: m/s² of an acceleration, m/s of a velocity.
    units : str, optional
        Unit of the levels of an acceleration, instead of m/s²: g, m/s2 or cm/s2. The coordinate ``level`` is in m/s²
        all the same; ``level_given`` has the levels as they were given.
    limit_zeta, limit_u, limit_v : float or sequence of float, optional
        Further limit states.
    estimator : str or sequence of str, optional
        stripes, ida, cloud.
    vary : mapping, str or sequence of str, optional
        Numbers that are not known: ``{"eccentricity": "normal(0.1,0.02)"}`` or ``"eccentricity=normal(0.1,0.02)"``.
    hazard : path, optional
        A CSV of levels and annual rates of exceedance, or the curve of a site as OpenQuake exports it.
    hazard_units : str, optional
        Unit of its levels, where they are accelerations: g or m/s2.
    resample : str, optional
        What is drawn for the intervals: event, recording or motion.
    bootstrap, seed, samples, target, both_directions, strict, baseline : optional
        As of the command.
    out, resume, tile : optional
        As for `envelope`.
    **keywords
        The scene, as of `envelope`.

    Returns
    -------
    dict of xarray.Dataset
        The tables of the command by their names: ``fragility``, ``fits``, ``capacities``, ``rates``, ``sensitivity``,
        ``points``. Variables and coordinates have ``units`` and ``long_name``: levels and medians are in the SI unit of
        the measure.
    """
    keywords = {**keywords, "suite": _suite_path(suite)}
    units = keywords.get("units")
    given = None if units is None else (str(units), factor(units))
    if given is not None:
        keywords["units"] = given[1]
    with heard(progress) as hears:
        tables, about = _topple.fragility(keywords, hears)
    if tables is None or about is None:
        return None
    return of_fragility(tables, json.loads(about), given)


def _suite_path(path: Any) -> str:
    if not isinstance(path, (str, os.PathLike)):
        raise ValueError("suite: give the path of a folder, a zip or a list of records (CSV)")
    os.stat(path)
    return str(os.fspath(path))


def open(path: str | os.PathLike[str]) -> Any:
    """Open a map that was written: lazily from map.zarr, else from map.npz; or the leaves of a refined one.

    Parameters
    ----------
    path : path
        A directory of results, or one of these files; leaves.zarr, lazily, or leaves.npz for the leaves.

    Returns
    -------
    xarray.Dataset
        As for `pulse`. Of leaves a variable a column over the dimension ``leaf``, with the numbers of their first cells
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

        register()
        lazy = xarray.open_zarr(place, consolidated=False)
        lazy.attrs = attributes({**nested(lazy.attrs), **of_run(place)})
        return lazy
    if place.suffix != ".npz":
        raise ValueError(f"{place}: give a directory of results, or a map or leaves as .zarr or .npz")
    with np.load(place) as arrays:
        if "about" not in arrays:
            raise ValueError(f"{place}: no map of topple")
        about = json.loads(str(arrays["about"])) | of_run(place)
        about["coordinates"] = {key: arrays[key] for key in about["axes"]}
        columns = [name for name in [*about["columns"], "proved"] if name in arrays]
        if "counts" in about:
            return of_leaves({name: arrays[name] for name in [*about["counts"], *columns]}, about)
        return of_map({name: arrays[name] for name in columns}, about)


def __dir__() -> list[str]:
    return [*__all__, "Arrays", "distributed"]


# Datasets that other calls opened have their ``topple``, too, where xarray is there already; it takes long to load.
if sys.modules.get("xarray") is not None:
    register()


def parameters() -> list[dict[str, Any]]:
    """The parameters of a scene: key, symbol, unit, meaning, source, legal and plausible range, default, section."""
    found: list[dict[str, Any]] = json.loads(_topple.parameters())
    return found
