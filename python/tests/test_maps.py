"""Maps of the package and of the command are the same, bit by bit."""

import json
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import topple

PULSE = {"object": 1, "eccentricity": 0.2, "t_h": 1.75, "t_v": 0.75, "omega": "0.2:15:31", "a_h": "0.1:15:30"}
RECORD = {"object": 2, "t_h": "0.5:4:17", "t_v": "0.1:2:16"}


def flags(numbers):
    return [text for key, value in numbers.items() for text in ("--" + key.replace("_", "-"), str(value))]


def same(found, npz):
    """Every array of an archive is a variable or a coordinate with the same bits."""
    with np.load(npz) as arrays:
        about = json.loads(str(arrays["about"]))
        names = [name for name in arrays if name != "about"]
        assert len(names) > 15
        for name in names:
            values = found[name].values
            assert values.dtype == arrays[name].dtype, name
            assert np.array_equal(values, arrays[name], equal_nan=values.dtype.kind == "f"), name
        assert list(found["outcome"].dims) == about["index"]
        assert found["outcome"].attrs["flag_meanings"].split() == about["outcome"]
        assert json.loads(found.attrs["scene"]) == about["scene"]


# The larger map has two chunks.
@pytest.mark.parametrize("size", [30, 280])
@pytest.mark.parametrize("precision", ["f32", "f64"])
def test_pulse(command, tmp_path, precision, size):
    scene = PULSE | {"a_h": f"0.1:15:{size}", "omega": f"0.2:15:{size + 1}"}
    run = ["--backend", "cpu", "--precision", precision, "--verify", "none", "--out", tmp_path]
    command("pulse", *flags(scene), *run)
    found = topple.pulse(**scene, backend="cpu", precision=precision, verify=0)
    same(found, tmp_path / "map.npz")
    again = topple.open(tmp_path)
    assert np.array_equal(found["zeta"].values, again["zeta"].values)


@pytest.mark.parametrize("precision", ["f32", "f64"])
def test_record(command, records, tmp_path, precision):
    pair = {"horizontal": records / "synthetic_h.at2", "vertical": records / "synthetic_v.at2"}
    run = ["--backend", "cpu", "--precision", precision, "--verify", "none", "--out", tmp_path]
    command("seismic", *flags(RECORD | pair), *run)
    found = topple.seismic(**RECORD, **pair, backend="cpu", precision=precision, verify=0)
    same(found, tmp_path / "map.npz")


def test_the_synthetic_pair(command, tmp_path):
    """Without a record the call has the motion that the command writes and reads."""
    numbers = {"object": 1, "t_h": "0.5:4:6", "t_v": "0.2:2:5"}
    command("seismic", *flags(numbers), "--backend", "cpu", "--verify", "none", "--out", tmp_path)
    found = topple.seismic(**numbers, backend="cpu", verify=0)
    same(found, tmp_path / "map.npz")


@pytest.mark.parametrize("name", ["map.npz", "map.zarr"])
def test_an_opened_map_has_the_step_of_its_run(command, tmp_path, name):
    """The motion of its cells is that of the map, not of the default step."""
    pytest.importorskip("zarr")
    scene = PULSE | {"omega": "1:9:3", "a_h": "1:9:3", "t_max": 10.0}
    run = ["--backend", "cpu", "--verify", "none", "--precision", "f64", "--step", "0.001", "--files", "npz,zarr"]
    command("pulse", *flags(scene), *run, "--out", tmp_path)
    called = topple.pulse(**scene, backend="cpu", precision="f64", step=0.001, verify=0)
    opened = topple.open(tmp_path / name)
    assert json.loads(opened.attrs["method"]) == json.loads(called.attrs["method"])
    motions = [found.topple.history(omega=5.0, a_h=5.0) for found in (called, opened)]
    assert len(motions[0]["t"]) > 1000 and np.array_equal(motions[0]["u"].values, motions[1]["u"].values)


def test_a_mat_file_holds_the_arrays_of_the_archive(command, tmp_path):
    """MATLAB reads them with the first index as the fastest one."""
    io = pytest.importorskip("scipy.io")
    scene = PULSE | {"omega": "1:9:5", "a_h": "1:9:4"}
    run = ["--refine", 1, "--files", "npz,mat", "--verify", "none", "--backend", "cpu"]
    command("pulse", *flags(scene), *run, "--out", tmp_path)
    for name in ("map", "leaves"):
        archive = np.load(tmp_path / f"{name}.npz")
        found = io.loadmat(tmp_path / f"{name}.mat", mat_dtype=False)
        assert set(archive.files) == {key for key in found if not key.startswith("__")}
        assert found.pop("about").item() == str(archive["about"])
        for key in set(archive.files) - {"about"}:
            expected = archive[key].T if archive[key].ndim == 2 else archive[key][:, None]
            assert np.array_equal(found[key], expected, equal_nan=expected.dtype.kind == "f"), key
            assert found[key].dtype.itemsize == expected.dtype.itemsize, key
    assert io.loadmat(tmp_path / "map.mat")["zeta"].shape == (5, 4)


