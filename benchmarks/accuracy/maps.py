# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Float maps in PFM files, as arrays (v, u)."""

import numpy as np


def read_pfm(path):
    """float32 (height, width), rows from top to bottom."""
    with open(path, "rb") as file:
        if file.readline().strip() != b"Pf":
            raise SystemExit(f"{path}: not a PFM with one channel")
        width, height = (int(word) for word in file.readline().split())
        order = "<" if float(file.readline()) < 0 else ">"
        values = np.fromfile(file, order + "f4", width * height)
    if values.size != width * height:
        raise SystemExit(f"{path}: cut short")
    return values.reshape(height, width)[::-1].astype(np.float32)


def write_pfm(path, values):
    with open(path, "wb") as file:
        file.write(b"Pf\n%d %d\n-1\n" % values.shape[::-1])
        file.write(values[::-1].astype("<f4").tobytes())
