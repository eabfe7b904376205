"""Records as Python has them: files, arrays, traces of other packages."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Mapping

import numpy as np

_UNITS = {"g": 9.81, "m/s2": 1.0, "cm/s2": 0.01, "gal": 0.01}


def _is_file(record: Any) -> bool:
    return isinstance(record, (str, os.PathLike))


def _samples(key: str, record: Any) -> tuple[np.ndarray, float | None, str]:
    """The samples of an array, or of a trace with `data` and `stats` as obspy's, with their step and title."""
    stats = getattr(record, "stats", None)
    if stats is None:
        return np.asarray(record, dtype=float).ravel(), None, key
    title = getattr(record, "id", None) or key
    return np.asarray(record.data, dtype=float).ravel(), float(stats.delta), str(title)


def scene_file(scene: str | os.PathLike[str]) -> tuple[str, str]:
    """The text of a scene's file, and the folder from which files of records are looked for."""
    path = Path(scene)
    return path.read_text(encoding="utf-8"), str(path.parent.absolute())


def taken(keywords: Mapping[str, Any]) -> dict[str, Any]:
    """Keywords in which a record of arrays has become a `motion`; files must be there."""
    keywords = dict(keywords)
    horizontal, vertical = keywords.get("horizontal"), keywords.get("vertical")
    given = [record for record in (horizontal, vertical) if record is not None]
    if not given:
        return keywords
    if all(_is_file(record) for record in given):
        for record in given:
            # A missing file is an OSError, as anywhere in Python.
            os.stat(record)
        return keywords
    if horizontal is None or any(_is_file(record) for record in given):
        raise ValueError("horizontal: give both components as files, or both as arrays")
    dt, units = keywords.pop("dt", None), keywords.pop("units", None)
    if units is None:
        raise ValueError("units: missing; give g, m/s2 or cm/s2 of the arrays")
    if units not in _UNITS:
        raise ValueError(f"units: {units} is not known; give g, m/s2 or cm/s2")
    h, own, title = _samples("horizontal", horizontal)
    own_steps = [own]
    v = None
    if vertical is not None:
        v, other, _ = _samples("vertical", vertical)
        own_steps.append(other)
    steps = {float(step) for step in [*own_steps, dt] if step is not None}
    if len(steps) != 1:
        problem = "the components differ in it; resample one" if steps else "missing; give the time between samples, s"
        raise ValueError(f"dt: {problem}")
    factor = _UNITS[units]
    keywords["motion"] = (
        steps.pop(),
        (factor * h).tolist(),
        None if v is None else (factor * v).tolist(),
        title,
    )
    del keywords["horizontal"]
    keywords.pop("vertical", None)
    return keywords
