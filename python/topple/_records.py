"""Records in Python: files, arrays, traces of other packages."""

from __future__ import annotations

import numbers
import os
from decimal import Decimal
from pathlib import Path
from typing import Any, Mapping

import numpy as np

from ._help import parameters

_UNITS = {"g": 9.81, "m/s2": 1.0, "cm/s2": 0.01, "gal": 0.01}


def factor(units: Any) -> float:
    """The factor from these units to m/s^2."""
    name = str(units).strip().lower().replace("**", "").replace("^", "").replace("²", "2")
    name = name.replace("sec", "s").replace("/s/s", "/s2").replace("gals", "gal").rstrip(".")
    if name not in _UNITS:
        raise ValueError(f"units: {units} is not known; give g, m/s2 or cm/s2")
    return _UNITS[name]


def _masked(record: Any) -> int | None:
    """The first sample that numpy has masked, of an array or of a sequence with masked values in it."""
    if isinstance(record, np.ma.MaskedArray):
        # The mask of a structure is one, too; no structure is a record.
        hidden = np.flatnonzero(np.ma.getmaskarray(record)) if record.dtype.names is None else np.array([], dtype=int)
        return int(hidden[0]) if hidden.size else None
    if isinstance(record, (list, tuple)):
        return next((k for k, value in enumerate(record) if np.ma.is_masked(value)), None)
    return None


def _are_numbers(values: np.ndarray) -> bool:
    """True of real numbers, and of objects that each are one: truths, texts and times could be made numbers, too."""
    if values.dtype.kind == "O":
        return all(isinstance(value, (numbers.Real, Decimal)) and not isinstance(value, bool) for value in values.flat)
    return values.dtype.kind in "iuf"


def _checked(key: str, record: Any) -> np.ndarray:
    """Samples of one component."""
    hidden = _masked(record)
    if hidden is not None:
        raise ValueError(f"{key}: sample {hidden} is masked; fill the gaps, as filled(0.0) does, or cut the record")
    try:
        values = np.asarray(record)
        if not _are_numbers(values):
            raise TypeError
        samples = values.astype(float)
    except (TypeError, ValueError):
        raise ValueError(f"{key}: no array of numbers; give a path, an array or a trace") from None
    if sum(length > 1 for length in samples.shape) > 1:
        raise ValueError(f"{key}: an array of shape {samples.shape}; give the samples of one component")
    samples = samples.ravel()
    wrong = np.flatnonzero(~np.isfinite(samples))
    if wrong.size:
        raise ValueError(f"{key}: sample {wrong[0]} is no finite number")
    return samples


def _plausible(keywords: Mapping[str, Any], peak: float, units: Any) -> None:
    """Refuses a motion so strong that its units must be others. What a factor makes of it is judged with the scene."""
    highest = parameters()["pga"]["plausible"][1]
    scale = np.abs(np.atleast_1d(keywords["scale"])).max() if _is_number(keywords.get("scale")) else 1.0
    scaled = peak * scale if scale < 1.0 else peak
    if scaled > highest and "pga" not in keywords and not keywords.get("force"):
        raise ValueError(f"units: in {units} the peak is {peak:.4g} m/s2, which is not plausible; give others, or force=True")


def _is_number(value: Any) -> bool:
    return value is not None and np.asarray(value).dtype.kind in "iuf"


def _no_path(key: str, record: Any) -> None:
    """Refuses a file that is open, and the bytes of one."""
    if hasattr(record, "read") or isinstance(record, (bytes, bytearray, memoryview)):
        what = "an open file" if hasattr(record, "read") else "bytes"
        raise ValueError(f"{key}: {what} is not read; give a path (str or Path)")


def _is_file(record: Any) -> bool:
    return isinstance(record, (str, os.PathLike))


def _step(delta: float) -> float:
    """The step of a trace: where it was kept as a float of 32 bits, the decimal number that was meant."""
    short = np.float32(delta)
    return float(str(short)) if float(short) == delta else float(delta)


def _component(key: str, record: Any) -> tuple[np.ndarray, float | None, str, tuple[str, str, float] | None]:
    """The samples of an array, or of a trace with `data` and `stats` as obspy's, with their step, title and origin."""
    stats = getattr(record, "stats", None)
    if stats is None:
        return _checked(key, record), None, key, None
    if np.ma.is_masked(record.data):
        raise ValueError(f"{key}: the trace has gaps; fill them, as merge(fill_value=0) does, or cut it")
    title = getattr(record, "id", None) or key
    codes = (str(getattr(stats, code, "") or "") for code in ("network", "station", "location"))
    begin = getattr(stats, "starttime", None)
    start = float(getattr(begin, "timestamp", "nan"))
    station = ".".join(code for code in codes if code)
    origin = (station, str(getattr(stats, "channel", "") or ""), start)
    return _checked(key, record.data), _step(float(stats.delta)), str(title), origin


