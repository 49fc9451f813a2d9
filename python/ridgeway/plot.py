# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""Pictures of maps, graphs and paths with matplotlib, which only this module needs.

    import ridgeway.plot

    ridgeway.plot.floor_plan(roadmap, path, height=1.2).figure.savefig("plan.png")
"""

import numpy as np

from ridgeway import FREE, OCCUPIED


def _heights_of(roadmap, states):
    """Of where a robot may be, metres: of the graph's vertices, without any of all free voxels."""
    if len(roadmap.graph.vertices):
        return roadmap.graph.vertices[:, 2]
    return states.origin[2] + states.voxel_size * (np.nonzero(states.values == FREE)[2] + 0.5)


def floor_plan(roadmap, *paths, height=None, graph=True, axes=None):
    """Draws a roadmap from above, and paths on it, from a disc to a square; returns matplotlib's Axes.

    `paths`: PlanResult, or arrays (N, 3), metres, world. `height`: of the layer whose walls are
    shown, metres; None: the median of the paths', or without any of the graph's vertices'; planar
    maps have one layer. `graph`: draw the sparse graph too. `axes`: to draw on; None: those of a
    new figure.
    """
    import matplotlib.pyplot as plt

    states = roadmap.esdf.states()
    size, low = states.voxel_size, np.array(states.origin)
    ways = [np.reshape(getattr(path, "waypoints", path), (-1, 3)) for path in paths]
    title = roadmap.source or "roadmap"
    if states.values.ndim == 2:
        shown = states.values
    else:
        if height is None:
            heights = np.concatenate([way[:, 2] for way in ways] + [[]])
            height = np.median(heights if len(heights) else _heights_of(roadmap, states))
        layer = int(np.floor((height - low[2]) / size))
        if not 0 <= layer < states.values.shape[2]:
            raise ValueError(f"height: expected metres within the map, got {height}")
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
