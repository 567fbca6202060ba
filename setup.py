# SPDX-License-Identifier: BSD-3-Clause
"""Builds the extension of the Python module with CMake.

GIGARAY_BUILD_DIR: a build folder that is used as it is configured, in place of a new one.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
LEFT_OUT = ["CLI", "TESTS", "BASELINES", "BENCHMARKS", "EXAMPLES"]


def version() -> str:
    found = re.search(r"project\(gigaray VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert found
    return found[1]


class CMakeBuild(build_ext):
    """The one target of CMake that is the extension."""

    def build_extension(self, extension: Extension) -> None:
        stated = os.environ.get("GIGARAY_BUILD_DIR")
        build = pathlib.Path(stated or self.build_temp).resolve()
        if not stated:
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja",
                            "-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}",
                            *(f"-DGIGARAY_{part}=OFF" for part in LEFT_OUT)], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "gigaray_python"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        built = build / "python" / "gigaray" / target.name
        if not built.is_file():
            sys.exit(f"{build} builds the module for another Python than {sys.executable}")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(built, target)
        subprocess.run(["strip", "--strip-unneeded", target], check=True)


setup(version=version(), ext_modules=[Extension("gigaray._gigaray", [])],
      cmdclass={"build_ext": CMakeBuild}, options={"build": {"build_base": "build/wheel"}})
