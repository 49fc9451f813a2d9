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
    """(nx, ny, nz), or (nx, ny) of a planar map; a copy."""
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


class TrajectorySamples(NamedTuple):
    """A trajectory at N times."""

    time: np.ndarray
    """(N,), seconds from the start; of one time (`at`) alone this and the others have no N."""
    position: np.ndarray
    """(N, 3), metres, world frame."""
    velocity: np.ndarray
    """(N, 3), metres a second."""
    acceleration: np.ndarray
    """(N, 3), metres a second^2."""
    yaw: np.ndarray
    """(N,), radians, never jumps."""
    yaw_rate: np.ndarray
    """(N,), radians a second."""


class Surface(NamedTuple):
    """A surface as triangles, their fronts towards free space."""

    vertices: np.ndarray
    """(N, 3), metres, world frame."""
    normals: np.ndarray
    """(N, 3), of length one, towards free space."""
    triangles: np.ndarray
    """(M, 3) uint32: places in `vertices`."""
