"""Least amplitudes that overturn a free-standing block, by SciPy: the figures of tests/engine/free_standing.rs.

theta'' = -p^2 [sin(s alpha - theta) + a(t)/g cos(s alpha - theta)], s the sign of theta (Zhang & Makris 2001);
the angular velocity after an impact is eta times the one before. python3 tests/data/free_standing.py
"""

from math import atan, copysign, cos, exp, pi, sin, sqrt, tan

from scipy.integrate import solve_ivp
from scipy.optimize import brentq

G, P, ALPHA, ETA, END = 9.81, 2.14, 0.25, 0.9, 25.0


def one_cosine(x):
    return cos(2 * pi * x)


def ricker(x):
    s = pi * (x - 1.5)
    return (1 - 2 * s * s) * exp(-s * s)


def ricker_antisymmetric(x):
    beta = sqrt(3 - sqrt(6)) * sqrt(6) * exp(-(3 - sqrt(6)) / 2)
    s = 2 * pi * (x - 2) / sqrt(3)
    return (s * s - 3) * s * exp(-s * s / 2) / beta


def overturns(wave, periods, w, a):
    """Impacts before overturning; None where the block stands."""
    period = 2 * pi / (w * P)
    pulse_end = periods * period
    amplitude = a * ALPHA * G

    def ground(t, forced):
        return amplitude * wave(t / period) if forced else 0.0

    t, theta, rate, side, impacts = 0.0, 0.0, 0.0, 0, 0
    for until, forced in ((pulse_end, True), (END, False)):
        while t < until:
            if side == 0:
                # At rest on both corners until the ground's acceleration lifts it.
                lift = lambda t: abs(ground(t, forced)) - G * tan(ALPHA)
                if lift(t + 1e-12) <= 0:
                    if not forced:
                        return None
                    steps = [t + (until - t) * k / 4000 for k in range(4001)]
                    found = next((k for k in range(1, 4001) if lift(steps[k]) > 0), None)
                    if found is None:
                        t = until
                        continue
                    t = brentq(lift, steps[found - 1], steps[found], xtol=1e-14)
                side = -copysign(1, ground(t + 1e-9, forced))
                theta, rate = 0.0, 0.0

            def slope(t, y, s=side):
                push = ground(t, forced) / G
                return [y[1], -P * P * (sin(s * ALPHA - y[0]) + push * cos(s * ALPHA - y[0]))]

            def lands(t, y, s=side):
                # Just after an uplift the angle is zero too.
                return s * y[0] + (1e-13 if t == start else 0)

            def falls(t, y):
                return abs(y[0]) - pi / 2

            start = t
            lands.terminal, lands.direction, falls.terminal = True, -1, True
            run = solve_ivp(slope, (t, until), [theta, rate], method="DOP853", rtol=1e-10, atol=1e-13,
                            max_step=period / 16, events=(lands, falls))
            t, (theta, rate) = run.t[-1], run.y[:, -1]
            if len(run.t_events[1]):
                return impacts
            if len(run.t_events[0]):
                impacts += 1
                theta, rate = 0.0, ETA * rate
                side = -side
                if abs(rate) < 1e-5:
                    side = 0
    return None


def threshold(test, low, high):
    first = test(low)
    assert first != test(high), (low, high)
    while high - low > 1e-7:
        middle = (low + high) / 2
        if test(middle) == first:
            low = middle
        else:
            high = middle
    return (low + high) / 2


if __name__ == "__main__":
    for wave, periods in ((one_cosine, 1), (ricker, 3), (ricker_antisymmetric, 4)):
        for w in (3.0,):
            amplitudes = [1 + 0.1 * k for k in range(1, 140)]
            said, last = [], None
            for a in amplitudes:
                now = overturns(wave, periods, w, a)
                if now != last:
                    at = threshold(lambda a: overturns(wave, periods, w, a) == last, a - 0.1, a)
                    said.append(f"{last} -> {now} at {at:.5f}")
                last = now
            print(wave.__name__, f"omega_p/p = {w}:", "; ".join(said[:8]), flush=True)
