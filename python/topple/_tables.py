"""Tables of the library, which are CSV, as columns."""

from __future__ import annotations

import csv
import io
import os
from typing import Any, Mapping

import numpy as np

from ._dataset import attributes, axes, dataset, described
from ._help import parameters


#: Columns of names, which may look like numbers.
NAMES = ("id", "device", "record", "event", "station", "horizontal", "vertical", "limit_state", "estimator", "parameter")


def _column(name: str, texts: list[str]) -> np.ndarray:
    """Numbers, an empty one not a number; texts where one is none."""
    if name in NAMES:
        return np.array(texts, dtype=str)
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)


def columns(text: str) -> dict[str, np.ndarray]:
    """The columns of a table."""
    names, *rows = csv.reader(io.StringIO(text))
    return {name: _column(name, [row[k] for row in rows]) for k, name in enumerate(names)}


def _attrs(name: str, about: Mapping[str, Any]) -> dict[str, Any]:
    """What is known of a column: its meaning, and of a number its unit."""
    if name in about["columns"]:
        return described(about["columns"][name])
    # Of a number that is not known the value that is drawn.
    entry = parameters().get(name.removeprefix("drawn_"))
    return described({"meaning": f"{entry['meaning']}, as drawn", "unit": entry["unit"] or "1"}) if entry else {}


def of_suite(text: str, about: Mapping[str, Any]) -> Any:
    """A suite: each column is a variable over the dimension `id`."""
    of = {name: (("id",), values, _attrs(name, about)) for name, values in columns(text).items()}
    ids = of.pop("id")
    return dataset(of, {"id": ids}, attributes(about))


def of_devices(text: str, about: Mapping[str, Any]) -> Any:
    """A comparison: each column is a variable over the dimension `device`."""
    of = {name: (("device",), values, _attrs(name, about)) for name, values in columns(text).items()}
    names = of.pop("device")
    return dataset(of, {"device": names}, attributes(about))


def written(devices: Any) -> str:
    """A list of devices as CSV: the text of a file, or what mappings or the rows of a DataFrame have."""
    if isinstance(devices, (str, os.PathLike)):
        with open(devices, encoding="utf-8-sig", newline="") as file:
            return file.read()
    rows = devices.to_dict("records") if hasattr(devices, "to_dict") else devices
    if isinstance(rows, Mapping) or not all(isinstance(row, Mapping) for row in rows):
        raise ValueError("devices: give the path of a list (CSV), a sequence of mappings, or a DataFrame")
    rows = list(rows)
    keys = list(dict.fromkeys(key for row in rows for key in row))
    text = io.StringIO()
    # Within quotes a name may begin with what begins a comment.
    table = csv.writer(text, lineterminator="\n", quoting=csv.QUOTE_ALL)
    table.writerow(keys)
    for row in rows:
        table.writerow([_field(row.get(key)) for key in keys])
    return text.getvalue()


def _field(value: Any) -> str:
    """A value of a device as text; None and what is not a number are left out."""
    # Alone what is not a number differs from itself.
    return "" if value is None or value != value else str(value)


#: By how much of itself the value of an axis in a table may be off: tables have numbers of f32 in the digits of f32.
OFF = 1e-6


def _along(key: str, values: np.ndarray, known: list[float]) -> np.ndarray:
    """The places of values of an axis among those that it has."""
    axis = np.asarray(known, dtype=float)
    order = np.argsort(axis)
    above = np.clip(np.searchsorted(axis[order], values), 1, max(len(axis) - 1, 1))
    ends = [order[above - 1], order[np.minimum(above, len(axis) - 1)]]
    away = [np.abs(axis[end] - values) for end in ends]
    at = np.where(away[0] <= away[1], *ends)
    # Written so that a value that is no number is none of them, either.
    if not np.all(np.abs(axis[at] - values) <= OFF * np.abs(axis[at])):
        raise RuntimeError(f"{key}: a table has a value that the axis has not; a defect of topple, please report it")
    return at


