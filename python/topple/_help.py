"""The text of help() on keywords, and the message about an unknown one."""

from __future__ import annotations

import difflib
import functools
import json
import textwrap
from typing import Any, Callable, Iterable, Mapping, TypeVar

from . import _topple

Call = TypeVar("Call", bound=Callable[..., Any])

#: Types and meanings of the keywords that are no numbers of the parameter table.
WORDS = {
    "object": ("int", "a block of the paper's Table 1: 1 caryatid, 2 server cabinet, 3 hospital cabinet"),
    "isolation": ("str", "directions in which the base moves: dual, horizontal, vertical, none"),
    "shape": ("str", "one-sine, one-cosine, half-sine, rectangle, ricker, mavroeidis-papageorgiou, ..."),
    "horizontal": (
        "Any",
        "horizontal record: a path, an array, or a trace or a stream as obspy's; a stream may hold the vertical, too",
    ),
    "vertical": ("Any", "vertical record, positive up: as horizontal"),
    "horizontal_channel": ("str", "channel of the horizontal record's file, where it has several: its number or direction"),
    "vertical_channel": ("str", "channel of the vertical record's file"),
    "dt": ("float", "time between samples, s, where the record does not tell"),
    "units": ("str", "g, m/s2 or cm/s2, where the record does not tell"),
    "horizontal_2": ("Path", "second horizontal component, at a right angle to the first; ``azimuth`` turns both"),
    "horizontal_2_channel": ("str", "channel of its file"),
    "azimuth": ("float", "turn the horizontal components to this azimuth, degrees from north over east"),
    "horizontal_azimuth": ("float", "azimuth of ``horizontal``, where its file does not tell"),
    "horizontal_2_azimuth": ("float", "azimuth of ``horizontal_2``, where its file does not tell"),
    "join": ("Path", "record that follows, such as an aftershock: its horizontal component"),
    "join_vertical": ("Path", "its vertical component"),
    "join_gap": ("float", "zeros between both records, s; by default 30"),
    "floor_period": ("float", "put the base on a floor, a linear oscillator of this period, s"),
    "floor_damping": ("float", "damping of the floor's oscillator, as a share of the critical one; by default 0.05"),
    "floor_factor": ("float", "factor on the oscillator's acceleration relative to the ground; by default 1"),
    "baseline": ("str", "none or line: what is subtracted from the velocity of each component, the line nearest to it"),
    "pressure": ("str", "what presses on a friction pendulum: follows or constant"),
    "overturn": ("str", "critical-angle or quarter-turn"),
    "force": ("bool", "accept numbers that are not plausible"),
    "x": ("str", "key of the first axis, which runs fastest"),
    "y": ("str", "key of the second axis"),
    "backend": ("str", "auto, gpu, cpu or reference"),
    "adapter": ("int | Sequence[int]", "the GPU, or several of them, by the numbers of ``topple adapters``"),
    "precision": ("str", "f32 or f64"),
    "step": ("float", "largest step, s"),
    "resolve": ("bool", "run cells of doubt again in f64 with half the step"),
    "full_model": ("bool", "leave out no part of the model that a scene does not need"),
    "repair": ("bool", "run the cells beside a boundary again in f64 with half the step; replace those that change"),
    "columns": (
        "str | Sequence[str]",
        "columns of the map, by their names: a cell runs no longer than these need; by default all",
    ),
    "verify": ("int", "cells that the reference runs again; 0 for none; by default as many as 30 s allow, 128 at most"),
    "out": ("Path", "directory: the map is written there as map.zarr, and opened lazily"),
    "resume": ("bool", "go on from what an interrupted call left in ``out``"),
    "refine": ("int", "halve the cells beside boundaries so many times; the result is the leaves, as `open` gives them"),
    "smooth": ("float", "with ``refine``: share of its range by which a number between cells that ran may be off"),
    "tile": ("str", "shard ``k/n`` of the grid, left in ``out`` for `merge`"),
    "threads": ("int", "threads of the CPU; by default as many as it has cores"),
    "vary": (
        "str | Sequence[str] | Mapping[str, str]",
        'numbers that are not known: ``{"eccentricity": "normal(0.1,0.02)"}``, or texts ``"eccentricity=normal(0.1,0.02)"``; '
        "normal(MEAN,DEVIATION), uniform(LOW,HIGH) or lognormal(MEDIAN,BETA), cut off at two more numbers LOW,HIGH; the "
        "result is probabilities",
    ),
    "pixel": ("bool", "each cell's axes have any value in its pixel; the result is probabilities"),
    "samples": ("int", "with ``vary`` or ``pixel``: sweeps that tell the probabilities, best a power of two; by default 64"),
    "seed": ("int", "with ``vary`` or ``pixel``: seed of the sweeps' points, up to 4294967295; by default 0"),
    "sharpness": ("bool", "tell in ``attrs`` how sharp the boundaries are: basin entropy, uncertainty exponent, dimension"),
}


