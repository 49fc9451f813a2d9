# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""Pictures of maps, graphs and paths with matplotlib, which only this module needs.

    import ridgeway.plot

    ridgeway.plot.floor_plan(roadmap, path, height=1.2).figure.savefig("plan.png")
"""

from typing import Any, Iterator, Optional

import numpy as np

from ridgeway import FREE, OCCUPIED, Alternatives, Grid, InputError, PlanResult, Roadmap, Trajectory


def _ways_of(path: Any) -> Iterator[np.ndarray]:
    """The waypoints of a path, or of several."""
    if isinstance(path, Alternatives) or isinstance(path, (list, tuple)) and any(
        isinstance(one, PlanResult) for one in path
    ):
        for one in path:
            yield from _ways_of(one)
        return
    if isinstance(path, Trajectory):
        path = path.sample(0.05).position
    points = np.asarray(getattr(path, "waypoints", path), dtype=float)
    if points.size % 3 or points.ndim not in (1, 2):
        raise InputError(f"paths: expected PlanResult, Trajectory or points (N, 3), got {type(path).__name__}")
    yield points.reshape(-1, 3)


def _heights_of(roadmap: Roadmap, states: Grid) -> np.ndarray:
    """Of where a robot may be, metres: of the graph's vertices, without any of all free voxels."""
    if len(roadmap.graph.vertices):
        return roadmap.graph.vertices[:, 2]
    return states.origin[2] + states.voxel_size * (np.nonzero(states.values == FREE)[2] + 0.5)


def floor_plan(
    roadmap: Roadmap,
    *paths: Any,
    height: Optional[float] = None,
    graph: bool = True,
    axes: Any = None,
) -> Any:
    """Draws a roadmap from above, and paths on it, from a disc to a square; returns matplotlib's Axes.

    `paths`: PlanResult, Alternatives, Trajectory, or arrays (N, 3), metres, world. `height`: of the layer whose walls are
    shown, metres; None: the median of the paths', or without any of the graph's vertices'; planar
    maps have one layer. `graph`: draw the sparse graph too. `axes`: to draw on; None: those of a
    new figure.
    """
    import matplotlib.pyplot as plt

    states = roadmap.esdf.states()
    size, low = states.voxel_size, np.array(states.origin)
    ways = [way for path in paths for way in _ways_of(path)]
    title = roadmap.source or "roadmap"
    if states.values.ndim == 2:
        shown = states.values
    else:
        if height is None:
            heights = np.concatenate([way[:, 2] for way in ways] + [[]])
            height = np.median(heights if len(heights) else _heights_of(roadmap, states))
        layer = int(np.floor((height - low[2]) / size))
        if not 0 <= layer < states.values.shape[2]:
            top = low[2] + size * states.values.shape[2]
            raise InputError(
                f"height: is {height} (give metres within the map, {low[2]:.2f} to {top:.2f})"
            )
        shown = states.values[:, :, layer]
        title += f" at {low[2] + size * (layer + 0.5):.2f} m"
    # Unknown pale, free white, obstacles dark.
    shades = np.full(shown.shape + (3,), 0.85)
    shades[shown == FREE] = 1.0
    shades[shown == OCCUPIED] = 0.25
    high = low[:2] + size * np.array(shown.shape)
    if axes is None:
        wide, deep = high - low[:2]
        _, axes = plt.subplots(figsize=(9, np.clip(9 * deep / wide + 0.8, 3, 12)), layout="constrained")
    axes.imshow(
        shades.transpose(1, 0, 2), origin="lower", extent=(low[0], high[0], low[1], high[1])
    )
    if graph and len(roadmap.graph.edges):
        from matplotlib.collections import LineCollection

        ends = roadmap.graph.vertices[:, :2][roadmap.graph.edges]
        axes.add_collection(LineCollection(ends, colors="tab:blue", linewidths=0.8, zorder=2))
    for number, points in enumerate(ways):
        if len(points):
            length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
            axes.plot(
                points[:, 0], points[:, 1], color=f"C{number + 3}", label=f"{length:.1f} m", zorder=3
            )
            axes.plot(*points[0, :2], "o", color=f"C{number + 3}", zorder=4)
            axes.plot(*points[-1, :2], "s", color=f"C{number + 3}", zorder=4)
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_xlabel("x, metres")
    axes.set_ylabel("y, metres")
    axes.set_title(title)
    return axes
