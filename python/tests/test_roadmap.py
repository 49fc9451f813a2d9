# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
import copy
import json
import subprocess

import numpy as np
import pytest

import ridgeway
from conftest import GOAL, START


def cli(program, *words, codes=(0,)):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    assert done.returncode in codes, done.stderr
    return done.stdout


def test_files_and_plans_are_those_of_the_command_line(program, real_file, real, tmp_path):
    cli(program, "build", real_file, "-o", tmp_path / "a.ridge", "--min-clearance", "0.3", "--json")
    real.save(tmp_path / "b.ridge")
    assert (tmp_path / "a.ridge").read_bytes() == (tmp_path / "b.ridge").read_bytes()
    ridgeway.load(tmp_path / "a.ridge").save(tmp_path / "c.ridge")
    assert (tmp_path / "a.ridge").read_bytes() == (tmp_path / "c.ridge").read_bytes()

    rng = np.random.default_rng(1)
    places = real.diagram.points[rng.integers(0, len(real.diagram), 12)]
    for start, goal in zip(places[::2], places[1::2]):
        words = ("--from=" + ",".join(map(repr, start)), "--to=" + ",".join(map(repr, goal)))
        told = json.loads(cli(program, "plan", tmp_path / "a.ridge", *words, "--json", codes=(0, 2)))
        plan = real.plan(start, goal)
        assert plan.status == told["status"]
        if plan:
            assert plan.length == told["length"] and plan.clearance == told["clearance"]
            assert np.array_equal(plan.waypoints, np.array(told["waypoints"]))


def test_the_same_bytes_with_other_options_and_threads(program, real_file, tmp_path):
    cli(program, "build", real_file, "-o", tmp_path / "a.ridge", "--min-clearance", "0.35",
        "--unknown", "ignore", "--voxel-size", "0.1", "--keep-in", "-5,-5,0,20,5,2")
    limits = ridgeway.FlightLimits(keep_in=((-5, -5, 0), (20, 5, 2)))
    for threads in (1, 2):
        made = ridgeway.build(real_file, voxel_size=0.1, min_clearance=0.35, unknown="ignore",
                              limits=limits, threads=threads)
        made.save(tmp_path / "b.ridge")
        assert (tmp_path / "a.ridge").read_bytes() == (tmp_path / "b.ridge").read_bytes()


def test_what_never_changes_is_its_own_copy(real):
    place = real.diagram.points[0]
    plan = real.plan(place, place)
    for thing in (real, real.graph, real.esdf, plan, real.trajectory(plan), ridgeway.FlightLimits()):
        assert copy.copy(thing) is thing
        assert copy.deepcopy({"it": [thing]})["it"][0] is thing
    with pytest.raises(TypeError):
        copy.copy(ridgeway.LiveRoadmap(voxel_size=0.1, min_clearance=0.3))


@pytest.mark.parametrize("unknown", ["obstacle", "ignore", "free"])
def test_a_map_stays_as_it_was_when_it_is_built_from(real_file, unknown, tmp_path):
    grid = ridgeway.load_map(real_file, voxel_size=0.2)
    before = grid.to_numpy().values
    for name in "ab":
        ridgeway.build(grid, min_clearance=0.4, unknown=unknown).save(tmp_path / (name + ".ridge"))
        assert np.array_equal(grid.to_numpy().values, before)
    assert (tmp_path / "a.ridge").read_bytes() == (tmp_path / "b.ridge").read_bytes()


def test_stages_one_by_one_are_those_of_build(rooms):
    grid = ridgeway.OccupancyMap.from_numpy(rooms, 0.1)
    roadmap = ridgeway.build(grid, min_clearance=0.25)
    esdf = ridgeway.compute_esdf(grid)
    assert np.array_equal(esdf.block_squared, roadmap.esdf.block_squared)
    traversable = ridgeway.traversable_voxels(esdf, 0.25)
    gvd = ridgeway.compute_gvd(esdf, traversable)
    edges = ridgeway.extract_edges(esdf, gvd)
    assert len(traversable) > len(gvd) > len(edges) >= len(ridgeway.thin(edges)) > 0
    assert len(gvd) == roadmap.report["gvd_voxels"] and len(edges) == roadmap.report["edge_voxels"]
    skeleton = ridgeway.compute_skeleton(esdf, 0.25)
    assert skeleton == roadmap.diagram and not skeleton == edges
    graph = ridgeway.build_graph(esdf, skeleton, min_clearance=0.25)
    simple = ridgeway.simplify_graph(esdf, graph)
    for name in ("vertices", "edges", "edge_lengths", "edge_clearances", "vertex_clearances"):
        assert np.array_equal(getattr(simple, name), getattr(roadmap.graph, name)), name
    other = ridgeway.compute_esdf(ridgeway.OccupancyMap.from_numpy(rooms[::2], 0.1))
    with pytest.raises(ValueError, match="diagram: is of another map"):
        ridgeway.build_graph(other, skeleton)


