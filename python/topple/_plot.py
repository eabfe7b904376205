"""Maps drawn by matplotlib, as the command draws them."""

from __future__ import annotations

import json
import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _topple

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Size of a legend's letters, points: of a picture of its own, and of one in a narrow place, inches.
LETTERS, SMALL, NARROW = 8.5, 7.0, 5.0
#: From an axis to what is said below its numbers and its name, points.
BELOW = 38.0
#: Width of a letter over its size, about.
LETTER = 0.52
#: Columns that are drawn over one axis.
CURVES = ("zeta", "max_u", "stroke_v")


def _numbers() -> dict[str, dict[str, Any]]:
    return {entry["key"]: entry for entry in json.loads(_topple.parameters())}


def label(key: str) -> str:
    """The name of an axis or of a column: its symbol and its unit."""
    known = {**{entry["name"]: {**entry, "symbol": entry["name"]} for entry in json.loads(_topple.columns())}, **_numbers()}
    if key not in known:
        return key
    unit = known[key]["unit"]
    return f"{known[key]['symbol']} [{unit}]" if unit else str(known[key]["symbol"])


def classes(dataset: Any) -> tuple[np.ndarray, np.ndarray]:
    """The class of each cell as its place in the palette, and where dots lie."""
    columns = [(dataset["outcome"], np.uint8), (dataset["impacts"], np.uint32), (dataset["uplifts"], np.uint32)]
    flat = [np.ascontiguousarray(np.asarray(values).ravel(), dtype=kind) for values, kind in columns]
    kinds, dots = _topple.kinds(*flat)
    shape = np.asarray(dataset["outcome"]).shape
    return kinds.reshape(shape), dots.reshape(shape)


def beyond(dataset: Any) -> np.ndarray:
    """Where the model does not hold: tensile contact, or more friction asked for than there is."""
    found = np.asarray(dataset["min_contact"]) < 0.0
    numbers = json.loads(dataset.attrs["scene"])["numbers"]
    if "friction" in numbers:
        friction = dataset["friction"] if "friction" in dataset.coords else float(numbers["friction"])
        found = found | np.asarray((dataset["friction_demand"] > friction).transpose(*dataset["outcome"].dims))
    return found


def _scale(ax: Axes, which: str, values: np.ndarray) -> None:
    """A logarithmic scale where values are evenly apart on it."""
    if len(values) < 3 or values.min() <= 0.0:
        return
    ratios, steps = values[1:] / values[:-1], np.diff(values)
    if np.allclose(ratios, ratios[0], rtol=1e-6) and not np.allclose(steps, steps[0], rtol=1e-6):
        (ax.set_xscale if which == "x" else ax.set_yscale)("log")


def _below(dataset: Any) -> str:
    """What is said of a scene below its picture."""
    parts = [_topple.caption(dataset.attrs["scene"])]
    numbers = _numbers()
    for key in dataset.coords:
        if dataset[key].ndim == 0 and key in numbers:
            parts.append(f"{numbers[key]['symbol']} = {dataset[key].item():.4g} {numbers[key]['unit']}".strip())
    return ", ".join(part.replace(" ", "\xa0") for part in ", ".join(parts).split(", "))


def map_of(dataset: Any, column: str, ax: Axes | None) -> Axes:
    """Draws a column of a map; see `Accessor.plot`."""
    import matplotlib.pyplot as plt

    if column not in dataset or "outcome" not in dataset:
        raise ValueError(f"column: {column} is no column of a map here; the Dataset has {', '.join(dataset.data_vars)}")
    dataset = dataset.squeeze()
    dims = dataset["outcome"].dims
    if len(dims) not in (1, 2):
        names = ", ".join(map(str, dims)) or "none"
        raise ValueError(f"axes: {names}; a picture has one or two, select values of others as ds.sel({names.split(', ')[0]}=...)")
    if len(dims) == 1:
        return _curves(dataset, ax)
    if ax is None:
        ax = plt.subplots(figsize=(6.4, 6.8), layout="constrained")[1]
    y, x = (np.asarray(dataset[dim]) for dim in dims)
    _scale(ax, "x", x)
    _scale(ax, "y", y)
    (_outcomes if column == "outcome" else _greys)(dataset, column, ax, x, y)
    ax.set_xlabel(label(dims[1]))
    ax.set_ylabel(label(dims[0]))
    title = json.loads(dataset.attrs["scene"])["title"]
    ax.set_title(title if column == "outcome" else f"{title}: {dataset[column].attrs.get('long_name', column)}", wrap=True)
    return ax


def _kept(text: str) -> str:
    """A text whose numbers stay on one line with their units."""
    return text.replace(" %", "\xa0%").replace("< ", "<\xa0")


