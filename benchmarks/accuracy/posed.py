# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Depth maps of posed views against each other."""

import json

import numpy as np

import maps

AGREE = 0.01  # of the depth


class PosedView:
    """A view of a result of `gigaray depth` whose light field is unstructured."""

    def __init__(self, folder, entry):
        camera = entry["camera"]
        self.name = entry["name"]
        self.focal = np.array(camera["focal_px"])
        self.centre = np.array(camera["principal_point_px"])
        self.rotation = np.array(camera["rotation"])
        self.translation = np.array(camera["translation"])
        self.position = -self.rotation.T @ self.translation
        self.depth_file = folder / self.name / "depth.pfm"

    def depth(self):
        return maps.read_pfm(self.depth_file).astype(float)

    def scene_points(self, depth):
        """(height, width, 3) of the pixels."""
        rows, columns = np.indices(depth.shape)
        ray = (np.stack([columns, rows], -1) - self.centre) / self.focal
        in_camera = np.concatenate([ray, np.ones(depth.shape + (1,))], -1) * depth[..., None]
        return (in_camera - self.translation) @ self.rotation

    def project(self, points):
        """Column, row and depth of scene points."""
        in_camera = points @ self.rotation.T + self.translation
        z = in_camera[..., 2]
        pixel = in_camera[..., :2] / z[..., None] * self.focal + self.centre
        return pixel[..., 0], pixel[..., 1], z


def views_of(result):
    entries = json.loads((result / "gigaray.json").read_text())["views"]
    if not entries or "camera" not in entries[0]:
        raise SystemExit(f"{result}: no result of posed views")
    return [PosedView(result, entry) for entry in entries]


def compare(first, second):
    """Of the pixels of the first view: how many have an estimate, land inside the second view,
    meet an estimate there, agree with it within 1 %, and are behind it (hidden, if that is
    right)."""
    depth, other = first.depth(), second.depth()
    with np.errstate(all="ignore"):
        column, row, z = second.project(first.scene_points(depth))
        column, row = np.rint(column), np.rint(row)
        inside = (z > 0) & (column >= 0) & (column < other.shape[1])
        inside &= (row >= 0) & (row < other.shape[0])
        seen = other[np.where(inside, row, 0).astype(int), np.where(inside, column, 0).astype(int)]
        met = inside & np.isfinite(seen)
        agree = met & (np.abs(seen / z - 1) < AGREE)
        behind = met & ~agree & (seen < z)
    return np.array([np.isfinite(depth).sum(), inside.sum(), met.sum(), agree.sum(), behind.sum()])


def agreement(result):
    """Every view against the one that stands nearest: shares of pixels, in percent."""
    views = views_of(result)
    total, pixels = np.zeros(5), 0
    for view in views:
        others = [other for other in views if other is not view]
        nearest = min(others, key=lambda o: np.linalg.norm(o.position - view.position))
        total += compare(view, nearest)
        pixels += view.depth().size
    estimates, inside, met, agree, behind = total
    return {"views": len(views), "estimates": 100 * estimates / pixels,
            "inside": 100 * inside / estimates, "agree": 100 * agree / met, "behind": 100 * behind / met,
            "agree_of_not_behind": 100 * agree / (met - behind)}