def test_distances_are_those_of_brute_force(rooms):
    esdf = ridgeway.compute_esdf(ridgeway.OccupancyMap.from_numpy(rooms, 0.1))
    grid = esdf.distances()
    assert grid.values.shape == rooms.shape and grid.values.dtype == np.float32
    solid = np.argwhere(rooms == ridgeway.OCCUPIED)
    rng = np.random.default_rng(2)
    for voxel in np.argwhere(rooms == ridgeway.FREE)[rng.integers(0, (rooms == 1).sum(), 200)]:
        gap = np.maximum(np.abs(solid - voxel) - 0.5, 0.0)
        assert grid.values[tuple(voxel)] == pytest.approx(0.1 * np.sqrt((gap**2).sum(1).min()), rel=1e-6)
    blocks = esdf.block_squared
    assert not blocks.flags.writeable and not blocks.flags.owndata
    assert np.shares_memory(esdf.block(0), blocks) and np.array_equal(esdf.block(-1), blocks[-1])
    with pytest.raises(IndexError):
        esdf.block(len(blocks))
    assert esdf.block_sites.shape == blocks.shape + (3,)


def test_routes_of_a_plan_from_above_stay_in_its_plane():
    plan = np.full((60, 40), ridgeway.FREE)
    plan[[0, -1]] = plan[:, [0, -1]] = plan[30, 10:] = ridgeway.OCCUPIED
    roadmap = ridgeway.build(ridgeway.OccupancyMap.from_numpy(plan, 0.1, (0, 0, 1.0)), min_clearance=0.3)
    distances = roadmap.esdf.distances().values
    solid = np.argwhere(plan == ridgeway.OCCUPIED)
    gaps = np.maximum(np.abs(np.argwhere(plan == ridgeway.FREE)[:, None] - solid) - 0.5, 0.0)
    assert np.allclose(distances[plan == ridgeway.FREE], 0.1 * np.sqrt((gaps**2).sum(2).min(1)), rtol=1e-6)
    path = roadmap.plan((1.0, 3.0, 0.0), (5.0, 3.0, 9.0))
    assert path and 6.0 < path.length < 7.0 and path.clearance >= 0.3
    assert np.allclose(path.waypoints[:, 2], 1.05)


def test_free_space_is_asked_point_by_point(roadmap):
    esdf = roadmap.esdf
    points = np.random.default_rng(3).uniform((0, 0, 0), (6.4, 4.4, 2.4), (500, 3))
    free = esdf.is_free(points, 0.25)
    assert free.dtype == bool and 0 < free.sum() < 500
    for point, answer in zip(points, free):
        assert answer == (esdf.clearance([point]) >= 0.25 * (1 - 1e-9))
    distance, gradient = esdf.distance_at(points)
    assert np.all(np.abs(distance[free] - [esdf.clearance([p]) for p in points[free]]) < 0.2)
    assert gradient.shape == (500, 3)
    assert np.isnan(esdf.distance_at([[1e30, 0, 0], [-50, 0, 0]])[0]).all()
    assert esdf.is_free([[1e30, 0, 0]], 0.1).tolist() == [False]
    assert not esdf.path_is_free([(1.5, 1, 1), (5, 1, 1)], 0.25)
    assert esdf.path_is_free(roadmap.plan(START, GOAL).waypoints, 0.25)
    with pytest.raises(ValueError, match="radius"):
        esdf.is_free(points, np.nan)


