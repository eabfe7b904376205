"""Maps drawn by matplotlib, as the command draws them."""

from __future__ import annotations

import json
import re
import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _topple
from ._colours import rgb
from ._help import parameters
from ._print import TEXTURES, Print

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Edges of cells along both axes.
Edges = tuple[np.ndarray, np.ndarray]
#: Size of a legend's letters, points: of a picture of its own, and of one in a narrow place, inches.
LETTERS, SMALL, NARROW = 8.5, 7.0, 5.0
#: From an axis to what is said below its numbers and its name, points.
BELOW = 38.0
#: Width of a letter over its size, about.
LETTER = 0.52
#: What a cell does that stands and has no value of a column.
WITHOUT = {"t_uplift": "does not lift"}
#: Columns that are drawn over one axis.
CURVES = {"zeta": "ζ, on the left", "max_u": "max |u|", "stroke_v": "stroke of v"}


def label(key: str) -> str:
    """The name of an axis: its symbol and its unit."""
    entry = parameters().get(key)
    if entry is None:
        return key
    # An index is lowered.
    symbol = re.sub(r"^(\w)_(\w+)$", r"$\1_{\2}$", entry["symbol"])
    return f"{symbol} [{entry['unit']}]" if entry["unit"] else str(symbol)


def meaning(values: Any) -> str:
    """What a column is, with its unit, in short lines."""
    unit = values.attrs.get("units")
    text = values.attrs.get("long_name", str(values.name)).split(";")[0] + (f" [{unit}]" if unit else "")
    return textwrap.fill(text, 40)


def classes(dataset: Any) -> tuple[np.ndarray, np.ndarray]:
    """The class of each cell as its place in the palette, and where dots lie."""
    columns = [(dataset["outcome"], np.uint8), (dataset["impacts"], np.uint32), (dataset["uplifts"], np.uint32)]
    flat = [np.ascontiguousarray(np.asarray(values).ravel(), dtype=kind) for values, kind in columns]
    kinds, dots = _topple.kinds(*flat)
    shape = np.asarray(dataset["outcome"]).shape
    return kinds.reshape(shape), dots.reshape(shape)


def _has_class(dataset: Any, *names: str) -> np.ndarray:
    """Where cells have one of these outcomes."""
    flags = dataset["outcome"].attrs["flag_meanings"].split()
    return np.isin(np.asarray(dataset["outcome"]), [flags.index(name) for name in names])


def tells_beyond(dataset: Any) -> bool:
    """Whether a map has the columns that say where the model is not valid."""
    return "min_contact" in dataset and "friction_demand" in dataset


def beyond(dataset: Any) -> np.ndarray:
    """Where the model is not valid: no contact force or a tensile one, or more friction needed than there is. Nowhere where a
    map has not the columns that tell it."""
    if not tells_beyond(dataset):
        return np.zeros(np.asarray(dataset["outcome"]).shape, dtype=bool)
    least = np.asarray(dataset["min_contact"])
    found: np.ndarray = (least < 0.0) | ((least <= 0.0) & ~_has_class(dataset, "unresolved"))
    numbers = json.loads(dataset.attrs["scene"])["numbers"]
    if "friction" in numbers:
        friction = dataset["friction"] if "friction" in dataset.coords else float(numbers["friction"])
        found = found | np.asarray((dataset["friction_demand"] > friction).transpose(*dataset["outcome"].dims))
    return found


def _is_log(values: np.ndarray) -> bool:
    """True of values that are evenly apart on a logarithmic scale alone."""
    if len(values) < 3 or values.min() <= 0.0:
        return False
    ratios, steps = values[1:] / values[:-1], np.diff(values)
    return bool(np.allclose(ratios, ratios[0], rtol=1e-6) and not np.allclose(steps, steps[0], rtol=1e-6))


def _scale(ax: Axes, which: str, values: np.ndarray) -> None:
    """A logarithmic scale where values are evenly apart on it."""
    if _is_log(values):
        (ax.set_xscale if which == "x" else ax.set_yscale)("log")


