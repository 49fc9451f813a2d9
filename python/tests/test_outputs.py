# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""Pictures, missions, files of others, and what is said of paths and places."""

import json
import struct
import subprocess

import numpy as np
import pytest

import ridgeway
from conftest import GOAL, START


def size_of_png(file):
    data = file.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


def test_pictures_are_those_of_the_command_line(roadmap, program, tmp_path):
    plan = roadmap.plan(START, GOAL)
    roadmap.draw(tmp_path / "a.png", plan, width=800)
    assert size_of_png(tmp_path / "a.png")[0] == 800
    roadmap.save(tmp_path / "rooms.ridge")
    plan.save(tmp_path / "path.json")
    subprocess.run([program, "export", tmp_path / "rooms.ridge", "--picture", tmp_path / "b.png",
                    "--path", tmp_path / "path.json"], check=True)
    assert np.array_equal(ridgeway.read_path(tmp_path / "path.json"), plan.waypoints)
    roadmap.draw(tmp_path / "c.png", plan, title="rooms.ridge")
    roadmap.draw(tmp_path / "d.svg", roadmap.trajectory(plan), roadmap.alternatives(START, GOAL, 2))
    roadmap.draw(tmp_path / "e.svg", roadmap.trajectory(plan))
    assert (tmp_path / "d.svg").stat().st_size > (tmp_path / "e.svg").stat().st_size > 5000
    assert size_of_png(tmp_path / "b.png") == size_of_png(tmp_path / "c.png")
    roadmap.draw(tmp_path / "c.svg", plan.waypoints, {"one": plan, "two": [START, GOAL]}, sides=True,
                 band=(0.5, 1.5), diagram_colour="component", title="Two rooms")
    drawn = (tmp_path / "c.svg").read_text()
    assert drawn.lstrip().startswith("<?xml") and "</svg>" in drawn


@pytest.mark.parametrize(
    "call, error, words",
    [
        (lambda r, f: r.draw(f / "a.bmp"), ValueError, "bmp"),
        (lambda r, f: r.draw(f / "a.png", width=1), ValueError, "width"),
        (lambda r, f: r.draw(f / "a.png", band=(2, 1)), ValueError, "band"),
        (lambda r, f: r.draw(f / "a.png", band=1), ValueError, "band"),
        (lambda r, f: r.draw(f / "a.png", diagram_colour="red"), ValueError, "diagram_colour"),
        (lambda r, f: r.draw(f / "a.png", r.plan((0, 0, 0), GOAL)), ValueError, "path: is no path"),
        (lambda r, f: r.draw(f / "a.png", paths=[START]), TypeError, "paths: expected a dict"),
        (lambda r, f: r.draw(f / "a.png", colour="red"), TypeError, "diagram_colour|colour"),
        (lambda r, f: r.draw(f / "none/a.png"), ValueError, "a.png"),
        (lambda r, f: r.plan(START, GOAL).save_mission(f / "a.csv", 47, 8, 400), ValueError, ".plan"),
        (lambda r, f: r.plan(START, GOAL).save_mission(f / "a.plan", 97, 8, 400), ValueError, "latitude"),
        (lambda r, f: r.plan((0, 0, 0), GOAL).save_mission(f / "a.plan", 47, 8, 400), ValueError, "no waypoints"),
        (lambda r, f: r.plan((0, 0, 0), GOAL).save(f / "a.csv"), ValueError, "has none"),
        (lambda r, f: ridgeway.read_path(f / "a.csv"), ValueError, "a.csv"),
        (lambda r, f: r.describe((0, np.nan, 0)), ValueError, "point"),
        (lambda r, f: r.esdf.surroundings([], 0.3), ValueError, "path"),
        (lambda r, f: r.esdf.surroundings([START], -1), ValueError, "radius"),
        (lambda r, f: ridgeway.open_scans(f), ValueError, "poses.txt"),
    ],
)
def test_bad_input_names_argument_and_expectation(roadmap, tmp_path, call, error, words):
    with pytest.raises(error, match=words):
        call(roadmap, tmp_path)
    assert not list(tmp_path.glob("a.*"))


def test_missions_are_where_the_world_lies(roadmap, tmp_path):
    plan = roadmap.plan(START, GOAL)
    plan.save_mission(tmp_path / "m.plan", 47.0, 8.0, altitude=400.0)
    items = json.loads((tmp_path / "m.plan").read_text())["mission"]["items"]
    assert len(items) == len(plan.waypoints)
    assert items[0]["params"][6] == pytest.approx(400.0 + START[2], abs=1e-5)
    north = items[0]["params"][4] - 47.0
    assert north * 111_170 == pytest.approx(START[1], abs=0.01)  # metres a degree, there