def test_scene_file(command, records, tmp_path):
    scene = tmp_path / "scene.toml"
    command("pulse", *flags(PULSE), "--save-scene", scene)
    found = topple.run(scene, backend="cpu", verify=0)
    other = topple.pulse(**PULSE, backend="cpu", verify=0)
    assert np.array_equal(found["t_end"].values, other["t_end"].values)
    assert topple.run(scene, backend="cpu", verify=0, omega=5.0)["omega"].values.tolist() == [5.0]


def samples(path):
    """The accelerations of an AT2 file, g, and its step, s."""
    lines = path.read_text().splitlines()
    dt = float(lines[3].split("DT=")[1].split()[0])
    return np.array([float(text) for line in lines[4:] for text in line.split()]), dt


class Stats:
    delta = 0.0


class Trace:
    """A trace as obspy's: samples, and a header with their step."""

    def __init__(self, data, delta):
        self.data = data
        self.stats = Stats()
        self.stats.delta = delta


def test_arrays_are_records(records):
    pair = [records / "synthetic_h.at2", records / "synthetic_v.at2"]
    by_file = topple.seismic(**RECORD, horizontal=pair[0], vertical=pair[1], backend="cpu", verify=0)
    (h, dt), (v, _) = samples(pair[0]), samples(pair[1])
    by_array = topple.seismic(**RECORD, horizontal=h, vertical=v, dt=dt, units="g", backend="cpu", verify=0)
    traces = [Trace(h * 981.0, dt), Trace(v * 981.0, dt)]
    by_trace = topple.seismic(
        **RECORD, horizontal=traces[0], vertical=traces[1], units="cm/s2", backend="cpu", verify=0
    )
    for other in (by_array, by_trace):
        assert np.array_equal(by_file["outcome"].values, other["outcome"].values)
        # A sample is rounded to a unit in the last place when its unit changes.
        assert np.allclose(by_file["max_u"].values, other["max_u"].values, rtol=1e-4)


def test_numpy_makes_axes():
    omega, a_h = np.linspace(1.0, 9.0, 7), [2.0, 5.0, 11.0]
    found = topple.pulse(object=1, t_h=1.75, t_v=0.75, omega=omega, a_h=a_h, backend="cpu", verify=0)
    assert found["zeta"].shape == (3, 7)
    assert found["omega"].values.tolist() == omega.tolist()
    one = topple.pulse(object=1, t_h=1.75, t_v=0.75, omega=omega[2], a_h=5.0, backend="cpu", verify=0)
    assert one["outcome"].values.item() == found["outcome"].sel(a_h=5.0).values[2]


def needs_the_store():
    """Maps on disk are opened by these."""
    for name in ("zarr", "dask"):
        pytest.importorskip(name, reason=f"{name} is not installed: maps on disk are not opened")


def test_on_disk(tmp_path):
    needs_the_store()
    whole = topple.pulse(**PULSE, backend="cpu", verify=0)
    lazy = topple.pulse(**PULSE, backend="cpu", verify=0, out=tmp_path)
    assert lazy["zeta"].chunks is not None
    assert np.array_equal(lazy["zeta"].values, whole["zeta"].values)
    assert lazy.attrs["backend"] == "cpu"