def _own_units(records: list[Any]) -> str | None:
    """The units that all traces have among their `stats`, as some readers put them there."""
    found = {str(getattr(getattr(record, "stats", None), "units", None) or "") for record in records}
    return found.pop() or None if len(found) == 1 else None


def _traces(record: Any) -> list[Any] | None:
    """The traces of a stream as obspy's; None of anything else."""
    traces = getattr(record, "traces", None)
    return traces if isinstance(traces, list) and not hasattr(record, "stats") else None


def _one(key: str, traces: list[Any]) -> Any:
    """The only trace of a component."""
    if len(traces) != 1:
        names = ", ".join(str(trace.id) for trace in traces) or "none"
        raise ValueError(f"{key}: a stream must have one {key} trace, here are {names}; select one, or merge them")
    return traces[0]


def _of_streams(horizontal: Any, vertical: Any) -> tuple[Any, Any]:
    """Traces in the place of streams; that of the horizontal component may hold the vertical one, too."""
    first, second = _traces(horizontal), _traces(vertical)
    if first is not None and vertical is None:
        second = [trace for trace in first if _is_vertical(trace)] or None
        first = [trace for trace in first if not _is_vertical(trace)]
    return (
        horizontal if first is None else _one("horizontal", first),
        vertical if second is None else _one("vertical", second),
    )


def _is_vertical(trace: Any) -> bool:
    """True of a channel whose code ends with Z, as the codes of SEED do."""
    return str(getattr(trace.stats, "channel", "")).upper().endswith("Z")


def scene_file(scene: str | os.PathLike[str]) -> tuple[str, str]:
    """The text of a scene's file, and the folder from which files of records are looked for."""
    path = Path(scene)
    return path.read_text(encoding="utf-8"), str(path.parent.absolute())


def taken(keywords: Mapping[str, Any]) -> dict[str, Any]:
    """Keywords in which a record of arrays has become a `motion`; files must be there."""
    keywords = dict(keywords)
    horizontal, vertical = _of_streams(keywords.get("horizontal"), keywords.get("vertical"))
    given = [record for record in (horizontal, vertical) if record is not None]
    if not given:
        return keywords
    for key, record in (("horizontal", horizontal), ("vertical", vertical)):
        _no_path(key, record)
    if all(_is_file(record) for record in given):
        for key in ("horizontal", "vertical"):
            record = keywords.get(key)
            if record is not None:
                # A missing file is an OSError, as anywhere in Python.
                os.stat(record)
                keywords[key] = os.fsdecode(record)
        return keywords
    if horizontal is None or any(_is_file(record) for record in given):
        raise ValueError("horizontal: give both components as files, or both as arrays")
    dt, units = keywords.pop("dt", None), keywords.pop("units", None)
    own = _own_units(given)
    if units is None and own is None:
        raise ValueError("units: missing; give g, m/s2 or cm/s2 of the arrays")
    scale = factor(own if units is None else units)
    if own is not None and factor(own) != scale:
        raise ValueError(f"units: the trace's are {own}, {units} is given; leave units out")
    if dt is not None and (not _is_number(dt) or np.ndim(dt) > 0 or np.ma.is_masked(dt)):
        raise ValueError("dt: give the time between samples, s")
    components: list[Any] = []
    for key, record in (("horizontal", horizontal), ("vertical", vertical)):
        if record is None:
            components.append(None)
            continue
        samples, step, title, origin = _component(key, record)
        if step is None and dt is None:
            raise ValueError("dt: missing; give the time between samples, s")
        if step is not None and dt is not None and abs(step - dt) > 1e-6 * step:
            raise ValueError(f"dt: the trace's is {step} s, {dt} s is given; leave dt out")
        if key == "horizontal":
            _plausible(keywords, scale * float(np.abs(samples).max(initial=0.0)), own if units is None else units)
        components.append((float(dt) if step is None else step, samples.tolist(), title, origin))
    keywords["motion"] = (*components, scale, bool(keywords.get("force")), keywords.get("baseline"))
    del keywords["horizontal"]
    keywords.pop("vertical", None)
    return keywords


def uncertain(keywords: dict[str, Any]) -> bool:
    """True if keywords have numbers that are not known; a mapping in them becomes a dict."""
    if isinstance(keywords.get("vary"), Mapping):
        keywords["vary"] = dict(keywords["vary"])
    vary = keywords.get("vary")
    if keywords.get("pixel") or (vary is not None and (not hasattr(vary, "__len__") or len(vary) > 0)):
        return True
    for key in ("samples", "seed"):
        if keywords.get(key) is not None:
            raise ValueError(f"{key}: means nothing where all is known; give vary or pixel, too")
    return False
