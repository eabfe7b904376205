"""Traces and streams of obspy are records."""

import numpy as np
import pytest

import topple

obspy = pytest.importorskip("obspy", reason="obspy is not installed: its traces are not tried")

SCENE = {"object": 2, "t_h": "1:3:5", "t_v": "0.2:1:4", "backend": "cpu", "verify": 0}
DT = 0.01


def trace(channel, samples, start=0.0):
    header = {"network": "XX", "station": "ABC", "channel": channel, "delta": DT, "starttime": obspy.UTCDateTime(start)}
    return obspy.Trace(np.array(samples, subok=True), header)


@pytest.fixture(scope="module")
def pair():
    t = np.arange(0.0, 6.0, DT)
    horizontal = 300.0 * np.sin(7.0 * t) * np.exp(-(((t - 3.0) / 1.5) ** 2))
    return trace("HNE", horizontal), trace("HNZ", 0.5 * np.roll(horizontal, 20))


@pytest.fixture(scope="module")
def by_arrays(pair):
    h, v = pair
    return topple.seismic(**SCENE, horizontal=h.data, vertical=v.data, dt=DT, units="cm/s2")


def test_traces_and_streams_are_their_samples(pair, by_arrays):
    h, v = pair
    for given in (
        {"horizontal": h, "vertical": v},
        {"horizontal": obspy.Stream([v, h])},
        {"horizontal": obspy.Stream([h]), "vertical": obspy.Stream([v])},
        {"horizontal": h, "vertical": obspy.Stream([v])},
        # A mask that hides nothing.
        {"horizontal": trace("HNE", np.ma.masked_array(h.data, mask=False)), "vertical": v},
    ):
        assert topple.seismic(**SCENE, **given, units="cm/s2").equals(by_arrays), given
    alone = topple.seismic(**SCENE, horizontal=obspy.Stream([h]), units="cm/s2")
    assert not alone.equals(by_arrays)


def test_a_file_that_obspy_wrote(pair, by_arrays, tmp_path):
    obspy.Stream(list(pair)).write(str(tmp_path / "record.mseed"), format="MSEED", encoding="FLOAT64")
    read = obspy.read(str(tmp_path / "record.mseed"))
    assert topple.seismic(**SCENE, horizontal=read, units="cm/s2").equals(by_arrays)


def test_what_is_ambiguous_is_refused(pair):
    h, v = pair
    north = trace("HNN", h.data)
    elsewhere = v.copy()
    elsewhere.stats.station = "XYZ"
    gaps = h.copy()
    gaps.data = np.ma.masked_array(h.data, mask=np.arange(len(h.data)) == 7)
    # What obspy itself makes of two pieces of a trace.
    first, last = h.slice(endtime=h.stats.starttime + 2.0), h.slice(starttime=h.stats.starttime + 2.5)
    merged = obspy.Stream([first, last]).merge()
    assert np.ma.is_masked(merged[0].data)
    for given, line in (
        ({"horizontal": obspy.Stream([h, north, v])}, "^horizontal: a stream must have one .*XX.ABC..HNE, XX.ABC..HNN"),
        ({"horizontal": obspy.Stream([v])}, "^horizontal: a stream must have one .*none"),
        ({"horizontal": gaps, "vertical": v}, "^horizontal: the trace has gaps"),
        ({"horizontal": h, "vertical": gaps}, "^vertical: the trace has gaps"),
        ({"horizontal": merged}, "^horizontal: the trace has gaps"),
        ({"horizontal": v, "vertical": h}, "^horizontal: .* is a vertical component"),
        ({"horizontal": h, "vertical": north}, "^vertical: .*(the same motion|is a horizontal)"),
        ({"horizontal": h, "vertical": elsewhere}, "^vertical: .* is of another place .* 'XX.ABC' and 'XX.XYZ'"),
        ({"horizontal": h, "vertical": trace("HNZ", v.data, start=90.0)}, "^vertical: .* begins 90 s away"),
    ):
        with pytest.raises(ValueError, match=line):
            topple.seismic(**SCENE, **given, units="cm/s2")
    with pytest.raises(ValueError, match="^units: missing"):
        topple.seismic(**SCENE, horizontal=h)


def test_traces_that_do_not_begin_together_are_aligned(pair):
    h, v = pair
    late = topple.seismic(**SCENE, horizontal=h, vertical=trace("HNZ", v.data[200:], start=2.0), units="cm/s2")
    zeros = np.concatenate([np.zeros(200), v.data[200:]])
    assert late.equals(topple.seismic(**SCENE, horizontal=h.data, vertical=zeros, dt=DT, units="cm/s2"))


def test_each_trace_has_its_own_step_and_units(pair, by_arrays):
    h, v = pair
    single = v.copy()
    single.stats.delta = float(np.float32(DT))
    assert topple.seismic(**SCENE, horizontal=h, vertical=single, units="cm/s2").equals(by_arrays)
    fine = trace("HNZ", np.interp(np.arange(2 * len(v) - 1) / 2, np.arange(len(v)), v.data))
    fine.stats.delta = DT / 2
    topple.seismic(**SCENE, horizontal=h, vertical=fine, units="cm/s2")
    odd = v.copy()
    odd.stats.delta = DT * 1.0005
    with pytest.raises(ValueError, match="^vertical: .* no common divisor"):
        topple.seismic(**SCENE, horizontal=h, vertical=odd, units="cm/s2")
    own = [trace.copy() for trace in pair]
    for units in ("cm/s**2", "CM/SEC/SEC", "gals", "cm/sec2."):
        for trace_of in own:
            trace_of.stats.units = units
        assert topple.seismic(**SCENE, horizontal=obspy.Stream(own)).equals(by_arrays), units
    with pytest.raises(ValueError, match="^units: the trace's are"):
        topple.seismic(**SCENE, horizontal=obspy.Stream(own), units="g")
    with pytest.raises(ValueError, match="^units: missing"):
        topple.seismic(**SCENE, horizontal=own[0], vertical=v)
