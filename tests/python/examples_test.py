# SPDX-License-Identifier: BSD-3-Clause
"""The examples run."""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys

import pytest

FOLDER = pathlib.Path(os.environ["GIGARAY_SOURCE"]) / "examples" / "python"


def output_of(name, *arguments):
    done = subprocess.run([sys.executable, FOLDER / name, *arguments], capture_output=True,
                          text=True, cwd=arguments[0] if arguments else None)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_garden_draws_its_pictures(tmp_path):
    if importlib.util.find_spec("matplotlib") is None:
        pytest.fail("missing package python3-matplotlib")
    text = output_of("garden.py", tmp_path)
    bad = float(re.search(r"([0-9.]+) % of the pixels", text)[1])
    assert bad < 35
    assert {"garden.png", "between.png"} <= {file.name for file in tmp_path.iterdir()}


def test_hci_scene_is_scored():
    text = output_of("hci_scene.py")
    assert "4D, 25 views" in text
    assert float(re.search(r"BadPix0.07 +([0-9.]+)", text)[1]) < 15
