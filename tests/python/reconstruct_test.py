# SPDX-License-Identifier: BSD-3-Clause
"""Depth: maps without a copy, the same bits from everywhere."""

import pickle
import subprocess
import threading

import numpy as np
import pytest

import gigaray as gg

from conftest import RANGE


def same(a, b):
    return np.array_equal(a, b, equal_nan=True)


def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline().strip() == b"Pf"
        width, height = map(int, file.readline().split())
        assert float(file.readline()) < 0
        return np.frombuffer(file.read(), "<f4").reshape(height, width)[::-1]


def test_disparity_is_near_the_truth(garden, depth):
    error = np.abs(depth.disparity - garden.truth())
    assert np.nanmedian(error) < 0.03
    assert len(depth) == 7 and depth.views == garden.names


def test_maps_look_into_the_library(depth):
    view = depth["view_002"]
    for array in view.disparity, view.confidence, view.level, view.depth:
        assert array.shape == (61, 93) and not array.flags.owndata
        assert type(array.base).__name__ == "PyCapsule"
    assert view.disparity.dtype == np.float32 and view.level.dtype == np.int8
    assert (0 <= view.confidence).all() and (view.confidence <= 1).all()


def test_maps_outlive_their_result(garden):
    maps = gg.reconstruct(garden, views=[2], disparity=RANGE)[2].disparity
    again = gg.reconstruct(garden, views="view_002", disparity=RANGE)[2].disparity
    assert same(maps, again)


def test_arrays_give_the_bits_of_files(tmp_path):
    written = gg.synth("planes", views=(5, 1), size=(93, 61), folder=tmp_path / "planes")
    rig = written.rig
    pixels = np.stack(list(written))
    lf = gg.LightField(pixels, s=range(5), focal_px=rig["focal_px"], baseline=rig["baseline"],
                       focus_distance=rig["focus_distance"], unit="m")
    a = gg.reconstruct(written, disparity=RANGE)
    b = gg.reconstruct(lf, disparity=RANGE)
    for i in range(5):
        assert same(a[i].disparity, b[i].disparity) and same(a[i].confidence, b[i].confidence)
        assert same(a[i].level, b[i].level) and same(a[i].depth, b[i].depth)


def test_posed_arrays_give_the_bits_of_the_scene(walk):
    cameras = [walk.camera(i) for i in range(len(walk))]
    lf = gg.LightField.from_poses(list(walk), [c.c2w for c in cameras], [c.K for c in cameras],
                                  convention="opencv", unit="m")
    a = gg.reconstruct(walk, views="centre", disparity=(0.2, 1.1))
    b = gg.reconstruct(lf, views="centre", disparity=(0.2, 1.1))
    np.testing.assert_allclose(a.depth, b.depth, rtol=1e-4)
    error = np.abs(a.top.depth * walk.truth() - 1)
    assert np.nanmedian(error) < 0.02
    with pytest.raises(gg.Error, match="inverse_depth"):
        a.disparity


def test_program_gives_the_same_bits(tmp_path, program):
    lf = gg.synth("planes", views=(5, 1), size=(93, 61), folder=tmp_path / "planes")
    out = gg.reconstruct(lf)
    subprocess.run([program, "depth", tmp_path / "planes", "-o", tmp_path / "out"], check=True,
                   capture_output=True)
    for view in out:
        assert same(view.disparity, read_pfm(tmp_path / "out" / view.name / "disparity.pfm"))
        assert same(view.confidence, read_pfm(tmp_path / "out" / view.name / "confidence.pfm"))


def test_memory_changes_no_bit(garden, depth):
    out = gg.reconstruct(garden, disparity=RANGE, memory="600MiB")
    assert all(same(a.disparity, b.disparity) for a, b in zip(out, depth))


def test_depth_follows_from_disparity(garden, depth):
    rig = garden.rig
    fb = rig["focal_px"] * rig["baseline"]
    expected = fb / (depth.disparity + fb / rig["focus_distance"])
    np.testing.assert_allclose(depth.depth, expected, rtol=1e-5)


