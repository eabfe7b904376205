"""What the Python package costs: its size and import, a call over its sweep, the memory of a large map, and a map
beside the same by SciPy's solve_ivp cell by cell.

    topple chart --cells-only --out DIR
    python benches/python/measure.py DIR

in an environment with the package, scipy, xarray.
"""

import json
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "peers"))

SCENE = {"object": 1, "eccentricity": 0.2, "t_h": 1.75, "t_v": 0.75, "progress": False, "verify": 0, "backend": "cpu"}


def size():
    import topple

    files = [path for path in Path(topple.__file__).parent.rglob("*") if path.suffix != ".pyc" and path.is_file()]
    print(f"installed: {sum(path.stat().st_size for path in files) / 1e6:.1f} MB")


def imports():
    def seconds(module):
        line = f"import time; t = time.perf_counter(); import {module}; print(time.perf_counter() - t)"
        runs = [subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, check=True) for _ in range(9)]
        return statistics.median(float(run.stdout) for run in runs)

    numpy, whole = seconds("numpy"), seconds("topple")
    print(f"import topple: {1e3 * whole:.0f} ms, of which numpy {1e3 * numpy:.0f} ms")


def overhead():
    import topple

    keywords = SCENE | {"omega": "0.2:15:400", "a_h": "0.1:15:400"}
    topple.pulse(**keywords)
    ratios = []
    for _ in range(9):
        began = time.perf_counter()
        found = topple.pulse(**keywords)
        whole = time.perf_counter() - began
        ratios.append((whole / found.attrs["sweep_seconds"], whole))
    ratio, whole = statistics.median(ratios)
    print(f"400 x 400: a call takes {whole:.3f} s, {100 * (ratio - 1):.1f} % over its sweep (median of 9)")


def memory():
    script = (
        "import json, resource, sys, topple, xarray\n"
        "peak = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024\n"
        f"scene = {SCENE!r}\n"
        "topple.pulse(**scene, omega='0.2:15:40', a_h='0.1:15:40')\n"
        "before = peak()\n"
        "map = topple.pulse(**scene, omega='0.2:15:4096', a_h='0.1:15:4096')\n"
        "print(json.dumps([before, peak(), map.nbytes, map.attrs['sweep_seconds']]))\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    before, peak, held, seconds = json.loads(done.stdout)
    print(
        f"4096 x 4096: the Dataset is {held / 1e9:.2f} GB, the process grew by {(peak - before) / 1e9:.2f} GB at most, "
        f"the sweep took {seconds:.0f} s"
    )


def against_scipy(directory):
    import cells as common
    from scipy_peer import solve

    import topple

    scenes, record = common.read(directory)
    pulse = scenes["pulse"]
    keys = ("t_h", "t_v", "psi", "xi_h", "xi_v", "alpha_y", "half_width", "height", "offset", "mass", "inertia", "plate_h", "plate_v", "a_v", "t_max")
    scene = {key: getattr(pulse[0], key) for key in keys}
    omega = sorted({c.omega for c in pulse})
    a_h = sorted({c.a_h for c in pulse})
    began = time.perf_counter()
    by_scipy = {(c.a_h, c.omega): solve(c, record, 1e-6)[0] for c in pulse}
    scipy_seconds = time.perf_counter() - began
    runs = []
    for _ in range(9):
        began = time.perf_counter()
        found = topple.pulse(**scene, omega=omega, a_h=a_h, backend="cpu", verify=0, progress=False)
        runs.append(time.perf_counter() - began)
    names = found.outcome.flag_meanings.split()
    differ = sum(
        names[int(found.outcome.sel(a_h=a, omega=o))] != outcome for (a, o), outcome in by_scipy.items()
    )
    seconds = statistics.median(runs)
    print(
        f"{len(pulse)} cells: SciPy (RK45, rtol 1e-6) {scipy_seconds:.1f} s, the call {1e3 * seconds:.1f} ms, "
        f"{scipy_seconds / seconds:.0f} times; {differ} outcomes differ"
    )


if __name__ == "__main__":
    size()
    imports()
    overhead()
    memory()
    against_scipy(sys.argv[1])
