# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""OpenCV's semi-global block matching on one wide pair of a light field: the stereo baseline."""

import math
import time

import cv2
import numpy as np

# Of blocks of 3 … 11 px with and without a higher cap of the prefilter the best on all HCI scenes.
BLOCK = 3
PARAMETERS = {"blockSize": BLOCK, "P1": 8 * 3 * BLOCK**2, "P2": 32 * 3 * BLOCK**2,
              "preFilterCap": 31, "disp12MaxDiff": 1, "uniquenessRatio": 10,
              "speckleWindowSize": 50, "speckleRange": 2, "mode": cv2.STEREO_SGBM_MODE_HH}


def stated_parameters():
    words = ", ".join(f"{name} {value}" for name, value in PARAMETERS.items())
    return (f"OpenCV {cv2.__version__} StereoSGBM, the centre view and the view "
            f"farthest from it in its row, {words}; holes take the farther neighbour of their row")


def wide_pair(scene):
    """The centre and the farthest view of its row (of equally far ones the one to the right), or
    None."""
    centre = scene.centre()
    row = [v for v in scene.views if abs(v.t - centre.t) < 1e-6 and v is not centre]
    if not row:
        return None
    return centre, max(row, key=lambda v: (abs(v.s - centre.s), v.s))


def filled(disparity):
    """Holes take the smaller of the next values to the left and to the right."""
    columns = np.arange(disparity.shape[1])
    result = disparity.copy()
    for row in result:
        known = np.flatnonzero(np.isfinite(row))
        if known.size == 0:
            continue
        left = known[np.clip(np.searchsorted(known, columns, "right") - 1, 0, None)]
        right = known[np.clip(np.searchsorted(known, columns), None, known.size - 1)]
        holes = ~np.isfinite(row)
        row[holes] = np.minimum(row[left], row[right])[holes]
    return result


def disparity_of(scene, low, high):
    """Disparity of the centre view, px per view step, and seconds; None without a pair. low, high:
    the range to search, px per view step."""
    pair = wide_pair(scene)
    if pair is None:
        return None
    centre, other = pair
    pictures = [cv2.imread(str(view.file), cv2.IMREAD_COLOR) for view in pair]
    steps = other.s - centre.s
    if steps < 0:  # The matcher wants the second picture from the right.
        pictures = [cv2.flip(picture, 1) for picture in pictures]
    begin = time.perf_counter()
    first = math.floor(low * abs(steps)) - 1
    count = 16 * math.ceil((high * abs(steps) + 2 - first) / 16)
    matcher = cv2.StereoSGBM_create(minDisparity=first, numDisparities=count, **PARAMETERS)
    # A margin, so that the columns of which the range leaves the picture are matched too.
    margin = max(0, first + count) + max(0, -first)
    wide = [cv2.copyMakeBorder(p, 0, 0, margin, margin, cv2.BORDER_REPLICATE) for p in pictures]
    matched = matcher.compute(*wide)[:, margin:-margin].astype(np.float32) / 16
    disparity = filled(np.where(matched >= first, matched, np.nan) / abs(steps))
    seconds = time.perf_counter() - begin
    return (disparity if steps > 0 else disparity[:, ::-1].copy()), seconds
