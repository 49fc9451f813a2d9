# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""From a 3D map to a route.

    import ridgeway

    roadmap = ridgeway.build("office.bt", min_clearance=0.3)
    path = roadmap.plan((1.3, -2.8, 1.2), (26.0, -0.1, 1.3))
    if path:
        print(path.length, path.waypoints)  # metres; (N, 3)

Lengths are metres, angles radians, points (x, y, z) in the world's frame, z up. Arrays of voxels
are indexed [x, y, z]. What is wrong with an argument is said by InputError (a ValueError) or
TypeError; that there is no route is an answer (`path.status`, `path.reason`), no error.
"""

import os as _os

from ridgeway import _core
from ridgeway._core import *  # noqa: F401,F403
from ridgeway._core import __version__
from ridgeway._values import (
    FREE,
    OCCUPIED,
    UNKNOWN,
    Cancelled,
    Grid,
    InputError,
    Surface,
    TrajectorySamples,
)

__all__ = [name for name in vars(_core) if not name.startswith("_")]
__all__ += ["FREE", "OCCUPIED", "UNKNOWN", "Grid", "Surface", "TrajectorySamples", "__version__"]

# The program that reads meshes lies beside the package, but where it is Debian's.
_reader = _os.path.join(_os.path.dirname(__file__), "ridgeway-mesh-reader")
if _os.access(_reader, _os.X_OK):
    _os.environ.setdefault("RIDGEWAY_MESH_READER", _reader)
del _reader