@functools.cache
def parameters() -> dict[str, dict[str, Any]]:
    """The parameter table by keys; not to be changed."""
    return {entry["key"]: entry for entry in json.loads(_topple.parameters())}


@functools.cache
def sections() -> dict[str, list[tuple[str, str, str]]]:
    """The keywords of each section of a scene, of ``settings``, ``method``, ``refining`` and ``uncertain``: key, type, meaning."""
    found = {
        section: [(key, *WORDS[key]) for key in words] for section, words in json.loads(_topple.words()).items()
    }
    for entry in parameters().values():
        unit = f" [{entry['unit']}]" if entry["unit"] else ""
        default = f"; by default {entry['default']}" if entry["default"] else ""
        found[entry["section"]].append((entry["key"], "Numbers", f"{entry['symbol']}{unit}, {entry['meaning']}{default}"))
    return found


def listed(*names: str) -> Callable[[Call], Call]:
    """Puts the keywords of sections into a docstring, in the place of ``{keywords}``."""

    def put(call: Call) -> Call:
        lines = []
        for name in names:
            for key, kind, meaning in sections()[name]:
                kind = "float, sequence of float, or str" if kind == "Numbers" else kind
                lines.append(f"    {key} : {kind}, optional")
                lines += textwrap.wrap(meaning, 108, initial_indent="        ", subsequent_indent="        ")
        # python -OO has no docstrings.
        call.__doc__ = call.__doc__ and call.__doc__.replace("    {keywords}", "\n".join(lines))
        return call

    return put


#: The sections of keywords that calls take.
SECTIONS = {
    "pulse": ("block", "base", "pulse", "run", "settings", "refining", "uncertain"),
    "seismic": ("block", "base", "record", "run", "settings", "refining", "uncertain"),
    "run": ("block", "base", "pulse", "record", "run", "settings", "refining", "uncertain"),
    "history": ("block", "base", "pulse", "record", "run", "method"),
}
#: Flags of the command that no call has.
COMMAND = ("dry_run", "files", "keep_every", "save_scene")
#: What a keyword of a section says where it has none.
ELSEWHERE = {
    "pulse": "a record shakes the base here; topple.pulse has pulses",
    "record": "a pulse shakes the base here; topple.seismic has records",
}


def _nearest(word: str) -> str | None:
    """The keyword that a word may mean: by its symbol, or by its letters."""
    plain = word.replace("_", "").lower()
    for entry in parameters().values():
        if word == entry["symbol"] or plain in (entry["symbol"].replace("_", "").lower(), entry["key"].replace("_", "")):
            return str(entry["key"])
    keys = [key for entries in sections().values() for key, *_ in entries]
    near = difflib.get_close_matches(word.lower(), keys, 1)
    return near[0] if near else None


def known(call: str, keywords: Mapping[str, Any], names: Iterable[str], *others: str) -> None:
    """Refuses a keyword that a call does not have, and names the one that may be meant; `names` are its sections."""
    own = {key for name in names for key, *_ in sections()[name]} | {"title", *others}
    for key in keywords:
        if key in own:
            continue
        for section, elsewhere in ELSEWHERE.items():
            if key in [known for known, *_ in sections()[section]]:
                raise ValueError(f"{key}: {elsewhere}")
        near = _nearest(key)
        if key in COMMAND:
            hint = "the command alone has it"
        elif call == "history" and key in [known for known, *_ in sections()["settings"]]:
            hint = "it says how a map is run; leave it out"
        else:
            hint = f"did you mean {near}?" if near in own else f"help(topple.{call}) lists them"
        raise ValueError(f"{key}: no keyword of this name; {hint}")
