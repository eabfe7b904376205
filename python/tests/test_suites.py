"""Suites of the package and of the command have the same tables."""

import csv

import numpy as np
import pytest

import topple

SCENE = {"object": 1, "u_y": 0.02, "t_h": "1:3:4", "t_v": "0.2:0.6:3"}


def flags(numbers):
    return [text for key, value in numbers.items() for text in ("--" + key.replace("_", "-"), str(value))]


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text else np.nan


def test_suite(command, records, tmp_path):
    command("suite", records / "list.csv", "--out", tmp_path)
    found = topple.suite(records / "list.csv")
    table = rows(tmp_path / "suite.csv")
    assert [row["id"] for row in table] == found["id"].values.tolist() == ["one", "two", "three"]
    for name in ("pga_h", "arias", "d5_95"):
        assert np.array_equal([number(row[name]) for row in table], found[name].values, equal_nan=True), name


@pytest.mark.parametrize("precision", ["f32", "f64"])
def test_envelope(command, records, tmp_path, precision):
    limits = {"standing": 0.3, "limit_u": 0.76, "precision": precision, "backend": "cpu"}
    suite = ["--suite", records / "list.csv", "--verify", "none", "--out", tmp_path]
    command("envelope", *flags(SCENE | limits), *suite)
    found = topple.envelope(records / "list.csv", **SCENE, **limits, verify=0)
    assert found["standing"].dims == ("t_v", "t_h")
    for name, table in (("standing", "envelope"), ("max_u_84", "envelope"), ("feasible", "envelope"), ("zeta_100", "zeta")):
        values = [number(row[name]) for row in rows(tmp_path / f"{table}.csv")]
        assert np.array_equal(found[name].values.ravel(), values, equal_nan=True), name
    assert 0 < found["feasible"].values.sum() < found["feasible"].size


def test_fragility(command, records, tmp_path):
    asked = {"levels": "2:14:7", "limit_zeta": 0.5, "bootstrap": 50, "backend": "cpu"}
    suite = ["--suite", records / "list.csv", "--verify", "none", "--out", tmp_path]
    command("fragility", *flags(SCENE | asked), *suite)
    found = topple.fragility(records / "list.csv", **SCENE, **asked, verify=0)
    assert set(found) == {"fragility", "fits", "capacities"}
    fits = found["fits"]
    assert fits["theta"].dims == ("t_v", "t_h", "limit_state", "estimator")
    for row in rows(tmp_path / "fits.csv"):
        at = {"t_h": float(row["t_h"]), "t_v": float(row["t_v"])}
        at |= {"limit_state": row["limit_state"], "estimator": row["estimator"]}
        for name in ("theta", "beta_high", "separable"):
            assert np.array_equal(fits[name].sel(at).item(), number(row[name]), equal_nan=True), (at, name)
    failed = found["fragility"]["failed"]
    for row in rows(tmp_path / "fragility.csv"):
        at = {key: float(row[key]) for key in ("t_h", "t_v", "level")} | {"limit_state": row["limit_state"]}
        assert failed.sel(at).item() == float(row["failed"])
    assert fits["theta"].notnull().any()


def test_names_of_records_stay_names(records):
    lines = (records / "list.csv").read_text().replace("one,", "001,").replace("two,", "1,")
    (records / "numbers.csv").write_text(lines)
    assert topple.suite(records / "numbers.csv")["id"].values.tolist() == ["001", "1", "three"]
    asked = {"levels": "2:14:7", "bootstrap": 50, "backend": "cpu", "verify": 0}
    found = topple.fragility(records / "numbers.csv", **SCENE, **asked)
    assert found["capacities"]["record"].values.tolist() == ["001", "1"]


def test_what_a_suite_refuses(records):
    with pytest.raises(ValueError, match="^suite: give the path"):
        topple.suite([records / "list.csv"])
    with pytest.raises(ValueError, match="^levels: no keyword of this name"):
        topple.envelope(records / "list.csv", **SCENE, levels=[1.0, 2.0])
    with pytest.raises(ValueError, match="^u_y: missing"):
        topple.envelope(records / "list.csv", object=1, t_h=1.0, t_v=0.4)
    with pytest.raises(ValueError, match="^standing: 1.5 must lie"):
        topple.envelope(records / "list.csv", **SCENE, standing=1.5)
    with pytest.raises(ValueError, match="^estimator: ida scales"):
        topple.fragility(records / "list.csv", **SCENE, estimator="ida")
    with pytest.raises(FileNotFoundError):
        topple.suite(records / "nothing")
