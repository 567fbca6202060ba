# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong."""

from __future__ import annotations


class Error(RuntimeError):
    """What gigaray raises: one line that says what is wrong, with which file or argument, and what
    to do.

    `code` is what kind of thing it is: "invalid_argument", "bad_input", "io", "device",
    "out_of_memory" or "cancelled".
    """

    code: str

    def __init__(self, message: str, code: str = "invalid_argument") -> None:
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type[Error], tuple[str, str]]:
        return type(self), (str(self), self.code)
