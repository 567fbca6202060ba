# SPDX-License-Identifier: BSD-3-Clause
"""What is made of depth."""

import json

import numpy as np
import pytest

import gigaray as gg

from conftest import RANGE


def same(a, b):
    return np.array_equal(a, b, equal_nan=True)


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """A folder, its light field, and depth."""
    folder = tmp_path_factory.mktemp("scene") / "planes"
    lf = gg.synth("planes", views=(5, 1), size=(144, 93), folder=folder)
    return folder, lf, gg.reconstruct(lf, disparity=RANGE)


def test_saved_and_loaded_again(scene, tmp_path):
    _, lf, out = scene
    out.save(tmp_path / "out", formats=["npy"])
    again = gg.load(tmp_path / "out")
    assert again.views == out.views and again.top.name == out.top.name
    for a, b in zip(out, again):
        assert same(a.disparity, b.disparity) and same(a.confidence, b.confidence)
        assert same(a.depth, b.depth) and same(a.camera.K, b.camera.K)
        assert (a.picture == b.picture).all()
    assert same(np.load(tmp_path / "out" / "disparity.npy"), out.disparity)
    assert json.loads((tmp_path / "out" / "gigaray.json").read_text())["format"] == "gigaray depth"
    sure = gg.load(tmp_path / "out", min_confidence=0.9)
    assert (np.isnan(sure.disparity) == ~(out.confidence >= 0.9)).all()
    with pytest.raises(gg.Error, match="already"):
        again.save(tmp_path / "more")


def test_nothing_of_others_is_replaced(scene, tmp_path):
    _, _, out = scene
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("keep")
    with pytest.raises(gg.Error) as caught:
        out.save(tmp_path / "mine")
    assert "mine" in str(caught.value)
    assert (tmp_path / "mine" / "notes.txt").read_text() == "keep"


def test_arrays_are_saved_too_and_maps_need_no_pictures(garden, depth, tmp_path):
    lf = gg.LightField(list(garden), s=range(7))
    out = gg.reconstruct(lf, disparity=RANGE, views="centre")
    out.save(tmp_path / "out")
    again = gg.load(tmp_path / "out")
    assert same(again.disparity, out.disparity)
    with pytest.raises(gg.Error) as caught:
        again.render((0, 0))
    assert "\n" not in str(caught.value)


def test_scores_against_arrays_scenes_and_folders(scene, tmp_path):
    folder, lf, out = scene
    rendered = gg.synth("planes", views=(5, 1), size=(144, 93))
    scores = gg.evaluate(out, folder)
    assert 0 <= scores["BadPix0.07"] < 40 and scores["filled"] == 100
    assert gg.evaluate(out, rendered)["BadPix0.07"] == scores["BadPix0.07"]
    assert gg.evaluate(out.disparity, rendered.truth())["MSEx100"] == scores["MSEx100"]
    perfect = gg.evaluate(rendered.truth(), rendered.truth(), metrics=["hci", "middlebury"])
    assert perfect["BadPix0.01"] == 0 and len(perfect) > len(scores)
    out.save(tmp_path / "out")
    of_files = gg.evaluate(tmp_path / "out", folder)
    assert of_files["BadPix0.07"] == scores["BadPix0.07"]
    each = gg.evaluate(out, folder, views="all")
    assert set(each) == set(out.views)
    assert each["view_002"]["BadPix0.07"] == scores["BadPix0.07"]
    assert each["view_004"] == gg.evaluate(out, rendered, views="all")["view_004"]


def test_mistakes_of_scores(garden, depth):
    with pytest.raises(gg.Error) as caught:
        gg.evaluate(depth.disparity, np.zeros((5, 5), np.float32))
    assert caught.value.code == "bad_input"
    with pytest.raises(gg.Error, match="metrics"):
        gg.evaluate(depth, garden, metrics="best")
    with pytest.raises(gg.Error, match="`estimate`"):
        gg.evaluate(np.zeros(3), np.zeros((5, 5)))
    with pytest.raises(gg.Error) as caught:
        gg.evaluate(depth, "/nowhere")
    assert "/nowhere" in str(caught.value)


def test_depth_of_photographs_is_scored(walk):
    out = gg.reconstruct(walk, views="centre", disparity=(0.2, 1.1))
    assert gg.evaluate(out, walk)["within 5 %"] > 50


def test_probe_says_why(garden, depth):
    found = gg.probe(garden, u=40, v=30, disparity=RANGE, decided=True)
    assert found.scores.shape == found.hypotheses.shape
    assert abs(found.hypotheses[0] + 1.2) < 1e-6 and found.view == 3
    assert found.samples.shape == (7, 3)
    assert abs(found.samples[3] * 255 - garden[3][30, 40]).max() < 0.51
    assert found.decision["level"] == depth.top.level[30, 40]
    with pytest.raises(gg.Error):
        gg.probe(garden, u=93, v=0, disparity=RANGE)


