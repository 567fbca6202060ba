# SPDX-License-Identifier: BSD-3-Clause
"""The lines that the module was made for, on small scenes."""

import importlib.util
import os
import pathlib

import numpy as np
import pytest

import gigaray as gg


@pytest.fixture(scope="module")
def cotton(tmp_path_factory):
    """A folder as of the HCI benchmark."""
    folder = tmp_path_factory.mktemp("hci") / "cotton"
    folder.mkdir()
    place = pathlib.Path(os.environ["GIGARAY_SOURCE"]) / "examples" / "python" / "hci_scene.py"
    spec = importlib.util.spec_from_file_location("hci_scene", place)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    example.render_scene(folder)
    return folder


def test_the_lines_run(cotton, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    lf = gg.open(cotton)
    assert (lf.kind, lf.shape, lf.positions.shape) == ("4D", (25, 93, 144, 3), (25, 2))
    assert (lf[12] == lf["input_Cam012"]).all() and lf.epi(v=60).shape == (5, 144, 3)
    with gg.progress():
        out = gg.reconstruct(lf, views=[12, 13], disparity=(-1.6, 1.5), preset="auto", device="cpu",
                             memory="2GiB")
    assert capsys.readouterr().err != ""
    d = out.disparity
    v = out["input_Cam013"]
    assert v.depth.shape == v.confidence.shape == v.level.shape == d.shape == (93, 144)
    assert v.camera.K.shape == (3, 3) and v.points().shape == (93, 144, 3)
    assert out.mask(near=1, far=.2).any() and out.render(pose=(.5, 0)).shape == (93, 144, 3)
    out.save("out")
    assert np.array_equal(gg.load("out").disparity, d, equal_nan=True)
    scores = gg.evaluate(out, cotton)
    assert scores["BadPix0.07"] < 15
    truth = gg.synth("planes", views=(5, 5), size=(144, 93)).truth()
    assert gg.evaluate(d, truth)["BadPix0.07"] == scores["BadPix0.07"]
    if gg.config()["meshing"]:
        assert len(out.cloud()) > 100
        out.mesh(method="grid").save("x.glb")


def test_the_lines_of_a_row_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lf = gg.synth("garden", views=(17, 1), size=(93, 61))
    pixels = np.stack(list(lf))
    row = gg.LightField(pixels, s=np.arange(-8, 9), unit="m")
    out = gg.reconstruct(row, disparity=(-1.2, 1.2))
    why = gg.probe(row, u=84, v=50, disparity=(-1.2, 1.2))
    assert why.scores.max() > 0
    gg.encode(row, out, "x.grl")
    assert gg.open("x.grl").shape == row.shape
