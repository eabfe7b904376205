#!/usr/bin/env python3
"""Compares two programs topple byte for byte: the files of some forty scenes, on the CPU and on a GPU, in f32 and f64.

    python3 benches/same/same.py OLD NEW [--only WORD] [--keep FOLDER]

OLD and NEW are paths of binaries. Each scene is run by both, each in a folder of its own; all files that they write
must be the same, byte for byte. In run.json times and speeds are left out of the comparison, and what a backend says
of itself. A GPU, or a software adapter, is used where `topple adapters` lists one. The exit status is 1 where a file differs.

Whoever changes the engine's shape and not its results runs it before and after.
"""

import argparse
import hashlib
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# Object 1 on the base of Fig. 11.
BASE = "--object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75"
PLANE = "--omega 0.2:15:24 --a-h 0.1:15:20"
PERIODS = "--t-h 0.5:4:12 --t-v 0.05:2:10"
FREE = "--half-width 0.3 --height 0.9 --isolation none"
SUITE = "--suite suite --object 1 --u-y 0.01 --t-h 0.5:4:5 --t-v 0.1:1:4"

# What every backend and both precisions run.
MAPS = {
    "pulse": f"pulse {BASE} --a-v 0.5 {PLANE}",
    "one-cosine": f"pulse {BASE} --pulse one-cosine --cycles 2 {PLANE}",
    "half-sine": f"pulse {BASE} --pulse half-sine --a-v 2 {PLANE}",
    "rectangle": f"pulse {BASE} --pulse rectangle {PLANE}",
    "ricker": f"pulse {BASE} --pulse ricker {PLANE}",
    "ricker-antisymmetric": f"pulse {BASE} --pulse ricker-antisymmetric {PLANE}",
    "bell": f"pulse {BASE} --pulse mavroeidis-papageorgiou --omega 5 --a-h 4 --gamma 1:4:13 --phase 0:3:11",
    "horizontal": f"pulse --object 2 --isolation horizontal --t-h 2 {PLANE}",
    "vertical": f"pulse --object 3 --isolation vertical --t-v 0.5 --a-v 1 {PLANE}",
    "ground": f"pulse {FREE} {PLANE}",
    "quarter-turn": f"pulse {FREE} --overturn quarter-turn {PLANE}",
    "restitution": f"pulse {FREE} --restitution 0.9 {PLANE}",
    "no loss": f"pulse {FREE} --restitution 1 --omega 3:9:9 --a-h 2:9:9 --t-max 8",
    "tilt": f"pulse {BASE} --tilt 0.02 {PLANE}",
    "wall": f"pulse {BASE} --psi 0:1:6 --bouc-wen-n 1:4:4 --omega 5 --a-h 4:6:7",
    "damping": f"pulse {BASE} --xi-h 0:0.4:8 --xi-v 0:0.4:8 --omega 6 --a-h 6",
    "device": f"pulse {BASE} --u-y 0.001:0.1:9:log --omega 1,2,4,8 --a-h 3,-5,8",
    "force": f"pulse {BASE} --yield-force 200:4000:9 --omega 3 --a-h 3:9:9",
    "block": "pulse --slenderness 2:6:8 --size 0.5:2:8 --isolation none --omega 4 --a-h 5",
    "offset": f"pulse --half-width 0.2 --height 0.8 --mass 500 --plate-h 50 --plate-v 50 --offset 0:0.15:9"
    f" --t-h 1.5 --t-v 0.4 --omega 4:9:9 --a-h 6",
    "six axes": "pulse --object 1 --t-h 1,2 --t-v 0.3,0.7 --eccentricity 0,0.3 --psi 0.1,0.5 --omega 4:9:5 --a-h 3:9:6",
    "full model": f"pulse {BASE} --full-model --omega 0.2:15:10 --a-h 0.1:15:10",
    "friction": f"pulse {BASE} --friction 0.4 {PLANE}",
    "small step": f"pulse {BASE} --step 0.002 --omega 0.2:15:10 --a-h 0.1:15:10",
    "record": f"seismic --object 1 --eccentricity -0.4 {PERIODS}",
    "record of ground": f"seismic {FREE} --scale 0.2:3:30",
    "record and scale": "seismic --object 2 --t-h 1:3:5 --t-v 0.5 --u-y 0.01 --scale 0.5:2:5",
    "record and peak": "seismic --object 3 --t-h 1:3:5 --t-v 0.5 --pga 2:9:5 --t-max 40",
    "record, horizontal": "seismic --object 1 --isolation horizontal --t-h 0.5:4:30",
}
# What is run on the CPU in f32 alone: the ways around the sweep, not the sweep.
STUDIES = {
    "verified": f"pulse {BASE} --omega 2:9:12 --a-h 2:9:12 --verify 40",
    "resolve": f"pulse {BASE} --resolve --omega 2:9:12 --a-h 2:9:12",
    "repair": f"pulse {BASE} --repair --omega 2:9:12 --a-h 2:9:12",
    "refine": f"pulse {BASE} --omega 0.2:15:9 --a-h 0.1:15:9 --refine 4 --verify none",
    "smooth": f"seismic --object 1 --t-h 0.5:4:9 --t-v 0.3:2:9 --refine 3 --smooth 0.02 --verify none",
    "zarr": f"pulse {BASE} --omega 0.2:15:30 --a-h 0.1:15:30 --files zarr,csv,npz --verify none",
    "sharpness": f"pulse {BASE} --omega 0.2:15:30 --a-h 0.1:15:30 --sharpness --verify none",
    "vary": f"pulse {BASE} --omega 2:9:8 --a-h 2:9:8 --vary eccentricity=normal(0.2,0.02) --samples 8 --verify none",
    "pixel": f"pulse {BASE} --omega 2:9:8 --a-h 2:9:8 --pixel --samples 8 --verify none",
    "reference": f"pulse {BASE} --omega 2:9:4 --a-h 2:9:4 --backend reference --verify none",
    "history": f"history {BASE} --omega 9 --a-h 8.4",
    "suite": "suite suite",
    "envelope": f"envelope {SUITE} --limit-u 0.4 --limit-v 0.05 --both-directions",
    "fragility": "fragility --suite suite --object 1 --u-y 0.01 --t-h 1,2 --t-v 0.5 --levels 1:12:5",
    # Fits that have a beta: their intervals are those of the bootstrap.
    "fragility, resampled": "fragility --suite stretched --object 1 --u-y 0.01 --t-h 0.8,1.6 --t-v 0.3 --levels 0.5:20:12"
    " --limit-zeta 0.5 --estimator stripes,ida,cloud",
    "fragility, varied": "fragility --suite suite --object 1 --u-y 0.01 --t-h 1,2 --t-v 0.5 --levels 1:12:5 "
    "--bootstrap 99 --vary eccentricity=normal(0.2,0.02) --vary xi-h=lognormal(0.05,0.3,0.02,0.1) --samples 16 --verify none",
    "fragility, rates": "fragility --suite stretched --object 1 --u-y 0.01 --t-h 0.8,1.6 --t-v 0.3 --levels 0.5:20:12"
    " --hazard site.csv --target 0.001 --export nrml,pelicun --bootstrap 99",
    "envelope, columns": f"envelope {SUITE} --limit-u 0.4 --columns zeta,impacts",
    "compare": "compare devices.csv --suite stretched --object 1 --scales 0.5:3:6 --columns zeta,stop_force --hazard site.csv"
    " --levels 0.5:20:12 --limit-u 0.4",
}
# What changes from run to run, and what a backend says of itself; the same do keys with these endings.
CHANGING = {"adapter", "date", "seconds", "start", "sweep", "threads", "timings", "version"}
ENDINGS = ("_seconds", "_per_second")


