# SPDX-License-Identifier: BSD-3-Clause
"""Depth of views, and what is made of it."""

from __future__ import annotations

import functools
import math
import os
from typing import Any, Iterable, Iterator, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from gigaray import _gigaray
from gigaray._error import Error
from gigaray._light_field import LightField
from gigaray._page import Page
from gigaray._surfaces import Cloud, Mesh
from gigaray._values import Memory, PathLike, Views, memory_bytes, views_text

Array = npt.NDArray[Any]
FloatMap = npt.NDArray[np.float32]


class View:
    """Depth of one view. Maps are (v, u), NaN where there is no estimate; they are made when they
    are first asked for, and look into the memory of the library."""

    def __init__(self, result: Result, index: int) -> None:
        self._result = result
        self._core = result._core
        self.index = index

    @property
    def name(self) -> str:
        return self._result.light_field.names[self.index]

    @functools.cached_property
    def _maps(self) -> dict[str, Any]:
        return self._core.maps(self.index)

    @property
    def disparity(self) -> FloatMap:
        """px per view step, positive is nearer. Of views of a rig; see `inverse_depth`."""
        if self._result.light_field.kind == "unstructured":
            raise Error("`disparity`: unstructured views have none; use `depth` or `inverse_depth`")
        return self._maps["disparity"]

    @functools.cached_property
    def depth(self) -> FloatMap:
        """Distance along the optical axis, scene units. Raises Error where the rig isn't known."""
        return self._core.depth(self.index)

    @functools.cached_property
    def inverse_depth(self) -> FloatMap:
        """1 / depth, 1 / scene unit."""
        if self._result.light_field.kind == "unstructured":
            return self._maps["disparity"]
        return np.float32(1) / self.depth

    @property
    def confidence(self) -> Optional[FloatMap]:
        """0 … 1: the probability of being right within 0.07 px, or within 1 % of the depth of
        unstructured views; with preset "paper" eq. 7. None: not known, as in .grl files."""
        return self._maps["confidence"]

    @property
    def level(self) -> Optional[npt.NDArray[np.int8]]:
        """Pyramid level that decided, 0 is the finest, -1 none. None: not known of results that
        were opened."""
        return self._maps["level"]

    @property
    def camera(self) -> _gigaray.Camera:
        """Its camera in the scene. Of a rig whose focal length and view step are not known they
        are taken as the longer side of the picture and as 1."""
        return self._core.camera(self.index)

    @property
    def picture(self) -> Array:
        """(v, u, 3), uint8 or uint16, sRGB"""
        return self._result.light_field[self.index]

    def points(self) -> npt.NDArray[np.float64]:
        """(v, u, 3): the place of every pixel's point in the scene, scene units; NaN: none."""
        return self._core.points(self.index)

    def __repr__(self) -> str:
        return f"<gigaray.View {self.name}>"


