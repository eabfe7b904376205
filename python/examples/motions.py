"""Made-up ground motions for the examples: noise under an envelope, through the filter of Kanai and Tajimi.

They stand for a suite of records; put the folder of your own in their place.
"""

import csv
from pathlib import Path

import numpy as np


def ground_motion(seed, peak, duration=20.0, dt=0.01, frequency=15.0, damping=0.6):
    """A motion of a largest acceleration `peak`: the acceleration of a filter (rad/s) under noise."""
    noise = np.random.default_rng(seed).standard_normal(round(duration / dt))
    t = np.arange(noise.size) * dt
    envelope = np.minimum(t / 3.0, 1.0) * np.exp(-np.maximum(t - 8.0, 0.0) / 3.0)
    spectrum = np.fft.rfft(noise * envelope)
    omega = 2.0 * np.pi * np.fft.rfftfreq(noise.size, dt)
    ratio = omega / frequency
    filtered = (1.0 + 2.0j * damping * ratio) / (1.0 - ratio**2 + 2.0j * damping * ratio)
    # Without the longest periods, so that it ends without a velocity.
    long = (omega / 0.6) ** 2 / (1.0 + (omega / 0.6) ** 2)
    motion = np.fft.irfft(spectrum * filtered * long, noise.size)
    return motion * peak / np.abs(motion).max()


def write_suite(folder, count, peak_h=4.0, peak_v=2.0, dt=0.01):
    """Writes `count` pairs and their list into a folder; returns the path of the list."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "list.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["id", "horizontal", "vertical", "dt", "units"])
        for k in range(count):
            for name, seed, peak in (("h", k, peak_h), ("v", 1000 + k, peak_v)):
                np.savetxt(folder / f"{k:02}_{name}.txt", ground_motion(seed, peak, dt=dt), fmt="%.6e")
            table.writerow([f"motion {k + 1}", f"{k:02}_h.txt", f"{k:02}_v.txt", dt, "m/s2"])
    return folder / "list.csv"
