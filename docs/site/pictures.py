#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""Makes the pictures of docs/concepts.md, docs/parameters.md and docs/tutorials again, in docs/images.

    PYTHONPATH=build/python python3 docs/site/pictures.py [NAME...]
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import warnings

import matplotlib
import numpy as np
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import ridgeway
import ridgeway.plot

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs/images"
HEIGHT = 1.25
START, GOAL = (1.0, 1.0, HEIGHT), (14.0, 9.0, 3.5)


def house(voxel_size=0.1):
    return ridgeway.load_map(ROOT / "worlds/house.yaml", voxel_size=voxel_size)


def panels(count, ratio):
    """Axes side by side; `ratio`: height over width of what each shows."""
    width = 10.0 / count
    figure, axes = plt.subplots(1, count, figsize=(10, width * ratio + 0.55), layout="constrained")
    return figure, list(np.atleast_1d(axes))


def walls(axes, roadmap, title, height=HEIGHT, graph=False, paths=()):
    ridgeway.plot.floor_plan(roadmap, *paths, height=height, graph=graph, axes=axes)
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("")
    axes.set_ylabel("")
    axes.set_xticks([])
    axes.set_yticks([])


def shrink(picture, name, width=None):
    """Few colours: a quarter of the bytes."""
    image = Image.open(picture).convert("RGB")
    if width and image.width > width:
        image = image.resize((width, image.height * width // image.width), Image.LANCZOS)
    image.quantize(96).save(IMAGES / f"{name}.png", optimize=True)


def save(figure, name):
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        figure.savefig(file.name, dpi=110)
        shrink(file.name, name)
    plt.close(figure)


def concepts_distances():
    roadmap = ridgeway.build(house(), min_clearance=0.4)
    figure, (left, right) = panels(2, 0.68)
    walls(left, roadmap, "the map: a layer of voxels at 1.25 m")
    grid = roadmap.esdf.distances(bounds=((0, 0, 1.2), (15, 10, 1.3)))
    walls(right, roadmap, "distances to the nearest obstacle, metres")
    values = np.where(grid.values[:, :, 0] > 0, grid.values[:, :, 0], np.nan)
    low = grid.origin
    shown = right.imshow(values.T, origin="lower", cmap="viridis",
                         extent=(low[0], low[0] + 0.1 * values.shape[0], low[1], low[1] + 0.1 * values.shape[1]))
    figure.colorbar(shown, ax=right, shrink=0.8)
    save(figure, "concepts_distances")


def concepts_ridges():
    roadmap = ridgeway.build(house(), min_clearance=0.4)
    esdf = roadmap.esdf
    ridges = ridgeway.compute_gvd(esdf, ridgeway.traversable_voxels(esdf, 0.4)).points
    ridges = ridges[np.abs(ridges[:, 2] - HEIGHT) < 0.06]
    figure, (left, right) = panels(2, 0.68)
    walls(left, roadmap, "ridges of the distances (GVD), in this layer")
    left.scatter(ridges[:, 0], ridges[:, 1], s=2, c="tab:orange", linewidths=0)
    walls(right, roadmap, "the diagram, at all heights")
    points = roadmap.diagram.points
    right.scatter(points[:, 0], points[:, 1], s=2.5, c="tab:red", linewidths=0)
    save(figure, "concepts_ridges")


def concepts_routes():
    roadmap = ridgeway.build(house(), min_clearance=0.4)
    routes = roadmap.alternatives(START, (14.2, 6.0, HEIGHT), 2)
    figure, (left, right) = panels(2, 0.68)
    walls(left, roadmap, f"the graph: {len(roadmap.graph.vertices)} vertices, {len(roadmap.graph.edges)} edges",
          graph=True)
    vertices = roadmap.graph.vertices
    left.scatter(vertices[:, 0], vertices[:, 1], s=10, c="tab:blue", zorder=3)
    walls(right, roadmap, "paths: two routes between the same places",
          paths=[routes[i] for i in range(len(routes))])
    save(figure, "concepts_routes")


def concepts_unknown():
    fusion = ridgeway.TsdfFusion(voxel_size=0.1)
    recording = ridgeway.open_sequence(ROOT / "data/house_depth")
    for number in (0, 2, 5, 7, 11, 13):
        image, pose = recording[number]
        fusion.integrate_depth(image, recording.camera, pose)
    seen = fusion.map().occupancy()
    figure, axes = panels(3, 0.72)
    for axis, policy in zip(axes, ("obstacle", "ignore", "free")):
        roadmap = ridgeway.build(seen, min_clearance=0.3, unknown=policy)
        walls(axis, roadmap, f"--unknown {policy}: {len(roadmap.graph.edges)} edges", graph=True)
    save(figure, "concepts_unknown")


def over(name, label, values, make, ratio=0.68, height=HEIGHT):
    """One panel a value of a parameter."""
    figure, axes = panels(len(values), ratio)
    for axis, value in zip(axes, values):
        roadmap = make(value)
        walls(axis, roadmap, f"{label} {value}: {len(roadmap.graph.vertices)} vertices, {len(roadmap.graph.edges)} edges",
              height, graph=True)
    save(figure, name)


def parameters_min_clearance():
    over("parameters_min_clearance", "--min-clearance", (0.3, 0.5, 0.7),
         lambda value: ridgeway.build(house(), min_clearance=value))


def parameters_voxel_size():
    over("parameters_voxel_size", "--voxel-size", (0.1, 0.2, 0.3),
         lambda value: ridgeway.build(house(value), min_clearance=0.4))


def scan(**config):
    return ridgeway.build(ROOT / "data/fr_079.bt", bounds=((-6, -9, -1), (14, 9, 4)), min_clearance=0.3, **config)


def parameters_significance():
    over("parameters_significance", "--significance", (0.1, 0.35, 1.0),
         lambda value: scan(significance=value), ratio=0.9, height=1.0)


def parameters_graph():
    over("parameters_graph", "--graph", ("fitted", "simple"),
         lambda value: scan(simplify=value == "simple"), ratio=0.9, height=1.0)


def parameters_prefer_clearance():
    roadmap = ridgeway.build(house(), min_clearance=0.3)
    figure, axes = panels(3, 0.68)
    for axis, value in zip(axes, (0, 1, 10)):
        path = roadmap.plan(START, GOAL, prefer_clearance=value)
        walls(axis, roadmap, f"--prefer-clearance {value}", paths=[path])
    save(figure, "parameters_prefer_clearance")


def by_program(name, *commands):
    """What commands of the program write to picture.png."""
    program = os.environ.get("RIDGEWAY_PROGRAM", ROOT / "build/bin/ridgeway")
    with tempfile.TemporaryDirectory() as folder:
        for command in commands:
            subprocess.run([program, "--quiet", *command.replace("DATA", str(ROOT / "data")).split()], cwd=folder,
                           check=True, stdout=subprocess.DEVNULL)
        shrink(pathlib.Path(folder) / "picture.png", name, width=1000)


def tutorial_mesh():
    by_program("tutorial_mesh", "build DATA/levine.stl -o a.ridge --min-clearance 0.3",
               "plan a.ridge --from -1.3,0.5,1.2 --to 11.5,26,1.2 -o path.json",
               "export a.ridge --picture picture.png --path path.json")


def tutorial_depth_camera():
    by_program("tutorial_depth_camera", "fuse DATA/house_depth -o f.ridge",
               "build f.ridge -o a.ridge --min-clearance 0.3 --unknown ignore",
               "plan a.ridge --from 1,1,1.5 --to 9,6.5,1.5 -o path.json",
               "export a.ridge --picture picture.png --path path.json")


def tutorial_simulation():
    page = (ROOT / "docs/tutorials/simulation.md").read_text()
    world = page.split("cat > room.yaml <<'END'\n")[1].split("END\n")[0]
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(world)
        file.flush()
        by_program("tutorial_simulation", f"explore {file.name} -o a.ridge --start 1,1,1 --picture picture.png")


MADE = {name: make for name, make in globals().items()
        if name.startswith(("concepts_", "parameters_", "tutorial_"))}

if __name__ == "__main__":
    warnings.simplefilter("ignore")
    for name in sys.argv[1:] or MADE:
        MADE[name]()
        print(name, (IMAGES / f"{name}.png").stat().st_size)
