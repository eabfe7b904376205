"""Tables of the library, which are CSV, as columns."""

from __future__ import annotations

import csv
import io
from typing import Any, Mapping

import numpy as np

from ._dataset import attributes, axes, dataset, described
from ._help import parameters


#: Columns of names, which may look like numbers.
NAMES = ("id", "record", "event", "station", "horizontal", "vertical", "limit_state", "estimator", "parameter")


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
    """A suite: a dimension `id`, a variable a column."""
    of = {name: (("id",), values, _attrs(name, about)) for name, values in columns(text).items()}
    ids = of.pop("id")
    return dataset(of, {"id": ids}, attributes(about))


def of_cells(tables: list[str], about: Mapping[str, Any]) -> Any:
    """Tables with a row a cell: a dimension an axis."""
    index = tuple(about["index"])
    shape = tuple(len(about["coordinates"][key]) for key in index)
    data_vars: dict[str, Any] = {}
    for text in tables:
        for name, values in columns(text).items():
            if name not in about["coordinates"]:
                data_vars[name] = (index, values.reshape(shape), _attrs(name, about))
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


def _pivoted(
    text: str, keys: tuple[str, ...], about: Mapping[str, Any], factor: tuple[str, float] | None
) -> Any:
    """A table whose rows, in each cell, are the combinations of some keys; `factor` is the unit of levels as they were
    given, and what makes SI units of it."""
    table = columns(text)
    index = tuple(about["index"])
    sides = [len(about["coordinates"][key]) for key in index]
    # In the order of the rows; the values of a later key are the same under every earlier one.
    known = {key: list(dict.fromkeys(table[key].tolist())) for key in keys}
    shape = tuple(sides) + tuple(len(known[key]) for key in keys)
    places = [{value: place for place, value in enumerate(known[key])} for key in keys]
    rows = len(table[keys[0]])
    each = rows // max(int(np.prod(sides)), 1)
    at = [np.arange(rows) // each]
    at += [np.array([place[value] for value in table[key].tolist()]) for key, place in zip(keys, places)]
    flat = np.ravel_multi_index(at, (int(np.prod(sides)), *shape[len(sides) :]))
    data_vars: dict[str, Any] = {}
    for name, values in table.items():
        if name in about["coordinates"] or name in keys:
            continue
        full = np.full(shape, np.nan) if values.dtype.kind == "f" else np.full(shape, "", dtype=values.dtype)
        full.flat[flat] = values
        data_vars[name] = (index + keys, full, _attrs(name, about))
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
    """The tables of a fragility by their names; of points that are drawn a row each."""
    return {
        name: _pivoted(text, KEYS[name], about, factor) if name in KEYS else _rows(text, about)
        for name, text in tables.items()
    }
