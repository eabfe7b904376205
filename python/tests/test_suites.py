"""Suites of the package and of the command have the same tables."""

import contextlib
import csv
import json

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


def test_what_was_decided_of_each_file_is_told(command, records, tmp_path):
    folder = tmp_path / "records"
    folder.mkdir()
    for name, as_name, way in (("synthetic_h.at2", "one.txt", "090"), ("synthetic_v.at2", "two.txt", "DOWN")):
        text = (records / name).read_text().split("\n")
        text[1] = f"A Quake, 1/2/2003, A Station, {way}"
        (folder / as_name).write_text("\n".join(text))
    (folder / "notes.txt").write_text("mine")
    (folder / "page.html").write_text("<html><body>Login")
    command("suite", folder, "--out", tmp_path / "out")
    found = topple.suite(folder)
    assert found["id"].values.tolist() == ["one.txt"] and found["vertical"].values.tolist() == ["two.txt"]
    (told,) = found["notes"].values.tolist()
    assert "paired by what the files state, station A Station" in told and "turned over" in told
    assert [row["notes"] for row in rows(tmp_path / "out" / "suite.csv")] == [told]
    unused = json.loads(found.attrs["unused"])
    assert unused == json.loads((tmp_path / "out" / "run.json").read_text())["unused"]
    assert list(unused) == ["notes.txt", "page.html"] and "a web page" in unused["page.html"]
    with pytest.raises(ValueError, match="2 files are not used"):
        topple.suite(folder, strict=True)


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


def placed(found, table, keys):
    """Every row of a table is where its axes and keys say, and elsewhere there is nothing."""
    names = [name for name in table[0] if name not in (*found.coords, *keys)]
    for row in table:
        at = {key: float(row[key]) if found[key].dtype.kind == "f" else row[key] for key in found.dims if key in row}
        for name in names:
            there = found[name].sel(at, method=None).item()
            assert np.array_equal(there, number(row[name]), equal_nan=True), (at, name, there)
    for name in names:
        assert int(found[name].notnull().sum()) == sum(row[name] != "" for row in table), name


def test_rows_are_placed_by_their_columns_where_cells_have_fewer(command, tmp_path):
    """A base without stiffness after yielding and without a damper goes as far as the numbers do, and of the run nothing is
    known: it is no row of the strongest level."""
    push = [0.0, *[1.0] * 50, *[-0.2] * 250]
    (tmp_path / "push.txt").write_text("\n".join(map(str, push)) + "\n")
    (tmp_path / "list.csv").write_text("id,horizontal,vertical,dt,units\npush,push.txt,,0.1,m/s2\n")
    base = {"object": 1, "isolation": "horizontal", "t_h": 20, "u_y": 10, "xi_h": 0, "psi": "0,1"}
    asked = base | {"levels": "0.2,2,10000", "bootstrap": 40, "backend": "cpu"}
    out = tmp_path / "out"
    command("fragility", *flags(asked), "--both-directions", "--force", "--suite", tmp_path / "list.csv", "--verify", "none", "--out", out)
    table = rows(out / "fragility.csv")
    assert [(row["psi"], row["level"]) for row in table if row["limit_state"] == "overturning"] == [
        ("0.0", "0.2"), ("0.0", "2.0"), ("1.0", "0.2"), ("1.0", "2.0"), ("1.0", "10000.0"),
    ]
    found = topple.fragility(tmp_path / "list.csv", **asked, both_directions=True, force=True, verify=0)
    for name, keys in (("fragility", ("limit_state", "level")), ("fits", ("limit_state", "estimator")), ("capacities", ("record",))):
        placed(found[name], rows(out / f"{name}.csv"), keys)
    assert found["fragility"]["level"].values.tolist() == [0.2, 2.0, 10000.0]