def _edges(values: np.ndarray) -> np.ndarray:
    """The edges of cells, half-way between them on their scale."""
    at = np.log(values) if _is_log(values) else values
    middles = 0.5 * (at[1:] + at[:-1])
    edges = np.concatenate([[2.0 * at[0] - middles[0]], middles, [2.0 * at[-1] - middles[-1]]])
    found: np.ndarray = np.exp(edges) if _is_log(values) else edges
    return found


def _below(dataset: Any) -> str:
    """What is said of a scene below its picture."""
    parts = [_topple.caption(dataset.attrs["scene"])]
    numbers = parameters()
    for key in dataset.coords:
        if dataset[key].ndim == 0 and key in numbers:
            parts.append(f"{numbers[key]['symbol']} = {dataset[key].item():.4g} {numbers[key]['unit']}".strip())
    return ", ".join(part.replace(" ", "\xa0") for part in ", ".join(parts).split(", "))


def map_of(dataset: Any, column: str, ax: Axes | None, asked: Print) -> Axes:
    """Draws a column of a map; see `Accessor.plot`."""
    _check(dataset, column)
    if ax is not None and asked.width is not None:
        raise ValueError("width: the figure of ax has a width; leave it out, or leave out ax")
    dataset = dataset.squeeze()
    dims = dataset["outcome"].dims
    if not dims:
        raise ValueError("axes: none; of one cell ds.topple.history() gives the motion")
    if len(dims) > 2:
        names = ", ".join(map(str, dims))
        raise ValueError(f"axes: {names}; a picture has one or two, select values of others as ds.sel({dims[0]}=...)")
    with asked.letters():
        return _curves(dataset, ax, asked) if len(dims) == 1 else _map(dataset, column, ax, asked)


def _title(dataset: Any, asked: Print) -> str:
    return asked.title or str(json.loads(dataset.attrs["scene"])["title"])


def _map(dataset: Any, column: str, ax: Axes | None, asked: Print) -> Axes:
    """A map of two axes."""
    dims = dataset["outcome"].dims
    if ax is None:
        ax = asked.subplots(1, 6.8)
    dataset = dataset.sortby(list(dims))
    y, x = (_edges(np.asarray(dataset[dim], dtype=float)) for dim in dims)
    for which, dim in zip("yx", dims):
        _scale(ax, which, np.asarray(dataset[dim], dtype=float))
    (_outcomes if column == "outcome" else _greys)(dataset, column, ax, (x, y), asked)
    ax.set_xlabel(label(dims[1]))
    ax.set_ylabel(label(dims[0]))
    ax.set_title(_title(dataset, asked), wrap=True)
    return ax


def _check(dataset: Any, column: str) -> None:
    """Refuses what is no map: other tables, and maps of which an axis was averaged away."""
    if "outcome" not in dataset or "scene" not in dataset.attrs:
        raise ValueError("outcome: missing; maps are drawn so, other tables by xarray's own plot")
    if column == "outcome" and not ("impacts" in dataset and "uplifts" in dataset):
        raise ValueError("columns: colours tell impacts and uplifts, too; ask for outcome, impacts and uplifts")
    if column not in dataset:
        raise ValueError(f"column: {column} is no column of the map; it has {', '.join(dataset.data_vars)}")
    if column in ("status", "proved") or dataset["outcome"].dtype.kind not in "iu":
        raise ValueError(f"column: {column} has no picture; outcomes as they are, and columns of numbers, have one")
    for key, values in json.loads(dataset.attrs["scene"])["numbers"].items():
        if not isinstance(values, (int, float)) and key not in dataset.coords:
            raise ValueError(f"{key}: the map has lost this axis; select a value of it instead, as ds.sel({key}=...)")


def motion_of(dataset: Any, asked: Print) -> Any:
    """Draws u, v and φ of a history over the time."""
    with asked.letters():
        return _motion(dataset, asked)


