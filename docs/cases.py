"""The table and the picture of cases.md, from the directories that its commands make (pandas, matplotlib).

    python docs/cases.py compare isolation.png
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pandas

BLOCKS = {1: "statue", 2: "rack", 3: "cabinet"}
ECCENTRICITIES = ["0", "0.2"]
COLOURS = {"horizontal": "0.45", "dual": "#b02020"}
# Of dual isolation this period is compared, and of the fragilities of the table this one.
T_V, T_H = 0.5, 2.0


def read(root: Path, command: str, case: tuple, table: str) -> pandas.DataFrame:
    block, e, base = case
    rows = pandas.read_csv(root / f"{command}-{block}-{e}-{base}" / table)
    return rows[rows.t_v == T_V] if base == "dual" else rows


def fits(root: Path, case: tuple, state: str) -> pandas.DataFrame:
    rows = read(root, "fragility", case, "fits.csv")
    return rows[rows.limit_state == state].set_index("t_h")


def lowest(root: Path, case: tuple) -> pandas.Series:
    """The level at which each record first overturns the block; infinite where none does."""
    rows = read(root, "fragility", case, "capacities.csv")
    return rows[rows.t_h == T_H].set_index("record").lowest.fillna(float("inf"))


def row(root: Path, case: tuple) -> str:
    block, e, base = case
    cells = read(root, "envelope", case, "envelope.csv")
    cells = cells[cells.t_h.between(1, 4)]
    words = [BLOCKS[block], e, base]
    words += [f"{100 * cells[key].mean():.2f}" for key in ("standing", "rocked")]
    words += [f"{cells[key].mean():.3f}" for key in ("max_u_50", "max_u_84", "stroke_v_84")]
    for state in ("uplift", "overturning"):
        fit = fits(root, case, state).loc[T_H]
        words.append(f"{fit.theta:.1f} ({fit.theta_low:.1f} to {fit.theta_high:.1f})")
    alone = lowest(root, (block, e, "horizontal"))
    own = lowest(root, case)
    words.append(f"{(own < alone).sum()}, {(own > alone).sum()}" if base == "dual" else "")
    return f"| {' | '.join(words)} |"


def draw(root: Path, picture: str) -> None:
    plt.rcParams.update({"font.size": 7, "axes.linewidth": 0.6})
    figure, plots = plt.subplots(1, 3, figsize=(7.48, 2.5), sharey=True)
    for plot, block in zip(plots, BLOCKS):
        for state, line, mark in (("overturning", "-", "o"), ("uplift", "--", "^")):
            for base, colour in COLOURS.items():
                fit = fits(root, (block, "0", base), state)
                bars = [fit.theta - fit.theta_low, fit.theta_high - fit.theta]
                # Beside each other, so that the bars are seen.
                at = fit.index + (0.03 if base == "dual" else -0.03)
                style = {"color": colour, "ls": line, "marker": mark, "ms": 2.5, "lw": 0.9, "capsize": 1.5}
                plot.errorbar(at, fit.theta, bars, label=f"{state}, {base}", **style)
        plot.set(title=BLOCKS[block], xlabel="$T_h$ [s]", yscale="log")
        plot.set_yticks([5, 10, 20, 40], ["5", "10", "20", "40"])
        plot.set_yticks([], minor=True)
    plots[0].set_ylabel("θ: PGA [m/s²]")
    plots[1].legend(frameon=False, fontsize=6, loc="lower right")
    figure.tight_layout(pad=0.4)
    figure.savefig(picture, dpi=200)


if __name__ == "__main__":
    results = Path(sys.argv[1])
    for block in BLOCKS:
        for e in ECCENTRICITIES:
            for base in COLOURS:
                print(row(results, (block, e, base)))
    draw(results, sys.argv[2])