class Result:
    """Depth of the views of a light field: computed by `reconstruct`, or opened by `load`.

        out.disparity, out.depth           # of the centre view
        out["view_003"].confidence, out[3]
        for view in out: ...
    """

    def __init__(self, core: _gigaray.Result, light_field: Optional[LightField] = None) -> None:
        self._core = core
        self.light_field = light_field or LightField._of(core.light_field)
        self._views: dict[int, View] = {}

    def __getitem__(self, view: Union[int, str]) -> View:
        """A view by index or name. Raises KeyError, IndexError where it has no depth."""
        index = self.top.index if view == "centre" else self.light_field.index(view)
        if index not in self._core.views:
            raise IndexError(f"view {self.light_field.names[index]} has no depth: `views` left it "
                             "out")
        return self._views.setdefault(index, View(self, index))

    def __iter__(self) -> Iterator[View]:
        return (self[index] for index in self._core.views)

    def __len__(self) -> int:
        return len(self._core.views)

    @property
    def top(self) -> View:
        """The centre view, or the one nearest to it that has depth."""
        index = self._core.top_view
        return self._views.setdefault(index, View(self, index))

    @property
    def views(self) -> list[str]:
        """Names of the views that have depth."""
        names = self.light_field.names
        return [names[index] for index in self._core.views]

    @property
    def disparity(self) -> FloatMap:
        """Of the centre view, see View.disparity."""
        return self.top.disparity

    @property
    def depth(self) -> FloatMap:
        """Of the centre view, see View.depth."""
        return self.top.depth

    @property
    def inverse_depth(self) -> FloatMap:
        """Of the centre view, see View.inverse_depth."""
        return self.top.inverse_depth

    @property
    def confidence(self) -> Optional[FloatMap]:
        """Of the centre view, see View.confidence."""
        return self.top.confidence

    @property
    def range(self) -> Tuple[float, float]:
        """What was searched: px per view step, of unstructured views 1 / scene unit."""
        return self._core.range

    @property
    def device(self) -> str:
        """That computed it; "" of a result that was opened."""
        return self._core.device

    @property
    def seconds(self) -> Optional[dict[str, float]]:
        """Per stage; None of a result that was opened."""
        return self._core.seconds

    def save(self, path: PathLike, *, formats: Sequence[str] = (), min_confidence: float = 0,
             replace: bool = False) -> None:
        """Writes a folder as `gigaray depth` does (docs/formats.md), which appears when it is
        complete. formats: beside PFM, of "exr", "npy", "png16", "colmap", "nerfstudio".
        min_confidence: what is less sure is left out. replace: what is in the way and was not
        written by gigaray is moved aside. Raises Error("io"), "invalid_argument"."""
        self._core.save(os.fspath(path), list(formats), min_confidence, replace)

    def mask(self, *, near: Optional[float] = None, far: Optional[float] = None,
             at: Optional[Tuple[int, int]] = None, tolerance: Optional[float] = None,
             view: Union[int, str] = "centre", soft: bool = False) -> Array:
        """What lies in an interval of depth, in a view: (v, u), bool; with `soft` a matte, float32
        in 0 … 1.

        near, far: near > far are disparities (of unstructured views inverse depths), near < far
        distances. at: (u, v), a pixel of the centre view in their place: what is as far away, within
        `tolerance` px per view step (of unstructured views a share of the inverse depth), or as far
        as the surface goes."""
        return self.masks([view], near=near, far=far, at=at, tolerance=tolerance, soft=soft)[0]

    def masks(self, views: Optional[Iterable[Union[int, str]]] = None, *,
              near: Optional[float] = None, far: Optional[float] = None,
              at: Optional[Tuple[int, int]] = None, tolerance: Optional[float] = None,
              soft: bool = False) -> list[Array]:
        """`mask` of several views, of all that have depth unless stated."""
        if (near is None) != (far is None) or (near is None) == (at is None):
            raise Error("`mask` takes `near` and `far`, or `at`")
        indices = self._core.views if views is None else [self[view].index for view in views]
        between = (near, far) if near is not None and far is not None else None
        return _gigaray.masks(self._core, indices, between, at, tolerance, soft)

    def render(self, pose: Union[str, int, Tuple[float, float], _gigaray.Camera], *,
               sources: int = 8, memory: Memory = None, maps: bool = False) -> Any:
        """A novel view: (v, u, 3), uint8 or uint16, sRGB.

        pose: (s, t) between the views of a rig, view steps; a Camera; or a text as of `gigaray
        render --pose`: a view, "s,t", either with "+x,y,z" in scene units behind it, or a file.
        sources: views that it is made of, 1 … 32. maps: gives (picture, inverse depth, seen), where
        seen is False where no source sees the point."""
        limit = memory_bytes(memory)
        if isinstance(pose, _gigaray.Camera):
            made = _gigaray.render_camera(self._core, pose, sources, limit)
        else:
            text = pose if isinstance(pose, str) else _pose_text(pose)
            made = _gigaray.render_pose(self._core, text, sources, limit)
        return made if maps else made[0]

    def refocus(self, value: float, *, view: Union[int, str] = "centre",
                slope: Tuple[float, float] = (0.0, 0.0), aperture: float = math.inf) -> Array:
        """The picture of a lens as wide as the rig, sharp where the disparity (of unstructured
        views the inverse depth) is `value`, and changes by `slope` per px to the right and down.
        aperture: view steps around the view that have a part. (v, u, 3), sRGB."""
        index = self._core.top_view if view == "centre" else self.light_field.index(view)
        return _gigaray.refocus(self._core, index, value, slope[0], slope[1], aperture)

    def cloud(self, *, views: Views = "all", min_confidence: Optional[float] = None,
              voxel: float = 0, most_points: int = 0, memory: Memory = None) -> Cloud:
        """One cloud of points that several views confirm, merged in cubes of `voxel` scene units
        (0: the distance of neighbouring pixels). min_confidence: what is less sure is left out, 0.6
        of unstructured views and 0.1 of others unless stated. most_points: 0, as many as there are.
        Raises Error: "bad_input" where no point is left."""
        _require_meshing()
        return Cloud(_gigaray.cloud(self._core, self._with_depth(views), min_confidence, voxel,
                                    most_points, memory_bytes(memory)))

    def mesh(self, *, method: str = "grid", views: Views = "all",
             min_confidence: Optional[float] = None, voxel: float = 0, texture: bool = False,
             memory: Memory = None) -> Mesh:
        """A surface. method: "grid", depth maps on their pixels; "poisson", smooth and closed;
        "front", triangles between the points of the cloud. texture: colours from the pictures in
        place of those of vertices. Others as of `cloud`."""
        _require_meshing()
        return Mesh(_gigaray.mesh(self._core, method, self._with_depth(views), min_confidence, voxel,
                                  texture, memory_bytes(memory)))

    def view(self, *, title: str = "gigaray", views: Optional[Views] = None, max_size: int = 1024,
             compare: Optional[Result] = None, truth: Optional[PathLike] = None,
             height: int = 760) -> Page:
        """A page that shows it, as `gigaray view -o page.html`: in a notebook when it is the last
        of a cell, or `out.view().save("page.html")`.

        views: whose depth is shown; None: nine that stand apart. max_size: px, larger pictures are
        shrunk. compare: another result of the same views, to wipe. truth: a file or folder with the
        true disparity, for the errors. height: of the frame in a notebook, px."""
        chosen = "" if views is None else self._with_depth(views)
        return Page(_gigaray.page(self._core, title, chosen, max_size,
                                  compare._core if compare else None, os.fspath(truth or "")), height)

    def _with_depth(self, views: Views) -> str:
        return views_text(self._core.views if views == "all" else views)

    def __repr__(self) -> str:
        return f"<gigaray.Result {len(self)} of {len(self.light_field)} views>"


def _pose_text(pose: Any) -> str:
    if isinstance(pose, int):
        return str(pose)
    try:
        s, t = pose
        return f"{float(s)!r},{float(t)!r}"
    except (TypeError, ValueError):
        raise Error(f"`pose` is {pose!r}; it must be (s, t), a Camera, a view or a text") from None


def _require_meshing() -> None:
    if not _gigaray.config()["meshing"]:
        raise Error("gigaray was built without clouds and surfaces (GIGARAY_MESHING)")
