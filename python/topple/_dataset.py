"""Columns as an `xarray.Dataset`, or as arrays with attributes where xarray is not installed."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Mapping

import numpy as np

from ._accessor import register


@dataclass
class Arrays:
    """Arrays with dimensions, coordinates and attributes, in place of a Dataset where xarray is not installed."""

    data_vars: dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, Any]]]
    coords: dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, Any]]]
    attrs: dict[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> np.ndarray:
        """The values of a variable or of a coordinate."""
        return {**self.coords, **self.data_vars}[name][1]

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"{name}: without xarray a result is arrays by name, result[{name!r}]; install xarray for more")

    def __contains__(self, name: object) -> bool:
        return name in self.data_vars or name in self.coords


def dataset(data_vars: Mapping[str, Any], coords: Mapping[str, Any], attrs: Mapping[str, Any]) -> Any:
    """A Dataset; each variable and coordinate is (dimensions, values, attributes)."""
    try:
        import xarray
    except ImportError:
        return Arrays(dict(data_vars), dict(coords), dict(attrs))
    register()
    return xarray.Dataset(dict(data_vars), dict(coords), dict(attrs))


def described(of: Mapping[str, str]) -> dict[str, Any]:
    """Attributes of a quantity: its meaning and its unit."""
    attrs = {"long_name": of["meaning"]}
    if of["unit"]:
        attrs["units"] = of["unit"]
    return attrs


def flags(names: list[str]) -> dict[str, Any]:
    """Attributes of codes: what each means, by the CF conventions."""
    return {"flag_values": list(range(len(names))), "flag_meanings": " ".join(names)}


def attributes(about: Mapping[str, Any]) -> dict[str, Any]:
    """What a result is and how it was made; what is nested is JSON and a truth is 1 or 0, so that every format can store it."""

    def plain(value: Any) -> Any:
        if isinstance(value, bool):
            return int(value)
        return value if isinstance(value, (str, int, float)) else json.dumps(value)

    return {
        key: plain(value)
        for key, value in about.items()
        if value is not None and key not in ("axes", "columns", "coordinates", "counts", "outcome", "status", "index")
    }


def nested(attrs: Mapping[str, Any]) -> dict[str, Any]:
    """Attributes of a Zarr group: the texts of objects and arrays are these again."""

    def parsed(value: Any) -> Any:
        if isinstance(value, str) and value.startswith(("{", "[")):
            try:
                return json.loads(value)
            except ValueError:
                pass
        return value

    return {key: parsed(value) for key, value in attrs.items()}


def of_run(file: Path) -> dict[str, Any]:
    """How a map in a file was computed, from run.json beside it; nothing where that is missing, or of other files."""
    try:
        run = json.loads((file.parent / "run.json").read_text(encoding="utf-8"))
        if file.name not in run["files"]:
            return {}
        method = {key: run[key] for key in ("full_model", "largest_step", "precision", "repair", "resolve")}
        told = {key: run[key] for key in ("backend", "threads")}
        return {**told, "method": method, "sweep_seconds": run["timings"]["sweep"]}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def axes(about: Mapping[str, Any]) -> dict[str, Any]:
    """The coordinates of a grid."""
    units = about.get("axes", {})
    return {
        key: ((key,), np.asarray(values), described(units[key]) if key in units else {})
        for key, values in about["coordinates"].items()
    }


def of_map(columns: Mapping[str, np.ndarray], about: Mapping[str, Any]) -> Any:
    """A map: each column is a variable, each axis a dimension, the first axis last."""
    index = tuple(about["index"])
    shape = tuple(len(about["coordinates"][key]) for key in index)
    reshaped = {name: values.reshape(shape) for name, values in columns.items()}
    return _of_cells(reshaped, index, about["columns"], about)


def of_leaves(columns: Mapping[str, np.ndarray], about: Mapping[str, Any]) -> Any:
    """The leaves of a refined map: each column is a variable over their dimension, with the axes of the finest grid."""
    return _of_cells(columns, tuple(about["index"]), {**about["columns"], **about["counts"]}, about)


def _of_cells(
    columns: Mapping[str, np.ndarray], index: tuple[str, ...], known: Mapping[str, Any], about: Mapping[str, Any]
) -> Any:
    """Columns of cells over their dimensions; `known` has meanings and units."""
    data_vars = {}
    for name, values in columns.items():
        attrs = described(known[name]) if name in known else {}
        if name in ("outcome", "status"):
            attrs |= flags(about[name])
        data_vars[name] = (index, values, attrs)
    return dataset(data_vars, axes(about), attributes(about))