def _placed(
    table: Mapping[str, np.ndarray], about: Mapping[str, Any], keys: Mapping[str, list[Any]]
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """The columns of a table as arrays over the axes and over `keys`, whose values are given. The columns of the axes and
    of the keys say where a row lies, for a cell may have fewer rows than others; where there is none is no number."""
    rows = len(next(iter(table.values())))
    dims = (*about["index"], *keys)
    at, shape = [], []
    for key in about["index"]:
        known = about["coordinates"][key]
        # The end of a run is no column where it is the only one.
        at.append(_along(key, table[key], known) if key in table or len(known) > 1 else np.zeros(rows, dtype=int))
        shape.append(len(known))
    for key, known in keys.items():
        place = {value: place for place, value in enumerate(known)}
        at.append(np.array([place[value] for value in table[key].tolist()], dtype=int))
        shape.append(len(known))
    flat = np.ravel_multi_index(at, shape) if rows else np.array([], dtype=int)
    if len(np.unique(flat)) != rows:
        raise RuntimeError(f"{', '.join(dims)}: two rows of a table have the same; a defect of topple, please report it")
    data_vars = {}
    for name, values in table.items():
        if name not in dims:
            full = np.full(shape, np.nan) if values.dtype.kind == "f" else np.full(shape, "", dtype=values.dtype)
            full.flat[flat] = values
            data_vars[name] = (dims, full, _attrs(name, about))
    return data_vars, dims


def of_cells(tables: list[str], about: Mapping[str, Any]) -> Any:
    """Tables with one row per cell: each axis becomes a dimension."""
    data_vars: dict[str, Any] = {}
    for text in tables:
        data_vars |= _placed(columns(text), about, {})[0]
    shape = tuple(len(about["coordinates"][key]) for key in about["index"])
    best = [_told(np.unravel_index(cell, shape), data_vars, about) for cell in about["best"]]
    return dataset(data_vars, axes(about), attributes({**about, "best": best}))


#: Strokes that are told of the best cells.
STROKES = ("max_u_100", "stroke_v_100")


def _told(place: tuple[Any, ...], data_vars: Mapping[str, Any], about: Mapping[str, Any]) -> dict[str, float]:
    """A cell in words: its axes, the first one first, and its strokes, by names with their units."""
    told = {}
    for key, at in reversed(list(zip(about["index"], place))):
        unit = about["axes"][key]["unit"]
        told[f"{key} [{unit}]" if unit else key] = float(about["coordinates"][key][at])
    for name in STROKES:
        told[f"{name} [{about['columns'][name]['unit']}]"] = float(data_vars[name][1][place])
    return told


def _values(column: np.ndarray) -> list[Any]:
    """The values of a key: numbers ascending, names in the order of the rows."""
    values = list(dict.fromkeys(column.tolist()))
    return sorted(values) if column.dtype.kind == "f" else values


def _pivoted(
    text: str, keys: tuple[str, ...], about: Mapping[str, Any], factor: tuple[str, float] | None
) -> Any:
    """A table whose rows, in each cell, are the combinations of some keys; `factor` is the unit of levels as they were
    given, and what makes SI units of it."""
    table = columns(text)
    known = {key: _values(table[key]) for key in keys}
    data_vars, _ = _placed(table, about, known)
    coords = axes(about) | {key: ((key,), np.array(known[key]), _attrs(key, about)) for key in keys}
    if "level" in keys and factor is not None:
        # In the digits that were given.
        given = [float(f"{level / factor[1]:.12g}") for level in known["level"]]
        coords["level_given"] = (("level",), np.array(given), {"long_name": "level as it was given", "units": factor[0]})
    return dataset(data_vars, coords, attributes(about))


#: By which keys the tables of a fragility are pivoted, beside the axes.
KEYS = {
    "fragility": ("limit_state", "level"),
    "fits": ("limit_state", "estimator"),
    "capacities": ("record",),
    "rates": ("limit_state", "estimator"),
    "sensitivity": ("limit_state", "parameter"),
}


def _rows(text: str, about: Mapping[str, Any]) -> Any:
    """A table as it is, over the dimension `row`."""
    units = about["axes"]
    data_vars = {
        name: (("row",), values, described(units[name]) if name in units else _attrs(name, about))
        for name, values in columns(text).items()
    }
    return dataset(data_vars, {}, attributes(about))


def of_fragility(
    tables: Mapping[str, str], about: Mapping[str, Any], factor: tuple[str, float] | None = None
) -> dict[str, Any]:
    """The tables of a fragility by their names; the points of `vary` have one row each."""
    return {
        name: _pivoted(text, KEYS[name], about, factor) if name in KEYS else _rows(text, about)
        for name, text in tables.items()
    }
