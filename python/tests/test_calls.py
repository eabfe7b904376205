"""How calls behave: errors, progress, Ctrl-C, threads, machines without xarray."""

import os
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import topple

LONG = {"object": 1, "t_h": 1.75, "t_v": 0.75, "omega": "0.2:15:3000", "a_h": "0.1:15:3000", "backend": "cpu"}


@pytest.mark.parametrize(
    ("keywords", "line"),
    [
        ({"t_h": -1}, "^t_h: -1 must be a positive number$"),
        ({"th": 1}, "^th: no keyword of this name"),
        ({"omega": "1:9"}, "^omega: '1:9' is neither a number nor"),
        ({"omega": [1.0, 1.0]}, "^omega: "),
        ({"omega": [1.0, float("nan")]}, "^omega: "),
        ({"isolation": "both"}, "^isolation: 'both' is not known; give one of dual, horizontal"),
        ({"isolation": 1}, "^isolation: 1 is not a word$"),
        ({"shape": "sine"}, "^shape: 'sine' is not known; give one of one-sine"),
        ({"object": "caryatid"}, "^object: 'caryatid' is not the number of a block"),
        ({"x": "T_h"}, "^x: "),
        ({"T_h": 2}, "^T_h: no keyword of this name; did you mean t_h"),
        ({"keep_every": 2.0}, "^keep_every: no keyword of this name; the command alone has it"),
        ({"units": "g"}, "^units: a pulse shakes the base here; topple.seismic has records"),
        ({"horizontal": [1.0, 2.0]}, "^horizontal: a pulse shakes the base here"),
        ({"step": 5.0}, "^step: 5 s is not plausible"),
        ({"precision": "f16"}, "^precision: "),
        ({"backend": "cuda"}, "^backend: "),
        ({"resume": True}, "^out: missing"),
        ({"object": 9}, "^object: "),
        ({"verify": -1}, "verify"),
        ({"tile": "3/2", "out": "x"}, "^tile: "),
        ({"threads": 0}, "^threads: 0 is not a number of threads"),
        ({"threads": 100000}, "^threads: 100000 is too many"),
        ({"omega": b"3"}, "^omega: give a number"),
        ({"omega": True}, "^omega: give a number"),
        ({"omega": 3 + 1j}, "^omega: give a number"),
        ({"omega": np.array([1.0 + 0.0j, 2.0])}, "^omega: give a number"),
        ({"omega": np.array([True, False])}, "^omega: give a number"),
        ({"vary": 3}, "^vary: give a mapping"),
        ({"samples": 8}, "^samples: means nothing where all is known"),
        ({"vary": "eccentricity"}, "^vary: 'eccentricity' is no KEY=DISTRIBUTION"),
        ({"vary": {"eccentricity": "normal(0.1)"}}, "^vary: eccentricity: "),
        ({"vary": {"t_h": "normal(0.2,0.1)"}}, "^vary: .*2\\.3 %"),
        ({"pixel": True, "omega": "1:9:5", "samples": 1}, "^samples: 1 is not in 2 to"),
        ({"pixel": True, "omega": "1:9:5", "repair": True}, "^repair: probabilities have none"),
        ({"sharpness": True, "out": "x", "tile": "1/2"}, "^sharpness: a shard has no boundaries"),
    ],
)
def test_bad_input_is_a_line_with_its_keyword(keywords, line):
    scene = {"object": 1, "t_h": 1.75, "t_v": 0.75, "omega": 5.0, "a_h": 4.0}
    with pytest.raises(ValueError, match=line) as error:
        topple.pulse(**(scene | keywords))
    assert "\n" not in str(error.value) and "--" not in str(error.value)


def test_records_that_make_no_sense():
    scene = {"object": 1, "t_h": 1.75, "t_v": 0.75}
    for keywords, line in [
        ({"horizontal": [0.1, 0.2], "units": "g"}, "^dt: missing"),
        ({"horizontal": [0.1, 0.2], "dt": 0.01}, "^units: missing"),
        ({"horizontal": [0.1, 0.2], "dt": 0.01, "units": "ft"}, "^units: ft"),
        ({"horizontal": [0.1], "dt": 0.01, "units": "g"}, "^horizontal: give two"),
        ({"horizontal": [0.0, 0.0], "dt": 0.01, "units": "g"}, "^horizontal: all samples"),
        ({"horizontal": [0.1, float("inf")], "dt": 0.01, "units": "g"}, "^horizontal: "),
        ({"horizontal": [0.1, 0.2], "dt": -1, "units": "g"}, "^dt: -1"),
        ({"vertical": [0.1, 0.2], "dt": 0.01, "units": "g"}, "^horizontal: give both"),
        ({"horizontal": [[0.0, 0.1], [0.1, 0.2]], "dt": 0.01, "units": "g"}, r"^horizontal: an array of shape \(2, 2\)"),
        ({"horizontal": [1.0, 2.0j], "dt": 0.01, "units": "g"}, "^horizontal: no array of numbers"),
        ({"horizontal": ["a", "b"], "dt": 0.01, "units": "g"}, "^horizontal: no array of numbers"),
        ({"horizontal": [0.1, 0.2, float("nan")], "dt": 0.01, "units": "g"}, "^horizontal: sample 2 "),
        ({"horizontal": [0.1, 0.2], "dt": "x", "units": "g"}, "^dt: "),
        ({"horizontal": [100.0, 500.0], "dt": 0.01, "units": "m/s2"}, "^units: in m/s2 the peak is 500 m/s2"),
        ({"omega": 3.0}, "^omega: a record shakes the base here"),
    ]:
        with pytest.raises(ValueError, match=line):
            topple.seismic(**scene, **keywords)
    with pytest.raises(OSError):
        topple.seismic(**scene, horizontal="no/such/file.at2")