def test_plans_are_arrays_and_reasons(roadmap, rooms):
    plan = roadmap.plan(START, GOAL)
    assert plan and plan.ok and plan.status == "ok" and plan.reason == ""
    assert plan.waypoints.shape[1] == 3 and plan.waypoints.dtype == np.float64
    assert tuple(plan.waypoints[0]) == START and tuple(plan.waypoints[-1]) == GOAL
    steps = np.linalg.norm(np.diff(plan.waypoints, axis=0), axis=1)
    assert plan.length == pytest.approx(steps.sum())
    assert roadmap.esdf.clearance(plan.waypoints) == pytest.approx(plan.clearance)
    with pytest.raises(ValueError):
        plan.waypoints[0] = 0
    refused = {
        (9, 9, 9): "goal_outside_map",
        (1, 2, 1e308): "goal_outside_map",
        (0.05, 0.05, 0.05): "goal_in_collision",
        (0.3, 0.3, 0.3): "goal_in_collision",
    }
    for goal, status in refused.items():
        plan = roadmap.plan(START, goal)
        assert not plan and plan.status == status and "goal" in plan.reason
        assert plan.waypoints.shape == (0, 3)
    for wall, other in ((START, (3.2, 0.9, 1.0)), ((3.2, 0.9, 1.0), START)):
        for plan in (roadmap.plan(wall, other), roadmap.plan_many([wall], [other])[0]):
            assert "lies in an obstacle" in plan.reason
            snap = float(plan.reason.split("snap=")[1].split()[0])
            assert roadmap.plan(wall, other, snap=snap)
            assert not roadmap.plan(wall, other, snap=snap - 0.002)
    wide = roadmap.plan(START, GOAL, radius=0.5)
    assert wide.status == "no_route"
    assert wide.length == np.inf and wide.within == np.inf and np.isnan(wide.clearance)
    assert roadmap.explain(START, GOAL) is None  # there is a route
    blocked = roadmap.explain(START, GOAL, radius=0.5)
    assert 0.35 <= blocked.radius <= 0.4 and blocked.by == "obstacle" and blocked.map_end is None
    assert blocked.place[0] == pytest.approx(3.2, abs=0.2)
    assert repr(roadmap.explain(wide)) == repr(blocked)
    assert "explain(plan)" in wide.reason and roadmap.explain(roadmap.plan(START, GOAL)) is None
    with pytest.raises(TypeError, match="PlanResult knows"):
        roadmap.explain(wide, GOAL)
    limits = ridgeway.FlightLimits(keep_out=[((2.0, -1.0, -1.0), (4.0, 6.0, 4.0))])
    shut = roadmap.plan((0.1, 2.0, 1.0), GOAL, limits=limits, snap=1.0)
    assert shut.status == "no_route" and shut.moved_start > 0
    assert roadmap.explain(shut).by == "limits"
    assert "radius and height" in roadmap.plan((0.9, 0.9, 0.4), GOAL, robot_height=1.0).reason
    assert roadmap.plan((0.25, 0.8, 1.0), GOAL).status == "start_in_collision"
    assert roadmap.plan((0.25, 0.8, 1.0), GOAL, snap=0.5).moved_start > 0
    narrow = roadmap.plan(START, GOAL, radius=0.1)
    assert narrow.status == "radius_too_small" and "0.1, is smaller than" in narrow.reason
    assert "largest ball in a robot of that height" in roadmap.plan(START, GOAL, robot_height=0.2).reason
    assert "no place of the map has room for a radius of 7.0" in roadmap.plan(START, GOAL, radius=7.0).reason
    with pytest.raises(ValueError, match="whose widest place, .* has room for"):
        ridgeway.build(ridgeway.OccupancyMap.from_numpy(rooms, 0.1), min_clearance=7.0)


def test_a_wall_across_the_map_is_named_and_where_the_map_ends(rooms):
    rooms[:] = ridgeway.FREE
    rooms[31:33] = ridgeway.OCCUPIED
    cut = ridgeway.build(ridgeway.OccupancyMap.from_numpy(rooms, 0.1), min_clearance=0.25)
    blocked = cut.explain(START, GOAL)
    assert blocked.radius == 0 and blocked.by == "obstacle" and blocked.place is None
    beyond = [not 0 <= c <= size for c, size in zip(blocked.map_end, (6.4, 4.4, 2.4))]
    assert any(beyond) and blocked.map_end[0] < 3.1


