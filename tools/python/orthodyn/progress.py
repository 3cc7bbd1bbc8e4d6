"""Progress of a run, in one line that is overwritten."""
from __future__ import annotations

import sys
import time


class Progress:
    """Shows the completed percentage and the estimated remaining time on stderr."""

    def __init__(self, name: str, wanted: bool | None) -> None:
        """`wanted`: whether to show the progress; None: in a terminal or a notebook only."""
        self._is_on = (sys.stderr.isatty() or "ipykernel" in sys.modules) if wanted is None else wanted
        self._name, self._began, self._shown = name, time.monotonic(), 0
        self._first: float | None = None

    def show(self, now: float, end: float) -> None:
        if not self._is_on:
            return
        if self._first is None:
            self._first = now
        part = (now - self._first) / (end - self._first) if end > self._first else 1.0
        left = (time.monotonic() - self._began) * (1 - part) / part if part > 0 else float("inf")
        rest = f"  ({left:.0f} s left)" if left < 1e6 else ""
        self._write(f"{self._name}: {100 * part:3.0f} %, t = {now:.4g} s{rest}")

    def say(self, text: str) -> None:
        if not self._is_on:
            return
        self._write(text)
        sys.stderr.write("\n")

    def end(self) -> None:
        if self._shown:
            self._write("")

    def _write(self, text: str) -> None:
        sys.stderr.write("\r" + text.ljust(self._shown) + ("\r" if not text else ""))
        sys.stderr.flush()
        self._shown = len(text)
