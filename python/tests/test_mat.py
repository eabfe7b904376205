"""Files of MATLAB hold what a result holds."""

import builtins
import json

import numpy as np
import pytest

import topple

SCENE = {"object": 1, "eccentricity": 0.2, "t_h": 1.75, "t_v": 0.75, "omega": "0.2:15:7", "a_h": "0.1:15:5"}


def read(path):
    io = pytest.importorskip("scipy.io", reason="scipy is not installed: files of MATLAB are not written")
    return io.loadmat(path)


def test_a_map_comes_back(tmp_path):
    pytest.importorskip("scipy.io", reason="scipy is not installed: files of MATLAB are not written")
    ds = topple.pulse(**SCENE, backend="cpu", verify=0)
    topple.save_mat(ds, tmp_path / "map.mat")
    found = read(tmp_path / "map.mat")
    assert found["zeta"].shape == (5, 7) and found["omega"].shape == (7, 1) and found["a_h"].shape == (5, 1)
    about = json.loads(found["about"].item())
    assert about["variables"]["zeta"]["dims"] == ["a_h", "omega"] and about["variables"]["omega"]["unit"] == "rad/s"
    for name in ("zeta", "max_u", "t_uplift", "impacts", "outcome"):
        assert found[name].dtype == ds[name].dtype, name
        assert np.array_equal(found[name], np.asarray(ds[name]), equal_nan=name == "t_uplift"), name
    assert np.array_equal(found["omega"].ravel(), np.asarray(ds["omega"]))
    names = [name.item() for name in found["outcome_names"].ravel()]
    assert names == ds["outcome"].attrs["flag_meanings"].split() and len(set(found["outcome"].ravel().tolist())) > 2
    assert [path.name for path in tmp_path.iterdir()] == ["map.mat"]


def test_a_motion_comes_back(tmp_path):
    pytest.importorskip("scipy.io", reason="scipy is not installed: files of MATLAB are not written")
    motion = topple.history(**(SCENE | {"omega": 9.0, "a_h": 8.4}))
    topple.save_mat(motion, tmp_path / "motion.mat")
    found = read(tmp_path / "motion.mat")
    assert np.array_equal(found["phi"].ravel(), np.asarray(motion["phi"])) and found["t"].shape[1] == 1
    assert [mode.item() for mode in found["mode"].ravel()] == np.asarray(motion["mode"]).tolist()
    assert json.loads(found["about"].item())["outcome"] == motion.attrs["outcome"]


def test_what_is_refused(tmp_path, monkeypatch):
    ds = topple.pulse(**(SCENE | {"omega": 9.0}), backend="cpu", verify=0)
    pytest.importorskip("scipy.io", reason="scipy is not installed: files of MATLAB are not written")
    with pytest.raises(ValueError, match="^path: .*does not end in .mat"):
        topple.save_mat(ds, tmp_path / "map.txt")
    with pytest.raises(ValueError, match="^result: give a Dataset"):
        topple.save_mat({"fits": ds}, tmp_path / "map.mat")
    own = builtins.__import__

    def without_scipy(name, *rest):
        if name.startswith("scipy"):
            raise ImportError(name)
        return own(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without_scipy)
    with pytest.raises(ImportError, match="written by scipy, which is not installed: pip install scipy"):
        topple.save_mat(ds, tmp_path / "map.mat")
    assert not list(tmp_path.iterdir())