def _motion(dataset: Any, asked: Print) -> Any:
    palette = asked.colours
    axes = asked.subplots(3, 6.0, sharex=True)
    t = np.asarray(dataset["t"])
    rocks = np.asarray(dataset["mode"]) != "full_contact"
    for ax, (name, text) in zip(axes, (("u", "u [m]"), ("v", "v [m]"), ("phi", "φ [rad]"))):
        ax.plot(t, np.asarray(dataset[name]), color=rgb(palette["curves"][0]), linewidth=1.0)
        ax.fill_between(t, 0.0, 1.0, where=rocks, color=rgb(palette["rocks"]), transform=ax.get_xaxis_transform(), label="rocking")
        ax.set_ylabel(text)
    axes[0].set_title(_title(dataset, asked), wrap=True)
    axes[-1].set(xlabel="t [s]", xlim=(t[0], t[-1]))
    if rocks.any():
        axes[-1].legend(frameon=False)
    return axes


def _kept(text: str) -> str:
    """A text whose numbers stay on one line with their units."""
    return text.replace(" %", "\xa0%").replace("< ", "<\xa0")


def _legend(ax: Axes, handles: list[Any], dataset: Any, asked: Print) -> None:
    """What is said below a picture, as wide as that: where it were wider, the layout would shrink the picture."""
    from matplotlib.transforms import offset_copy

    figure = ax.get_figure(root=True)
    assert figure is not None
    width = ax.get_position().width * figure.get_figwidth()
    size = asked.font_size or (LETTERS if width > NARROW else SMALL)
    letters = int(72.0 * width / (LETTER * size))
    for handle in handles:
        handle.set_label(textwrap.fill(_kept(str(handle.get_label())), max(letters // 2 - 4, 12)))
    ax.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(0.0, 0.0),
        bbox_transform=offset_copy(ax.transAxes, figure, y=-BELOW * asked.scale, units="points"),
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


def _swatches(kinds: np.ndarray, asked: Print) -> list[Any]:
    """A line of the legend for each class that is there, with its share."""
    import matplotlib
    from matplotlib.patches import Patch

    palette = asked.colours
    places, counts = np.unique(kinds, return_counts=True)
    swatches = []
    for place, share in zip(places, _topple.shares(counts.tolist())):
        entry = palette["kinds"][place]
        with matplotlib.rc_context({"hatch.color": rgb(entry["over"])}):
            swatch = Patch(facecolor=rgb(entry["colour"]), hatch=TEXTURES[entry["texture"]], label=f"{entry['label']}: {share}")
        if min(entry["colour"]) == 255:
            swatch.set(hatch="xxx", edgecolor="black")
        swatches.append(swatch)
    return swatches


def _outcomes(dataset: Any, _: str, ax: Axes, edges: Edges, asked: Print) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    palette = asked.colours
    kinds, dots = classes(dataset)
    colours = ListedColormap([rgb(entry["colour"]) for entry in palette["kinds"]])
    ax.pcolormesh(*edges, kinds, cmap=colours, vmin=-0.5, vmax=colours.N - 0.5, rasterized=True)
    handles = _swatches(kinds, asked)
    for place, entry in enumerate(palette["kinds"]):
        # Each in the one of white and black that is seen on the colour.
        own, over = kinds == place, rgb(entry["over"])
        for where, hatch in ((own & dots, "..."), (own, TEXTURES[entry["texture"]])):
            if hatch:
                _hatched(ax, edges, where, hatch, over)
    if dots.any():
        handles.append(Patch(facecolor=rgb(palette["marked"]), hatch="...", edgecolor="black", label=palette["dotted"]))
    text = "contact force tensile or friction too small: the model does not hold"
    for where, hatch, meaning in ((kinds == colours.N - 1, "xxx", None), (beyond(dataset), "///", text)):
        _hatched(ax, edges, where, hatch)
        if where.any() and meaning:
            handles.append(Patch(facecolor=rgb(palette["marked"]), hatch=hatch, edgecolor="black", label=meaning))
    if not tells_beyond(dataset):
        handles.append(Patch(facecolor="none", label="Contact forces were not asked for: where the model does not hold is not shown."))
    _legend(ax, handles, dataset, asked)


def _hatched(ax: Axes, edges: Edges, where: np.ndarray, hatch: str, colour: Any = "black") -> None:
    """Hatches cells, each up to its edges."""
    import matplotlib

    if where.any():
        # A value just inside either edge of a cell: a contour runs between those of neighbours.
        x, y = (_insides(of) for of in edges)
        twice = np.repeat(np.repeat(where.astype(float), 2, axis=0), 2, axis=1)
        with matplotlib.rc_context({"hatch.color": colour}):
            ax.contourf(x, y, twice, levels=[0.5, 1.5], colors="none", hatches=[hatch])


def _insides(edges: np.ndarray) -> np.ndarray:
    """Of each cell a value just inside of either edge."""
    inside = 0.001 * np.diff(edges)
    found: np.ndarray = np.stack([edges[:-1] + inside, edges[1:] - inside], axis=1).ravel()
    return found


def _greys(dataset: Any, column: str, ax: Axes, edges: Edges, asked: Print) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    palette = asked.colours
    stands = _has_class(dataset, "full_contact", "rocking")
    unresolved = _has_class(dataset, "unresolved")
    values = np.ma.masked_array(np.asarray(dataset[column], dtype=float), ~stands)
    shades = palette["greys"][::-1] if column in palette["falls"] else palette["greys"]
    greys = ListedColormap([rgb(grey) for grey in shades])
    mesh = ax.pcolormesh(*edges, values, cmap=greys, rasterized=True)
    fallen = np.ma.masked_array(np.ones(values.shape), stands | unresolved)
    ax.pcolormesh(*edges, fallen, cmap=ListedColormap([rgb(palette["fallen"])]), rasterized=True)
    figure = ax.get_figure()
    assert figure is not None
    figure.colorbar(mesh, ax=ax, label=meaning(dataset[column]), shrink=0.8)
    handles = [Patch(facecolor=rgb(palette["fallen"]), label="overturned")] if fallen.count() else []
    without = stands & np.isnan(np.ma.getdata(values))
    for where, hatch, text in ((without, "///", WITHOUT.get(column, "no value")), (unresolved, "xxx", "unresolved")):
        _hatched(ax, edges, where, hatch)
        if where.any():
            handles.append(Patch(facecolor="white", hatch=hatch, edgecolor="black", label=text))
    _legend(ax, handles, dataset, asked)


def _curves(dataset: Any, ax: Axes | None, asked: Print) -> Axes:
    """Curves of the cells that stand, and the outcomes as a strip above them."""
    from matplotlib.colors import ListedColormap

    palette = asked.colours
    (dim,) = dataset["outcome"].dims
    dataset = dataset.sortby(dim)
    x = np.asarray(dataset[dim], dtype=float)
    if ax is None:
        ax = asked.subplots(1, 5.2)
    kinds, _ = classes(dataset)
    stands = _has_class(dataset, "full_contact", "rocking")
    strip = ax.inset_axes((0.0, 1.02, 1.0, 0.06), sharex=ax)
    colours = ListedColormap([rgb(entry["colour"]) for entry in palette["kinds"]])
    strip.pcolormesh(_edges(x), [0.0, 1.0], kinds[np.newaxis], cmap=colours, vmin=-0.5, vmax=colours.N - 0.5)
    strip.tick_params(left=False, labelleft=False, labelbottom=False, bottom=False)
    handles = _swatches(kinds, asked)
    metres = ax.twinx()
    for (name, text), style in zip(CURVES.items(), ("-", "--", ":")):
        values = np.where(stands, np.asarray(dataset[name], dtype=float), np.nan)
        if np.nanmax(values, initial=0.0) > 0.0:
            handles += (ax if name == "zeta" else metres).plot(x, values, style, color="black", linewidth=1.0, label=text)
    _scale(ax, "x", x)
    for one, text in ((ax, "ζ"), (metres, "max |u|, stroke of v [m]")):
        one.set_ylim(bottom=0.0)
        one.set_ylabel(text)
    ax.set_xlabel(label(dim))
    strip.set_title(_title(dataset, asked), wrap=True)
    _legend(ax, handles, dataset, asked)
    return ax
