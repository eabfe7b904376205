"""The library's colours, as matplotlib takes them."""

from __future__ import annotations

import functools
import json
from typing import Any

from . import _topple


@functools.cache
def known_colours(palette: str = "colour") -> dict[str, Any]:
    """The colours of pictures in a palette by their meaning; not to be changed."""
    found: dict[str, Any] = json.loads(_topple.palette(palette))
    return found


def rgb(colour: list[int]) -> tuple[float, float, float]:
    """Red, green and blue of a colour, each from 0 to 1."""
    red, green, blue = (part / 255.0 for part in colour)
    return red, green, blue
