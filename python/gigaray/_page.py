# SPDX-License-Identifier: BSD-3-Clause
"""The page that shows a result."""

from __future__ import annotations

import html
import os

from gigaray._values import PathLike


class Page:
    """A page with light field, depth, masks and points, as of `gigaray view`: shown by a notebook,
    or saved."""

    def __init__(self, text: str, height: int) -> None:
        self.html = text
        self._height = height

    def save(self, path: PathLike) -> None:
        """Writes one file that opens in a browser."""
        with open(os.fspath(path), "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="{self._height}" '
                'style="border: 0" title="gigaray"></iframe>')

    def __repr__(self) -> str:
        return f"<gigaray.Page, {len(self.html) / 1e6:.1f} MB>"
