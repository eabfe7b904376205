"""Fragilities of made-up runs by SciPy 1.17.1, which crates/studies/tests/studies/fits.rs holds topple's to.

    pip install scipy==1.17.1 && python crates/studies/tests/data/fits.py [RUNS.csv ...]

writes fits_runs.csv (the runs), fits_figures.csv (theta and beta of each set by each estimator), fits_curve.csv (a hazard
curve) and fits_rates.csv (annual rates over it) into its own folder. A RUNS.csv has the columns
record,level,failed,collapsed,demand and, if records count differently, weight; its name is that of its set. A demand is that
over its limit: 1 is the limit. The sets real_* are runs of topple itself under 30 motions of a download from PEER, out of
runs.csv of `topple fragility`: a statue (object 1) that overturns, a rack (object 2) with zeta above 0.5, and a cabinet (object 3)
without isolation with zeta above 0.3.
"""

import csv
import pathlib
import sys

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, minimize, root
from scipy.special import expit, log_expit, log_ndtr, ndtr

here = pathlib.Path(__file__).parent


def made(seed, records, levels, theta=1.0, beta=0.4, collapse=2.0, weights=None, demands=True):
    """Runs of records. The demand grows with the level, the block collapses at levels some way above its limit."""
    rng = np.random.default_rng(seed)
    runs = []
    for record in range(records):
        capacity = theta * np.exp(beta * rng.standard_normal())
        falls = collapse * theta * np.exp(beta * rng.standard_normal())
        weight = 1.0 if weights is None else weights(rng)
        for level in levels(rng, record):
            demand = (level / capacity) ** 1.3 * np.exp(0.5 * beta * rng.standard_normal())
            collapsed = level * np.exp(0.5 * beta * rng.standard_normal()) > falls
            failed = bool(collapsed or demand >= 1.0)
            runs.append([record, weight, level, failed, collapsed, demand if demands and not collapsed else None])
    return rounded(runs)


def rounded(runs):
    """The runs as they are in the file."""
    digits = [[r, float(f"{w:.6g}"), float(f"{x:.6g}"), int(f), int(c), d if d is None else float(f"{d:.6g}")]
              for r, w, x, f, c, d in runs]
    return digits


def fixed(*levels):
    return lambda rng, record: levels


def standing_again(seed):
    """30 % of the records stand again above their lowest failing level."""
    rng = np.random.default_rng(seed)
    runs = []
    for record in range(30):
        capacity = np.exp(0.4 * rng.standard_normal())
        again = record % 10 < 3
        fails = 0
        for level in np.geomspace(0.3, 4.0, 10):
            failed = level >= capacity
            fails += failed
            failed = failed and not (again and fails == 2)
            runs.append([record, 1.0, level, failed, failed, None])
    return rounded(runs)


def nearly_separable():
    """All stand up to 1, all fail from 1.2 on, but for one run at 1.2 that stands and one at 1 that fails."""
    runs = [[record, 1.0, level, level > 1.1, level > 1.1, None]
            for record in range(12) for level in (0.6, 0.8, 1.0, 1.2, 1.5, 2.0)]
    runs[3][3] = runs[3][4] = False
    runs[8][3] = runs[8][4] = True
    return rounded(runs)


def falling_at(level, runs):
    """Every block collapses from a level on."""
    return [[r, w, x, 1, 1, None] if x > level else [r, w, x, f, c, d] for r, w, x, f, c, d in runs]


sets = {
    "plain": made(1, 24, fixed(*np.linspace(0.3, 3.0, 8))),
    "weighted": made(2, 24, fixed(*np.linspace(0.3, 3.0, 8)), weights=lambda rng: rng.uniform(0.2, 3.0)),
    "unequal": made(3, 30, lambda rng, record: sorted(rng.choice(np.linspace(0.2, 2.8, 9), 1 + record % 7, False))),
    "narrow": made(4, 20, fixed(*np.linspace(4.8, 5.2, 9)), theta=5.0, beta=0.02, collapse=1.02),
    "nearly": nearly_separable(),
    "decades": made(5, 20, fixed(*np.geomspace(1e-3, 1e2, 11)), theta=0.3, beta=2.0, collapse=20.0),
    "own": made(6, 40, lambda rng, record: np.sort(rng.uniform(0.2, 3.0, 4))),
    "again": standing_again(7),
    "truncated": made(8, 25, fixed(*np.linspace(0.2, 1.2, 6)), theta=1.1, beta=0.5, collapse=1.5,
                      weights=lambda rng: rng.uniform(0.5, 2.0)),
    "overturning": made(9, 25, fixed(*np.linspace(0.3, 3.0, 7)), demands=False,
                        weights=lambda rng: rng.uniform(0.5, 2.0)),
    "step": falling_at(2.1, made(10, 20, fixed(*np.linspace(0.4, 3.2, 8)), theta=1.8, collapse=1e9)),
}


