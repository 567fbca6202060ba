# SPDX-License-Identifier: BSD-3-Clause
"""Types that are stated are those that there are."""

import importlib.util
import os
import pathlib
import subprocess
import sys

import pytest

import gigaray as gg

# Classes of pybind11 have a metaclass of its own, which no stub states.
CLASSES = ["Camera", "LightField", "PointCloud", "Result", "Surface"]

if importlib.util.find_spec("mypy") is None:
    pytest.fail("missing package mypy", pytrace=False)

with_meshing = pytest.mark.skipif(not gg.config()["meshing"], reason="types are of all there can be")


def run(folder, *command):
    done = subprocess.run([sys.executable, *command], capture_output=True, text=True, cwd=folder,
                          env={**os.environ, "MYPYPATH": os.environ["PYTHONPATH"],
                               "MYPY_CACHE_DIR": str(folder)})
    assert done.returncode == 0, done.stdout + done.stderr


@with_meshing
def test_stubs_of_the_extension_hold(tmp_path):
    known = tmp_path / "known"
    known.write_text("".join(f"gigaray._gigaray.{name}\n" for name in CLASSES))
    run(tmp_path, "-m", "mypy.stubtest", "gigaray._gigaray", "--allowlist", known)


@with_meshing
def test_stubs_are_those_that_stubgen_writes(tmp_path):
    source = pathlib.Path(os.environ["GIGARAY_SOURCE"])
    run(tmp_path, source / "scripts" / "python_stubs.py", tmp_path)
    stored = source / "python" / "gigaray" / "_gigaray.pyi"
    assert (tmp_path / "_gigaray.pyi").read_text() == stored.read_text()


def test_types_of_the_package_agree(tmp_path):
    run(tmp_path, "-m", "mypy", "-p", "gigaray")
