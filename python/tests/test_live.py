# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
import threading

import numpy as np
import pytest

import ridgeway
from conftest import GOAL, START, two_rooms


@pytest.fixture(scope="module")
def house(source):
    return ridgeway.open_sequence(source / "data/house_depth")


def lattice_voxels(states):
    voxels = np.argwhere(states != ridgeway.UNKNOWN)
    return voxels, states[tuple(voxels.T)]


def test_live_snapshots_are_what_build_makes(tmp_path):
    states = two_rooms()
    live = ridgeway.LiveRoadmap(voxel_size=0.1, min_clearance=0.25)
    assert live.snapshot() is None
    report = live.set_voxels(*lattice_voxels(states))
    assert report["has_roadmap"] and report["changed_voxels"] == states.size
    open_door = live.settled()
    assert open_door.is_settled
    ridgeway.build(live.map(), min_clearance=0.25).save(tmp_path / "built.ridge")
    open_door.save(tmp_path / "live.ridge")
    built = ridgeway.load(tmp_path / "built.ridge")
    assert np.array_equal(built.graph.edges, open_door.graph.edges)
    assert np.array_equal(built.esdf.distances().values, open_door.esdf.distances().values)
    path = open_door.plan(START, GOAL)

    door = np.argwhere(states[31:33, 18:26, 2:22] == ridgeway.FREE) + (31, 18, 2)
    live.set_voxels(door, ridgeway.OCCUPIED)
    shut = live.snapshot()
    assert not shut.is_settled and shut.plan(START, GOAL).status == "no_route"
    delta = ridgeway.delta_between(open_door, shut)
    assert not delta.is_empty and delta.counts["closed"] > 0
    assert delta.may_invalidate(path.waypoints, 0.25)
    assert delta.may_invalidate(path) and open_door.still_safe(path) and not shut.still_safe(path)
    assert not shut.esdf.path_is_free(path.waypoints, 0.25)
    assert open_door.plan(START, GOAL).length == path.length  # a snapshot stays as it is
    states[31:33, 18:26, 2:22] = ridgeway.OCCUPIED
    blocks = shut.esdf.block_states  # copied where blocks are not in one piece
    assert blocks.shape[1:] == (8, 8, 8) and (blocks == ridgeway.FREE).sum() == (states == 1).sum()


@pytest.mark.parametrize(
    "call, error, words",
    [
        (lambda r: r.set_voxels([[0, 0]], 1), ValueError, r"voxels: .*\(N, 3\)"),
        (lambda r: r.set_voxels([[0.5, 0, 0]], 1), TypeError, "voxels: expected .* whole numbers"),
        (lambda r: r.set_voxels([[0, 0, 2**40]], 1), ValueError, r"voxels\[0\]"),
        (lambda r: r.set_voxels(np.full((1, 3), 2**64 - 1, np.uint64), 1), ValueError, r"voxels\[0\]: is 18446744"),
        (lambda r: r.set_voxels([[0, 0, 0]], 3), ValueError, "states: is 3"),
        (lambda r: r.set_voxels([[0, 0, 0]], [1, 2]), ValueError, "states: .*1"),
        (lambda r: r.set_voxels([[0, 0, 0]], 0.5), TypeError, "states: expected whole numbers"),
        (lambda r: r.set_voxels([[0, 0, 0]], "free"), TypeError, "states"),
        (lambda r: r.set_voxels([[0, 0, 0]], np.array(["1"])), TypeError, "states"),
        (lambda r: r.set_voxels([[0, 0, 0]], np.array([b"1"])), TypeError, "states"),
        (lambda r: r.set_voxels([[0, 0, 0]], np.array([1 + 0j])), TypeError, "states"),
        (lambda r: r.integrate_points(np.zeros((3, 2)), np.eye(4)), ValueError, r"points: .*\(N, 3\)"),
        (lambda r: r.integrate_points(np.zeros((3, 3)), np.eye(3)), ValueError, r"T_world_sensor: .*\(4, 4\)"),
        (lambda r: r.integrate_points(np.zeros((3, 3)), np.full((4, 4), np.nan)), ValueError, "T_world_sensor"),
        (lambda r: r.integrate_depth(np.zeros((3, 3, 3)), ridgeway.PinholeCamera(), np.eye(4)), ValueError,
         r"image: .*\(H, W\)"),
        (lambda r: r.integrate_depth(np.zeros((3, 3)), ridgeway.PinholeCamera(), np.eye(4)), ValueError, "image|camera"),
        (lambda r: r.integrate_depth(np.full((3, 3), 2000, np.uint16), ridgeway.PinholeCamera(), np.eye(4)), TypeError,
         "image: .*metres.*uint16.*1000"),
        (lambda r: r.correct_poses({0: np.eye(4)}), ValueError, "frame 0"),
        (lambda r: r.correct_poses({1: np.eye(4)}), ValueError, "log"),
        (lambda r: ridgeway.LiveRoadmap(voxel_sice=1), TypeError, "did you mean 'voxel_size'"),
        (lambda r: ridgeway.LiveRoadmap(voxel_size=-1), ValueError, "voxel_size"),
        (lambda r: ridgeway.TsdfFusion(integrator="rays"), ValueError, "'ray_casting'"),
        (lambda r: ridgeway.PinholeCamera(fx=0), ValueError, "fx"),
        (lambda r: ridgeway.open_sequence("nowhere"), ValueError, "nowhere"),
    ],
)
def test_bad_input_names_argument_and_expectation(call, error, words):
    with pytest.raises(error, match=words):
        call(ridgeway.LiveRoadmap(voxel_size=0.1))


