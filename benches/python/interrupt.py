"""How long a call goes on after Ctrl-C: the time from the signal to KeyboardInterrupt, at random times of each call.

    python benches/python/interrupt.py [RUNS [CALL ...]]

in an environment with the package, xarray, zarr, dask. The first line is a sleep, which ends as soon as Python hears the
signal: what the machine itself takes. A call that was done before the signal came is not counted. CALL is the beginning of a
line's name.
"""

import os
import random
import shutil
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy as np

import topple

BLOCK = {"object": 1, "progress": False, "backend": "cpu"}
PULSE = BLOCK | {"t_h": 1.75, "t_v": 0.75}
MOTIONS = 40


def motion(seed, dt):
    """A made-up record, m/s^2."""
    t = np.arange(0.0, 20.0, dt)
    noise = np.random.default_rng(seed).normal(size=t.size)
    waves = np.convolve(noise, np.hanning(round(0.3 / dt)), mode="same")
    shaken = waves * np.exp(-(((t - 7.0) / 4.0) ** 2))
    return 4.0 * shaken / np.abs(shaken).max()


def records(folder):
    """A suite of made-up records of 0.001 s, as text."""
    lines = ["id,horizontal,vertical,dt,units"]
    for seed in range(MOTIONS):
        np.savetxt(folder / f"{seed}.txt", motion(seed, 0.001), fmt="%.6e")
        lines.append(f"{seed},{seed}.txt,,0.001,m/s2")
    (folder / "list.csv").write_text("\n".join(lines) + "\n")
    return folder


def calls(suite, out):
    ground = {"horizontal": motion(1, 0.005), "vertical": 0.6 * motion(2, 0.005), "dt": 0.005, "units": "m/s2"}
    periods = {"t_h": "0.5:4:30", "t_v": "0.1:1:30"}
    large = PULSE | {"omega": "0.2:15:2048", "a_h": "0.1:15:2048"}
    small = PULSE | {"omega": "0.2:15:257", "a_h": "0.1:15:257"}

    def stored():
        shutil.rmtree(out, ignore_errors=True)
        topple.pulse(**large, verify=0, out=out)

    return {
        "sleep": lambda: time.sleep(2.0),
        "pulse, 2048 x 2048": lambda: topple.pulse(**large),
        "pulse, 2048 x 2048, out=": stored,
        "pulse, 257 x 257, refine=4": lambda: topple.pulse(**small, refine=4),
        "pulse, 257 x 257, vary=": lambda: topple.pulse(**small, vary={"eccentricity": "normal(0.1,0.02)"}),
        "seismic, 200 x 200": lambda: topple.seismic(**BLOCK, **ground, t_h="0.5:4:200", t_v="0.1:1:200"),
        "suite, 40 records": lambda: topple.suite(suite),
        "envelope, 30 x 30, 40 records": lambda: topple.envelope(suite, **BLOCK, u_y=0.02, **periods),
        "fragility, 40 records, 10 levels": lambda: topple.fragility(
            suite, **BLOCK, u_y=0.02, t_h="1:3:5", t_v=[0.4, 0.8], levels="1:20:10:log", limit_u=0.3, bootstrap=1000
        ),
        "history, reference": lambda: topple.history(
            object=1, t_h=1.75, t_v=0.75, omega=9, a_h=2, t_max=5000, force=True, backend="reference"
        ),
    }


def once(call, after):
    """Seconds from the signal to its end; None where the call was done before."""
    pressed = []

    def press():
        pressed.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(after, press)
    try:
        timer.start()
        call()
        timer.cancel()
        timer.join()
        # The signal may have come between the end of the call and here.
        time.sleep(0.01)
    except KeyboardInterrupt:
        return time.perf_counter() - pressed[0]
    return None


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    wanted = tuple(sys.argv[2:])
    rng = random.Random(1)
    print("| call | whole call, s | stopped | median, ms | 95th percentile, ms | longest, ms |")
    print("|---|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        suite = records(Path(folder))
        for name, call in calls(suite, Path(folder, "out")).items():
            if wanted and not name.startswith(wanted):
                continue
            began = time.perf_counter()
            call()
            whole = time.perf_counter() - began
            times = [once(call, rng.uniform(0.02, 0.95 * whole)) for _ in range(runs)]
            told = 1e3 * np.array([seconds for seconds in times if seconds is not None])
            middle, most, longest = np.percentile(told, [50, 95, 100])
            print(f"| {name} | {whole:.1f} | {len(told)} of {runs} | {middle:.0f} | {most:.0f} | {longest:.0f} |", flush=True)
    # Work that goes on unheard is not waited for.
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
