"""The progress bar of a call."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator

Progress = Callable[[str, int, int], Any]


class Bar:
    """A bar of tqdm for each phase, where tqdm is installed; it appears after a second."""

    def __init__(self) -> None:
        self.bar: Any = None
        self.phase: tuple[str, int] | None = None

    def __call__(self, phase: str, done: int, total: int) -> None:
        from tqdm.auto import tqdm

        if (phase, total) != self.phase:
            self.close()
            self.phase = (phase, total)
            unit = " shards" if phase == "tiles" else " cells"
            self.bar = tqdm(total=total, desc=phase, delay=1.0, leave=False, unit=unit, unit_scale=total > 9999)
        self.bar.update(done - self.bar.n)

    def close(self) -> None:
        """Ends the bar."""
        if self.bar is not None:
            self.bar.close()
        self.bar = None


def listener(progress: bool | Progress | None) -> Progress | None:
    """The listener of a call's progress: the given function; or a bar, if it is wanted and tqdm is installed."""
    if callable(progress):
        return progress
    if progress is False:
        return None
    if progress is not None and progress is not True:
        raise ValueError("progress: give False, True or a function of (phase, done, total)")
    try:
        import tqdm.auto  # noqa: F401
    except ImportError:
        if progress:
            raise
        return None
    return Bar()


@contextmanager
def heard(progress: bool | Progress | None) -> Iterator[Progress | None]:
    """The listener of a call's progress while the call runs; a bar ends with the call."""
    hears = listener(progress)
    try:
        yield hears
    finally:
        if isinstance(hears, Bar):
            hears.close()