def test_fusion_is_that_of_the_live_map(house, tmp_path):
    fusion = ridgeway.TsdfFusion(voxel_size=0.2, max_range=6.0)
    live = ridgeway.LiveRoadmap(voxel_size=0.2, max_range=6.0, min_clearance=0.3)
    count = min(len(house), 6)
    for i in range(count):
        image, pose = house[i]
        assert image.dtype == np.float32 and pose.shape == (4, 4)
        fusion.integrate_depth(image, house.camera, pose)
        live.integrate_depth(image, house.camera, pose)
    assert len(fusion) == count
    with pytest.warns(UserWarning, match="millimetres"):
        ridgeway.TsdfFusion().integrate_depth(1000.0 * image, house.camera, pose)
    tsdf = fusion.map()
    seen = tsdf.block_weights > 0
    assert np.abs(tsdf.block_distances[seen]).max() <= tsdf.truncation * (1 + 1e-6)
    assert tsdf.occupancy().counts["occupied"] == live.map().counts["occupied"] > 0
    surface = tsdf.surface()
    assert surface.triangles.max() < len(surface.vertices) == len(surface.normals)
    tsdf.save(tmp_path / "map.ridge")
    again = ridgeway.load_tsdf(tmp_path / "map.ridge")
    assert np.array_equal(again.block_distances[again.block_weights > 0], tsdf.block_distances[seen])
    assert ridgeway.load_map(tmp_path / "map.ridge").counts == tsdf.occupancy().counts
    with pytest.raises(IndexError):
        house[len(house)]


def test_poses_are_corrected_while_scans_go_on(house, tmp_path):
    def roadmap(name, **config):
        return ridgeway.LiveRoadmap(voxel_size=0.2, max_range=6.0, min_clearance=0.3,
                                    log_folder=str(tmp_path / name), **config)

    live, true = roadmap("live"), roadmap("true")
    for i in range(4):
        image, pose = house[i]
        off = pose.copy()
        off[0, 3] += 0.5 * (i == 1)
        live.integrate_depth(image, house.camera, off)
        true.integrate_depth(image, house.camera, pose)
        if i == 2:
            live.begin_correcting({2: house[1][1]})
    assert live.finish_correcting()["fused_again"] > 0 and live.is_correction_ready()
    assert live.map().counts == true.map().counts
    live.settled().save(tmp_path / "live.ridge")
    ridgeway.build(live.map(), min_clearance=0.3).save(tmp_path / "batch.ridge")
    assert (tmp_path / "live.ridge").read_bytes() == (tmp_path / "batch.ridge").read_bytes()
    assert live.finish_correcting()["fused_again"] == 0


