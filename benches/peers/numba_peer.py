"""A fast Python program: fixed-step RK4 compiled by numba over all threads, every switch found by
bisection of the step and the rest of the step taken from there.

    python numba_peer.py DIR RESULTS.csv

DIR holds the cells.csv and record.csv of `topple chart --cells-only --out DIR`.
"""

import sys
import time

import numba
import numpy as np
from numba import njit, prange

import cells as common
from cells import GRAVITY, SWITCHES

STEPS = [0.5**power for power in range(5, 12)]
REST = 1e-4
OUTCOMES = ["full_contact", "rocking", "overturned_left", "overturned_right", "unresolved"]
KINDS = ["", "uplift_left", "uplift_right", "impact_left", "impact_right", "impact_rest", "overturn"]
FIELDS = ["recorded", "omega", "a_h", "a_v", "dt", "t_max", "tilt", "half_width", "height", "offset",
          "mu_h", "mu_v", "rho2", "omega_h", "omega_v", "psi", "xi_h", "xi_v", "u_y", "v0",
          "pulse_end", "moves_h", "moves_v"]
CELL = np.dtype([(name, np.float64) for name in FIELDS])


@njit(inline="always")
def ground(c, record, t):
    if c.recorded != 0.0:
        x = t / c.dt
        i = min(int(x), record.shape[0] - 2)
        share = x - i
        return (record[i, 0] + share * (record[i + 1, 0] - record[i, 0]),
                record[i, 1] + share * (record[i + 1, 1] - record[i, 1]))
    if t >= c.pulse_end:
        return 0.0, 0.0
    wave = np.sin(c.omega * t)
    return c.a_h * wave, c.a_v * wave


@njit
def rates(c, record, side, t, y, k):
    """Fills k with the rates of y; returns X and Y."""
    ug, vg = ground(c, record, t)
    f_h, f_v = ug, vg + GRAVITY
    if c.moves_h != 0.0:
        f_h = -(c.psi * c.omega_h**2 * y[0] + (1 - c.psi) * c.omega_h**2 * c.u_y * y[4]
                + 2 * c.xi_h * c.omega_h * y[1])
    if c.moves_v != 0.0:
        f_v = -(c.omega_v**2 * y[2] + 2 * c.xi_v * c.omega_v * y[3])
    ddphi = 0.0
    if side != 0:
        b, h = c.half_width + side * c.offset, c.height
        sin, cos = np.sin(y[5]), np.cos(y[5])
        p, q = h * cos + side * b * sin, side * b * cos - h * sin
        w = y[6] * y[6]
        f_h += c.mu_h * q * w
        f_v += c.mu_v * p * w
        ddphi = (p * f_h - q * f_v) / (c.rho2 + b * b + h * h - c.mu_h * p * p - c.mu_v * q * q)
        f_h += c.mu_h * p * ddphi
        f_v -= c.mu_v * q * ddphi
    k[0], k[2], k[5], k[6] = y[1], y[3], y[6], ddphi
    k[1] = f_h - ug if c.moves_h != 0.0 else 0.0
    k[3] = f_v - vg - GRAVITY if c.moves_v != 0.0 else 0.0
    k[4] = 0.0
    if c.moves_h != 0.0 and c.u_y > 0.0:
        loading = 1.0 if y[1] * y[4] > 0.0 else 0.0
        k[4] = y[1] / c.u_y * (1.0 - y[4] * y[4] * loading)
    return f_h, f_v


@njit
def step(c, record, side, t, h, y, out, k):
    """One step of RK4 from y to out; k has room for five rows."""
    rates(c, record, side, t, y, k[0])
    for i in range(7):
        k[4, i] = y[i] + 0.5 * h * k[0, i]
    rates(c, record, side, t + 0.5 * h, k[4], k[1])
    for i in range(7):
        k[4, i] = y[i] + 0.5 * h * k[1, i]
    rates(c, record, side, t + 0.5 * h, k[4], k[2])
    for i in range(7):
        k[4, i] = y[i] + h * k[2, i]
    rates(c, record, side, t + h, k[4], k[3])
    for i in range(7):
        out[i] = y[i] + h / 6 * (k[0, i] + 2 * (k[1, i] + k[2, i]) + k[3, i])


@njit
def uplift(c, record, t, y, k):
    """The corner that the block lifts about, or 0."""
    x_base, y_base = rates(c, record, 0, t, y, k)
    left = x_base - (c.half_width + c.offset) / c.height * y_base
    right = -x_base - (c.half_width - c.offset) / c.height * y_base
    if left > 0.0 and left >= right:
        return 1
    return -1 if right > 0.0 else 0


@njit
def happened(c, record, side, t, y, k):
    """1 impact or uplift left, 2 overturning or uplift right, 0 nothing."""
    if side == 0:
        corner = uplift(c, record, t, y, k)
        return 1 if corner > 0 else (2 if corner < 0 else 0)
    if side * y[5] < 0.0:
        return 1
    angle = np.arctan2(c.half_width + side * c.offset, c.height)
    return 2 if side * y[5] >= angle else 0


