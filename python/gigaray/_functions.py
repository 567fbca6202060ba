# SPDX-License-Identifier: BSD-3-Clause
"""What is done with light fields and results."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from gigaray import _gigaray
from gigaray._error import Error
from gigaray._light_field import LightField, open
from gigaray._result import Result, View
from gigaray._values import Memory, PathLike, Views, memory_bytes, views_text

Range = Optional[Tuple[float, float]]


def config() -> dict[str, Any]:
    """version, python (the interpreter that this was built for), python_version, and meshing: are
    there clouds and surfaces?"""
    return _gigaray.config()


def _request(views: Views, disparity: Range, depth: Range, preset: str, device: str, backend: str,
             memory: Memory, options: Optional[Mapping[str, Any]],
             more: Mapping[str, Any]) -> dict[str, Any]:
    return {"views": views_text(views), "disparity": disparity, "depth": depth, "preset": preset,
            "device": device, "backend": backend, "memory": memory_bytes(memory),
            "options": {**(options or {}), **more}}


def reconstruct(light_field: LightField, *, views: Views = "all", disparity: Range = None,
                depth: Range = None, preset: str = "auto", device: str = "",
                backend: str = "opencl", memory: Memory = None,
                options: Optional[Mapping[str, Any]] = None, **more: Any) -> Result:
    """Depth of the views of a light field.

    views: "all", "centre", or names and indices. disparity: (lo, hi) to search, px per view step
    (of unstructured views inverse depth); or depth: (near, far), scene units, far may be infinite;
    without both it is found. preset: "auto" or "paper". device: "cpu", "gpu", an index, or a part
    of a name; "" is the first GPU, else the CPU; GIGARAY_DEVICE chooses too. backend: "opencl", or
    "reference", plain loops, slow. memory: most that the run may take, "2GiB" or GiB; the result
    does not depend on it.
    options: fields of docs/options.md by name, {"winner.median_radius": 3}; as keywords their dots
    are two underscores, winner__median_radius=3.

    The same input gives the same bits, from files, arrays or the program. Raises Error,
    KeyboardInterrupt.
    """
    core = _gigaray.reconstruct(
        light_field._core,
        _request(views, disparity, depth, preset, device, backend, memory, options, more))
    return Result(core)


def load(path: PathLike, *, input: Optional[PathLike] = None, min_confidence: float = 0) -> Result:
    """Opens what `Result.save` or `gigaray depth` wrote, or a .grl file. input: where the pictures
    are, when they are no more where they were. min_confidence: what is less sure becomes NaN. Maps
    are read when they are asked for; where the pictures are gone, maps are there still."""
    return Result(_gigaray.load(os.fspath(path), os.fspath(input) if input is not None else "",
                                min_confidence))


def scenes() -> list[str]:
    """Names of the scenes of `synth`."""
    return _gigaray.scene_names()


def synth(scene: str, *, views: Union[int, Tuple[int, int]] = (17, 1),
          size: Tuple[int, int] = (352, 240), disparity: Tuple[float, float] = (-1.0, 1.0),
          path: Optional[str] = None, extent: Optional[float] = None, step: Optional[float] = None,
          noise: float = 0, outliers: float = 0, seed: int = 1, bit_depth: int = 8,
          folder: Optional[PathLike] = None, replace: bool = False) -> LightField:
    """Renders a scene with exact truth (`LightField.truth`). The same arguments give the same
    pixels on every machine.

    scene: one of `scenes()`. views: along s and along t. size: width, height, px. disparity: of
    the farthest and the nearest surface, px per view step. path: "line", "arc" or "walk":
    photographs of posed cameras instead, along `extent` m or with `step` degrees between
    neighbours. noise: standard deviation, of a full range of 1. outliers: share of views with
    somebody in the picture. folder: writes files there as `gigaray synth` does, and opens them.
    """
    arguments = {"views": (views, 1) if isinstance(views, int) else views, "size": size,
                 "disparity": disparity, "path": path, "extent": extent, "step": step,
                 "noise": noise, "outliers": outliers, "seed": seed, "bit_depth": bit_depth}
    if folder is not None:
        _gigaray.synth_folder(scene, arguments, os.fspath(folder), replace)
        return open(folder)
    return LightField._of(_gigaray.synth(scene, arguments))


def evaluate(estimate: Any, truth: Any, *, views: Views = "centre",
             metrics: Union[str, Sequence[str]] = "hci", border: Optional[int] = None
             ) -> dict[str, Any]:
    """Scores of disparity against the truth, by name: shares are percent (docs/accuracy.md).

    estimate: a Result, a map (v, u), or a folder or file as of `gigaray evaluate`. truth: a map, a
    synthetic LightField, or a scene of a benchmark or file. A Result of unstructured views is
    scored by its depth against true inverse depth of a synthetic LightField, or a map of depth.
    views: of a Result or folder, "centre", "all" that have depth or names; several give a
    dictionary of dictionaries. metrics: "hci", "middlebury" or both. border: px left out on each
    side, 15 for HCI unless stated.

    Raises Error: "bad_input" for what is missing or of another size.
    """
    names = [metrics] if isinstance(metrics, str) else list(metrics)
    if isinstance(estimate, (str, os.PathLike)):
        if not isinstance(truth, (str, os.PathLike)):
            raise Error("`truth` of a folder or file must be one, too")
        return _gigaray.score_folders([os.fspath(estimate)], os.fspath(truth), views_text(views),
                                      names, border)
    if not isinstance(estimate, Result):
        return _score(estimate, truth, 0, names, border)
    if views == "centre":
        chosen = [estimate.top]
    elif views == "all":
        chosen = list(estimate)
    else:
        chosen = [estimate[name.strip()] if name.strip() in estimate.views else
                  estimate[int(name)] for name in views_text(views).split(",")]
    scores: dict[str, dict[str, Any]] = {}
    for view in chosen:
        if estimate.light_field.kind == "unstructured":
            scores[view.name] = _score_depth(view, truth, border)
        else:
            scores[view.name] = _score(view.disparity, _truth_of(truth, view, views), view.index,
                                       names, border)
    return scores if len(scores) > 1 else scores[chosen[0].name]


def _truth_of(truth: Any, view: View, views: Views) -> Any:
    """Of a view that is not the centre a scene has its own file."""
    if isinstance(truth, (str, os.PathLike)) and views != "centre":
        return os.path.join(os.fspath(truth), "truth", view.name + ".pfm")
    return truth


def _score(estimate: Any, truth: Any, view: int, metrics: list[str], border: Optional[int]
           ) -> dict[str, float]:
    if isinstance(truth, LightField):
        truth = _synthetic_truth(truth, view)
    if isinstance(truth, (str, os.PathLike)):
        return _gigaray.score_scene(estimate, os.fspath(truth), metrics, border)
    return _gigaray.score_maps(estimate, truth, metrics, border)


def _score_depth(view: View, truth: Any, border: Optional[int]) -> dict[str, float]:
    if isinstance(truth, (str, os.PathLike)):
        raise Error("`truth` of unstructured views must be a map of depth or a synthetic LightField;"
                    " of folders see `gigaray evaluate --metrics depth`")
    if isinstance(truth, LightField):
        truth = np.float32(1) / _synthetic_truth(truth, view.index)
    return _gigaray.score_depth_maps(view.depth, truth, border or 0)


def _synthetic_truth(light_field: LightField, view: int) -> npt.NDArray[np.float32]:
    truth = light_field.truth(view)
    if truth is None:
        raise Error("`truth` is a light field without a truth; only rendered ones have it")
    return truth


@dataclasses.dataclass(frozen=True)
class Probe:
    """Why a pixel has the disparity that it has. Of unstructured views disparity is inverse depth."""

    view: int
    u: int
    v: int
    disparity: float  #: the winner; NaN: none
    confidence: float  #: best score minus mean score
    hypotheses: npt.NDArray[np.float32]  #: (n,), px per view step
    scores: npt.NDArray[np.float32]  #: (n,); -1: not tested
    samples: npt.NDArray[np.float32]  #: (view, 3): the colour on the winner's ray, 0 … 1; NaN: none
    best: Optional[Tuple[float, float]]  #: (disparity, score)
    runner_up: Optional[Tuple[float, float]]  #: the highest peak of another hill
    mean: float  #: score of the tested hypotheses
    seen_by: int  #: views that see the point of the winner
    decision: Optional[dict[str, Any]] = None  #: level, view and pixel that decided, if asked for


def probe(light_field: LightField, *, u: int, v: int, view: Union[int, str] = "centre",
          decided: bool = False, disparity: Range = None, depth: Range = None,
          preset: str = "auto", device: str = "", backend: str = "opencl", memory: Memory = None,
          options: Optional[Mapping[str, Any]] = None, **more: Any) -> Probe:
    """The score curve of pixel (u, v) of a view. decided: computes the depth of all views too, for
    what decided the pixel. Others as of `reconstruct`. Raises Error for a pixel that isn't there."""
    arguments = _request("all", disparity, depth, preset, device, backend, memory, options, more)
    return Probe(**_gigaray.probe(light_field._core, u, v, str(view), arguments, decided))


def encode(light_field: LightField, result: Result, path: PathLike, *, max_error: int = 0,
           replace: bool = False) -> dict[str, int]:
    """Writes a .grl file, a light field with its disparities for every command and for `open`;
    lossless with max_error 0, else values may differ by so much. result: depth of all its views.
    Gives rays, tuples, rgb_bytes (of all views without compression) and file_bytes."""
    return _gigaray.encode(light_field._core, result._core, os.fspath(path), max_error, replace)


def colours() -> Any:
    """The colours of depth pictures: blue is far, red is near, black has no estimate. A colormap for
    matplotlib, `plt.imshow(out.disparity, cmap=gg.colours())`; without matplotlib the table
    (256, 3), uint8."""
    table = _gigaray.depth_colours()
    try:
        from matplotlib.colors import ListedColormap  # type: ignore[import]
    except ImportError:
        return table
    colormap = ListedColormap(table / 255.0, name="gigaray")
    colormap.set_bad("black")
    return colormap