def _legend(ax: Axes, handles: list[Any], dataset: Any) -> None:
    """What is said below a picture, as wide as that: where it were wider, the layout would shrink the picture."""
    from matplotlib.transforms import offset_copy

    figure = ax.get_figure(root=True)
    assert figure is not None
    width = ax.get_position().width * figure.get_figwidth()
    size = LETTERS if width > NARROW else SMALL
    letters = int(72.0 * width / (LETTER * size))
    for handle in handles:
        handle.set_label(textwrap.fill(_kept(str(handle.get_label())), max(letters // 2 - 4, 12)))
    ax.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(0.0, 0.0),
        bbox_transform=offset_copy(ax.transAxes, figure, y=-BELOW, units="points"),
        ncols=2,
        frameon=False,
        fontsize=size,
        title=textwrap.fill(_below(dataset), letters),
        title_fontsize=size,
        alignment="left",
        borderaxespad=0.0,
        columnspacing=1.0,
        handlelength=1.6,
    )


def _swatches(kinds: np.ndarray) -> list[Any]:
    """A line of the legend for each class that is there, with its share."""
    from matplotlib.patches import Patch

    palette = json.loads(_topple.palette())
    places, counts = np.unique(kinds, return_counts=True)
    swatches = []
    for place, share in zip(places, _topple.shares(counts.tolist())):
        entry = palette["kinds"][place]
        swatch = Patch(facecolor=_rgb(entry["colour"]), label=f"{entry['label']}: {share}")
        if min(entry["colour"]) == 255:
            swatch.set(hatch="xxx", edgecolor="black")
        swatches.append(swatch)
    return swatches


def _rgb(colour: list[int]) -> tuple[float, float, float]:
    red, green, blue = (part / 255.0 for part in colour)
    return red, green, blue


def _outcomes(dataset: Any, _: str, ax: Axes, x: np.ndarray, y: np.ndarray) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    palette = json.loads(_topple.palette())
    kinds, dots = classes(dataset)
    colours = ListedColormap([_rgb(entry["colour"]) for entry in palette["kinds"]])
    ax.pcolormesh(x, y, kinds, cmap=colours, vmin=-0.5, vmax=colours.N - 0.5, shading="nearest", rasterized=True)
    handles = _swatches(kinds)
    over = [(dots, "...", palette["dotted"]), (kinds == colours.N - 1, "xxx", None)]
    over.append((beyond(dataset), "///", "contact force tensile or friction too small: the model does not hold"))
    for where, hatch, meaning in over:
        _hatched(ax, x, y, where, hatch)
        if where.any() and meaning:
            handles.append(Patch(facecolor="#bdb0aa", hatch=hatch, edgecolor="black", label=meaning))
    _legend(ax, handles, dataset)


def _hatched(ax: Axes, x: np.ndarray, y: np.ndarray, where: np.ndarray, hatch: str) -> None:
    """Hatches cells, up to half-way to their neighbours."""
    if where.any():
        ax.contourf(x, y, where.astype(float), levels=[0.5, 1.5], colors="none", hatches=[hatch])


def _greys(dataset: Any, column: str, ax: Axes, x: np.ndarray, y: np.ndarray) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    palette = json.loads(_topple.palette())
    flags = dataset["outcome"].attrs["flag_meanings"].split()
    codes = np.asarray(dataset["outcome"])
    stands = np.isin(codes, [flags.index("full_contact"), flags.index("rocking")])
    unresolved = codes == flags.index("unresolved")
    values = np.ma.masked_array(np.asarray(dataset[column], dtype=float), ~stands)
    mesh = ax.pcolormesh(x, y, values, cmap="Greys", shading="nearest", rasterized=True)
    fallen = np.ma.masked_array(np.ones(values.shape), stands | unresolved)
    ax.pcolormesh(x, y, fallen, cmap=ListedColormap([_rgb(palette["fallen"])]), shading="nearest", rasterized=True)
    figure = ax.get_figure()
    assert figure is not None
    figure.colorbar(mesh, ax=ax, label=label(column), shrink=0.8)
    _legend(ax, [Patch(facecolor=_rgb(palette["fallen"]), label="overturned")] if fallen.count() else [], dataset)


def _curves(dataset: Any, ax: Axes | None) -> Axes:
    """Curves of the cells that stand, and the outcomes as a strip above them."""
    import matplotlib.pyplot as plt
    from matplotlib.colors import ListedColormap

    palette = json.loads(_topple.palette())
    (dim,) = dataset["outcome"].dims
    x = np.asarray(dataset[dim])
    if ax is None:
        ax = plt.subplots(figsize=(6.4, 5.2), layout="constrained")[1]
    kinds, _ = classes(dataset)
    flags = dataset["outcome"].attrs["flag_meanings"].split()
    stands = np.isin(np.asarray(dataset["outcome"]), [flags.index("full_contact"), flags.index("rocking")])
    strip = ax.inset_axes((0.0, 1.02, 1.0, 0.06), sharex=ax)
    colours = ListedColormap([_rgb(entry["colour"]) for entry in palette["kinds"]])
    twice = np.vstack([kinds, kinds])
    strip.pcolormesh(x, [0.0, 1.0], twice, cmap=colours, vmin=-0.5, vmax=colours.N - 0.5, shading="nearest")
    strip.tick_params(left=False, labelleft=False, labelbottom=False, bottom=False)
    handles = _swatches(kinds)
    for name, style in zip(CURVES, ("-", "--", ":")):
        values = np.where(stands, np.asarray(dataset[name], dtype=float), np.nan)
        if np.nanmax(values, initial=0.0) > 0.0:
            handles += ax.plot(x, values, style, color="black", linewidth=1.0, label=label(name))
    _scale(ax, "x", x)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(label(dim))
    strip.set_title(json.loads(dataset.attrs["scene"])["title"], wrap=True)
    _legend(ax, handles, dataset)
    return ax
