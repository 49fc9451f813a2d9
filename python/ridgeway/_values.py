# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""Small types that are plain Python."""

from typing import NamedTuple, Tuple

import numpy as np


class InputError(ValueError):
    """Something that was handed in is bad.

    `where`: the argument or the file that is; `problem`: what is wrong with it; `remedy`: what to
    do about it. The message has all three.
    """

    where: str = ""
    problem: str = ""
    remedy: str = ""


class Cancelled(RuntimeError):
    """A progress function returned False. What was asked for was not done, nothing was changed."""


class Grid(NamedTuple):
    """Values of a full box of voxels, in the order that `OccupancyMap.from_numpy` takes them."""

    values: np.ndarray
    """(nx, ny, nz), a copy."""
    voxel_size: float
    """Metres."""
    origin: Tuple[float, float, float]
    """Low corner of the voxel [0, 0, 0], metres, world frame."""


UNKNOWN = np.uint8(0)
"""State of a voxel of which nothing is known."""
FREE = np.uint8(1)
"""State of a voxel that is known to be free."""
OCCUPIED = np.uint8(2)
"""State of a voxel that is known to be occupied."""