def test_surroundings_tell_the_known_from_the_unknown():
    states = np.full((60, 40, 30), ridgeway.FREE)
    states[:, :, 0] = ridgeway.OCCUPIED
    states[:, 20:] = ridgeway.UNKNOWN
    grid = ridgeway.OccupancyMap.from_numpy(states, 0.1)
    roadmap = ridgeway.build(grid, min_clearance=0.3, unknown="ignore")
    beside = roadmap.esdf.surroundings([(1.0, 1.5, 1.0), (5.0, 1.5, 1.0)], 0.6)
    assert beside["known"] == pytest.approx(0.9) and beside["unknown"] == pytest.approx(0.5)
    assert beside["unknown_share"] == pytest.approx(1.0) and beside["unknown_inside"] == 0.0
    assert roadmap.esdf.surroundings([(1.0, 1.0, 1.5)], 0.3)["unknown_share"] == 0.0
    with pytest.raises(ridgeway.InputError, match="no place of the map"):
        roadmap.esdf.surroundings([(1.0, 1.0, 1.5), (1e300, 1.0, 1.5)], 0.3)


def test_places_are_described(roadmap, rooms):
    here = roadmap.describe(START)
    assert here["status"] == "ok" and here["state"] == "free" and here["component"] == 0
    assert here["clearance"] == pytest.approx(roadmap.esdf.clearance([START]))
    assert roadmap.describe((0.05, 0.05, 0.05))["state"] == "occupied"
    rooms[31:33, 18:26, 2:22] = ridgeway.OCCUPIED
    rooms[31:33, 20:24, 8:12] = ridgeway.FREE  # a window 0.4 m wide, too narrow
    window = ridgeway.build(ridgeway.OccupancyMap.from_numpy(rooms, 0.1), min_clearance=0.25)
    (way,) = window.describe(START)["ways"]
    assert way["radius"] == pytest.approx(0.15) and way["by"] == "obstacle"
    assert np.allclose(way["place"], (3.2, 2.2, 1.0), atol=0.15)


def test_scans_are_arrays(tmp_path):
    (tmp_path / "one.xyz").write_text("1 2 3\n4 5 6\n")
    (tmp_path / "poses.txt").write_text("one.xyz 1 0 0 0 0 0 1\n")
    scans = ridgeway.open_scans(tmp_path)
    assert len(scans) == 1 and scans.layout == "scans" and scans.without_pose == 0
    points, pose = scans[-1]
    assert np.array_equal(points, [[1, 2, 3], [4, 5, 6]]) and pose[0, 3] == 1.0
    with pytest.raises(IndexError):
        scans[1]


def test_a_lidar_scans_a_world_and_scans_are_written(source, tmp_path):
    world = ridgeway.load_world(source / "worlds/house.yaml")
    lidar = ridgeway.SpinningLidar(rows=8, columns=90, vertical=0.8, max_range=6.0)
    assert (lidar.rows, lidar.columns, lidar.vertical, lidar.max_range) == (8, 90, 0.8, 6.0)
    pose = np.eye(4)
    pose[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]  # it looks along the world's y
    pose[:3, 3] = 1.2, 1.2, 1.5
    points = world.scan_with(lidar, pose)
    assert points.dtype == np.float64 and points.shape[1] == 3 and 100 < len(points) <= 8 * 90
    ranges = np.linalg.norm(points, axis=1)
    assert ranges.max() <= 6.0 and np.all(np.abs(np.arcsin(points[:, 2] / ranges)) <= 0.4 + 1e-9)
    with ridgeway.ScanWriter(tmp_path / "run") as writer:
        writer.add(points, pose)
        writer.add(np.vstack([points[:5], [np.nan, 0, 0]]), pose)
        assert len(writer) == 2 and not (tmp_path / "run").exists()
    scans = ridgeway.open_scans(tmp_path / "run")
    assert len(scans) == 2 and len(scans[1][0]) == 5
    again, read_pose = scans[0]
    assert np.allclose(again, points, atol=1e-6) and np.allclose(read_pose, pose)
    seen = lidar.field_of_view(share_of_range=1.0, row_gap=0.1)
    assert seen["vertical"] == pytest.approx(0.8) and seen["range"] < lidar.field_of_view()["range"]
    ridgeway.Explorer(**seen)


def test_scans_are_written_whole_or_not_at_all(tmp_path):
    with pytest.raises(RuntimeError, match="in between"):
        with ridgeway.ScanWriter(tmp_path / "run") as writer:
            writer.add(np.zeros((1, 3)), np.eye(4))
            raise RuntimeError("in between")
    assert not list(tmp_path.iterdir())
    writer = ridgeway.ScanWriter(tmp_path / "run")
    with pytest.raises(ValueError, match="no scan yet"):
        writer.finish()
    writer.add(np.zeros((1, 3)), np.eye(4))
    writer.finish()
    for call in (writer.finish, lambda: writer.add(np.zeros((1, 3)), np.eye(4))):
        with pytest.raises(ValueError, match="written already"):
            call()
    with pytest.raises(ValueError, match="not empty"):
        ridgeway.ScanWriter(tmp_path / "run")


