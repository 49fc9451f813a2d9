# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""A robot that maps a room by itself, from Python."""

import numpy as np
import pytest

import ridgeway

ROOM = """
name: room
planes:
  - {point: [0, 0, 0], normal: [1, 0, 0]}
  - {point: [6, 0, 0], normal: [-1, 0, 0]}
  - {point: [0, 0, 0], normal: [0, 1, 0]}
  - {point: [0, 4, 0], normal: [0, -1, 0]}
  - {point: [0, 0, 0], normal: [0, 0, 1]}
  - {point: [0, 0, 2.4], normal: [0, 0, -1]}
boxes:
  - {centre: [3, 1.2, 1.2], size: [0.4, 2.4, 2.4]}
"""
START, VOXEL, RADIUS = np.array([1.1, 1.1, 1.1]), 0.2, 0.3
CAMERA = ridgeway.PinholeCamera(80, 60, 40, 40, 39.5, 29.5)


def camera_pose(position, yaw):
    """Camera to world: x right, y down, z forward, level."""
    forward, left = (np.cos(yaw), np.sin(yaw), 0), (-np.sin(yaw), np.cos(yaw), 0)
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([-np.array(left), (0, 0, -1), forward])
    pose[:3, 3] = position
    return pose


def live_map():
    live = ridgeway.LiveRoadmap(voxel_size=VOXEL, min_clearance=RADIUS, max_distance=3.0)
    offsets = np.argwhere(np.ones((7, 7, 7))) - 3  # around the start, as somebody has looked
    near = offsets[(offsets**2).sum(1) <= 9]
    live.set_voxels(np.floor(START / VOXEL).astype(int) + near, ridgeway.FREE)
    return live


def test_a_room_is_explored_without_touching_it(tmp_path):
    (tmp_path / "room.yaml").write_text(ROOM)
    world = ridgeway.load_world(tmp_path / "room.yaml")
    truth = ridgeway.compute_esdf(world.occupancy(0.1, (-0.2, -0.2, -0.2, 6.2, 4.2, 2.6)))
    live = live_map()
    explorer = ridgeway.Explorer(**ridgeway.field_of_view(CAMERA), home=START)
    position, velocity, acceleration, yaw = START, np.zeros(3), np.zeros(3), 0.0
    flying, since, step, flown = None, 0, None, []
    for tick in range(400):
        pose = camera_pose(position, yaw)
        live.integrate_depth(world.render_depth(CAMERA, pose), CAMERA, pose)
        step = explorer.decide(live.snapshot(), 0.25 * tick, position, velocity, acceleration, yaw)
        if step:
            flying, since = step.sample(0.25), tick
            assert np.allclose(flying.position[0], position)
            assert step.coefficients.shape == (len(step.durations), 4, 10)
        if step.status in ("complete", "stuck"):
            break
        if flying is not None:
            now = min(tick + 1 - since, len(flying.time) - 1)
            position, velocity, acceleration, yaw = (
                flying.position[now], flying.velocity[now], flying.acceleration[now], flying.yaw[now])
            flown.append(position)
    assert step.status == "complete" and step.goal is None
    assert np.linalg.norm(position - START) < 0.1
    assert truth.clearance(np.array(flown)) >= RADIUS - 0.15  # of voxels that are half as large
    assert live.map().counts["free"] * VOXEL**3 > 0.8 * (6 * 4 * 2.4 - 0.4 * 2.4 * 2.4)
    assert {u["reason"] for u in explorer.unseen()} <= {"too_narrow", "out_of_view", "looked_in_vain"}
    assert repr(step).startswith("ExplorationStep(status='complete'")


def test_the_first_decision_looks_at_a_frontier():
    live = live_map()
    explorer = ridgeway.Explorer(strategy="nearest", horizontal=6.283, vertical=1.2, range=4.0, spacing=0.4)
    step = explorer.decide(live.snapshot(), 0.0, START)
    clusters = explorer.frontiers()
    assert step.frontiers >= 1 and len(clusters) >= step.frontiers
    assert np.allclose(clusters[0]["centroid"], START, atol=0.5)  # a ball around the start
    assert step.seconds["total"] >= step.seconds["tour"]
    assert step.tour.shape[1] == 4


@pytest.mark.parametrize(
    "call, error, words",
    [
        (lambda: ridgeway.Explorer(spacing=0), ValueError, "spacing"),
        (lambda: ridgeway.Explorer(kept_clearance=-1), ValueError, "kept_clearance"),
        (lambda: ridgeway.Explorer(kept_clearance=np.inf), ValueError, "kept_clearance"),
        (lambda: ridgeway.Explorer(range=-1), ValueError, "range"),
        (lambda: ridgeway.Explorer(strategy="random"), ValueError, "strategy: .*'tour', 'nearest'"),
        (lambda: ridgeway.Explorer(until=5), ValueError, "until"),
        (lambda: ridgeway.Explorer(within=[[0, 0, 0]]), ValueError, "within"),
        (lambda: ridgeway.Explorer(spacin=1), TypeError, "spacing"),
        (lambda: ridgeway.field_of_view(CAMERA, share_of_range=0), ValueError, "share_of_range"),
        (lambda: ridgeway.field_of_view(CAMERA, max_range=np.nan), ValueError, "max_range"),
    ],
)
def test_bad_configurations_are_named(call, error, words):
    with pytest.raises(error, match=words):
        call()


def test_bad_states_are_refused():
    live, explorer = live_map(), ridgeway.Explorer()
    with pytest.raises(ValueError, match="position"):
        explorer.decide(live.snapshot(), 0.0, (np.nan, 0, 0))
    explorer.decide(live.snapshot(), 1.0, START)
    with pytest.raises(ValueError, match="time"):
        explorer.decide(live.snapshot(), 0.5, START)
    ignoring = ridgeway.LiveRoadmap(voxel_size=VOXEL, min_clearance=RADIUS, unknown="ignore")
    ignoring.set_voxels(np.argwhere(np.ones((20, 20, 20))), ridgeway.FREE)
    with pytest.raises(ValueError, match="unknown"):
        ridgeway.Explorer().decide(ignoring.snapshot(), 0.0, (2, 2, 2))
