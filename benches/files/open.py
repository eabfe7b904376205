"""Opens a map's map.zarr by xarray and its map.npz by numpy, and compares them: open.py DIR.

Needs numpy, xarray, zarr 3 and dask. Prints each array with its type, chunks and size on disk."""
import json
import pathlib
import sys

import numpy
import xarray

out = pathlib.Path(sys.argv[1])
npz = numpy.load(out / "map.npz")
zarr = xarray.open_zarr(out / "map.zarr")
about = json.loads(str(npz["about"]))
for key, value in about.items():
    own = zarr.attrs[key]
    assert (json.loads(own) if isinstance(value, (dict, list)) else own) == value, key
for name in npz.files:
    if name == "about":
        continue
    array = zarr[name]
    same = numpy.array_equal(array.values, npz[name], equal_nan=array.dtype.kind == "f")
    size = sum(file.stat().st_size for file in (out / "map.zarr" / name).rglob("*") if file.is_file())
    print(f"{name:16} {str(array.dtype):8} {array.dims} chunks {array.chunks} {size:>9} bytes", "" if same else "DIFFERS")
    assert same and array.dtype == npz[name].dtype
chunks = sum(file.stat().st_size for file in (out / "map.zarr").rglob("*") if file.is_file())
print(f"equal; map.zarr {chunks} bytes, map.npz {(out / 'map.npz').stat().st_size}")
