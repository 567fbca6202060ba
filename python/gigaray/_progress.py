# SPDX-License-Identifier: BSD-3-Clause
"""Progress of long calls, and what the library has to say."""

from __future__ import annotations

import contextlib
import contextvars
import logging
import sys
import time
from typing import Callable, Iterator, Optional, TextIO

ProgressSink = Callable[[str, float, float], None]

_log = logging.getLogger("gigaray")
_progress: contextvars.ContextVar[Optional[ProgressSink]] = contextvars.ContextVar(
    "gigaray_progress", default=None)


def sinks() -> tuple[Optional[ProgressSink], Callable[[str], None]]:
    """What a call hands its progress and its messages to."""
    return _progress.get(), _log.warning


class _Printer:
    """One line per stage, rewritten on a terminal."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._is_terminal = stream.isatty()
        self._stage = ""
        self._begin = time.monotonic()
        self._is_open = False

    def __call__(self, stage: str, done: float, total: float) -> None:
        is_new = stage != self._stage
        if is_new:
            self.close()
            self._stage, self._begin = stage, time.monotonic()
        if self._is_terminal:
            self._stream.write("\r" + self._line(stage, done, total) + "\x1b[K")
            self._is_open = True
        elif is_new:
            self._stream.write(stage + "\n")
        self._stream.flush()

    def _line(self, stage: str, done: float, total: float) -> str:
        share = min(done / total, 1.0) if total > 0 else 0.0
        passed = time.monotonic() - self._begin
        left = f", {passed * (1 - share) / share:.0f} s left" if 0 < share < 1 else ""
        return f"{stage}: {100 * share:3.0f} %{left}"

    def close(self) -> None:
        if self._is_open:
            self._stream.write("\n")
            self._is_open = False


@contextlib.contextmanager
def progress(sink: Optional[ProgressSink] = None) -> Iterator[None]:
    """Shows the progress of all calls inside of the `with`, on stderr or by `sink`.

    sink: called as sink(stage, done, total) in the calling thread, some 25 times a second at most;
    done and total are in the same unit, which differs between stages. What it raises stops the
    call.

    >>> with gg.progress():
    ...     out = gg.reconstruct(lf)
    """
    printer = _Printer(sys.stderr) if sink is None else None
    token = _progress.set(sink if printer is None else printer)
    try:
        yield
    finally:
        _progress.reset(token)
        if printer is not None:
            printer.close()