@pytest.mark.parametrize(
    "call, error, words",
    [
        (lambda w: ridgeway.SpinningLidar(rows=0), ValueError, "rows"),
        (lambda w: ridgeway.SpinningLidar(columns=1.5), TypeError, "columns"),
        (lambda w: ridgeway.SpinningLidar(vertical=9.0), ValueError, "vertical"),
        (lambda w: ridgeway.SpinningLidar(min_range=5.0, max_range=2.0), ValueError, "range"),
        (lambda w: ridgeway.SpinningLidar(range_sigma=np.nan), ValueError, "range_sigma"),
        (lambda w: ridgeway.SpinningLidar().field_of_view(share_of_range=0), ValueError, "share_of_range"),
        (lambda w: ridgeway.SpinningLidar().field_of_view(row_gap=-1), ValueError, "row_gap"),
        (lambda w: w.add(np.zeros((3, 2)), np.eye(4)), ValueError, "points"),
        (lambda w: w.add(np.zeros((3, 3)), np.eye(3)), ValueError, "T_world_sensor"),
        (lambda w: ridgeway.ScanWriter(3), TypeError, "folder"),
    ],
)
def test_bad_lidars_and_scans_are_named(tmp_path, call, error, words):
    with pytest.raises(error, match=words):
        call(ridgeway.ScanWriter(tmp_path / "run"))


def test_saved_paths_are_flown_with_their_escapes(roadmap, tmp_path):
    start, goal = (0.25, 0.8, 1.0), (5.4, 2.9, 1.2)
    plan = roadmap.plan(start, goal, escape=True)
    plan.save(tmp_path / "out.json")
    again = roadmap.read_plan(tmp_path / "out.json")
    assert again.escape_start == pytest.approx(plan.escape_start) and again.escape_start > 0
    assert again.clearance == pytest.approx(plan.clearance) and again.length == pytest.approx(plan.length)
    assert roadmap.still_safe(again) and not roadmap.still_safe(roadmap.read_plan(tmp_path / "out.json", radius=0.6))
    assert roadmap.trajectory(again).duration == roadmap.trajectory(plan).duration
    roadmap.plan(start, goal).save(tmp_path / "none.json")
    with pytest.raises(ValueError, match="no path: start_in_collision"):
        roadmap.read_plan(tmp_path / "none.json")


def test_files_of_voxblox_are_read_back(roadmap, tmp_path):
    with pytest.raises(ValueError, match="let it end in .vxblx"):
        roadmap.export_voxblox(tmp_path / "rooms.ply")
    roadmap.export_voxblox(tmp_path / "rooms.vxblx")
    roadmap.export_graph(tmp_path / "rooms.pb")
    assert (tmp_path / "rooms.pb").stat().st_size > 0
    with pytest.warns(UserWarning, match="esdf"):  # of two layers
        again = ridgeway.load_map(tmp_path / "rooms.vxblx")
    assert again.voxel_size == pytest.approx(roadmap.voxel_size)
    assert again.counts["free"] == (roadmap.esdf.states().values == ridgeway.FREE).sum()


@pytest.mark.filterwarnings("ignore::UserWarning")  # which tell what was taken for granted
def test_meshes_have_units_and_open_places(source):
    mesh = source / "data/levine.stl"
    metres = ridgeway.load_map(mesh, voxel_size=0.2)
    coarse = ridgeway.load_map(mesh, voxel_size=0.2, units=0.5, up="z")
    assert np.ptp(np.array(coarse.bounds), 0)[0] == pytest.approx(np.ptp(np.array(metres.bounds), 0)[0] / 2, rel=0.1)
    with pytest.raises(ValueError, match="up"):
        ridgeway.load_map(mesh, up="north")
    with pytest.raises(ValueError, match="inside"):
        ridgeway.load_map(mesh, inside=(1, 2))


def test_pockets_and_surfaces(rooms, source, tmp_path):
    rooms[10:12, 10:12, 0] = ridgeway.FREE
    rooms[0, 0, 0] = ridgeway.FREE
    grid = ridgeway.OccupancyMap.from_numpy(rooms, 0.1)
    for least, gone in ((0.002, 1), (0.01, 5)):
        assert grid.counts["free"] - grid.without_pockets(least).counts["free"] == gone
    fusion = ridgeway.TsdfFusion(voxel_size=0.2)
    image, pose = ridgeway.open_sequence(source / "data/house_depth")[0]
    fusion.integrate_depth(image, ridgeway.open_sequence(source / "data/house_depth").camera, pose)
    fusion.map().save_surface(tmp_path / "house.ply")
    assert (tmp_path / "house.ply").read_bytes().startswith(b"ply")
    fusion.map().export_voxblox(tmp_path / "house.vxblx")
    assert ridgeway.load_map(tmp_path / "house.vxblx").counts["free"] > 0