def scaled(runs):
    """Weights that sum to the number of records."""
    weight = {run[0]: run[1] for run in runs}
    factor = len(weight) / sum(weight.values())
    return np.array([run[1] * factor for run in runs])


def best(negative, gradient, starts):
    """The minimum by Nelder and Mead from several starts, then the root of the gradient."""
    found = min((minimize(negative, start, method="Nelder-Mead",
                          options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 20000, "maxfev": 20000})
                 for start in starts), key=lambda fit: fit.fun)
    polished = root(gradient, found.x, method="hybr", tol=1e-14)
    assert np.allclose(polished.x, found.x, rtol=1e-5, atol=1e-6), (polished.x, found.x)
    return polished.x


def starts(y):
    return [(np.mean(y) + shift, np.log(spread)) for shift in (-0.3, 0.0, 0.3) for spread in (0.03, 0.3, 1.5)]


def probit(y, w, failed):
    def parts(p):
        u = (y - p[0]) / np.exp(p[1])
        sign = np.where(failed, 1.0, -1.0)
        return u, sign, log_ndtr(sign * u)

    def gradient(p):
        u, sign, ln = parts(p)
        slope = w * sign * np.exp(-0.5 * u * u - 0.5 * np.log(2.0 * np.pi) - ln)
        return np.array([np.sum(slope) / np.exp(p[1]), np.sum(slope * u)])

    p = best(lambda p: -np.sum(w * parts(p)[2]), gradient, starts(y))
    return np.exp(p[0]), np.exp(p[1])


def logistic(y, w, failed):
    """ln x at P = 1/2, and how far apart in ln x the odds differ by e."""
    sign = np.where(failed, 1.0, -1.0)

    def gradient(p):
        u = (y - p[0]) / np.exp(p[1])
        slope = w * sign * expit(-sign * u)
        return np.array([np.sum(slope) / np.exp(p[1]), np.sum(slope * u)])

    p = best(lambda p: -np.sum(w * log_expit(sign * (y - p[0]) / np.exp(p[1]))), gradient, starts(y))
    return p[0], np.exp(p[1])


def separable(y, failed):
    return np.max(y[~failed], initial=-np.inf) <= np.min(y[failed], initial=np.inf)


def stripes(runs):
    y, failed = np.log([run[2] for run in runs]), np.array([run[3] == 1 for run in runs])
    return None if separable(y, failed) else probit(y, scaled(runs), failed)


def ida(runs):
    records = {}
    for (record, _, level, failed, *_), weight in zip(runs, scaled(runs)):
        one = records.setdefault(record, [weight, np.inf, 0.0])
        one[1] = min(one[1], level) if failed else one[1]
        one[2] = max(one[2], level)
    w, lowest, highest = np.array(list(records.values())).T
    fails = np.isfinite(lowest)
    if fails.all():
        mean = np.average(np.log(lowest), weights=w)
        square = np.average((np.log(lowest) - mean) ** 2, weights=w)
        return np.exp(mean), np.sqrt(square * len(w) / (len(w) - 1))
    y = np.log(np.where(fails, lowest, highest))

    def u(p):
        return (y - p[0]) / np.exp(p[1])

    def negative(p):
        return -np.sum(w * np.where(fails, -0.5 * u(p) ** 2 - p[1], log_ndtr(-u(p))))

    def gradient(p):
        tail = np.exp(-0.5 * u(p) ** 2 - 0.5 * np.log(2.0 * np.pi) - log_ndtr(-u(p)))
        slope = w * np.where(fails, u(p), tail)
        return np.array([np.sum(slope) / np.exp(p[1]), np.sum(slope * u(p)) - np.sum(w[fails])])

    p = best(negative, gradient, starts(y))
    return np.exp(p[0]), np.exp(p[1])


