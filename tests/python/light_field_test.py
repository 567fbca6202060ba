# SPDX-License-Identifier: BSD-3-Clause
"""Light fields of files and of arrays."""

import gc
import sys

import numpy as np
import pytest

import gigaray as gg


def error_of(call):
    with pytest.raises(gg.Error) as caught:
        call()
    assert "\n" not in str(caught.value)
    return caught.value


def test_a_folder_shows_what_it_is(tmp_path):
    written = gg.synth("planes", views=(3, 2), size=(93, 61), folder=tmp_path / "grid")
    lf = gg.open(tmp_path / "grid")
    assert repr(lf) == repr(written)
    assert (lf.kind, lf.shape, len(lf)) == ("4D", (6, 61, 93, 3), 6)
    assert lf.positions.tolist()[0] == [-1, -0.5]
    assert lf.names[0] == "view_00_00" and lf.disparity_range == (-1, 1)
    assert lf[0].shape == (61, 93, 3) and lf[0].dtype == np.uint8
    assert (lf["view_01_02"] == lf[-1]).all()
    assert lf.rig["unit"] == "m" and lf.rig["focal_px"] > 0


def test_rendered_is_what_is_written(tmp_path, garden):
    written = gg.synth("garden", views=(7, 1), size=(93, 61), folder=tmp_path / "garden")
    assert all((a == b).all() for a, b in zip(garden, written))


def test_views_that_are_not_there(garden):
    with pytest.raises(IndexError):
        garden[7]
    with pytest.raises(KeyError):
        garden["nobody"]


def test_epi_is_a_row_of_all_views(garden):
    epi = garden.epi(v=30)
    assert epi.shape == (7, 93, 3)
    assert all((epi[i] == garden[i][30]).all() for i in range(7))
    assert "`v`" in str(error_of(lambda: garden.epi(v=61)))
    assert "one of" in str(error_of(lambda: garden.epi()))


def test_epi_of_a_grid_has_one_row_of_its_views():
    lf = gg.synth("planes", views=(3, 5), size=(93, 61))
    assert (lf.epi(v=7, t=-2)[1] == lf[1][7]).all()
    assert lf.epi(u=9, s=1).shape == (5, 61, 3)
    assert (lf.epi(u=9, s=1)[4] == lf[14][:, 9]).all()


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_arrays_are_taken_with_any_strides_and_not_copied(dtype):
    rng = np.random.default_rng(1)
    pixels = rng.integers(0, 255, (3, 144, 93, 3)).astype(dtype)
    backwards = np.asfortranarray(pixels)[:, ::-1, :, ::-1]
    before = sys.getrefcount(backwards)
    lf = gg.LightField(backwards, s=[0, 1, 2])
    assert all((lf[i] == backwards[i]).all() and lf[i].dtype == dtype for i in range(3))
    backwards[1, 0, 0, 0] ^= 1
    assert (lf[1] == backwards[1]).all()
    assert lf.positions.tolist() == [[-1, 0], [0, 0], [1, 0]]
    del lf
    gc.collect()
    assert sys.getrefcount(backwards) == before


def test_array_outlives_its_name():
    lf = gg.LightField(np.full((2, 20, 20, 3), 7, np.uint8), s=[0, 1])
    gc.collect()
    assert (lf[1] == 7).all()


