"""Progress of long work."""

from __future__ import annotations

import importlib.util
import sys
import time
import warnings
from typing import Any, Callable, Optional

from . import _given

#: Called with what is being done, how much of it is done, and how much there is to do, if that is known.
Progress = Callable[[str, int, Optional[int]], None]

#: Work that is done sooner, in s, needs no bar.
PATIENCE = 0.5

#: True once a notebook was told that it has no widgets.
_said = False


class Bar:
    """A bar of tqdm, if that is installed and somebody can see it."""

    def __init__(self, shown: bool) -> None:
        self._since = time.monotonic()
        self._bar: Any = None
        self._shown = shown
        #: What was done before, and says nothing about how fast the rest is.
        self.known = 0

    def __call__(self, stage: str, done: int, of: int | None) -> None:
        if not self._shown or time.monotonic() < self._since + PATIENCE:
            return
        if self._bar is None:
            try:
                tqdm = _tqdm()
            except ImportError:
                self._shown = False
                return
            self._bar = tqdm(leave=False, initial=self.known)
            self._bar.start_t -= time.monotonic() - self._since
        self._bar.set_description(stage, refresh=False)
        self._bar.initial = min(self.known, done)
        self._bar.total = of
        self._bar.n = done
        self._bar.refresh()

    def close(self) -> None:
        """Takes the bar away."""
        if self._bar is not None:
            self._bar.close()


def _tqdm() -> Any:
    """The bar of this terminal or notebook; where a notebook has no widgets it is text, which is said once."""
    global _said
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
    if "ipykernel" in sys.modules and importlib.util.find_spec("ipywidgets") is None and not _said:
        _said = True
        print("note: progress is shown as text; `pip install ipywidgets` makes it a bar", file=sys.stderr)
    return tqdm


def bar(wanted: bool | None | Progress) -> Progress | Bar:
    """What is called with the progress: the user's function, or a bar where a terminal or a notebook shows it."""
    if callable(wanted):
        return wanted
    if wanted is not None:
        wanted = _given.flag("progress", wanted)
    seen = sys.stderr is not None and sys.stderr.isatty() or "ipykernel" in sys.modules
    return Bar(seen if wanted is None else wanted)
