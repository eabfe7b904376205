"""Writes topple/_keywords.py, the types of the keywords, from the tables of the library.

Run it after a parameter has changed: ``python python/tests/write_keywords.py``. The tests compare the file with its text.
"""

import textwrap
from pathlib import Path

from topple import _help

PLACE = Path(__file__).parent.parent / "topple" / "_keywords.py"

HEAD = '''"""Types of the keywords. Written by write_keywords.py from the library's tables: change these."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping, Sequence, TypedDict, Union

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = Union[float, str, Sequence[float], NDArray[Any]]
    Path = Union[str, os.PathLike[str]]
'''

#: The sections of keywords, and the calls that take them.
SECTIONS = {
    "block": "The block and its plates.",
    "base": "The base.",
    "pulse": "The pulse.",
    "record": "The record.",
    "run": "Duration and criteria.",
    "settings": "How a scene is run.",
    "method": "How a motion is integrated.",
    "refining": "How its map is refined.",
    "uncertain": "Numbers that are not known.",
}
CALLS = {
    "PulseCall": ("under pulses", ["block", "base", "pulse", "run", "settings", "refining", "uncertain"]),
    "RecordCall": ("under a record", ["block", "base", "record", "run", "settings", "refining", "uncertain"]),
    "SuiteCall": ("under a suite of records", ["block", "base", "run", "settings"]),
    "CellCall": ("of one cell", ["block", "base", "pulse", "record", "run", "method"]),
    "AnyCall": (
        "under anything", ["block", "base", "pulse", "record", "run", "settings", "refining", "uncertain"]
    ),
}


def text() -> str:
    """What the file must hold."""
    lines = [HEAD]
    for section, doc in SECTIONS.items():
        lines += ["", f"class {section.capitalize()}(TypedDict, total=False):", f'    """{doc}"""', ""]
        for key, kind, meaning in _help.sections()[section]:
            lines += textwrap.wrap(meaning, 110, initial_indent="    # ", subsequent_indent="    # ")
            lines.append(f"    {key}: {kind}")
        lines.append("")
    for name, (under, sections) in CALLS.items():
        bases = ", ".join(section.capitalize() for section in sections)
        lines += ["", f"class {name}({bases}, total=False):", f'    """Keywords of a call {under}."""', "", "    title: str", ""]
    return "\n".join(lines)


if __name__ == "__main__":
    PLACE.write_text(text(), encoding="utf-8")