def test_encoded_is_lossless(scene, tmp_path):
    _, lf, out = scene
    report = gg.encode(lf, out, tmp_path / "x.grl")
    assert report["file_bytes"] == (tmp_path / "x.grl").stat().st_size < report["rgb_bytes"]
    again = gg.open(tmp_path / "x.grl")
    assert all((a == b).all() for a, b in zip(lf, again))
    assert gg.load(tmp_path / "x.grl").disparity.shape == out.disparity.shape
    with pytest.raises(gg.Error, match="all views"):
        gg.encode(lf, gg.reconstruct(lf, views="centre", disparity=RANGE), tmp_path / "y.grl")


def test_masks_are_intervals_of_disparity_and_depth(garden, depth):
    mask = depth.mask(near=1, far=0.2)
    assert mask.dtype == bool and not mask.flags.owndata
    assert (mask == ((depth.disparity >= 0.2) & (depth.disparity <= 1))).all()
    z = depth.depth
    assert (depth.mask(near=1.0, far=1.5) == ((z >= 1) & (z <= 1.5))).mean() > 0.999
    assert depth.mask(at=(40, 30))[30, 40]
    assert len(depth.masks(near=1, far=0.2)) == 7
    soft = depth.mask(near=1, far=0.2, soft=True)
    assert soft.dtype == np.float32 and 0 <= soft.min() and soft.max() <= 1
    with pytest.raises(gg.Error, match="`near`"):
        depth.mask(near=1)


def test_rendered_is_near_the_picture_of_a_view(scene):
    _, lf, out = scene
    picture, inverse, seen = out.render((0, 0), maps=True)
    assert picture.dtype == np.uint8 and picture.shape == lf[2].shape and seen.mean() > 0.95
    assert np.abs(picture.astype(float) - lf[2])[seen].mean() < 3
    assert (out.render("centre") == picture).all()
    assert (out.render(out.top.camera) == picture).all()
    assert out.render((0.5, 0)).shape == picture.shape
    assert out.refocus(0.3).shape == picture.shape
    with pytest.raises(gg.Error):
        out.render("nobody")
    with pytest.raises(gg.Error, match="`pose`"):
        out.render((1, 2, 3))


def test_cloud_and_surface(scene, tmp_path):
    if not gg.config()["meshing"]:
        pytest.skip("built without meshing")
    _, _, out = scene
    cloud = out.cloud()
    assert cloud.positions.shape == cloud.normals.shape == cloud.colours.shape == (len(cloud), 3)
    assert cloud.colours.dtype == np.uint8 and len(cloud) > 1000 and len(cloud.supports) == len(cloud)
    np.testing.assert_allclose(np.linalg.norm(cloud.normals, axis=1), 1, atol=1e-3)
    z = cloud.positions[:, 2] + cloud.origin[2]
    assert np.nanmin(out.depth) * 0.9 < z.min() and z.max() < np.nanmax(out.depth) * 1.1
    cloud.save(tmp_path / "x.ply")
    assert (tmp_path / "x.ply").read_bytes().startswith(b"ply")
    mesh = out.mesh(method="grid")
    assert mesh.faces.max() < len(mesh) and mesh.faces.shape[1] == 3
    mesh.save(tmp_path / "x.glb")
    assert (tmp_path / "x.glb").read_bytes().startswith(b"glTF")
    with pytest.raises(gg.Error):
        mesh.save(tmp_path / "x.doc")
    with pytest.raises(gg.Error, match="`method`"):
        out.mesh(method="best")


def test_the_page_shows_the_result(scene, tmp_path):
    folder, _, out = scene
    page = out.view(title="planes", views=[0, 2], truth=folder)
    start = page.html.index('<script type="application/json" id="gigaray-scene">')
    text = page.html[page.html.index(">", start) + 1:page.html.index("</script>", start)]
    shown = json.loads(text)
    assert [view["maps"] is not None for view in shown["views"]] == [True, False, True, False, False]
    assert shown["views"][2]["maps"]["error"] in page.html
    assert page._repr_html_().startswith("<iframe srcdoc=")
    page.save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text() == page.html
    with pytest.raises(gg.Error, match="nothing"):
        out.view(truth=tmp_path / "nothing")


def test_arrays_of_a_cloud_outlive_it(scene):
    _, _, out = scene
    positions = out.cloud().positions
    assert same(positions, out.cloud().positions)


def test_colours_are_those_of_depth_pictures():
    colormap = gg.colours()
    if isinstance(colormap, np.ndarray):
        assert colormap.shape == (256, 3)
        return
    red, green, blue, _ = colormap(1.0)
    assert red > blue and colormap(0.1)[2] > colormap(0.1)[0]
    assert colormap(np.ma.masked_invalid([np.nan]))[0].tolist() == [0, 0, 0, 1]