def test_what_was_saved_is_drawn_and_run_again(command, records, tmp_path):
    """In a process of its own, whose first Dataset is one that was opened."""
    needs_the_store()
    command("pulse", *flags(PULSE), "--files", "npz,zarr", "--verify", "none", "--backend", "cpu", "--out", tmp_path / "p")
    pair = {"horizontal": records / "synthetic_h.at2", "vertical": records / "synthetic_v.at2"}
    topple.seismic(**RECORD, **pair, backend="cpu", verify=0, out=tmp_path / "s")
    script = textwrap.dedent(
        f"""
        import matplotlib; matplotlib.use("agg")
        import json, topple
        for name in ("map.zarr", "map.npz"):
            ds = topple.open({str(tmp_path / "p")!r} + "/" + name)
            ds.topple.plot()
            assert json.loads(ds.attrs["scene"])["numbers"]["t_h"] == 1.75
            motion = ds.topple.history(omega=9.0, a_h=8.0)
            assert float(motion.t[-1]) > 0.1
            motion.topple.plot()
        ds = topple.open({str(tmp_path / "s")!r})
        ds.topple.plot("max_u")
        """
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    ours = topple.seismic(**RECORD, **pair, backend="cpu", verify=0, step=0.004)
    cell = ours.topple.history(t_h=2.0, t_v=0.5)
    alone = topple.history(object=2, t_h=2.0, t_v=0.5, **pair, step=0.004)
    assert np.array_equal(cell.phi.values, alone.phi.values)
    assert len(alone.t) != len(topple.history(object=2, t_h=2.0, t_v=0.5, **pair, progress=False).t)


@pytest.mark.parametrize("engine", ["netcdf4", "scipy"])
def test_every_dataset_goes_into_netcdf(command, records, tmp_path, engine):
    """What a map in chunks and the results of calls have beside their values can be stored by another format, too."""
    needs_the_store()
    pytest.importorskip({"netcdf4": "netCDF4"}.get(engine, engine))
    import xarray

    scene = PULSE | {"omega": "0.2:15:9", "a_h": "0.1:15:9"}
    command("pulse", *flags(scene), "--refine", 1, "--files", "zarr", "--verify", "none", "--out", tmp_path / "p")
    pair = {"horizontal": records / "synthetic_h.at2", "vertical": records / "synthetic_v.at2"}
    command("seismic", *flags(RECORD | pair), "--files", "zarr", "--verify", "none", "--out", tmp_path / "s")
    stored = [tmp_path / "p" / "map.zarr", tmp_path / "p" / "leaves.zarr", tmp_path / "s" / "map.zarr"]
    found = [xarray.open_zarr(place, consolidated=False) for place in stored] + [topple.open(place) for place in stored]
    found.append(topple.pulse(**scene, backend="cpu", verify=0, sharpness=True))
    found.append(topple.history(object=1, t_h=1.75, t_v=0.75, omega=6.0, a_h=8.0))
    for number, ds in enumerate(found):
        assert all(isinstance(value, (str, int, float)) and not isinstance(value, bool) for value in ds.attrs.values())
        file = tmp_path / f"{number}.nc"
        ds.to_netcdf(file, engine=engine)
        with xarray.open_dataset(file, engine=engine) as back:
            assert json.loads(back.attrs["scene"])["numbers"]["t_h"], number
            for name in ds.variables:
                assert np.array_equal(ds[name].values, back[name].values, equal_nan=ds[name].dtype.kind == "f"), name


def test_leaves_of_a_refined_map(command, tmp_path):
    scene = PULSE | {"omega": "0.2:15:17", "a_h": "0.1:15:17"}
    command("pulse", *flags(scene), "--refine", 2, "--backend", "cpu", "--verify", "none", "--out", tmp_path)
    leaves = topple.open(tmp_path / "leaves.npz")
    whole = topple.pulse(**(scene | {"omega": leaves.omega.values, "a_h": leaves.a_h.values}), backend="cpu", verify=0)
    assert whole.outcome.shape == (65, 65)
    assert int((leaves.width * leaves.height).sum()) == whole.outcome.size
    # The first cell of a leaf was run, and has the numbers of the whole sweep.
    for name in ("outcome", "zeta", "impacts"):
        assert np.array_equal(leaves[name].values, whole[name].values.ravel()[leaves.cell.values]), name


def test_leaves_in_the_store_are_those_of_the_archive(command, tmp_path):
    needs_the_store()
    # More leaves than a chunk has.
    scene = PULSE | {"omega": "0.2:15:257", "a_h": "0.1:15:257", "t_max": 3}
    command("pulse", *flags(scene), "--refine", 1, "--files", "npz,zarr", "--verify", "none", "--out", tmp_path)
    lazy, whole = topple.open(tmp_path / "leaves.zarr"), topple.open(tmp_path / "leaves.npz")
    assert lazy["zeta"].chunks == ((65536, lazy.sizes["leaf"] - 65536),)
    assert lazy.sizes == whole.sizes and set(lazy.variables) == set(whole.variables)
    assert lazy.attrs == whole.attrs
    for name in whole.variables:
        ours, theirs = lazy[name], whole[name]
        assert ours.dims == theirs.dims and ours.dtype == theirs.dtype, name
        assert np.array_equal(ours.values, theirs.values, equal_nan=ours.dtype.kind == "f"), name
        # The archive does not say what it means.
        assert ours.attrs == theirs.attrs or name == "proved", name
    zarr = pytest.importorskip("zarr")
    assert zarr.open_group(tmp_path / "leaves.zarr", mode="r")["cell"][-1] == whole["cell"].values[-1]


def test_refine_gives_the_leaves_that_the_command_writes(command, tmp_path):
    scene = PULSE | {"omega": "0.2:15:9", "a_h": "0.1:15:9"}
    command("pulse", *flags(scene), "--refine", 2, "--backend", "cpu", "--verify", "none", "--out", tmp_path)
    written = topple.open(tmp_path / "leaves.npz")
    found = topple.pulse(**scene, backend="cpu", verify=0, refine=2)
    assert set(found.data_vars) == set(written.data_vars)
    for name in written.data_vars:
        assert np.array_equal(found[name].values, written[name].values, equal_nan=name == "t_uplift"), name
    assert json.loads(found.attrs["refined"])["shape"] == [33, 33]
    with pytest.raises(ValueError, match="^refine: .*leave out"):
        topple.pulse(**scene, refine=2, out=tmp_path)
    with pytest.raises(ValueError, match="^smooth: .*refine"):
        topple.pulse(**scene, smooth=0.1)
    with pytest.raises(ValueError, match="^refine: .*list"):
        topple.pulse(**(scene | {"omega": [1.0, 2.0, 5.0]}), refine=2)


def test_repair():
    found = topple.pulse(**PULSE, backend="cpu", verify=0, repair=True)
    repaired = json.loads(found.attrs["repaired"])
    assert repaired["checked"] > 50 and repaired["undecided"] == 0
    plain = topple.pulse(**PULSE, backend="cpu", verify=0)
    assert "repaired" not in plain.attrs
    assert int((plain.outcome != found.outcome).sum()) == repaired["changed"]


def test_columns_that_are_asked_for(command, tmp_path):
    whole = topple.pulse(**PULSE, backend="cpu", verify=0)
    command("pulse", *flags(PULSE), "--backend", "cpu", "--columns", "zeta,outcome", "--out", tmp_path)
    for some in (
        topple.pulse(**PULSE, backend="cpu", verify=0, columns=["outcome", "zeta"]),
        topple.pulse(**PULSE, backend="cpu", verify=0, columns="outcome,zeta"),
        topple.open(tmp_path / "map.npz"),
    ):
        assert list(some.data_vars) == ["outcome", "zeta"]
        for name in some.data_vars:
            # But for rounding: without contact forces motions in full contact are made in another order.
            assert np.allclose(some[name], whole[name], rtol=1e-4, atol=0.0), name
        with pytest.raises(ValueError, match="^columns: colours tell impacts"):
            some.topple.plot()
    drawn = topple.pulse(**PULSE, backend="cpu", verify=0, columns="outcome,impacts,uplifts")
    texts = [text.get_text() for text in drawn.topple.plot().get_legend().get_texts()]
    assert any("not asked for" in text.replace("\n", " ") for text in texts)
    stored = topple.pulse(**PULSE, backend="cpu", verify=0, columns="max_u", out=tmp_path / "lazy")
    assert "max_u" in stored and "max_v" not in stored
    for wrong, told in [("max_w", "^columns: no column is called 'max_w'"), ([], "^columns: names none")]:
        with pytest.raises(ValueError, match=told):
            topple.pulse(**PULSE, columns=wrong)
    with pytest.raises(ValueError, match="^columns: probabilities have none"):
        topple.pulse(**PULSE, columns="outcome", pixel=True)


def test_history(command, tmp_path):
    cell = {"object": 1, "eccentricity": 0.2, "t_h": 1.75, "t_v": 0.75, "omega": 9, "a_h": 8.4}
    command("history", *flags(cell), "--out", tmp_path)
    found = topple.history(**cell)
    rows = np.genfromtxt(tmp_path / "history.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert len(rows) == found.sizes["row"]
    assert found["mode"].values.tolist() == rows["mode"].tolist()
    for name in ("t", "u", "phi"):
        ours, written = found[name].values, rows[name]
        # A number of f32 is written in the digits that tell it from other numbers of f32.
        single = ours.astype(np.float32)
        as_single = (single == ours) & (single == written.astype(np.float32))
        assert np.all((ours == written) | as_single), name
