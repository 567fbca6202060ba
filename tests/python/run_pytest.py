# SPDX-License-Identifier: BSD-3-Clause
"""Runs tests with pytest, or says which package is missing."""

import importlib.util
import sys

PACKAGES = {"numpy": "python3-numpy", "pytest": "python3-pytest"}

missing = [package for name, package in PACKAGES.items() if importlib.util.find_spec(name) is None]
if missing:
    sys.exit(f"tests of the Python module: missing package {', '.join(missing)}")

import pytest  # noqa: E402

sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", "--durations=5", *sys.argv[1:]]))