def still(value):
    """A manifest without what changes from run to run."""
    if isinstance(value, dict):
        kept = {key for key in value if key not in CHANGING and not key.endswith(ENDINGS)}
        return {key: still(value[key]) for key in kept}
    return [still(inner) for inner in value] if isinstance(value, list) else value


def contents(path):
    data = path.read_bytes()
    if path.name == "run.json":
        data = json.dumps(still(json.loads(data)), sort_keys=True).encode()
    return hashlib.sha256(data).hexdigest()


def run(binary, place, out, arguments):
    """Runs a scene into the folder `out`; returns its files by name, or what it was refused with."""
    # Of one name for both: run.json has the paths of a synthetic pair.
    same = place / "out"
    command = [str(binary), *arguments, "--out", str(same), "--quiet"]
    done = subprocess.run(command, cwd=place, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if same.exists():
        same.rename(out)
    if done.returncode:
        return {"refused": f"{done.returncode}: {done.stderr.strip()}"}
    return {str(path.relative_to(out)): contents(path) for path in sorted(out.rglob("*")) if path.is_file()}


def make_suite(binary, place):
    """Suites of made-up motions, the synthetic pair whole, in part, and stretched in time; a site and a list of devices."""
    (place / "site.csv").write_text("pga [m/s2],rate\n1,0.02\n4,0.001\n12,0.00002\n")
    (place / "devices.csv").write_text(
        "device,isolation,t_h,t_v,u_y,radius,mu,stop_gap,stop_stiffness\nfloor,none,,,,,,,\n"
        "spring,dual,0.8,0.3,0.01,,,,\npendulum,horizontal,,,,1.5,0.06,0.05,2e5\n"
    )
    made = place / "made"
    command = [str(binary), "seismic", "--object", "1", "--t-h", "1", "--t-v", "0.4", "--verify", "none", "--out", str(made)]
    subprocess.run(command, check=True, capture_output=True)
    suite = place / "suite"
    suite.mkdir()
    for name in ("synthetic_h.at2", "synthetic_v.at2"):
        shutil.copy(made / name, suite / name)
    (suite / "list.csv").write_text(
        "id,horizontal,vertical,scale\n"
        "a,synthetic_h.at2,synthetic_v.at2,1\nb,synthetic_h.at2,,1.7\nc,synthetic_v.at2,synthetic_h.at2,2.5\n"
    )
    # Motions of other periods: the block fails at other levels.
    suite = place / "stretched"
    suite.mkdir()
    rows = ["id,horizontal"]
    for component in "hv":
        text = (made / f"synthetic_{component}.at2").read_text()
        for stretch in (0.4, 0.7, 1, 1.5, 2.2, 3, 4):
            name = f"{component}{stretch}"
            longer = re.sub(r"(DT= *)(\S+)", lambda found: f"{found[1]}{stretch * float(found[2])}", text, count=1)
            (suite / f"{name}.at2").write_text(longer)
            rows.append(f"{name},{name}.at2")
    (suite / "list.csv").write_text("\n".join(rows) + "\n")


def scenes(gpu):
    """Names and arguments of all runs."""
    backends = [("cpu", "f32"), ("cpu", "f64")] + ([("gpu", "f32"), ("gpu", "f64")] if gpu else [])
    for name, line in MAPS.items():
        for backend, precision in backends:
            verify = ["--verify", "none"]
            yield f"{name}, {backend} {precision}", [*line.split(), "--backend", backend, "--precision", precision, *verify]
    for name, line in STUDIES.items():
        if name in ("reference", "suite"):
            yield name, line.split()
        else:
            yield name, [*line.split(), "--backend", "cpu"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--only", default="", help="scenes whose name has this word")
    parser.add_argument("--keep", type=Path, help="folder that keeps the files of scenes that differ")
    options = parser.parse_args()
    binaries = [options.old.resolve(), options.new.resolve()]
    listed = subprocess.run([binaries[0], "adapters"], capture_output=True, text=True).stdout
    first = [line.strip() for line in listed.splitlines() if line.lstrip().startswith("0")]
    gpu = bool(first)
    print(f"with the adapter {first[0]}" if gpu else "without an adapter: the CPU alone", flush=True)
    wrong = runs = files = 0
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        make_suite(binaries[0], place)
        outs = [place / "old", place / "new"]
        for name, arguments in scenes(gpu):
            if options.only not in name:
                continue
            found = [run(binary, place, out, arguments) for binary, out in zip(binaries, outs, strict=True)]
            runs += 1
            files += len(found[0])
            differ = [file for file in {**found[0], **found[1]} if found[0].get(file) != found[1].get(file)]
            if "refused" in found[0] and not differ:
                differ = [f"refused by both: {found[0]['refused']}"]
            wrong += bool(differ)
            if differ:
                print(f"{name}: {', '.join(differ)}", flush=True)
            for out in outs:
                if differ and options.keep and out.exists():
                    shutil.copytree(out, options.keep / name.replace(" ", "-") / out.name, dirs_exist_ok=True)
                shutil.rmtree(out, ignore_errors=True)
    print(f"{runs} runs, {files} files: {wrong} runs differ")
    return 1 if wrong or not runs else 0


if __name__ == "__main__":
    sys.exit(main())
