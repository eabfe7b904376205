"""Tables of the library as datasets: each is the cell of every row, and its columns after the axes."""

from __future__ import annotations

import csv
import io
import os
from typing import Any, Mapping

import numpy as np

from ._dataset import attributes, axes, dataset, described

#: A table: the cell of each row, and by the name of a column its values, its unit and its meaning.
Table = tuple[np.ndarray, Mapping[str, tuple[Any, str, str]]]


def _arrays(table: Table) -> dict[str, tuple[np.ndarray, dict[str, Any]]]:
    """The columns of a table, each with its attributes."""
    return {
        name: (np.asarray(values) if unit else np.array(values, dtype=str), described({"meaning": meaning, "unit": unit}))
        for name, (values, unit, meaning) in table[1].items()
    }


def of_rows(table: Table, about: Mapping[str, Any], key: str) -> Any:
    """A table without axes: each column is a variable over the dimension `key`, whose values are one of the columns."""
    of = {name: ((key,), *column) for name, column in _arrays(table).items()}
    _, names, _ = of.pop(key)
    return dataset(of, {key: names}, attributes(about))


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


def _shape(about: Mapping[str, Any]) -> tuple[int, ...]:
    """The numbers of values of the axes."""
    return tuple(len(about["coordinates"][key]) for key in about["index"])


def _placed(
    table: Table, about: Mapping[str, Any], keys: Mapping[str, list[Any]]
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """The columns of a table as arrays over the axes and over `keys`, whose values are given. The cell of a row and the columns
    of the keys say where it lies, for a cell may have fewer rows than others; where there is none is no number."""
    columns = _arrays(table)
    dims = (*about["index"], *keys)
    shape = (*_shape(about), *map(len, keys.values()))
    at = [*np.unravel_index(table[0], _shape(about))]
    for key, known in keys.items():
        place = {value: place for place, value in enumerate(known)}
        at.append(np.array([place[value] for value in columns[key][0].tolist()], dtype=int))
    flat = np.ravel_multi_index(at, shape)
    if len(np.unique(flat)) != len(flat):
        raise RuntimeError(f"{', '.join(dims)}: two rows of a table have the same; a defect of topple, please report it")
    data_vars = {}
    for name, (values, attrs) in columns.items():
        if name not in keys:
            full = np.full(shape, np.nan) if values.dtype.kind == "f" else np.full(shape, "", dtype=values.dtype)
            full.flat[flat] = values
            data_vars[name] = (dims, full, attrs)
    return data_vars, dims


def of_cells(tables: list[Table], about: Mapping[str, Any]) -> Any:
    """Tables with one row per cell: each axis becomes a dimension."""
    data_vars: dict[str, Any] = {}
    for table in tables:
        data_vars |= _placed(table, about, {})[0]
    best = [_told(np.unravel_index(cell, _shape(about)), data_vars, about) for cell in about["best"]]
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
        _, values, attrs = data_vars[name]
        told[f"{name} [{attrs['units']}]"] = float(values[place])
    return told


def _values(column: np.ndarray) -> list[Any]:
    """The values of a key: numbers ascending, names in the order of the rows."""
    values = list(dict.fromkeys(column.tolist()))
    return sorted(values) if column.dtype.kind == "f" else values


def _pivoted(
    table: Table, keys: tuple[str, ...], about: Mapping[str, Any], factor: tuple[str, float] | None
) -> Any:
    """A table whose rows, in each cell, are the combinations of some keys; `factor` is the unit of levels as they were
    given, and what makes SI units of it."""
    columns = _arrays(table)
    known = {key: _values(columns[key][0]) for key in keys}
    data_vars, _ = _placed(table, about, known)
    coords = axes(about) | {key: ((key,), np.array(known[key]), columns[key][1]) for key in keys}
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


def _rows(table: Table, about: Mapping[str, Any]) -> Any:
    """A table as it is, over the dimension `row`, the axes in front."""
    place = dict(zip(about["index"], np.unravel_index(table[0], _shape(about))))
    of = {key: (values[place[key]], attrs) for key, (_, values, attrs) in axes(about).items()}
    return dataset({name: (("row",), *column) for name, column in (of | _arrays(table)).items()}, {}, attributes(about))


def of_fragility(
    tables: Mapping[str, Table], about: Mapping[str, Any], factor: tuple[str, float] | None = None
) -> dict[str, Any]:
    """The tables of a fragility by their names; the points of `vary` have one row each."""
    return {
        name: _pivoted(table, KEYS[name], about, factor) if name in KEYS else _rows(table, about)
        for name, table in tables.items()
    }