@njit
def solve(c, record, longest, kinds, times, motions):
    """Outcome and zeta of a cell; its first switches go to the arrays."""
    y, end, k = np.zeros(7), np.zeros(7), np.zeros((5, 7))
    y[2], y[5] = c.v0, c.tilt
    side = int(np.sign(c.tilt))
    largest = np.zeros(2)
    largest[0 if side > 0 else 1] = abs(c.tilt)
    lifted, count, t = side != 0, 0, 0.0
    forced_end = min(c.pulse_end, c.t_max)
    unit = c.dt if c.recorded != 0.0 else forced_end
    pieces = max(1, int(np.ceil(unit / longest)))
    forced = unit / pieces
    steps_forced = int(round(forced_end / unit)) * pieces
    free = c.t_max - forced_end
    steps_free = int(np.ceil(free / longest - 1e-9))
    for n in range(steps_forced + steps_free):
        if n < steps_forced:
            begin, h = n * forced, forced
        else:
            h = free / steps_free
            begin = forced_end + (n - steps_forced) * h
        done = 0.0
        for _ in range(200):
            t = begin + done
            left = h - done
            if side == 0:
                corner = uplift(c, record, t, y, k[0])
                if corner != 0:
                    side, lifted = corner, True
                    if count < SWITCHES:
                        kinds[count], times[count] = (1 if side > 0 else 2), t
                        motions[count] = y
                    count += 1
                    continue
            step(c, record, side, t, left, y, end, k)
            what = happened(c, record, side, t + left, end, k[0])
            if what == 0:
                y[:] = end
                if side != 0:
                    i = 0 if side > 0 else 1
                    largest[i] = max(largest[i], abs(y[5]))
                break
            low, high = 0.0, left
            for _ in range(48):
                middle = 0.5 * (low + high)
                step(c, record, side, t, middle, y, end, k)
                if happened(c, record, side, t + middle, end, k[0]) != 0:
                    high = middle
                else:
                    low = middle
            step(c, record, side, t, high, y, end, k)
            what = happened(c, record, side, t + high, end, k[0])
            y[:] = end
            done += high
            t = begin + done
            kind = 0
            if side == 0:
                side, lifted = (1 if what == 1 else -1), True
                kind = 1 if side > 0 else 2
            elif what == 2:
                if count < SWITCHES:
                    kinds[count], times[count] = 6, t
                    motions[count] = y
                return (2 if side > 0 else 3), 1.0
            else:
                b = c.half_width - side * c.offset
                other = c.half_width + side * c.offset
                kappa_h, kappa_v = 1 - c.mu_h, 1 - c.mu_v
                d = c.rho2 + c.height**2 * kappa_h + b * b * kappa_v
                dphi = y[6]
                y[1] -= 2 * c.half_width * b * c.height * c.mu_h * kappa_v / d * dphi
                y[3] += side * 2 * c.half_width * c.mu_v * (c.height**2 * kappa_h + c.rho2) / d * dphi
                y[6] = (c.rho2 + c.height**2 * kappa_h - b * other * kappa_v) / d * dphi
                y[5] = 0.0
                side = -side
                if abs(y[6]) < REST:
                    side, y[6] = 0, 0.0
                kind = 5 if side == 0 else (3 if side > 0 else 4)
            if count < SWITCHES:
                kinds[count], times[count] = kind, t
                motions[count] = y
            count += 1
            if done >= h:
                break
        if not np.isfinite(y[5] + y[0] + y[2]):
            return 4, 0.0
    left_angle = np.arctan2(c.half_width + c.offset, c.height)
    right_angle = np.arctan2(c.half_width - c.offset, c.height)
    return (1 if lifted else 0), max(largest[0] / left_angle, largest[1] / right_angle)


@njit(parallel=True)
def sweep(cells, record, longest, outcomes, zetas, kinds, times, motions):
    for i in prange(cells.shape[0]):
        outcomes[i], zetas[i] = solve(cells[i], record, longest, kinds[i], times[i], motions[i])


def run(cells, record, longest):
    count = len(cells)
    packed = np.zeros(count, CELL)
    for i, c in enumerate(cells):
        packed[i] = tuple(float(getattr(c, name)) for name in FIELDS)
    packed = packed.view(np.recarray)
    result = (np.zeros(count, np.int64), np.zeros(count), np.zeros((count, SWITCHES), np.int64),
              np.zeros((count, SWITCHES)), np.zeros((count, SWITCHES, 7)))
    began = time.perf_counter()
    sweep(packed, record, longest, *result)
    return time.perf_counter() - began, result


def main(directory, results):
    scenes, record = common.read(directory)
    began = time.perf_counter()
    run(next(iter(scenes.values()))[:2], record, 0.05)
    start = time.perf_counter() - began
    rows = []
    for scene, cells in scenes.items():
        for longest in STEPS:
            if cells[0].recorded and longest > cells[0].dt:
                continue
            runs = [run(cells, record, longest) for _ in range(2)]
            seconds, (outcomes, zetas, kinds, times, motions) = min(runs, key=lambda r: r[0])
            print(f"{scene:8} 1/{1 / longest:g} s: {len(cells) / seconds:.0f} cells/s", file=sys.stderr)
            for i, c in enumerate(cells):
                switches = [common.switch(KINDS[kinds[i, j]], times[i, j], motions[i, j])
                            for j in range(SWITCHES) if kinds[i, j]]
                rows.append(dict(
                    scene=scene, method=f"numba {numba.__version__}", precision="f64",
                    step=longest, tolerance="", threads=numba.get_num_threads(),
                    seconds_a_cell=seconds / len(cells), start_seconds=start, runs=2,
                    cell=int(c.cell), outcome=OUTCOMES[outcomes[i]], zeta=zetas[i],
                    switches=";".join(switches)))
    common.write(results, rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
