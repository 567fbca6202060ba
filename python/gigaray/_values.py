# SPDX-License-Identifier: BSD-3-Clause
"""Arguments as users write them."""

from __future__ import annotations

import os
import re
from typing import Iterable, Union

from gigaray._error import Error

PathLike = Union[str, "os.PathLike[str]"]
Memory = Union[None, float, str]
Views = Union[str, int, Iterable[Union[str, int]]]

_BYTES = {"": 2**30, "B": 1, "KIB": 2**10, "MIB": 2**20, "GIB": 2**30, "TIB": 2**40,
          "KB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12}


def memory_bytes(memory: Memory) -> float:
    """Bytes of "2GiB", "500 MB" or a number of GiB; 0, three quarters of what is free, of None."""
    if memory is None:
        return 0.0
    match = re.fullmatch(r"\s*([0-9.eE+]+)\s*([A-Za-z]*)\s*", str(memory))
    try:
        if not match:
            raise ValueError
        number, unit = float(match[1]), _BYTES[match[2].upper()]
    except (ValueError, KeyError):
        raise Error(f"`memory` is {memory!r}; write GiB, or \"2GiB\", \"500MB\"") from None
    if not 0 < number * unit < 2.0**60:
        raise Error(f"`memory` is {memory!r}; it must be above 0")
    return number * unit


def views_text(views: Views) -> str:
    """Views as the library takes them: "all", "centre", or names and indices with commas."""
    if isinstance(views, str):
        return views
    try:
        listed: list[Union[str, int]] = list(views) if isinstance(views, Iterable) else [views]
        texts = [view if isinstance(view, str) else str(int(view)) for view in listed]
    except (TypeError, ValueError):
        raise Error(f"`views` is {views!r}; it must be \"all\", \"centre\", or names and indices"
                    ) from None
    if not texts:
        raise Error("`views` is empty")
    return ",".join(texts)
