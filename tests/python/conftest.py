# SPDX-License-Identifier: BSD-3-Clause
import os
import pathlib

import pytest

import gigaray as gg

RANGE = (-1.2, 1.2)


@pytest.fixture(scope="session")
def garden():
    """A row of odd size with its truth."""
    return gg.synth("garden", views=(7, 1), size=(93, 61))


@pytest.fixture(scope="session")
def depth(garden):
    """Depth of all its views."""
    return gg.reconstruct(garden, disparity=RANGE)


@pytest.fixture(scope="session")
def walk():
    """Photographs with posed cameras."""
    return gg.synth("room", views=6, size=(96, 72), path="walk", step=4)


@pytest.fixture(scope="session")
def program():
    """The program gigaray."""
    path = os.environ.get("GIGARAY_PROGRAM", "")
    if not pathlib.Path(path).is_file():
        pytest.skip("built without the program")
    return path
