"""Reads the curves that `topple fragility --export nrml,pelicun` writes by the programs that they are for.

    pip install openquake.engine==3.26.2 pelicun==3.10.0 && python docs/read_back.py DIR

reads DIR/fragility.xml by OpenQuake and DIR/fragility_pelicun.csv by pelicun, and writes DIR/read_back.csv: the probability of each
limit state at some levels, in SI units, as each program has it. crates/app/tests/app/exported_curves.rs holds topple's own fits
to such a file. OpenQuake needs GDAL, which its installer brings (https://docs.openquake.org).
"""

import csv
import pathlib
import sys

from openquake.hazardlib import nrml
from openquake.risklib import read_nrml
from pelicun import uq
from pelicun.assessment import Assessment

#: Acceleration of a g in topple, m/s²: OpenQuake has its levels in g.
GRAVITY = 9.81
LEVELS = [1.0, 2.0, 3.0, 4.0, 6.0, 9.0, 14.0]

read_nrml.update_validators()


def by_openquake(path):
    """OpenQuake's functions by its own classes."""
    model = nrml.to_python(str(path))
    for (measure, name), functions in model.items():
        functions = functions.build(model.limitStates, 20, 0)
        scale = {"PGV": 0.01, "IA": 1.0}.get(measure, GRAVITY)
        for state, function in zip(model.limitStates, functions):
            levels = [level / scale for level in LEVELS]
            for level, probability in zip(LEVELS, function(levels)):
                yield "openquake", name, state, level, probability


def by_pelicun(path):
    """Its parameters as pelicun loads them, in its units, and the distribution that it makes of them."""
    with path.open(encoding="utf-8", newline="") as file:
        names = [row["ID"] for row in csv.DictReader(file)]
    assessment = Assessment({"PrintLog": False, "Verbose": False})
    assessment.damage.load_model_parameters([str(path)], set(names))
    parameters = assessment.damage.ds_model.damage_params
    for name in names:
        row = parameters.loc[name]
        states = [key for key in row.index.get_level_values(0).unique() if key.startswith("LS")]
        for state in states:
            if row[state, "Family"] != "lognormal":
                continue
            theta = [float(row[state, "Theta_0"]), float(row[state, "Theta_1"])]
            variable = uq.LogNormalRandomVariable(name=f"{name}-{state}", theta=theta)
            for level, probability in zip(LEVELS, variable.cdf(LEVELS)):
                yield "pelicun", name, state, level, probability


def main():
    folder = pathlib.Path(sys.argv[1])
    rows = [*by_openquake(folder / "fragility.xml"), *by_pelicun(folder / "fragility_pelicun.csv")]
    with (folder / "read_back.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["program", "cell", "limit_state", "level", "probability"])
        writer.writerows((*row[:4], f"{row[4]:.12g}") for row in rows)


main()
