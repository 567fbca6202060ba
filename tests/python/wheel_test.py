# SPDX-License-Identifier: BSD-3-Clause
"""A wheel installs into a fresh environment and runs there."""

import os
import subprocess
import sys

USED = """
import gigaray as gg
lf = gg.synth("planes", views=3, size=(32, 32))
out = gg.reconstruct(lf, views="centre", disparity=(-1.2, 1.2))
assert out.disparity.shape == (32, 32)
print(gg.__file__)
"""


def run(*command, **others):
    done = subprocess.run(command, capture_output=True, text=True, **others)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_wheel_runs_in_a_fresh_environment(tmp_path):
    environment = {**os.environ, "GIGARAY_BUILD_DIR": os.environ["GIGARAY_BUILD"]}
    environment.pop("PYTHONPATH")
    run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index",
        "-w", tmp_path, os.environ["GIGARAY_SOURCE"], env=environment)
    wheels = list(tmp_path.glob("gigaray-*.whl"))
    assert len(wheels) == 1 and "none-any" not in wheels[0].name
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv")
    python = tmp_path / "venv" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", wheels[0], env=environment)
    used = run(python, "-c", USED, cwd=tmp_path, env=environment)
    assert used.strip().startswith(str(tmp_path / "venv"))
