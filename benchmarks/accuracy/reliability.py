# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""What a confidence means: the share of pixels that are right, by confidence."""

import numpy as np

RIGHT_PX = 0.07
BORDER_PX = 15
EDGES = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99]


def reliability(disparity, confidence, truth):
    """Rows {from, to, pixels, mean_confidence, right, right_from_here}: percent of pixels within
    0.07 px of the truth in a bin, and in it and all above. Confidence beyond 1 is in the last
    bin."""
    scored = np.isfinite(truth) & np.isfinite(disparity) & np.isfinite(confidence)
    for rim in (np.s_[:BORDER_PX], np.s_[-BORDER_PX:]):
        scored[rim] = False
        scored[:, rim] = False
    value = confidence[scored]
    right = np.abs(disparity[scored].astype(float) - truth[scored]) <= RIGHT_PX
    rows = []
    for low, high in zip(EDGES, EDGES[1:] + [None]):
        above = value >= low
        inside = above & (value < high) if high else above
        rows.append({
            "from": low, "to": high, "pixels": int(inside.sum()),
            "mean_confidence": float(value[inside].mean()) if inside.any() else None,
            "right": 100 * float(right[inside].mean()) if inside.any() else None,
            "right_from_here": 100 * float(right[above].mean()) if above.any() else None})
    return rows


def calibration_error(rows):
    """Mean distance between confidence and share right over the pixels, in percent."""
    filled = [row for row in rows if row["pixels"]]
    total = sum(row["pixels"] for row in filled)
    if not total:
        return None
    return sum(row["pixels"] * abs(100 * min(1, row["mean_confidence"]) - row["right"])
               for row in filled) / total
