# SPDX-License-Identifier: BSD-3-Clause
"""Depth for every view of a light field.

    import gigaray as gg
    lf = gg.open("hci/cotton")             # or gg.LightField(pixels, s=...), gg.synth("garden")
    with gg.progress():
        out = gg.reconstruct(lf)
    out.disparity                          # (v, u), px per view step, positive is nearer

Arrays have the axes (view, v, u, c): v is the row and u the column of a pixel, whose centre is at
integers. Positions (s, t) of views are in view steps; NaN is no estimate. What goes wrong is
gigaray.Error; notes of the library go to the logger "gigaray".
"""

from __future__ import annotations

import atexit as _atexit

from gigaray import _gigaray
from gigaray._error import Error
from gigaray._functions import (Probe, colours, config, encode, evaluate, load, probe, reconstruct,
                                scenes, synth)
from gigaray._light_field import LightField, open
from gigaray._page import Page
from gigaray._progress import progress
from gigaray._result import Result, View
from gigaray._surfaces import Cloud, Mesh

Camera = _gigaray.Camera
__version__: str = config()["version"]
__doc__ = (__doc__ or "") + f"""
This is version {__version__}, built for {config()["python"]} (Python {config()["python_version"]}).
"""

__all__ = [
    "Camera", "Cloud", "Error", "LightField", "Mesh", "Page", "Probe", "Result", "View", "colours",
    "config", "encode", "evaluate", "load", "open", "probe", "progress", "reconstruct", "scenes", "synth"
]

# Tracebacks name what users catch.
for _name in (Error, LightField, Result, View, Cloud, Mesh, Page, Probe):
    _name.__module__ = __name__

# Work that Ctrl-C left to itself still uses libraries that the end of the process takes away.
_atexit.register(_gigaray.wait_for_abandoned)
