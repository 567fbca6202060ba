# SPDX-License-Identifier: BSD-3-Clause
"""Depth and scores of a scene of the HCI 4D light field benchmark.

    python3 hci_scene.py [SCENE]

Without a scene a small one of the same shape is rendered.
"""

import pathlib
import shutil
import sys
import tempfile

import gigaray as gg

PARAMETERS = """[intrinsics]
focal_length_mm = 100.0
image_resolution_x_px = {width}
image_resolution_y_px = {height}
sensor_size_mm = 35.0
[extrinsics]
num_cams_x = 5
num_cams_y = 5
baseline_mm = 40.0
focus_distance_m = 6.0
[meta]
disp_min = -1.2
disp_max = 1.2
"""


def render_scene(folder: pathlib.Path) -> None:
    """input_CamNNN.png row by row, parameters.cfg and the true disparity of the centre view."""
    width, height = 144, 93
    with tempfile.TemporaryDirectory() as rendered:
        files = pathlib.Path(rendered) / "planes"
        gg.synth("planes", views=(5, 5), size=(width, height), folder=files)
        for number, view in enumerate(sorted(files.glob("view_*.png"))):
            shutil.copy(view, folder / f"input_Cam{number:03}.png")
        shutil.copy(files / "truth.pfm", folder / "gt_disp_lowres.pfm")
    (folder / "parameters.cfg").write_text(PARAMETERS.format(width=width, height=height))


def main(scene: pathlib.Path) -> None:
    lf = gg.open(scene)
    print(lf, lf.rig)
    out = gg.reconstruct(lf, views="centre")
    for name, value in gg.evaluate(out, scene).items():
        print(f"{name:24}{value:9.3f}")
    print(f"depth {out.depth.min():.2f} … {out.depth.max():.2f} {lf.rig['unit']}")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main(pathlib.Path(sys.argv[1]))
    else:
        with tempfile.TemporaryDirectory() as made:
            render_scene(pathlib.Path(made))
            main(pathlib.Path(made))