def cloud(runs):
    w = scaled(runs)
    y = np.log([run[2] for run in runs])
    demands = any(run[5] is not None for run in runs)
    collapsed = np.array([run[4 if demands else 3] == 1 for run in runs])
    if separable(y, collapsed):
        if collapsed.all() or not demands:
            return None
        step = 0.5 * (np.max(y[~collapsed]) + np.min(y[collapsed])) if collapsed.any() else np.inf
        falls, scale = (lambda ln: float(ln >= step)), 1.0
    else:
        at, scale = logistic(y, w, collapsed)
        falls = lambda ln: expit((ln - at) / scale)
    exceeds, sigma = (lambda ln: 0.0), 0.0
    if demands:
        # A demand of zero has no logarithm.
        use = np.array([run[4] == 0 and (run[5] or 0.0) > 0.0 for run in runs])
        s, d, v = y[use], np.log([run[5] for run, u in zip(runs, use) if u]), w[use]
        design = np.column_stack([np.ones_like(s), s])
        found, *_ = np.linalg.lstsq(design * np.sqrt(v)[:, None], d * np.sqrt(v), rcond=None)
        sigma = np.sqrt(np.sum(v * (d - design @ found) ** 2) / (np.sum(v) - 2.0))
        exceeds = lambda ln: ndtr((found[0] + found[1] * ln) / sigma)
    curve = lambda ln: exceeds(ln) * (1.0 - falls(ln)) + falls(ln)
    wide = 20.0 * (scale + sigma + np.ptp(y))
    ends = np.mean(y) - wide, np.mean(y) + wide
    level = lambda share: brentq(lambda ln: curve(ln) - share, *ends, xtol=1e-14, rtol=1e-14)
    return np.exp(level(0.5)), 0.5 * (level(ndtr(1.0)) - level(ndtr(-1.0)))


def read(path):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    truth = {"1": 1, "0": 0, "true": 1, "false": 0}
    return [[row["record"], float(row.get("weight") or 1.0), float(row["level"]), truth[row["failed"].lower()],
             truth[row["collapsed"].lower()], float(row["demand"]) if row["demand"] else None] for row in rows]


# Sets that were given once stay: they begin with real_.
with open(here / "fits_runs.csv") as file:
    for row in csv.DictReader(file):
        if row["set"].startswith("real_"):
            demand = float(row["demand"]) if row["demand"] else None
            run = [row["record"], float(row["weight"]), float(row["level"]), int(row["failed"]), int(row["collapsed"]), demand]
            sets.setdefault(row["set"], []).append(run)
for path in map(pathlib.Path, sys.argv[1:]):
    sets[path.stem] = read(path)

with open(here / "fits_runs.csv", "w") as file:
    print("set,record,weight,level,failed,collapsed,demand", file=file)
    for name, runs in sets.items():
        for record, weight, level, failed, collapsed, demand in runs:
            demand = "" if demand is None else f"{demand:.17g}"
            print(f"{name},{record},{weight:.17g},{level:.17g},{failed},{collapsed},{demand}", file=file)

with open(here / "fits_figures.csv", "w") as file:
    print("set,estimator,theta,beta", file=file)
    for name, runs in sets.items():
        for estimator in (stripes, ida, cloud):
            found = estimator(runs)
            theta, beta = ("", "") if found is None else (f"{number:.12g}" for number in found)
            print(f"{name},{estimator.__name__},{theta},{beta}", file=file)

levels = np.geomspace(0.05, 6.0, 12)
rates = np.array([float(f"{rate:.4g}") for rate in 0.02 * levels ** -1.2 * np.exp(-0.5 * levels)])
levels = np.array([float(f"{level:.4g}") for level in levels])
with open(here / "fits_curve.csv", "w") as file:
    print("level,rate", file=file)
    for level, rate in zip(levels, rates):
        print(f"{level:.4g},{rate:.4g}", file=file)

with open(here / "fits_rates.csv", "w") as file:
    print("theta,beta,rate", file=file)
    for theta, beta in [(1.0, 0.4), (0.3, 0.2), (2.5, 0.6), (0.02, 0.3), (20.0, 0.5), (1.1, 0.02), (0.9, 3.0)]:
        rate = 0.0
        for k in range(len(levels) - 1):
            y, ln = np.log(levels[k:k + 2]), np.log(rates[k:k + 2])
            slope = (ln[0] - ln[1]) / (y[1] - y[0])
            value = lambda x: ndtr((x - np.log(theta)) / beta) * slope * np.exp(ln[0] - slope * (x - y[0]))
            breaks = [b for b in np.log(theta) + beta * np.arange(-8, 9) if y[0] < b < y[1]]
            part, _ = quad(value, *y, points=breaks or None, epsabs=0.0, epsrel=1e-12, limit=500)
            rate += part
        print(f"{theta},{beta},{rate:.12g}", file=file)
