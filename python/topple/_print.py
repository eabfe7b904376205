"""How a picture is printed: its title, how wide it is, how large its letters are, and its colours."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

from . import _topple
from ._colours import known_colours

#: Size of letters of matplotlib, points, and the width that pictures have by themselves, inches.
LETTERS, WIDE = 10.0, 6.4
#: Millimetres of an inch.
INCH = 25.4
#: Lines over greys, as matplotlib calls them.
TEXTURES = {"": "", "across": "---", "upright": "|||"}


def checked_title(title: str | None) -> None:
    """Refuses a title that is no line of text."""
    if title is not None and not (isinstance(title, str) and title.strip() and title.isprintable()):
        raise ValueError("title: must be one line of text")


@dataclass(frozen=True)
class Print:
    """What is asked of a picture; the names are the command's."""

    title: str | None = None
    width: float | None = None
    font_size: float | None = None
    palette: str = "colour"

    def __post_init__(self) -> None:
        checked_title(self.title)
        known_colours(self.palette)
        for key, value in (("width", self.width), ("font_size", self.font_size)):
            if value is not None and (isinstance(value, bool) or not isinstance(value, (int, float))):
                raise ValueError(f"{key}: must be a number")
        if self.width is not None or self.font_size is not None:
            _topple.check_print(INCH * WIDE if self.width is None else self.width, self.font_size)

    @property
    def colours(self) -> dict[str, Any]:
        """The colours by what they are of."""
        return known_colours(self.palette)

    @property
    def scale(self) -> float:
        """How large letters are, of their usual size."""
        return 1.0 if self.font_size is None else self.font_size / LETTERS

    def letters(self) -> AbstractContextManager[None]:
        """Within it what is drawn has letters of the size."""
        if self.font_size is None:
            return nullcontext()
        import matplotlib

        return matplotlib.rc_context({"font.size": self.font_size, "axes.titlesize": "medium"})

    def subplots(self, rows: int, height: float, **keywords: Any) -> Any:
        """Axes one below the other in a figure of its own; `height` is that of one of the usual width, inches."""
        import matplotlib.pyplot as plt

        width = WIDE if self.width is None else self.width / INCH
        return plt.subplots(rows, 1, figsize=(width, height * width / WIDE), layout="constrained", **keywords)[1]