def test_points_fuse_as_images_do():
    fusion = ridgeway.TsdfFusion(voxel_size=0.1, integrator="ray_casting")
    y, z = np.meshgrid(np.linspace(-1, 1, 80), np.linspace(-1, 1, 80))
    wall = np.stack([np.full_like(y, 2.0), y, z], -1).reshape(-1, 3)
    wall[5] = np.nan  # passed over
    fusion.integrate_points(wall, np.eye(4))
    states = fusion.map().occupancy().state_at([(1.0, 0.0, 0.0), (2.05, 0.0, 0.0), (5.0, 0.0, 0.0)])
    assert states.tolist() == [ridgeway.FREE, ridgeway.OCCUPIED, ridgeway.UNKNOWN]


def test_worlds_are_rendered_and_voxelised(source):
    world = ridgeway.load_world(source / "worlds/house.yaml")
    camera = ridgeway.PinholeCamera(width=64, height=48, fx=32.0, fy=32.0, cx=31.5, cy=23.5)
    pose = np.array([[0, 0, 1, 5.0], [-1, 0, 0, 4.0], [0, -1, 0, 1.2], [0, 0, 0, 1.0]])
    image = world.render_depth(camera, pose)
    assert image.shape == (48, 64) and image.max() <= 10 * 2
    assert np.array_equal(image, world.render_depth(camera, pose))
    assert not np.array_equal(image, world.render_depth(camera, pose, range_sigma=0.01, seed=1))
    assert world.occupancy(0.2, ((0, 0, 0), (2, 2, 2))).counts["free"] > 0


def test_solids_that_come_and_go_are_seen_while_they_are_there(tmp_path):
    (tmp_path / "door.yaml").write_text(
        "planes: [{point: [4, 0, 0], normal: [-1, 0, 0]}]\n"
        "timed: [{from: 6, until: 14, boxes: [{centre: [2, 0, 0], size: [0.2, 2, 2]}]}]\n")
    world = ridgeway.load_world(tmp_path / "door.yaml")
    camera = ridgeway.PinholeCamera(width=5, height=5, fx=10, fy=10, cx=2, cy=2)
    along_x = np.array([[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])
    seen = [world.render_depth(camera, along_x, time=time)[2, 2] for time in (0, 6, 13.9, 14)]
    assert np.allclose(seen, [4, 1.9, 1.9, 4])
    lidar = ridgeway.SpinningLidar()
    nearest = [np.linalg.norm(world.scan_with(lidar, np.eye(4), time=time), axis=1).min() for time in (0, 7)]
    assert nearest[0] > 3.9 and nearest[1] < 2


def test_threads_plan_while_the_map_changes():
    states = two_rooms()
    voxels, values = lattice_voxels(states)
    live = ridgeway.LiveRoadmap(voxel_size=0.1, min_clearance=0.25)
    live.set_voxels(voxels, values)
    door = np.argwhere(states[31:33, 18:26, 2:22] == ridgeway.FREE) + (31, 18, 2)
    wrong, done = [], threading.Event()

    def ask():
        while not done.is_set():
            roadmap = live.snapshot()
            path = roadmap.plan(START, GOAL)
            if path and not roadmap.esdf.path_is_free(path.waypoints, 0.2499):
                wrong.append(path)
            if not path and path.status != "no_route":
                wrong.append(path)

    def disturb():  # a second one that updates has to wait its turn
        while not done.is_set():
            live.set_voxels([[1, 1, 1]], ridgeway.OCCUPIED)

    threads = [threading.Thread(target=ask), threading.Thread(target=disturb)]
    for thread in threads:
        thread.start()
    for turn in range(12):
        live.set_voxels(door, ridgeway.OCCUPIED if turn % 2 == 0 else ridgeway.FREE)
    done.set()
    for thread in threads:
        thread.join()
    assert wrong == [] and live.snapshot().plan(START, GOAL)