def test_points_are_seen_where_they_were_found(depth):
    view = depth[5]
    points = view.points()
    inside = points[np.isfinite(points[..., 0])]
    camera = view.camera
    seen = (camera.w2c[:3, :3] @ inside.T).T + camera.w2c[:3, 3]
    pixels = (camera.K @ seen.T).T
    v, u = np.nonzero(np.isfinite(points[..., 0]))
    np.testing.assert_allclose(pixels[:, 0] / pixels[:, 2], u, atol=1e-9)
    np.testing.assert_allclose(pixels[:, 1] / pixels[:, 2], v, atol=1e-9)
    np.testing.assert_allclose(seen[:, 2], view.depth[v, u], rtol=1e-5)


def test_depth_of_an_unknown_rig_is_an_error(garden):
    out = gg.reconstruct(gg.LightField(list(garden), s=range(7)), views="centre", disparity=RANGE)
    with pytest.raises(gg.Error, match="focal_px"):
        out.depth
    assert np.isfinite(out.top.points()).any()


def test_views_without_depth(garden):
    out = gg.reconstruct(garden, views=[1, "view_004"], disparity=RANGE)
    assert out.views == ["view_001", "view_004"] and out.top.name == "view_004"
    with pytest.raises(IndexError, match="view_002"):
        out[2]


@pytest.mark.parametrize("arguments, code, word", [
    ({"views": "nobody"}, "invalid_argument", "nobody"),
    ({"views": []}, "invalid_argument", "`views`"),
    ({"disparity": 3}, "invalid_argument", "`disparity`"),
    ({"disparity": ("a", "b")}, "invalid_argument", "`disparity`"),
    ({"disparity": (2, 1)}, "invalid_argument", "range"),
    ({"disparity": (0, 1), "depth": (1, 2)}, "invalid_argument", "`depth`"),
    ({"preset": "best"}, "invalid_argument", "best"),
    ({"backend": "cuda"}, "invalid_argument", "cuda"),
    ({"device": "abacus"}, "device", "abacus"),
    ({"memory": "2 apples"}, "invalid_argument", "`memory`"),
    ({"memory": -1}, "invalid_argument", "`memory`"),
    ({"memory": 0.001}, "out_of_memory", "MiB"),
    ({"winner__colour": 3}, "invalid_argument", "winner.colour"),
])
def test_mistakes_are_errors_of_one_line(garden, arguments, code, word):
    with pytest.raises(gg.Error) as caught:
        gg.reconstruct(garden, **arguments)
    assert caught.value.code == code and word in str(caught.value)
    assert "\n" not in str(caught.value)
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.code) == (str(caught.value), code)


def test_threads_may_call_at_once(garden, depth):
    results = {}

    def work(i):
        results[i] = gg.reconstruct(garden, views=[i], disparity=RANGE)[i].disparity

    threads = [threading.Thread(target=work, args=(i,)) for i in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for i in range(3):
        alone = gg.reconstruct(garden, views=[i], disparity=RANGE)[i].disparity
        assert same(results[i], alone)


def test_options_by_name(garden):
    views = {"views": "centre", "disparity": RANGE}
    plain = gg.reconstruct(garden, **views).disparity
    a = gg.reconstruct(garden, **views, winner__median_radius=3, hypotheses=40).disparity
    b = gg.reconstruct(garden, **views, options={"winner.median_radius": 3, "hypotheses": 40})
    assert same(a, b.disparity) and not same(a, plain)
    numpy_numbers = {"winner.median_radius": np.int64(3), "hypotheses": np.float32(40)}
    assert same(a, gg.reconstruct(garden, **views, options=numpy_numbers).disparity)
    for name, value in [("winner.median_radius", 99), ("winner.median_radius", "wide"),
                        ("winner.median_radius", [1, 2]), ("score.gradient", 7),
                        ("winner.median_radius", object())]:
        with pytest.raises(gg.Error, match="median_radius|gradient") as caught:
            gg.reconstruct(garden, **views, options={name: value})
        assert caught.value.code == "invalid_argument"
