"""What is not known: the package has the probabilities and the sharpness of the command."""

import csv
import json

import numpy as np
import pytest

import topple

SCENE = {"object": 1, "eccentricity": 0.1, "t_h": 1.75, "t_v": 0.75, "omega": "0.2:15:21", "a_h": "0.1:15:20"}
RUN = {"backend": "cpu", "precision": "f64"}
VARY = {"eccentricity": "normal(0.1,0.02)", "t_h": "lognormal(1.75,0.05)"}


def flags(numbers):
    return [text for key, value in numbers.items() for text in ("--" + key.replace("_", "-"), str(value))]


def is_the_table(found, path):
    """Every share of a table is that of the Dataset, in the table's order: the first axis fastest."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == found["rocking"].size
    assert int(rows[0]["samples"]) == found.attrs["samples"]
    for name in found.data_vars:
        # A share is written in the digits that tell it from other numbers of f32.
        written = np.array([float(row[name]) for row in rows])
        ours = found[name].values.ravel()
        assert np.all((ours == written) | (ours.astype(np.float32) == written.astype(np.float32))), name
    assert set(rows[0]) == {*found.data_vars, *found.coords, "samples"}


def test_numbers_that_vary(command, tmp_path):
    texts = [f"{key}={of}" for key, of in VARY.items()]
    told = [word for text in texts for word in ("--vary", text)]
    command("pulse", *flags(SCENE | RUN), *told, "--samples", 16, "--seed", 3, "--verify", "none", "--out", tmp_path)
    found = topple.pulse(**SCENE, **RUN, vary=VARY, samples=16, seed=3, verify=0)
    is_the_table(found, tmp_path / "probability.csv")
    run = json.loads((tmp_path / "run.json").read_text())
    for key in ("mean_probability", "certain", "largest_standard_error", "samples", "seed"):
        assert found.attrs[key] == run[key], key
    assert json.loads(found.attrs["vary"]) == run["vary"] == texts
    assert found["rocking"].dims == ("a_h", "omega") and found["rocking"].attrs["units"] == "1"
    assert 0.0 < found.attrs["mean_probability"] < 1.0
    total = sum(found[name].values for name in found.data_vars)
    assert np.allclose(total, 1.0)
    again = topple.pulse(**SCENE, **RUN, vary=texts, samples=16, seed=3, verify=0)
    assert again.equals(found)
    other = topple.pulse(**SCENE, **RUN, vary=VARY, samples=16, seed=4, verify=0)
    assert not other.equals(found)


def test_values_in_a_pixel(command, tmp_path):
    scene = {"object": 1, "t_h": "0.5:4:8", "t_v": "0.05:0.3:7"}
    command("seismic", *flags(scene | RUN), "--pixel", "--samples", 4, "--verify", 32, "--out", tmp_path)
    found = topple.seismic(**scene, **RUN, pixel=True, samples=4, verify=32)
    is_the_table(found, tmp_path / "probability.csv")
    verified = json.loads((tmp_path / "run.json").read_text())["verified"]
    assert [json.loads(found.attrs["verification"])[key] for key in ("sampled", "differ")] == verified
    assert verified[0] > 0


def test_an_axis_that_varies_is_none(command, tmp_path):
    scene = SCENE | {"omega": 9}
    command("pulse", *flags(scene | RUN), "--vary", "omega=uniform(8,10)", "--samples", 4, "--verify", "none", "--out", tmp_path)
    found = topple.pulse(**scene, **RUN, vary="omega=uniform(8,10)", samples=4, verify=0)
    assert found["rocking"].dims == ("a_h",)
    is_the_table(found, tmp_path / "probability.csv")


def test_sharpness(command, tmp_path):
    scene = SCENE | {"omega": "0.2:15:60", "a_h": "0.1:15:60"}
    command("pulse", *flags(scene | RUN), "--sharpness", "--verify", "none", "--out", tmp_path / "whole")
    told = json.loads((tmp_path / "whole" / "run.json").read_text())["sharpness"]
    found = topple.pulse(**scene, **RUN, sharpness=True, verify=0)
    assert json.loads(found.attrs["sharpness"]) == told
    assert told["s_b"]["value"] > 0.0
    assert "sharpness" not in topple.pulse(**SCENE, **RUN, verify=0).attrs
    for k in (1, 2):
        topple.pulse(**scene, **RUN, verify=0, out=tmp_path / f"part{k}", tile=f"{k}/2")
    joined = topple.merge([tmp_path / "part1", tmp_path / "part2"], verify=0, sharpness=True, threads=1)
    assert json.loads(joined.attrs["sharpness"]) == told


@pytest.mark.parametrize("backend", ["cpu", "reference"])
def test_threads_change_nothing_but_the_threads(backend):
    scene = SCENE | {"omega": "0.2:15:8", "a_h": "0.1:15:8"}
    found = {count: topple.pulse(**scene, backend=backend, verify=8, threads=count) for count in (1, 3)}
    assert found[1].equals(found[3])
    assert [found[count].attrs["threads"] for count in (1, 3)] == [1, 3]
