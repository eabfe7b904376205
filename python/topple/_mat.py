"""Results as files of MATLAB (MAT, version 5), which scipy writes."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from ._dataset import Arrays

#: The variable that tells what the others are.
ABOUT = "about"


def save_mat(result: Any, path: str | os.PathLike[str]) -> None:
    """Write a result as a file of MATLAB, version 5.

    Each column and each axis is a variable of its name; the order of the axes is the result's: of a map over ``omega``
    and ``a_h`` ``zeta(i, j)`` is at ``a_h(i)``, ``omega(j)``. Texts, such as ``mode`` of a history, are cells. Of codes,
    ``outcome`` and ``status``, the names are in ``outcome_names`` and ``status_names``: code 0 has the first. ``about``
    is JSON: the scene, the version, the order of the axes, unit and meaning of each variable.

    Parameters
    ----------
    result : xarray.Dataset or Arrays
        What a call of this package returns: a map, a motion, a suite. `fragility` returns several; give one of them.
    path : path
        The file, which ends in .mat; a file that is there is replaced.

    Raises
    ------
    ImportError
        scipy is not installed.
    ValueError
        What is no result, or a variable of 2 GiB or more, which the format cannot have.

    Examples
    --------
    >>> import tempfile, topple
    >>> ds = topple.pulse(object=1, t_h=1.75, t_v=0.75, omega="1:9:5", a_h="1:15:3", verify=0)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     topple.save_mat(ds, folder + "/map.mat")
    """
    try:
        from scipy.io import savemat
        from scipy.io.matlab import MatWriteError
    except ImportError as error:
        raise ImportError("files of MATLAB are written by scipy, which is not installed: pip install scipy") from error
    place = Path(path)
    if place.suffix != ".mat":
        raise ValueError(f"path: {place} does not end in .mat; give a name that does")
    variables = _variables(result)
    # Whole or not at all.
    handle, begun = tempfile.mkstemp(prefix=".topple-", suffix=".mat", dir=place.absolute().parent)
    try:
        with os.fdopen(handle, "wb") as file:
            savemat(file, variables, do_compression=True, oned_as="column")
        os.replace(begun, place)
    except MatWriteError as error:
        raise ValueError(f"result: {error}; a variable of this format has less than 2 GiB: select a part of the map") from error
    finally:
        if os.path.exists(begun):
            os.remove(begun)


def _variables(result: Any) -> dict[str, Any]:
    """The variables of a file by their names."""
    if isinstance(result, Arrays):
        all_of = {**result.coords, **result.data_vars}
    elif hasattr(result, "data_vars") and hasattr(result, "coords"):
        names = [*result.coords, *result.data_vars]
        all_of = {str(name): (result[name].dims, result[name].values, result[name].attrs) for name in names}
    else:
        raise ValueError("result: give a Dataset that a call returned; of a fragility one of its Datasets")
    found: dict[str, Any] = {}
    told: dict[str, Any] = {}
    for name, (dims, values, attrs) in all_of.items():
        values = np.asarray(values)
        # Texts become cells, truths become numbers.
        found[name] = values.astype(object) if values.dtype.kind in "OUT" else values
        told[name] = {"dims": list(dims), "unit": attrs.get("units", ""), "meaning": attrs.get("long_name", "")}
        if "flag_meanings" in attrs:
            found[f"{name}_names"] = np.array(attrs["flag_meanings"].split(), dtype=object)
    attrs = {key: value for key, value in result.attrs.items() if isinstance(value, (str, int, float))}
    found[ABOUT] = json.dumps({**attrs, "variables": told})
    return found
