"""What numpy, pandas and obspy give as numbers: used as it is meant, or refused in one line; nothing is read otherwise."""

import warnings
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import topple

DT = 0.01
T = np.arange(0.0, 6.0, DT)
GROUND = 3.0 * np.sin(7.0 * T) * np.exp(-(((T - 3.0) / 1.5) ** 2))
SHAKEN = {"object": 1, "t_h": [1.0, 2.0], "t_v": 0.4, "dt": DT, "units": "m/s2", "backend": "cpu", "verify": 0}
PULSE = {"object": 1, "t_h": 1.75, "t_v": 0.75, "a_h": 4.0, "backend": "cpu", "verify": 0}


def spoilt():
    """The motion with a sample that is no part of it, a hundred times too strong."""
    samples = GROUND.copy()
    samples[300] = 99.0
    return samples


def every_other(values):
    """The same values, not side by side in memory."""
    apart = np.zeros(2 * len(values))
    apart[::2] = values
    return apart[::2]


def read_only(values):
    values = np.array(values)
    values.flags.writeable = False
    return values


@pytest.fixture(scope="module")
def plain():
    return topple.seismic(**SHAKEN, horizontal=GROUND)


@pytest.mark.parametrize(
    "kind",
    [
        list,
        tuple,
        every_other,
        read_only,
        lambda values: np.asarray(values, dtype=">f8"),
        lambda values: np.asarray(values, dtype=np.longdouble),
        lambda values: np.asarray(values, dtype=object),
        lambda values: np.asfortranarray(values[np.newaxis]),
        lambda values: np.ma.masked_array(values, mask=np.zeros(len(values))),
        lambda values: np.ma.masked_array(values),
        lambda values: pytest.importorskip("pandas").Series(values, index=T),
        lambda values: pytest.importorskip("xarray").DataArray(values),
    ],
)
def test_a_record_is_its_samples_however_they_lie(plain, kind):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = topple.seismic(**SHAKEN, horizontal=kind(GROUND), vertical=None)
    assert np.array_equal(found["max_u"], plain["max_u"]) and float(plain["max_u"].max()) > 0.01


STRUCTURE = np.array([(0.1,), (0.2,)], dtype=[("a", float)])


@pytest.mark.parametrize("component", ["horizontal", "vertical"])
@pytest.mark.parametrize(
    ("record", "line"),
    [
        (lambda: np.ma.masked_greater(spoilt(), 50.0), "sample 300 is masked; fill the gaps"),
        (lambda: [*GROUND[:5], np.ma.masked, *GROUND[6:]], "sample 5 is masked"),
        (lambda: np.where(spoilt() > 50.0, np.nan, GROUND), "sample 300 is no finite number"),
        (lambda: [0.1, None, 0.2], "no array of numbers"),
        (lambda: pytest.importorskip("pandas").Series([0.1, None, 0.2]), "sample 1 is no finite number"),
        (lambda: [0.1, pytest.importorskip("pandas").NA, 0.2], "no array of numbers"),
        (lambda: STRUCTURE, "no array of numbers"),
        (lambda: np.ma.masked_array(STRUCTURE, mask=[True, False]), "no array of numbers"),
        (lambda: GROUND.astype(complex), "no array of numbers"),
        (lambda: GROUND > 0.0, "no array of numbers"),
        (lambda: np.array([True, 0.5, 0.2], dtype=object), "no array of numbers"),
        (lambda: np.array(["0.1", "0.2"]), "no array of numbers"),
        (lambda: np.array([1, 2], dtype="timedelta64[s]"), "no array of numbers"),
        (lambda: b"12", "bytes is not read; give a path"),
        (lambda: {"a": GROUND}, "no array of numbers"),
        (lambda: np.zeros((3, 2)), r"an array of shape \(3, 2\)"),
    ],
)
def test_what_is_no_record_is_refused(component, record, line):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=f"^{component}: {line}") as error:
            topple.seismic(**SHAKEN, **({"horizontal": GROUND} | {component: record()}))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "omega",
    [
        (2.0, 5.0),
        [2, 5],
        [Decimal(2), Fraction(5)],
        every_other([2.0, 5.0]),
        read_only([2.0, 5.0]),
        np.array([2, 5], dtype=">i2"),
        np.array([2.0, 5.0], dtype=np.float16),
        np.array([2.0, 5.0], dtype=object),
        np.ma.masked_array([2.0, 5.0], mask=[False, False]),
        [np.float32(2.0), np.array(5.0)],
    ],
)
def test_an_axis_is_its_values_however_they_lie(omega):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = topple.pulse(**PULSE, omega=omega)
        one = topple.pulse(**PULSE, omega=omega[1:])
    assert found["omega"].values.tolist() == [2.0, 5.0] and one["omega"].values.tolist() == [5.0]


MASKED = "values are masked; fill them, or leave them out"


