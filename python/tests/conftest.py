# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""What the tests share: a small world that is drawn by hand, and a real map."""

import os
import pathlib

import numpy as np
import pytest

import ridgeway

SOURCE = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def source():
    return SOURCE


@pytest.fixture(scope="session")
def program():
    """The command line of the same build."""
    return os.environ.get("RIDGEWAY_PROGRAM", str(SOURCE / "build/bin/ridgeway"))


@pytest.fixture(scope="session")
def real_file():
    return SOURCE / "data/fr_079.bt"


@pytest.fixture(scope="session")
def real(real_file):
    return ridgeway.build(real_file, min_clearance=0.3)


def two_rooms():
    """Two rooms of 3 x 4 x 2 m and a wall between them with a doorway 0.8 m wide, 0.1 m voxels."""
    states = np.full((64, 44, 24), ridgeway.OCCUPIED)
    states[2:62, 2:42, 2:22] = ridgeway.FREE
    states[31:33] = ridgeway.OCCUPIED
    states[31:33, 18:26, 2:22] = ridgeway.FREE
    return states


@pytest.fixture()
def rooms():
    return two_rooms()


@pytest.fixture(scope="session")
def roadmap():
    return ridgeway.build(ridgeway.OccupancyMap.from_numpy(two_rooms(), 0.1), min_clearance=0.25)


START, GOAL = (0.8, 0.8, 1.0), (5.6, 3.4, 1.2)