def test_progress_is_told_and_may_end_the_call():
    heard = []
    topple.pulse(**(LONG | {"omega": "0.2:15:300", "a_h": "0.1:15:300"}), progress=lambda *told: heard.append(told))
    assert heard[-1][1] == heard[-1][2]
    assert {"sweep", "reference"} <= {phase for phase, *_ in heard} | {"reference"}

    def stop(*_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        topple.pulse(**LONG, progress=stop)


def test_ctrl_c_ends_a_call():
    """The sweep hears of it within 20 ms and ends within 100; a busy machine may take longer."""
    script = textwrap.dedent(
        f"""
        import os, signal, threading, time, topple
        # A job in the background of a shell begins with Ctrl-C ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        at = []
        def press():
            at.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Timer(1.0, press).start()
        try:
            topple.pulse(**{LONG!r}, progress=False)
        except KeyboardInterrupt:
            print(time.perf_counter() - at[0])
        """
    )
    if sys.platform == "win32":
        pytest.skip("os.kill sends no Ctrl-C there")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) < 0.5


def test_ctrl_c_leaves_a_history():
    """The reference takes seconds for this cell; nobody waits for it."""
    script = textwrap.dedent(
        """
        import os, signal, threading, time, topple
        # A job in the background of a shell begins with Ctrl-C ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        at = []
        def press():
            at.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Timer(0.5, press).start()
        try:
            topple.history(object=1, t_h=1.75, t_v=0.75, omega=9, a_h=2, t_max=100000, force=True, backend="reference")
        except KeyboardInterrupt:
            print(time.perf_counter() - at[0], flush=True)
        os._exit(0)
        """
    )
    if sys.platform == "win32":
        pytest.skip("os.kill sends no Ctrl-C there")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) < 0.5


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked there")
def test_a_forked_process_says_what_to_do():
    script = textwrap.dedent(
        """
        import os, sys, topple
        scene = dict(object=1, t_h=1.75, t_v=0.75, omega=5.0, a_h=4.0, verify=0, backend="cpu")
        topple.pulse(**scene)
        child = os.fork()
        if child == 0:
            try:
                topple.pulse(**scene)
            except RuntimeError as error:
                os._exit(7 if "spawn" in str(error) else 8)
            os._exit(9)
        sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
        """
    )
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 7, (done.returncode, done.stderr)


def test_other_threads_go_on():
    """The interpreter's lock is released: a thread of Python counts while a map is swept."""
    counted = 0
    stop = threading.Event()

    def count():
        nonlocal counted
        while not stop.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    began = time.perf_counter()
    topple.pulse(**(LONG | {"omega": "0.2:15:400", "a_h": "0.1:15:400"}), verify=0, progress=False)
    took = time.perf_counter() - began
    stop.set()
    thread.join()
    # With the lock held it would not count at all; 1 ms is slept at least, some ms on a busy machine.
    assert counted > took / 0.05


def test_without_xarray():
    script = textwrap.dedent(
        """
        import sys
        sys.modules["xarray"] = None
        import topple
        map = topple.pulse(object=1, t_h=1.75, t_v=0.75, omega="1:9:4", a_h=[2.0, 6.0, 10.0], verify=0)
        assert type(map) is topple.Arrays and map["outcome"].shape == (3, 4) and "omega" in map
        assert map.data_vars["zeta"][0] == ("a_h", "omega")
        try:
            map.zeta
        except AttributeError as error:
            assert "install xarray" in str(error)
        else:
            raise AssertionError("an attribute that is not there")
        """
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_what_a_call_cannot_use_is_an_error(tmp_path):
    cell = {"object": 1, "t_h": 1.75, "t_v": 0.75, "omega": 5.0, "a_h": 4.0}
    settings = {"out": tmp_path, "resume": True, "tile": "1/2", "verify": 3, "repair": True, "resolve": True, "adapter": 0, "threads": 2}
    for key, value in settings.items():
        with pytest.raises(ValueError, match=f"^{key}: .*how a map is run"):
            topple.history(**cell, **{key: value})
    base = {"object": 1, "t_h": 1.75, "t_v": 0.75}
    (tmp_path / "a.txt").write_text("0.1\n0.2\n")
    for key, value in {"dt": 0.01, "units": "g", "vertical": tmp_path / "a.txt"}.items():
        with pytest.raises(ValueError, match=f"^{key}: no horizontal record is given"):
            topple.seismic(**base, **{key: value})
    for call in (topple.pulse, topple.history):
        with pytest.raises(ValueError, match="^progress: give False"):
            call(**cell, progress=3)
    with pytest.raises(ValueError, match="^out: 3 is not a path"):
        topple.pulse(**cell, out=3)
    assert topple.pulse(**cell, resume=False, verify=False)["zeta"].shape == (1, 1)


def test_a_history_is_drawn_in_one_way():
    pytest.importorskip("matplotlib")
    motion = topple.history(object=1, t_h=1.75, t_v=0.75, omega=6.0, a_h=8.0)
    for key, draw in (
        ("column", lambda: motion.topple.plot("zeta")),
        ("ax", lambda: motion.topple.plot(ax="none")),
        ("cell", lambda: motion.topple.animate({"omega": 6.0})),
        ("omega", lambda: motion.topple.animate(omega=6.0)),
    ):
        with pytest.raises(ValueError, match=f"^{key}: a history"):
            draw()