@pytest.mark.parametrize(
    ("value", "line"),
    [
        (np.ma.masked_array([2.0, 5.0], mask=[False, True]), MASKED),
        (np.ma.masked_array(5.0, mask=True), MASKED),
        (np.ma.masked, MASKED),
        ([2.0, np.ma.masked], MASKED),
        ([2.0, np.ma.masked_array(5.0, mask=True)], MASKED),
        ([2.0, float("nan")], ""),
        ([2.0, None], "give a number"),
        ([2.0, True], "give a number"),
        ([2.0, np.True_], "give a number"),
        ([2.0, "5"], "give a number"),
        ([2.0, [5.0]], "give a number"),
        (np.array([[2.0, 5.0]]), "give a number"),
        (np.array([[2.0], [5.0]]), "give a number"),
        (np.array([2.0, True], dtype=object), "give a number"),
        (np.array([2.0, None], dtype=object), "give a number"),
        (np.array(True, dtype=object), "give a number"),
        (np.array(["2", "5"]), "give a number"),
        (np.array([2, 5], dtype="timedelta64[s]"), "give a number"),
        (STRUCTURE, "give a number"),
        (STRUCTURE[0], "give a number"),
        (np.ma.masked_array(STRUCTURE, mask=[True, False]), "give a number"),
        (bytearray(b"25"), "give a number"),
        ({2.0: 1, 5.0: 1}, "give a number"),
        ({2.0, 5.0}, "give a number"),
    ],
)
def test_what_is_no_number_is_refused(value, line):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=f"^omega: {line}") as error:
            topple.pulse(**PULSE, omega=value)
        assert "\n" not in str(error.value)


def test_what_pandas_does_not_know_is_refused():
    pandas = pytest.importorskip("pandas")
    for value in (pandas.NA, pandas.array([2, None]), pandas.Series([2.0, None]), pandas.Series([2, pandas.NA], dtype="Int64")):
        with pytest.raises(ValueError, match="^omega: "):
            topple.pulse(**PULSE, omega=value)
    known = pandas.Series([2, 5], dtype="Int64", index=["a", "b"])
    assert topple.pulse(**PULSE, omega=known)["omega"].values.tolist() == [2.0, 5.0]


@pytest.mark.parametrize("key", ["object", "step", "verify", "adapter", "threads", "refine", "smooth", "samples", "seed"])
@pytest.mark.parametrize("value", [True, np.True_, np.ma.masked, np.array([1, 2]), 1j, "one", float("nan")])
def test_a_keyword_of_one_number_takes_no_other_thing(key, value):
    more = {"smooth": {"refine": 1}, "samples": {"pixel": True}, "seed": {"pixel": True}}.get(key, {})
    if key == "adapter" and isinstance(value, np.ndarray):
        pytest.skip("several adapters are a sequence of numbers")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=f"^{key}: ") as error:
            topple.pulse(**(PULSE | {"omega": "1:9:5", "a_h": "1:9:5"} | more | {key: value}))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("key", ["dt", "scale", "pga"])
def test_a_masked_number_of_a_record_is_none(key):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=f"^{key}: "):
            topple.seismic(**(SHAKEN | {key: np.ma.masked_array(0.5, mask=True)}), horizontal=GROUND)


@pytest.mark.parametrize(
    ("scale", "line"),
    [
        (float("inf"), "scale: .*finite number"),
        (float("nan"), "scale: .*finite number"),
        (1e308, "scale: the factor 1"),
        (150.0, r"scale: the factor 150 makes the peak 4\d\d"),
    ],
)
def test_a_factor_is_the_trouble_not_the_units(scale, line):
    with pytest.raises(ValueError, match=line):
        topple.seismic(**SHAKEN, horizontal=GROUND, scale=scale)


def test_an_open_file_and_bytes_are_no_arrays(tmp_path):
    path = tmp_path / "a.txt"
    np.savetxt(path, GROUND)
    for record in (path.open(), path.open("rb"), path.read_bytes(), bytearray(b"1\n2\n")):
        with pytest.raises(ValueError, match=r"horizontal: .* is not read; give a path \(str or Path\)"):
            topple.seismic(**SHAKEN, horizontal=record)


def test_an_offset_is_warned_of_and_a_line_takes_it_away(plain):
    with pytest.warns(UserWarning, match="horizontal: the ground ends with the velocity"):
        topple.seismic(**SHAKEN, horizontal=GROUND + 0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        level = topple.seismic(**SHAKEN, horizontal=GROUND + 0.5, baseline="line")
        same = topple.seismic(**SHAKEN, horizontal=GROUND, baseline="line")
    assert np.allclose(level["max_u"], same["max_u"], rtol=1e-4)
    with pytest.raises(ValueError, match="baseline: 'poly' is not known; give none or line"):
        topple.seismic(**SHAKEN, horizontal=GROUND, baseline="poly")


def test_codes_of_missing_samples_are_warned_of():
    ground = GROUND.copy()
    ground[300] = -999.0
    with pytest.warns(UserWarning, match="horizontal: 1 sample is exactly -999, number 301 first"):
        topple.seismic(**{**SHAKEN, "units": "cm/s2"}, horizontal=ground)
