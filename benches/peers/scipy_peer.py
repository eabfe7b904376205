"""What a researcher writes today: scipy.integrate.solve_ivp with terminal events, cell by cell.

    python scipy_peer.py DIR RESULTS.csv

DIR holds the cells.csv and record.csv of `topple chart --cells-only --out DIR`.
"""

import sys
import time

import numpy as np
import scipy
from scipy.integrate import solve_ivp

import cells as common
from cells import GRAVITY

TOLERANCES = [1e-4, 1e-6, 1e-8]
# Switches after which a cell is given up: terminal events restart the integration at the event, and
# a block that chatters while the ground moves never gets away from it.
MOST_EVENTS = 5000
# |phi'| after an impact below which the block is taken to stand, rad/s.
REST = 1e-4


def right_hand_side(c, side, record):
    """Rates of (u, u', v, v', z, phi, phi') and the base's accelerations X, Y; side 0 is full contact."""
    h, b = c.height, common.arm(c, side) if side else 0.0
    rows = record.tolist()

    def ground(t):
        if c.recorded:
            x = t / c.dt
            i = min(int(x), len(rows) - 2)
            share = x - i
            (h0, v0), (h1, v1) = rows[i], rows[i + 1]
            return h0 + share * (h1 - h0), v0 + share * (v1 - v0)
        if t >= c.pulse_end:
            return 0.0, 0.0
        wave = np.sin(c.omega * t)
        return c.a_h * wave, c.a_v * wave

    def accelerations(t, y):
        u, du, v, dv, z, phi, dphi = y
        ug, vg = ground(t)
        f_h, f_v = ug, vg + GRAVITY
        if c.moves_h:
            f_h = -(c.psi * c.omega_h**2 * u + (1 - c.psi) * c.omega_h**2 * c.u_y * z
                    + 2 * c.xi_h * c.omega_h * du)
        if c.moves_v:
            f_v = -(c.omega_v**2 * v + 2 * c.xi_v * c.omega_v * dv)
        if not side:
            return f_h, f_v, 0.0, ug, vg
        sin, cos = np.sin(phi), np.cos(phi)
        p = h * cos + side * b * sin
        q = side * b * cos - h * sin
        w = dphi * dphi
        f_h += c.mu_h * q * w
        f_v += c.mu_v * p * w
        ddphi = (p * f_h - q * f_v) / (c.rho2 + b * b + h * h - c.mu_h * p * p - c.mu_v * q * q)
        return f_h + c.mu_h * p * ddphi, f_v - c.mu_v * q * ddphi, ddphi, ug, vg

    def rates(t, y):
        u, du, v, dv, z, phi, dphi = y
        x_base, y_base, ddphi, ug, vg = accelerations(t, y)
        ddu = x_base - ug if c.moves_h else 0.0
        ddv = y_base - vg - GRAVITY if c.moves_v else 0.0
        dz = 0.0
        if c.moves_h and c.u_y > 0:
            dz = du / c.u_y * (1 - z * z * (0.5 + 0.5 * np.sign(du * z)))
        return [du, ddu, dv, ddv, dz, dphi, ddphi]

    return rates, accelerations


def events(c, side, accelerations):
    """Terminal events of a phase, in the order of their names."""
    def make(function, direction):
        function.terminal, function.direction = True, direction
        return function

    if side:
        angle = common.critical(c, side)
        return [make(lambda t, y: side * y[5], -1), make(lambda t, y: side * y[5] - angle, 1)]

    def uplift(s):
        def value(t, y):
            x_base, y_base, _, _, _ = accelerations(t, y)
            return s * x_base - common.arm(c, s) / c.height * y_base
        return value

    return [make(uplift(1), 1), make(uplift(-1), 1)]


def solve(c, record, tolerance):
    """Outcome, zeta and first switches of a cell."""
    y = np.array([0.0, 0.0, c.v0, 0.0, 0.0, c.tilt, 0.0])
    side = int(np.sign(c.tilt))
    t, largest, switches, lifted = 0.0, {1: 0.0, -1: 0.0}, [], side != 0
    if side:
        largest[side] = abs(c.tilt)
    phases = {s: right_hand_side(c, s, record) for s in (0, 1, -1)}

    def note(kind):
        if len(switches) < common.SWITCHES:
            switches.append(common.switch(kind, t, y))

    count = 0
    for stop in ([c.t_max] if c.recorded else [min(c.pulse_end, c.t_max), c.t_max]):
        while t < stop:
            count += 1
            if count > MOST_EVENTS:
                return "unresolved", 0.0, switches
            rates, accelerations = phases[side]
            found = events(c, side, accelerations)
            if not side:
                now = [f(t, y) for f in found]
                if max(now) > 0:
                    side = 1 if now[0] >= now[1] else -1
                    lifted = True
                    note("uplift_left" if side > 0 else "uplift_right")
                    continue
            run = solve_ivp(rates, (t, stop), y, rtol=tolerance, atol=0.01 * tolerance,
                            max_step=0.05, events=found, method="RK45")
            t, y = run.t[-1], run.y[:, -1]
            if side:
                largest[side] = max(largest[side], np.max(side * run.y[5]))
            if run.status != 1:
                continue
            which = 0 if run.t_events[0].size else 1
            if not side:
                side = 1 if which == 0 else -1
                lifted = True
                note("uplift_left" if side > 0 else "uplift_right")
            elif which == 1:
                note("overturn")
                return "overturned_left" if side > 0 else "overturned_right", 1.0, switches
            else:
                y = y.copy()
                y[5] = 0.0
                y[1], y[3], y[6] = common.impact(c, -side, y[1], y[3], y[6])
                side = -side
                if abs(y[6]) < REST:
                    side, y[6] = 0, 0.0
                note({1: "impact_left", -1: "impact_right", 0: "impact_rest"}[side])
    zeta = max(largest[s] / common.critical(c, s) for s in (1, -1))
    return "rocking" if lifted else "full_contact", zeta, switches


def main(directory, results):
    scenes, record = common.read(directory)
    rows = []
    for scene, cells in scenes.items():
        for tolerance in TOLERANCES:
            began = time.perf_counter()
            solved = [solve(c, record, tolerance) for c in cells]
            seconds = (time.perf_counter() - began) / len(cells)
            print(f"{scene:8} rtol {tolerance:g}: {1 / seconds:.1f} cells/s", file=sys.stderr)
            for c, (outcome, zeta, switches) in zip(cells, solved):
                rows.append(dict(
                    scene=scene, method=f"SciPy {scipy.__version__}", precision="f64",
                    step="", tolerance=tolerance, threads=1, seconds_a_cell=seconds,
                    start_seconds=0, runs=1, cell=int(c.cell), outcome=outcome, zeta=zeta,
                    switches=";".join(switches)))
    common.write(results, rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
