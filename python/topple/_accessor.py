"""The accessor ``topple`` of Datasets: pictures, and motions of cells."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from . import _plot
from ._print import Print

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes


class Accessor:
    """``ds.topple`` of a Dataset: `plot`, `history` and `animate`."""

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    def plot(
        self,
        column: str = "outcome",
        ax: Axes | None = None,
        *,
        title: str | None = None,
        width: float | None = None,
        font_size: float | None = None,
        palette: str = "colour",
    ) -> Any:
        """Draw a map over two axes, or curves over one.

        Parameters
        ----------
        column : str, optional
            ``outcome`` (default) in the colours of the command, or a column of numbers in greys.
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default a figure of its own.
        title : str, optional
            In the place of the scene's own.
        width : float, optional
            Width of the figure in print, 40 to 600 mm; by default 162.56.
        font_size : float, optional
            Size of the letters, 4 to 40 points.
        palette : str, optional
            ``colour`` (default), or ``grey`` for print without colours: outcomes that share a grey differ by lines.

        Returns
        -------
        matplotlib.axes.Axes
            Three of them for a history.

        Raises
        ------
        ValueError
            The Dataset has more than two axes (select values of the others first, as ``ds.sel(t_h=1.75)``), or is no map.

        Notes
        -----
        The Dataset of a history is drawn as u, v and φ over the time.

        Examples
        --------
        >>> import matplotlib
        >>> matplotlib.use("agg")
        >>> import topple
        >>> ds = topple.pulse(object=1, t_h=1.75, t_v=0.75, omega="1:9:30", a_h="1:15:30", verify=0)
        >>> ds.topple.plot().get_xlabel()
        'Ω [rad/s]'
        """
        asked = Print(title, width, font_size, palette)
        if self._is_history():
            for key, given in (("column", column != "outcome"), ("ax", ax is not None)):
                if given:
                    raise ValueError(f"{key}: a history is drawn as u, v and φ on axes of its own; leave it out")
            return _plot.motion_of(self._dataset, asked)
        return _plot.map_of(self._dataset, column, ax, asked)

    def _is_history(self) -> bool:
        return "phi" in self._dataset and self._dataset["phi"].dims == ("row",)

    def history(self, **keywords: Any) -> Any:
        """The motion of a cell of a map.

        Parameters
        ----------
        **keywords
            A value for each axis, as ``omega=5.0, a_h=6.0``; it need not be one of the map's. Of a map whose record
            came in arrays also ``horizontal``, ``vertical``, ``dt`` and ``units``.

        Returns
        -------
        xarray.Dataset
            As for `topple.history`.

        Examples
        --------
        >>> import topple
        >>> ds = topple.pulse(object=1, t_h=1.75, t_v=0.75, omega="1:9:5", a_h="1:15:5", verify=0)
        >>> motion = ds.topple.history(omega=9.0, a_h=8.5)
        >>> motion["phi"].dims
        ('row',)
        """
        import topple

        attrs = self._dataset.attrs
        axes = [key for key in json.loads(attrs["scene"])["numbers"] if key in self._dataset.coords]
        given = {key: self._dataset[key].item() for key in axes if self._dataset[key].ndim == 0}
        missing = [key for key in axes if key not in {**given, **keywords}]
        if missing:
            raise ValueError(f"{missing[0]}: missing; give a value for each axis of the map")
        # As the map was computed, where it tells it.
        method = json.loads(attrs["method"]) if "method" in attrs else {}
        names = {"precision": "precision", "largest_step": "step", "full_model": "full_model"}
        own = {name: method[key] for key, name in names.items() if key in method}
        if attrs.get("backend") == "reference":
            own["backend"] = "reference"
        result = (attrs["scene"], attrs.get("record"))
        return topple.history(**{**own, **given, **keywords, "result": result})

    def animate(self, cell: Any = None, *, speed: float = 1.0, **keywords: Any) -> FuncAnimation:
        """The block in motion, with its rocking angle.

        Parameters
        ----------
        cell : mapping or Dataset of one cell, optional
            Values of the axes: a mapping ``{"omega": 5.0, "a_h": 6.0}``, or a selection, as
            ``ds.sel(omega=5, a_h=6, method="nearest")``. The Dataset of a history needs none.
        speed : float, optional
            1 is the block's own time.
        **keywords
            As for `history`.

        Returns
        -------
        matplotlib.animation.FuncAnimation
            ``.save("block.gif")`` writes it, ``.to_jshtml()`` shows it in a notebook.
        """
        from . import _animation

        if self._is_history():
            for key in [*(["cell"] if cell is not None else []), *keywords]:
                raise ValueError(f"{key}: a history is of one cell already; leave it out")
            return _animation.of(self._dataset, speed)
        if cell is not None:
            coords = getattr(cell, "coords", cell)
            values = {key: getattr(coords[key], "values", coords[key]) for key in coords}
            keywords = {**values, **keywords}
        return _animation.of(self.history(**keywords), speed)


def register() -> None:
    """Gives Datasets their ``topple``, once."""
    import xarray

    if not hasattr(xarray.Dataset, "topple"):
        xarray.register_dataset_accessor("topple")(Accessor)  # type: ignore[no-untyped-call, unused-ignore]
