# SPDX-License-Identifier: BSD-3-Clause
"""Light fields: pictures and where they were taken from."""

from __future__ import annotations

import os
from typing import Any, Iterator, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from gigaray import _gigaray
from gigaray._error import Error
from gigaray._values import Memory, PathLike, Views, memory_bytes, views_text

Array = npt.NDArray[Any]


class LightField:
    """Pictures of a scene from many places: on a line ("3D"), in a plane ("4D"), or from posed
    cameras anywhere ("unstructured").

        lf = gg.open("hci/cotton")
        lf = gg.LightField(pixels, s=np.arange(-8, 9))
        lf = gg.LightField.from_poses(images, c2w, K, convention="opengl")
    """

    def __init__(self, pixels: Union[Array, Sequence[Array]], *, s: Optional[npt.ArrayLike] = None,
                 t: Optional[npt.ArrayLike] = None, focal_px: Optional[float] = None,
                 baseline: Optional[float] = None, focus_distance: Optional[float] = None,
                 unit: str = "", names: Sequence[str] = ()) -> None:
        """Views of parallel cameras.

        pixels: (view, v, u, 3), or a list of (v, u, 3): uint8 or uint16, encoded as sRGB, with any
            strides. They are not copied: leave them as they are while the light field is in use.
        s, t: (view,), places in view steps: s rises as the camera goes right, t as it goes down; the
            middle becomes 0. Without both the views are a row in their order, and that the camera
            goes right is held against the pictures.
        focal_px: focal length, px; baseline: scene units per view step; focus_distance: scene
            units, of what has disparity 0, infinity unless stated; unit: "m", "mm". With the first
            two, depth is known.
        names: one per view; "view_000" and so on unless stated.

        Raises Error naming the argument that can't be meant.
        """
        self._core = _gigaray.light_field_of_arrays(pixels, s, t, focal_px, baseline,
                                                    focus_distance, unit, list(names))

    @classmethod
    def from_poses(cls, images: Union[Array, Sequence[Array]], c2w: npt.ArrayLike,
                   K: npt.ArrayLike, *, convention: str,
                   depth: Optional[Tuple[float, float]] = None, unit: str = "",
                   names: Sequence[str] = ()) -> LightField:
        """Views of cameras anywhere, without distortion.

        images: (view, v, u, 3), or a list of (v, u, 3), as of LightField.
        c2w: (view, 4, 4) or (view, 3, 4), points of the camera to the scene.
        K: (3, 3) or (view, 3, 3), [[f_u, 0, c_u], [0, f_v, c_v], [0, 0, 1]], px.
        convention: "opengl" (x right, y up, z back; NeRF, Blender, nerfstudio), "opencv" or
            "colmap" (x right, y down, z ahead). The middle of the first pixel is at (0.5, 0.5) in
            "opengl" and "colmap", at (0, 0) in "opencv".
        depth: (near, far), scene units, of what the cameras see; found by features unless stated.
        """
        return cls._of(_gigaray.light_field_of_poses(images, c2w, K, convention, depth, unit,
                                                     list(names)))

    @classmethod
    def _of(cls, core: _gigaray.LightField) -> LightField:
        light_field = cls.__new__(cls)
        light_field._core = core
        return light_field

    @property
    def kind(self) -> str:
        """"3D", "4D" or "unstructured"."""
        return self._core.kind

    @property
    def shape(self) -> Tuple[int, int, int, int]:
        """(views, v, u, 3)"""
        return self._core.shape

    @property
    def positions(self) -> npt.NDArray[np.float64]:
        """(view, 2): s and t of every view, view steps."""
        return self._core.positions

    @property
    def names(self) -> list[str]:
        """Of the views, in their order."""
        return self._core.names

    @property
    def rig(self) -> dict[str, Any]:
        """focal_px (px), baseline (scene units per view step), focus_distance (scene units; None:
        infinity) and unit; None: not known."""
        return self._core.rig

    @property
    def disparity_range(self) -> Optional[Tuple[float, float]]:
        """(lo, hi) that the input states, px per view step; None: nothing."""
        return self._core.disparity

    @property
    def format(self) -> str:
        """What it was recognised as."""
        return self._core.format

    @property
    def notes(self) -> list[str]:
        """What was assumed, a line each."""
        return self._core.notes

    @property
    def centre(self) -> int:
        """Index of the view in the middle."""
        return self._core.centre

    def index(self, view: Union[int, str]) -> int:
        """Index of a view by index (which may count from the end), name or "centre"."""
        if not isinstance(view, str):
            return int(range(len(self))[view])
        if view in self.names:
            return self.names.index(view)
        if view == "centre":
            return self.centre
        raise KeyError(f"no view is called {view!r}")

    def camera(self, view: Union[int, str]) -> _gigaray.Camera:
        """Of an unstructured view."""
        return self._core.camera(self.index(view))

    def shown(self, view: Union[int, str]) -> Optional[npt.NDArray[np.bool_]]:
        """(v, u): False where the picture shows nothing of the scene; None: it does everywhere."""
        return self._core.shown(self.index(view))

    def truth(self, view: Union[int, str] = "centre") -> Optional[npt.NDArray[np.float32]]:
        """(v, u), of a synthetic scene the exact disparity (unstructured: inverse depth)."""
        return self._core.truth(self.index(view))

    def epi(self, v: Optional[int] = None, u: Optional[int] = None, *, t: Optional[float] = None,
            s: Optional[float] = None) -> Array:
        """An epipolar-plane image: (s, u, 3), row `v` of the views with one `t`, rising s; or
        (t, v, 3), column `u` of the views with one `s`. Unless stated those of the centre view."""
        if (v is None) == (u is None):
            raise Error("`epi` takes one of `v` and `u`")
        if v is not None:
            return self._core.epi(True, int(v), t)
        assert u is not None
        return self._core.epi(False, int(u), s)

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, view: Union[int, str]) -> Array:
        """The picture of a view, by index or name: (v, u, 3), uint8 or uint16, sRGB."""
        return self._core.picture(self.index(view))

    def __iter__(self) -> Iterator[Array]:
        return (self._core.picture(view) for view in range(len(self)))

    def __repr__(self) -> str:
        views, height, width, _ = self.shape
        return f"<gigaray.LightField {self.kind}, {views} views of {width} x {height} px>"


