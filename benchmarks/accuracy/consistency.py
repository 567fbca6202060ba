# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Do neighbouring views agree about the points that both see?"""

import numpy as np

AGREE_PX = 0.1


def neighbours(views):
    """Pairs of views one step apart along s or t."""
    at = {(round(v.s, 3), round(v.t, 3)): v for v in views}
    for (s, t), view in at.items():
        for place in ((round(s + 1, 3), t), (s, round(t + 1, 3))):
            if place in at:
                yield view, at[place]


def warped(disparity, from_view, to_view):
    """Where the pixels of one view land in another: rows, columns, disparities of those that land
    inside and that no nearer pixel of the same view covers."""
    height, width = disparity.shape
    v, u = np.indices(disparity.shape)
    known = np.isfinite(disparity)
    d = np.where(known, disparity, 0)
    column = np.rint(u + (from_view.s - to_view.s) * d).astype(int)
    row = np.rint(v + (from_view.t - to_view.t) * d).astype(int)
    inside = known & (column >= 0) & (column < width) & (row >= 0) & (row < height)
    row, column, d, v, u = (x[inside] for x in (row, column, d, v, u))
    nearest = np.full(disparity.shape, -np.inf)
    np.maximum.at(nearest, (row, column), d)
    front = d >= nearest[row, column] - AGREE_PX
    return row[front], column[front], d[front], v[front], u[front]


def agreement(first, second, first_view, second_view, truths=None):
    """(agreeing, compared) pixels of two disparity maps. A pixel is compared when it lands inside
    the other view, nothing nearer of its own view covers it and, with the truths of both views,
    both really see the point."""
    row, column, d, v, u = warped(first, first_view, second_view)
    compared = np.isfinite(second[row, column])
    if truths is not None:
        # Visible: the point that this pixel truly shows is the one seen at its true place.
        truth = truths[0]
        true_row, true_column, true_d, true_v, true_u = warped(truth, first_view, second_view)
        both = np.zeros(truth.shape, bool)
        both[true_v, true_u] = np.abs(truths[1][true_row, true_column] - true_d) < AGREE_PX
        compared &= both[v, u]
    error = np.abs(second[row, column] - d)[compared]
    return int((error <= AGREE_PX).sum()), int(compared.sum())