def test_mistakes_name_the_argument():
    pixels = np.zeros((3, 20, 21, 3), np.uint8)
    for call, word in [
        (lambda: gg.LightField(pixels.astype(float), s=[0, 1, 2]), "`pixels` holds float64"),
        (lambda: gg.LightField(pixels[0], s=[0]), "(20, 21, 3)"),
        (lambda: gg.LightField(pixels[..., :2], s=[0, 1, 2]), "`pixels`"),
        (lambda: gg.LightField(pixels[:1], s=[0]), "`pixels` has 1"),
        (lambda: gg.LightField("pixels"), "`pixels`"),
        (lambda: gg.LightField([pixels[0], pixels[0, 1:]]), "one size"),
        (lambda: gg.LightField(pixels, s=[0, 1]), "`s` has 2"),
        (lambda: gg.LightField(pixels, s=[0, 1, np.nan]), "`s` holds"),
        (lambda: gg.LightField(pixels, s=["a", "b", "c"]), "`s`"),
        (lambda: gg.LightField(pixels, s=[0, 0, 1]), "position"),
        (lambda: gg.LightField(pixels, names=["a"]), "`names`"),
        (lambda: gg.LightField(pixels, names=["a", "a", "b"]), "a"),
        (lambda: gg.LightField(pixels, focal_px=-1), "focal_px"),
        (lambda: gg.open("x", direction="north"), "`direction`"),
        (lambda: gg.open("x", grid=(1, 2, 3)), "`grid`"),
        (lambda: gg.open("x", convention="abc"), "`convention`"),
        (lambda: gg.synth("nowhere"), "nowhere"),
        (lambda: gg.synth("garden", views=1), "views"),
        (lambda: gg.synth("garden", size=(1, 1)), "width"),
        (lambda: gg.synth("garden", path="zigzag"), "`path`"),
    ]:
        error = error_of(call)
        assert error.code == "invalid_argument" and word in str(error), error


def test_files_that_are_not_there_are_bad_input():
    error = error_of(lambda: gg.open("/nowhere"))
    assert error.code == "bad_input" and "/nowhere" in str(error)


def poses_of(walk):
    cameras = [walk.camera(i) for i in range(len(walk))]
    return np.stack([c.c2w for c in cameras]), np.stack([c.K for c in cameras])


def test_poses_come_back_as_they_were_stated(walk):
    c2w, K = poses_of(walk)
    lf = gg.LightField.from_poses(list(walk), c2w, K, convention="opencv")
    assert lf.kind == "unstructured"
    for i in range(len(walk)):
        np.testing.assert_allclose(lf.camera(i).c2w, c2w[i], atol=1e-12)
        np.testing.assert_allclose(lf.camera(i).K, K[i])
    np.testing.assert_allclose(lf.positions, walk.positions)


def test_conventions_differ_in_axes_and_in_the_first_pixel(walk):
    c2w, K = poses_of(walk)
    half = K[0] + [[0, 0, 0.5], [0, 0, 0.5], [0, 0, 0]]
    flipped = c2w @ np.diag([1, -1, -1, 1.0])
    opengl = gg.LightField.from_poses(list(walk), flipped[:, :3], half, convention="opengl")
    colmap = gg.LightField.from_poses(list(walk), c2w, half, convention="colmap")
    for lf in opengl, colmap:
        np.testing.assert_allclose(lf.camera(1).w2c, walk.camera(1).w2c, atol=1e-12)
        np.testing.assert_allclose(lf.camera(1).K, K[1])


def test_mistakes_of_poses_name_the_argument(walk):
    c2w, K = poses_of(walk)
    images = list(walk)
    skewed = K[0] + [[0, 1, 0], [0, 0, 0], [0, 0, 0]]
    for arguments, how, word in [
        ((images, c2w[1:], K), {}, "`c2w`"),
        ((images, c2w, K[1:]), {}, "`K`"),
        ((images, c2w, skewed), {}, "`K`"),
        ((images, c2w * [[1, 1, 1, np.nan]], K), {}, "`c2w`"),
        ((images, c2w * [[1, 2, 1, 1]], K), {}, "`c2w` of view_000"),
        ((images, c2w, K), {"convention": "unity?"}, "`convention`"),
        ((images, c2w, K), {"depth": (2, 1)}, "`depth`"),
    ]:
        error = error_of(
            lambda: gg.LightField.from_poses(*arguments, **{"convention": "opencv", **how}))
        assert error.code == "invalid_argument" and word in str(error), error
