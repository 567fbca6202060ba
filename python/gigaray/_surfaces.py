# SPDX-License-Identifier: BSD-3-Clause
"""Point clouds and surfaces."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from gigaray._values import PathLike


class _Points:
    """What clouds and surfaces share. Arrays look into the memory of the library."""

    def __init__(self, core: Any) -> None:
        self._core = core

    @property
    def origin(self) -> npt.NDArray[np.float64]:
        """(3,): where the scene has what is (0, 0, 0) in `positions`; other than 0 of scenes that
        lie far out."""
        return self._core.origin

    @property
    def positions(self) -> npt.NDArray[np.float32]:
        """(n, 3), scene units, relative to `origin`"""
        return self._core.positions

    @property
    def normals(self) -> npt.NDArray[np.float32]:
        """(n, 3), unit, to the side that cameras saw"""
        return self._core.normals

    @property
    def colours(self) -> npt.NDArray[np.uint8]:
        """(n, 3), sRGB"""
        return self._core.colours

    def __len__(self) -> int:
        return len(self.positions)


class Cloud(_Points):
    """One coloured, oriented cloud of all views."""

    @property
    def confidences(self) -> npt.NDArray[np.float32]:
        """(n,), 0 … 1"""
        return self._core.confidences

    @property
    def supports(self) -> npt.NDArray[np.float32]:
        """(n,): other views that see the point there, mean of what was merged"""
        return self._core.supports

    def save(self, path: PathLike, *, replace: bool = False) -> None:
        """To .ply or .pcd; the file appears when it is complete. replace: another file in the way,
        which gigaray did not write, is moved aside. Raises Error."""
        self._core.save(os.fspath(path), replace)

    def __repr__(self) -> str:
        return f"<gigaray.Cloud {len(self)} points>"


class Mesh(_Points):
    """A surface of triangles."""

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """(m, 3): indices of vertices, counter-clockwise seen from the side of the cameras"""
        return self._core.faces

    def save(self, path: PathLike, *, replace: bool = False) -> None:
        """To .ply, .obj, .glb or .stl, textured to .glb or .obj; see Cloud.save."""
        self._core.save(os.fspath(path), replace)

    def __repr__(self) -> str:
        return f"<gigaray.Mesh {len(self)} vertices, {len(self.faces)} triangles>"