def test_one_place_is_asked_as_many_are(roadmap):
    field, states = roadmap.esdf, ridgeway.OccupancyMap.from_numpy(np.ones((4, 4, 4), np.uint8), 0.5)
    assert field.is_free(START, 0.25) and not field.is_free((0.1, 0.1, 0.1), 0.25)
    distance, gradient = field.distance_at(START)
    assert np.ndim(distance) == 0 and gradient.shape == (3,)
    assert distance == field.distance_at([START])[0][0]
    assert states.state_at((0.3, 0.3, 0.3)) == states.state_at([(0.3, 0.3, 0.3)])[0] == 1


def test_some_of_the_alternatives(roadmap):
    routes = roadmap.alternatives(START, GOAL, 3)
    assert [r.length for r in routes[::-1]] == [r.length for r in routes][::-1]
    assert len(routes[:1]) == 1 and routes[5:] == [] and len(routes[-1:]) == 1


def test_many_plans_are_the_plans_one_by_one(real):
    rng = np.random.default_rng(4)
    points = real.diagram.points[rng.integers(0, len(real.diagram), 60)]
    starts, goals = points[:30], points[30:]
    alone = [real.plan(a, b) for a, b in zip(starts, goals)]
    for threads in (1, 2):
        together = real.plan_many(starts, goals, threads=threads)
        assert [p.status for p in together] == [p.status for p in alone]
        for a, b in zip(alone, together):
            assert np.array_equal(a.waypoints, b.waypoints)
    fan = real.plan_many(starts[0], goals)
    assert [p.length for p in fan] == [real.plan(starts[0], b).length for b in goals]
    index, nearest = real.plan_nearest(starts[0], goals)
    lengths = [p.length if p else np.inf for p in fan]
    assert index == int(np.argmin(lengths)) and nearest.length == min(lengths)
    assert real.distances(starts[0], goals).shape == (30,)
    assert real.plan_many(starts[0], np.zeros((0, 3))) == []


def test_routes_over_places_and_on_other_sides(rooms):
    rooms[10:20, 16:26, 2:22] = ridgeway.OCCUPIED  # a pillar in the first room
    roadmap = ridgeway.build(ridgeway.OccupancyMap.from_numpy(rooms, 0.1), min_clearance=0.25)
    start = (0.6, 2.1, 1.0)
    plan, leg = roadmap.plan_via([start, (2.5, 0.7, 1.0), GOAL])
    assert plan and leg is None
    plan, leg = roadmap.plan_via([start, GOAL, (9, 9, 9)])
    assert not plan and leg == 1
    routes = roadmap.alternatives(start, GOAL, 4)
    assert len(routes) >= 2 and routes.status == "ok"
    sides = {bool(route.waypoints[np.abs(route.waypoints[:, 0] - 1.5).argmin(), 1] > 2.1) for route in routes}
    assert sides == {True, False}
    assert [r.length for r in routes] == sorted(r.length for r in routes)
    with pytest.raises(IndexError):
        routes[9]


def test_graphs_are_arrays_and_networkx(real, tmp_path):
    graph = real.graph
    edges, vertices = graph.edges, graph.vertices
    assert edges.shape[1] == 2 and vertices.shape[1] == 3 and not edges.flags.owndata
    lengths = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
    assert np.allclose(lengths, graph.edge_lengths, atol=1e-9)
    assert graph.edge_clearances.min() >= graph.min_clearance * (1 - 1e-9)
    networkx = pytest.importorskip("networkx")
    same = graph.to_networkx()
    assert same.number_of_nodes() == len(vertices) and same.number_of_edges() == len(edges)
    assert networkx.number_connected_components(same) == graph.components.max() + 1
    assert same.nodes[3]["pos"] == tuple(vertices[3])
    real.export_graph(tmp_path / "graph.json")
    read = networkx.node_link_graph(json.loads((tmp_path / "graph.json").read_text()))
    assert sorted(read.edges) == sorted(same.edges)


def test_a_roadmap_checks_itself(roadmap):
    report = roadmap.check(queries=20, seed=3)
    assert report["clean"] and report["queries"] == 20
    assert 1.0 <= report["length_ratio"]["median"] <= report["length_ratio"]["max"] < 1.2
    assert report == {**roadmap.check(queries=20, seed=3), "microseconds": report["microseconds"]}
    low = ridgeway.FlightLimits(keep_in=((-100, -100, 0), (100, 100, 1.2)))
    for options in ({"limits": low}, {"robot_height": 0.8}, {"quick": True}, {"within": 1.05}):
        assert roadmap.check(queries=20, **options)["clean"]
    with pytest.raises(ridgeway.InputError, match="robot_height"):
        roadmap.check(queries=1, robot_height=0.1)
    with pytest.raises(TypeError, match="robot_height"):
        roadmap.check(robot_hight=1.0)
    assert len(roadmap.components()) == roadmap.report["traversable_components"]


