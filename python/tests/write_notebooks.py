"""Writes the notebooks of python/examples from the scripts beside them, whose cells begin with ``# %%``.

Run it after a script has changed: ``python python/tests/write_notebooks.py``. A test compares the notebooks with their texts.
"""

import json
from pathlib import Path

EXAMPLES = Path(__file__).parent.parent / "examples"
#: The examples; motions.py is a module that they import.
NAMES = ["fig11", "fragility", "isolator"]


def text(name: str) -> str:
    """The notebook of an example."""
    cells = []
    for number, part in enumerate(("\n" + (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")).split("\n# %%")[1:]):
        head, _, body = part.partition("\n")
        lines = body.strip().splitlines(keepends=True)
        kind = "markdown" if "[markdown]" in head else "code"
        if kind == "markdown":
            lines = [line.removeprefix("#").removeprefix(" ") for line in lines]
        cell = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": lines}
        if kind == "code":
            cell |= {"execution_count": None, "outputs": []}
        cells.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    notebook = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(notebook, ensure_ascii=False, indent=1) + "\n"


if __name__ == "__main__":
    for name in NAMES:
        (EXAMPLES / f"{name}.ipynb").write_text(text(name), encoding="utf-8", newline="\n")
