# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Scenes with ground truth, and variants of them: fewer views, worse pictures."""

import json
import pathlib
import re
import shutil
from dataclasses import dataclass

import cv2
import numpy as np

TRUTHS = ["gt_disp_lowres.pfm", "truth.pfm"]
SEED = 20130721
HCI_PICTURE = re.compile(r"input_Cam(\d+)\.png")


@dataclass
class View:
    name: str
    file: pathlib.Path
    s: float
    t: float


@dataclass
class Scene:
    folder: pathlib.Path
    truth: pathlib.Path  # of the centre view
    views: list

    @property
    def name(self):
        return self.folder.resolve().name

    def centre(self):
        """The view nearest to the centre of the rig; ties as in the program: smaller s, then t."""
        return min(self.views, key=lambda v: (v.s**2 + v.t**2, v.s, v.t))

    def truth_of(self, view):
        """Truth of any view, or None."""
        path = self.folder / "truth" / f"{view}.pfm"
        return path if path.is_file() else None


def hci_views(folder):
    config = folder / "parameters.cfg"
    text = config.read_text() if config.is_file() else ""

    def cameras(key):
        stated = re.search(rf"{key}\s*=\s*(\d+)", text)
        return int(stated.group(1)) if stated else 9

    columns, rows = cameras("num_cams_x"), cameras("num_cams_y")
    views = []
    for path in sorted(folder.iterdir()):
        match = HCI_PICTURE.fullmatch(path.name)
        if match:
            row, column = divmod(int(match.group(1)), columns)
            views.append(View(path.stem, path, column - (columns - 1) / 2, row - (rows - 1) / 2))
    return views


def json_views(folder):
    root = json.loads((folder / "gigaray.json").read_text())
    return [View(v["name"], folder / v["file"], v["s"], v["t"]) for v in root["views"]]


def scene_in(folder):
    """The scene of a folder, or None when it has no truth."""
    truth = next((folder / name for name in TRUTHS if (folder / name).is_file()), None)
    if truth is None:
        return None
    views = json_views(folder) if (folder / "gigaray.json").is_file() else hci_views(folder)
    return Scene(folder, truth, views) if views else None


def scenes_in(folder):
    """The scene that the folder is, or those in it, in alphabetical order."""
    own = scene_in(folder)
    if own:
        return [own]
    found = [scene_in(path) for path in sorted(folder.iterdir()) if path.is_dir()]
    return [scene for scene in found if scene]


def pick_views(scene, part):
    """full, row, cross, star: views of the centre's row, column, diagonals; half: the centre and a
    random half of the others."""
    centre = scene.centre()
    if part == "half":
        others = [v for v in scene.views if v is not centre]
        kept = np.random.default_rng(SEED).choice(len(others), len(others) // 2, replace=False)
        return [v for i, v in enumerate(scene.views)
                if v is centre or others.index(v) in set(kept)]

    def is_in(view):
        ds, dt = abs(view.s - centre.s), abs(view.t - centre.t)
        in_row, in_column, in_diagonal = dt < 1e-6, ds < 1e-6, abs(ds - dt) < 1e-6
        return {"full": True, "row": in_row, "cross": in_row or in_column,
                "star": in_row or in_column or in_diagonal}[part]

    return [view for view in scene.views if is_in(view)]


def degraded(picture, view_idx, noise, quality):
    """8-bit pixels with Gaussian noise (of a full range of 1) and then through JPEG."""
    if noise:
        draw = np.random.default_rng([SEED, view_idx]).normal(0, noise * 255, picture.shape)
        picture = np.clip(np.round(picture + draw), 0, 255).astype(np.uint8)
    if quality:
        _, coded = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])
        picture = cv2.imdecode(coded, cv2.IMREAD_COLOR)
    return picture


class Variant:
    """A '+'-separated list of full, row, cross, star, half, noise=SIGMA, jpeg=QUALITY, norange
    (the disparity range is not stated)."""

    def __init__(self, text):
        self.text = text
        self.parts, self.noise, self.quality, self.states_range = [], 0.0, 0, True
        for word in text.split("+"):
            name, _, value = word.partition("=")
            if name == "noise" and value:
                self.noise = float(value)
            elif name == "jpeg" and value:
                self.quality = int(value)
            elif word == "norange":
                self.states_range = False
            elif word in ("full", "row", "cross", "star", "half"):
                self.parts.append(word)
            else:
                raise SystemExit(f"variant '{text}': '{word}' is not known: {Variant.__doc__}")

    def views(self, scene):
        views = scene.views
        for part in self.parts:
            views = pick_views(Scene(scene.folder, scene.truth, views), part)
        return views

    def is_scene_itself(self, scene):
        return (not self.noise and not self.quality and self.states_range
                and len(self.views(scene)) == len(scene.views))

    def derive(self, scene, folder):
        """The variant as a scene in `folder`; the scene itself when nothing changes."""
        if self.is_scene_itself(scene):
            return scene
        folder.mkdir(parents=True)
        views = self.views(scene)
        for view in views:
            target = folder / view.file.name
            if not self.noise and not self.quality:
                shutil.copyfile(view.file, target)
                continue
            picture = cv2.imread(str(view.file), cv2.IMREAD_COLOR)
            changed = degraded(picture, scene.views.index(view), self.noise, self.quality)
            cv2.imwrite(str(target.with_suffix(".png")), changed)
        self.describe(scene, {view.name for view in views}, folder)
        shutil.copyfile(scene.truth, folder / scene.truth.name)
        if (scene.folder / "truth").is_dir():
            shutil.copytree(scene.folder / "truth", folder / "truth")
        derived = scene_in(folder)
        return Scene(folder, derived.truth, derived.views)

    def describe(self, scene, names, folder):
        config, description = scene.folder / "parameters.cfg", scene.folder / "gigaray.json"
        if description.is_file():
            root = json.loads(description.read_text())
            root["views"] = [view for view in root["views"] if view["name"] in names]
            for view in root["views"]:
                file = pathlib.Path(view["file"])
                changed = self.noise or self.quality
                view["file"] = file.with_suffix(".png").name if changed else file.name
            root["kind"] = "3D" if len({view["t"] for view in root["views"]}) == 1 else "4D"
            if not self.states_range:
                root.pop("disparity_range", None)
            (folder / "gigaray.json").write_text(json.dumps(root))
        elif config.is_file():
            lines = config.read_text().splitlines()
            if not self.states_range:
                lines = [line for line in lines if not line.startswith(("disp_min", "disp_max"))]
            (folder / "parameters.cfg").write_text("\n".join(lines) + "\n")