def test_trajectories_hold_their_limits(roadmap, tmp_path):
    plan = roadmap.plan(START, GOAL)
    flight = roadmap.trajectory(plan, max_speed=1.5, max_acceleration=2.0)
    assert flight and flight.max_speed <= 1.5 and flight.max_acceleration <= 2.0
    states = flight.sample(0.02)
    assert states.time[-1] == pytest.approx(flight.duration)
    assert np.linalg.norm(states.velocity, axis=1).max() <= flight.max_speed * (1 + 1e-6)
    assert roadmap.esdf.is_free(states.position, 0.2499).all()
    assert flight.durations.sum() == pytest.approx(flight.duration)
    assert flight.coefficients.shape == (len(flight.durations), 4, 10)
    assert roadmap.trajectory(plan.waypoints).ok
    flight.save(tmp_path / "flight.csv")
    assert (tmp_path / "flight.csv").read_text().startswith("t,x,y,z")
    via = (2.6, 2.2, 1.4)
    for path, more in ((roadmap.plan_via([START, via, GOAL])[0], {}),
                       (roadmap.plan_via([START, via, GOAL])[0].waypoints, {"via": [via]})):
        passing = roadmap.trajectory(path, **more).sample(0.005).position
        assert np.linalg.norm(passing - via, axis=1).min() < 0.01
    refused = roadmap.trajectory([START, (5.6, 0.8, 1.0)])
    assert not refused and refused.status == "path_not_free"


def test_a_path_that_is_given_is_flown_as_one(roadmap, tmp_path):
    path = roadmap.plan(START, GOAL)
    roadmap.trajectory(path.waypoints).save(tmp_path / "given.json")
    given = json.loads((tmp_path / "given.json").read_text())
    assert given["answered_by"] == "given"
    assert given["path_clearance"] == pytest.approx(path.clearance)
    assert given["within"] == pytest.approx(path.within)


def test_a_plan_is_flown_by_the_robot_and_within_the_limits_that_it_was_asked_for(roadmap):
    esdf = roadmap.esdf
    wide = roadmap.plan(START, (2.6, 2.9, 1.0), radius=0.45)
    flight = roadmap.trajectory(wide)
    assert flight.clearance >= 0.45 and esdf.path_is_free(flight.sample(0.01).position, 0.45)
    assert roadmap.trajectory(wide, radius=0.3).duration <= flight.duration
    low, high = np.array([0.0, 1.6, 0.0]), np.array([2.0, 2.4, 9.0])
    around = roadmap.plan(START, (0.8, 3.4, 1.0), limits=ridgeway.FlightLimits(keep_out=[(low, high)]))
    places = roadmap.trajectory(around).sample(0.01).position
    assert not ((places > low) & (places < high)).all(axis=1).any()
    as_planned = roadmap.trajectory(around, limits=None).coefficients
    np.testing.assert_array_equal(as_planned, roadmap.trajectory(around).coefficients)
    for flown in (roadmap.trajectory(around, limits=ridgeway.FlightLimits()), roadmap.trajectory(around.waypoints)):
        assert flown.duration < roadmap.trajectory(around).duration
        places = flown.sample(0.01).position
        assert ((places > low) & (places < high)).all(axis=1).any()
    samples = roadmap.trajectory(around).sample(0.5)
    again = roadmap.trajectory(around).at(samples.time)
    for one, other in zip(samples, again):
        np.testing.assert_allclose(one, other, atol=1e-12)
    np.testing.assert_array_equal(flight.at(-1.0).position, START)
    assert flight.at(0.5).yaw == flight.at([0.5]).yaw[0] and flight.at(0.5).velocity.shape == (3,)
    with pytest.raises(ValueError, match="times: has one that is not finite"):
        flight.at([0.0, np.nan])
    tall = roadmap.plan(START, GOAL, robot_height=0.8)
    said = roadmap.trajectory(tall.waypoints, robot_height=0.8)
    np.testing.assert_array_equal(roadmap.trajectory(tall).coefficients, said.coefficients)
    assert esdf.path_is_free(wide, 0.45) and esdf.clearance(wide) == pytest.approx(wide.clearance)