def test_rows_are_placed_by_their_cells_in_any_order():
    """The tables of two axes, whose rows are shuffled, and some of which are not there."""
    from topple import _tables

    def number(*values):
        return np.array(values, dtype=float), "1", ""

    # The cells of the first axis follow each other.
    about = {"index": ["t_v", "t_h"], "coordinates": {"t_h": [3.0, 0.1, 2.0], "t_v": [0.5, 0.25]}, "best": []}
    for seed in range(20):
        order = np.random.default_rng(seed).permutation(6)[: 6 - seed % 3]
        ones = number(*np.ones(len(order)))
        table = {"standing": number(*10.0 * order), "max_u_100": ones, "stroke_v_100": ones}
        found = _tables.of_cells([(order, table)], about)["standing"].values
        expected = np.array([10.0 * k if k in order else np.nan for k in range(6)]).reshape(2, 3)
        assert np.array_equal(found, expected, equal_nan=True)
        levels = number(*7.0 - np.arange(len(order)))
        states = (["uplift"] * len(order), "", "")
        counts = _tables.of_fragility({"fragility": (order, {"limit_state": states, "level": levels, "failed": number(*10.0 * order)})}, about)
        counts = counts["fragility"]
        assert counts["level"].values.tolist() == sorted(levels[0])
        for k, cell in enumerate(order):
            there = counts["failed"].sel(limit_state="uplift", level=7 - k).isel(t_v=cell // 3, t_h=cell % 3)
            assert there.item() == 10.0 * cell
        assert int(counts["failed"].notnull().sum()) == len(order)
    with pytest.raises(RuntimeError, match="defect"):
        _tables.of_cells([(np.array([1, 1]), {"standing": number(1.0, 2.0)})], about)


def units(dataset):
    """The units of the numbers of a Dataset; each has one."""
    numbers = {name: of for name, of in dataset.variables.items() if of.dtype.kind in "fiu" and name != "row"}
    assert all(of.attrs["long_name"] for of in numbers.values()), numbers
    return {name: of.attrs.get("units") for name, of in numbers.items()}


def test_every_number_has_a_unit(records):
    suite = units(topple.suite(records / "list.csv"))
    assert suite["pga_h"] == "m/s²" and suite["arias"] == "m/s" and None not in suite.values()
    found = topple.envelope(records / "list.csv", **SCENE, standing=0.3, verify=0, backend="cpu", best="stroke_u")
    envelope = units(found)
    assert envelope["max_u_84"] == "m" and envelope["zeta_50"] == "1" and envelope["t_h"] == "s" and None not in envelope.values()
    best = json.loads(found.attrs["best"])
    cell = found.sel(t_h=best[0]["t_h [s]"], t_v=best[0]["t_v [s]"])
    assert cell["feasible"] == 1.0
    assert best[0]["max_u_100 [m]"] == cell["max_u_100"].item() == found["max_u_100"].where(found["feasible"] > 0).min().item()
    (records / "site.csv").write_text("level,rate\n0.5,0.05\n20,0.0001\n")
    asked = {"backend": "cpu", "verify": 0, "bootstrap": 50, "hazard": records / "site.csv"}
    vary = {"eccentricity": "normal(0.1,0.02)"}
    for more, unit in (
        ({"levels": "2:14:7"}, "m/s²"),
        ({"im": "pgv", "levels": "0.2:3:7"}, "m/s"),
        ({"im": "pga*", "levels": "0.5:9:5"}, "1"),
        ({"levels": "2:14:7", "vary": vary, "samples": 4}, "m/s²"),
    ):
        study = topple.fragility(records / "list.csv", **(SCENE | {"t_h": 2.0, "t_v": 0.4}), **asked, **more)
        told = {name: units(table) for name, table in study.items()}
        assert all(None not in of.values() for of in told.values()), told
        assert told["fragility"]["level"] == told["fits"]["theta"] == unit
        assert told["rates"]["rate"] == told["rates"]["missing_below"] == "1/year"
        # Where there is a rate, what may be missing has a bound.
        known = study["rates"]["rate"].notnull()
        assert study["rates"]["missing_below"].where(known).notnull().equals(known)
        assert ("capacities" in told) != ("points" in told)
    assert told["points"]["drawn_eccentricity"] == "1" and "sensitivity" in told


def test_a_hazard_curve_that_begins_late_is_below_no_target(records):
    """Two motions overturn the block from one level on: a step at theta, below the first level of the curve."""
    (records / "late.csv").write_text("level,rate\n10,0.0001\n20,0.00001\n")
    asked = {"backend": "cpu", "verify": 0, "bootstrap": 50, "estimator": "stripes", "hazard": records / "late.csv", "target": 0.0002}
    study = topple.fragility(records / "list.csv", **(SCENE | {"t_h": 2.0, "t_v": 0.4}), **asked, levels="2:14:7")
    one = {"limit_state": "overturning", "estimator": "stripes"}
    fit, rate = (study[name].sel(one).squeeze() for name in ("fits", "rates"))
    assert fit["separable"] == 1 and fit["theta"] < 10.0
    # The rate grows tenfold from level to half of it. The step is nowhere below the last level at which nothing fails, 6; a curve that begins
    # there, which the upper bound allows, too, misses more.
    step = 1e-4 * ((10.0 / 6.0) ** np.log2(10.0) - 1.0)
    assert fit["theta"] > 6.0 and rate["rate"].item() == pytest.approx(9e-5) and rate["missing_below"].item() > step
    assert rate["rate"] + rate["missing_above"] < 2e-4 and rate["below_target"] == 0


def test_a_hazard_curve_in_g_is_read_in_g(records):
    (records / "site.csv").write_text("level,rate\n0.05,0.05\n2,0.0001\n")
    scene = SCENE | {"t_h": 2.0, "t_v": 0.4, "backend": "cpu", "verify": 0}
    asked = {"levels": "2:14:7", "estimator": "stripes", "bootstrap": 50, "hazard": records / "site.csv"}
    with pytest.warns(UserWarning, match="nothing tells the unit of its levels, m/s2 is taken"):
        assumed = topple.fragility(records / "list.csv", **scene, **asked)["rates"]["rate_empirical"]
    in_g = topple.fragility(records / "list.csv", **scene, **asked, hazard_units="g", resample="motion")["rates"]
    assert (in_g["rate_empirical"] > assumed).all()
    with pytest.raises(ValueError, match="^hazard_units: .* give hazard, too"):
        topple.fragility(records / "list.csv", **scene, levels="2:14:7", hazard_units="g")
    for key, value in (("hazard_units", "ft"), ("resample", "day")):
        with pytest.raises(ValueError, match=f"^{key}: {value} is not known"):
            topple.fragility(records / "list.csv", **scene, **asked, **{key: value})
    for heading, said in (("PGA [g],PoE50", "line 1, column PoE50: says no annual rate"), ("PSA [g],rate", "these are no levels of pga")):
        (records / "site.csv").write_text(f"{heading}\n0.05,0.05\n2,0.0001\n")
        with pytest.raises(ValueError, match=f"^hazard: .*{said}"):
            topple.fragility(records / "list.csv", **scene, **asked)


def test_levels_in_g(records):
    scene = SCENE | {"t_h": 2.0, "t_v": 0.4}
    asked = {"bootstrap": 50, "backend": "cpu", "verify": 0}
    in_g = topple.fragility(records / "list.csv", **scene, **asked, levels=[0.3, 0.6, 1.2], units="g")
    in_si = topple.fragility(records / "list.csv", **scene, **asked, levels=[0.3 * 9.81, 0.6 * 9.81, 1.2 * 9.81])
    given = in_g["fragility"]["level_given"]
    assert given.values.tolist() == [0.3, 0.6, 1.2] and given.attrs["units"] == "g"
    assert in_g["fragility"]["level"].attrs["units"] == "m/s²"
    for name, table in in_si.items():
        assert in_g[name].drop_vars("level_given", errors="ignore").equals(table), name
    with pytest.raises(ValueError, match="^units: pgv is no acceleration; its levels are in m/s$"):
        topple.fragility(records / "list.csv", **scene, **asked, im="pgv", levels=[1.0, 2.0], units="g")


@pytest.mark.parametrize("call", [topple.envelope, topple.fragility])
def test_parts_are_joined(records, tmp_path, call):
    asked = SCENE | {"backend": "cpu", "verify": 0}
    if call is topple.fragility:
        asked |= {"levels": "2:14:4", "bootstrap": 50}
    whole = call(records / "list.csv", **asked)
    for k in (1, 2):
        assert call(records / "list.csv", **asked, out=tmp_path, tile=f"{k}/2") is None
    assert len(list((tmp_path / "motions").iterdir())) >= 2
    with pytest.raises(OSError, match="holds an unfinished run"):
        call(records / "list.csv", **asked, out=tmp_path)
    with pytest.raises(ValueError, match="^resume: the directory holds motions of another run"):
        call(records / "list.csv", **(asked | {"xi_h": 0.1}), out=tmp_path, resume=True)
    joined = call(records / "list.csv", **asked, out=tmp_path, resume=True, threads=1)
    for name in whole:
        assert joined[name].equals(whole[name]), name
    assert not (tmp_path / "motions").exists()
    with pytest.raises(ValueError, match="^out: missing"):
        call(records / "list.csv", **asked, resume=True)


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
    for alien in ({"omega": 3.0}, {"shape": "one-cosine"}, {"horizontal": "a.at2"}, {"dt": 0.01}):
        [key] = alien
        for call in (topple.envelope, topple.fragility):
            with pytest.raises(ValueError, match=f"^{key}: the motions of the suite shake the base"):
                call(records / "list.csv", **SCENE, **alien)
    for key, other in (("samples", "vary"), ("target", "hazard")):
        with pytest.raises(ValueError, match=f"^{key}: .* give {other}, too"):
            topple.fragility(records / "list.csv", **SCENE, **{key: 8}, levels=[1.0, 2.0])
    with pytest.raises(ValueError, match="^units: .* give levels, too"):
        topple.fragility(records / "list.csv", **SCENE, units="g")
    # An envelope has further columns, of numbers alone.
    columns = {topple.envelope: "outcome has names", topple.fragility: "they are those of maps"}
    for call in (topple.envelope, topple.fragility):
        with pytest.raises(ValueError, match="^repair: sweeps under a suite are not repaired"):
            call(records / "list.csv", **SCENE, repair=True)
        with pytest.raises(ValueError, match=f"^columns: {columns[call]}"):
            call(records / "list.csv", **SCENE, columns="outcome")
        for key in ("limit_u", "limit_v"):
            for value in (True, np.ma.masked, "wide"):
                with pytest.raises(ValueError, match=f"^{key}: "):
                    call(records / "list.csv", **SCENE, **{key: value})
    masked = np.ma.masked_array([1.0, 2.0], mask=[False, True])
    for key in ("levels", "limit_zeta"):
        with pytest.raises(ValueError, match=f"^{key}: values are masked"):
            topple.fragility(records / "list.csv", **(SCENE | {"levels": [1.0, 2.0]} | {key: masked}))
    with pytest.raises(ValueError, match="^levels: give a number"):
        topple.fragility(records / "list.csv", **SCENE, levels=[True, 2.0])
    for seed in (2**32, -1):
        with pytest.raises(ValueError, match=f"^seed: {seed} is not a whole number from 0 to 4294967295$"):
            topple.fragility(records / "list.csv", **SCENE, seed=seed, levels=[1.0, 2.0])
    with pytest.raises(ValueError, match="^estimator: ida scales"):
        topple.fragility(records / "list.csv", **SCENE, estimator="ida")
    with pytest.raises(FileNotFoundError):
        topple.suite(records / "nothing")


def test_a_missing_hazard_curve_is_named(records):
    with pytest.raises(FileNotFoundError, match="hazard: no/such.csv"):
        topple.fragility(records / "list.csv", **(SCENE | {"t_h": 2.0, "t_v": 0.4}), levels="2:14:7", hazard="no/such.csv")


DEVICES = [
    {"device": "bearing", "t_h": 1.5, "psi": 0.1},
    {"device": "floor", "isolation": "none"},
    {"device": "wire, rope", "t_h": 1.0, "t_v": 0.3, "xi_h": 0.15},
]


def test_compare(command, records, tmp_path):
    """Devices in any of three forms are those of the command's list."""
    shared = {"object": 1, "eccentricity": 0.2}
    devices = [device | ({} if "isolation" in device else {"u_y": 0.01, "t_v": device.get("t_v", 0.4)}) for device in DEVICES]
    path = tmp_path / "devices.csv"
    path.write_text(
        'device,t_h,psi,isolation,u_y,t_v,xi_h\nbearing,1.5,0.1,,0.01,0.4,\nfloor,,,none,,,\n"wire, rope",1,,,0.01,0.3,0.15\n'
    )
    asked = {"standing": 0.5, "limit_u": 0.3, "scales": "0.5:2:4", "columns": "zeta"}
    out = tmp_path / "compared"
    command("compare", path, *flags(shared | asked), "--suite", records / "list.csv", "--verify", "none", "--out", out)
    wanted = rows(out / "compare.csv")
    frames = [path, devices]
    with contextlib.suppress(ImportError):
        import pandas

        frames.append(pandas.DataFrame(devices))
    for given in frames:
        found = topple.compare(given, records / "list.csv", **shared, **asked, verify=0)
        assert found["device"].values.tolist() == [row["device"] for row in wanted] == ["bearing", "floor", "wire, rope"]
        for name in ("records", "standing", "max_u_84", "overturned_high", "feasible", "reserve", "fails_at", "zeta_100"):
            numbers = [float(row[name] or "nan") for row in wanted]
            assert np.array_equal(found[name], numbers, equal_nan=True), name
        assert found["max_u_84"].attrs["units"] == "m" and found["zeta_100"].attrs["units"] == "1"
    with pytest.raises(ValueError, match=r"^devices: line 3, column device: the name bearing stands in line 2"):
        topple.compare([devices[0], devices[0]], records / "list.csv", **shared)
    with pytest.raises(ValueError, match=r"^devices: line 1, column periode: no key"):
        topple.compare([{"device": "a", "periode": 1.0}], records / "list.csv", **shared)
    # A number that may be either of two is none; text with a decimal sign is one, and a name may begin as a comment does.
    known = {"isolation": "horizontal", "radius": 1.5, "mu": 0.06, "stop_gap": 0.05}
    with pytest.raises(ValueError, match=r"^devices: line 2, column stop_stiffness: '200,000' may be 200000 or 200"):
        topple.compare([{"device": "a", **known, "stop_stiffness": "200,000"}], records / "list.csv", **shared)
    named = [{"device": "# 1", **known, "stop_stiffness": "2e5"}, {"device": "#2", **known, "stop_stiffness": 200000.125}]
    found = topple.compare(named, records / "list.csv", **shared, verify=0)
    assert found["device"].values.tolist() == ["# 1", "#2"]
    with pytest.raises(ValueError, match=r"^devices: give the path"):
        topple.compare(devices[0], records / "list.csv", **shared)
    with pytest.raises(ValueError, match=r"^levels: it says the levels of hazard's measure; give hazard, too"):
        topple.compare(devices, records / "list.csv", **shared, levels=[1.0, 2.0])


def test_an_envelope_by_its_reserve_and_of_what_is_not_known(command, records, tmp_path):
    limits = {"limit_u": 0.3, "standing": 0.5}
    command("envelope", *flags(SCENE | limits), "--suite", records / "list.csv", "--verify", "none", "--out", tmp_path)
    found = topple.envelope(records / "list.csv", **SCENE, **limits, verify=0)
    reserve = [float(row["reserve"] or "nan") for row in rows(tmp_path / "envelope.csv")]
    assert np.array_equal(np.asarray(found["reserve"]).ravel(), reserve, equal_nan=True)
    scene = SCENE | {"t_h": 2.0, "t_v": 0.4}
    vary = {"eccentricity": "uniform(0,0.4)"}
    unknown = topple.envelope(records / "list.csv", **scene, vary=vary, samples=8, seed=3, verify=0)
    out = tmp_path / "unknown"
    more = ["--vary", "eccentricity=uniform(0,0.4)", "--samples", 8, "--seed", 3, "--verify", "none", "--out", out]
    command("envelope", *flags(scene), "--suite", records / "list.csv", *more)
    row = rows(out / "envelope.csv")[0]
    for name in ("overturned", "overturned_low", "overturned_high", "max_u_84"):
        assert float(np.asarray(unknown[name]).ravel()[0]) == float(row[name]), name
    with pytest.raises(ValueError, match=r"^best: least is not known"):
        topple.envelope(records / "list.csv", **SCENE, best="least")
    with pytest.raises(ValueError, match=r"^samples: it says how many points of vary; give vary, too"):
        topple.envelope(records / "list.csv", **SCENE, samples=8)