def open(path: PathLike, *, positions: Optional[PathLike] = None, direction: str = "",
         row_direction: str = "", images: Optional[PathLike] = None,
         masks: Optional[PathLike] = None, grid: Optional[Tuple[int, int]] = None,
         snake: bool = False, lenslet: Optional[Tuple[int, int]] = None, convention: str = "",
         strict: bool = False, max_size: int = 0, without: Views = "",
         focal_px: Optional[float] = None, baseline: Optional[float] = None,
         focus_distance: Optional[float] = None, unit: str = "", find_cameras: bool = False,
         colmap_folder: Optional[PathLike] = None, quality: str = "medium",
         memory: Memory = None) -> LightField:
    """Opens whatever the program `gigaray` takes as INPUT (docs/formats.md): a folder of numbered
    pictures or a grid of them, an HCI or Stanford scene, a lenslet picture, a COLMAP workspace,
    transforms.json, a .grl file and more. Pictures are decoded when they are first read.

    positions: text file with the place of every picture. direction, row_direction: "right",
    "left", "down" or "up", the way of the camera as the number (the row) rises. images, masks:
    folders. grid: (rows, columns) of numbered pictures, with `snake` every second row back.
    lenslet: (columns, rows). convention: of stated poses, "opencv", "opengl" and more. strict: a
    damaged picture is an error. max_size: px, larger pictures are shrunk. without: views to leave
    out. focal_px, baseline, focus_distance, unit: as of LightField. colmap_folder: where COLMAP's
    files go, when photographs from anywhere need cameras; PATH.colmap unless stated. find_cameras:
    of pictures that form a row, too; quality: "low", "medium" or "high". memory: most that opening
    may take, "2GiB" or GiB.

    Raises Error: "bad_input" where nothing fits, saying what is missing, or an input is damaged.
    """
    place = os.fspath(path)
    work = os.fspath(colmap_folder) if colmap_folder is not None else (
        place.rstrip("/") + ".colmap")
    return LightField._of(_gigaray.open(place, {
        "positions": positions, "direction": direction, "row_direction": row_direction,
        "images": images, "masks": masks, "grid": grid, "snake": snake, "lenslet": lenslet,
        "convention": convention, "strict": strict, "max_size": max_size,
        "without": views_text(without) if without != "" else "", "focal_px": focal_px,
        "baseline": baseline, "focus_distance": focus_distance, "unit": unit,
        "find_cameras": find_cameras, "colmap_folder": work, "quality": quality,
        "memory": memory_bytes(memory)}))
