# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""What arguments may be, what is said of those that may not, and what things say of themselves."""
import numpy as np
import pytest

import ridgeway
from conftest import GOAL, START


def test_what_has_no_answer_is_refused_by_name_and_what_is_endless_is_read_so(roadmap, tmp_path):
    roadmap.save(tmp_path / "rooms.ridge")
    with pytest.raises(ValueError, match="rooms.ridge: is a roadmap already"):
        ridgeway.load_map(tmp_path / "rooms.ridge")
    with pytest.raises(ValueError, match="queries: needs about"):
        roadmap.check(10**12)
    for deepest in (-1.0, np.nan):
        with pytest.raises(ValueError, match="deepest: is"):
            roadmap.esdf.distance_at([[1.0, 1.0, 1.0]], deepest=deepest)
    empty = ridgeway.OccupancyMap.from_numpy(np.full((20, 20, 20), ridgeway.FREE), 0.1)
    alone = ridgeway.build(empty, min_clearance=0.2, unknown="free").plan((0.5, 0.5, 0.5), (1.5, 1.5, 1.5))
    assert "clearance=inf" in repr(alone)


@pytest.mark.parametrize("kind", [tuple, list, np.array, lambda p: np.array(p, np.float32),
                                  lambda p: np.array([p, p])[::-1][0], lambda p: np.float64(p)[::-1][::-1]])
def test_points_may_be_anything_of_three_numbers(roadmap, kind):
    assert roadmap.plan(kind(START), kind(GOAL)).length == pytest.approx(
        roadmap.plan(START, GOAL).length, rel=1e-6)


@pytest.mark.parametrize(
    "ask, error, words",
    [
        (lambda r: r.plan((1, 2), GOAL), ValueError, r"start: .*three numbers"),
        (lambda r: r.plan(START, np.zeros((3, 3))), ValueError, "goal: .*three numbers"),
        (lambda r: r.plan(START, (1, 2, np.nan)), ValueError, "goal: .*finite"),
        (lambda r: r.plan("here", GOAL), TypeError, "start: expected three numbers"),
        (lambda r: r.plan(None, GOAL), TypeError, "start: expected"),
        (lambda r: r.plan((1, 2, "3"), GOAL), TypeError, "start: expected a number"),
        (lambda r: r.plan(START, GOAL, radius=-1), ValueError, "radius"),
        (lambda r: r.plan(START, GOAL, radius="0.3"), TypeError, "radius: expected a number"),
        (lambda r: r.plan(START, GOAL, shorten=1), TypeError, "shorten: expected True or False"),
        (lambda r: r.plan(START, GOAL, radius=True), TypeError, "radius: expected a number"),
        (lambda r: r.plan(START, GOAL, planner="astar"), ValueError, "planner: is 'astar'.*'esdf'"),
        (lambda r: r.plan(START, GOAL, raduis=1), TypeError, "did you mean 'radius'"),
        (lambda r: r.plan(START, GOAL, time_limit=np.nan), ValueError, "time_limit"),
        (lambda r: r.plan(START, GOAL, limits=(0, 1)), TypeError, "limits: expected FlightLimits"),
        (lambda r: r.plan_many([START, START], [GOAL] * 3), ValueError, "starts and goals"),
        (lambda r: r.plan_many(START, np.zeros((2, 2))), ValueError, r"goals: .*\(N, 3\)"),
        (lambda r: r.plan_many(START, [(0, 0, np.inf)]), ValueError, r"goals\[0\]"),
        (lambda r: r.distances(START, [GOAL], radius=0), ValueError, "radius"),
        (lambda r: r.distances(START, [GOAL], radius=0.01), ValueError, "radius: is 0.01, below"),
        (lambda r: r.plan(START, GOAL, min_clearance=1), TypeError, "did you mean 'radius'"),
        (lambda r: r.alternatives(START, GOAL, 0), ValueError, "count"),
        (lambda r: r.trajectory([(0, 0)]), ValueError, "path"),
        (lambda r: r.trajectory(r.plan(START, (9, 9, 9))), ValueError, "path: is no path"),
        (lambda r: r.save("map.txt"), ValueError, "ends in .ridge"),
        (lambda r: r.esdf.is_free(np.zeros((2, 4)), 0.1), ValueError, r"points: .*\(N, 3\)"),
    ],
)
def test_bad_queries_name_argument_and_expectation(roadmap, ask, error, words):
    with pytest.raises(error, match=words):
        ask(roadmap)


@pytest.mark.parametrize(
    "words, error, match",
    [
        (dict(min_clearance=0), ValueError, "min_clearance"),
        (dict(min_clearance=np.nan), ValueError, "min_clearance"),
        (dict(unknown="wall"), ValueError, "unknown: is 'wall'"),
        (dict(min_clearence=1), TypeError, "did you mean 'min_clearance'"),
        (dict(radius=1), TypeError, "did you mean 'min_clearance'"),
        (dict(threads=-1), ValueError, "threads"),
        (dict(threads=1.5), TypeError, "threads: expected a whole number"),
        (dict(tangent_pairs=-3), ValueError, "tangent_pairs"),
        (dict(tangent_pairs=2_000_000), ValueError, "tangent_pairs"),
        (dict(theta=9), ValueError, "theta"),
    ],
)
def test_bad_configurations_name_their_field(rooms, words, error, match):
    with pytest.raises(error, match=match):
        ridgeway.build(ridgeway.OccupancyMap.from_numpy(rooms, 0.1), **words)


def test_arrays_are_not_maps(rooms):
    with pytest.raises(TypeError, match="OccupancyMap.from_numpy"):
        ridgeway.build(rooms)


def test_what_things_say_of_themselves(roadmap):
    things = [roadmap, roadmap.esdf, roadmap.graph, roadmap.diagram, roadmap.plan(START, GOAL),
              roadmap.alternatives(START, GOAL), roadmap.trajectory(roadmap.plan(START, GOAL)),
              roadmap.explain(START, GOAL, 0.5), ridgeway.FlightLimits(), ridgeway.PinholeCamera(),
              ridgeway.SpinningLidar(),
              ridgeway.TsdfFusion(), ridgeway.LiveRoadmap()]
    for thing in things:
        assert repr(thing).startswith(type(thing).__name__ + "(")
        assert type(thing).__module__ == "ridgeway"


def properties_of(value):
    """All that can be read of it without a call."""
    kinds = [kind for kind in type(value).__mro__ if kind is not object]
    names = [name for kind in kinds for name, member in vars(kind).items() if isinstance(member, property)]
    return {name: getattr(value, name) for name in names}


def test_every_property_can_be_read(roadmap):
    start, goal = (1, 1, 1), (5, 3, 1)
    plan = roadmap.plan(start, goal)
    assert set(plan.seconds) == {"attach", "search", "shorten", "total"}
    things = [roadmap, roadmap.esdf, roadmap.graph, roadmap.diagram, plan, roadmap.alternatives(start, goal),
              roadmap.trajectory(plan.waypoints), roadmap.explain(start, goal, radius=0.45), ridgeway.FlightLimits()]
    for thing in things:
        assert properties_of(thing), thing


def test_masks_are_sets_of_voxels(rooms, roadmap):
    def diagram(voxel_size, origin):
        occupancy = ridgeway.OccupancyMap.from_numpy(rooms, voxel_size, origin)
        return ridgeway.compute_skeleton(ridgeway.compute_esdf(occupancy), 2.5 * voxel_size)

    here, again = diagram(0.1, (0, 0, 0)), diagram(0.1, (0, 0, 0))
    assert here == again and here != diagram(0.1, (1, 0, 0)) and here != diagram(0.05, (0, 0, 0))
    assert here != None and here != 1 and here not in [1, "x"]  # noqa: E711
    assert ridgeway.FlightLimits() != "x" and ridgeway.FlightLimits() == ridgeway.FlightLimits()
    elsewhere = ridgeway.compute_esdf(ridgeway.OccupancyMap.from_numpy(rooms, 0.05, (100, 200, 0)))
    with pytest.raises(ridgeway.InputError, match="another map"):
        ridgeway.build_graph(elsewhere, here)


def test_what_was_made_of_a_map_before_it_changed_is_refused(rooms):
    def field(states, **limits):
        return ridgeway.compute_esdf(ridgeway.OccupancyMap.from_numpy(states, 0.1), **limits)

    before, same = field(rooms), field(rooms)
    rooms[20:40, 20:24] = ridgeway.OCCUPIED
    graph = ridgeway.build_graph(before, ridgeway.compute_skeleton(before, 0.3), min_clearance=0.3)
    assert len(ridgeway.simplify_graph(same, graph).edges) > 0
    with pytest.raises(ridgeway.InputError, match="another map"):
        ridgeway.simplify_graph(field(rooms), graph)
    near = field(rooms, max_distance=0.4)
    for stage in (ridgeway.traversable_voxels, ridgeway.compute_skeleton):
        with pytest.raises(ridgeway.InputError, match="0.5: is beyond the distances"):
            stage(near, 0.5)


def test_radii_that_are_none_are_refused(roadmap):
    for radius in (-1, 0, -1e308, float("nan"), float("inf")):
        with pytest.raises(ridgeway.InputError):
            roadmap.explain((1, 1, 1), (5, 3, 1), radius=radius)


def classes():
    types = [kind for kind in vars(ridgeway).values() if isinstance(kind, type) and kind.__module__.startswith("ridgeway")]
    return [kind for kind in types if not issubclass(kind, (Exception, tuple))]


def test_objects_that_were_not_made_are_refused():
    class Mine(ridgeway.LiveRoadmap):
        def __init__(self):
            with pytest.raises(ridgeway.InputError):
                super().__init__(voxel_size=-1)
            with pytest.raises(TypeError, match="was not made"):
                repr(self)

    with pytest.raises(TypeError):
        Mine().snapshot()
    assert len(classes()) > 15
    for kind in classes():
        unmade = kind.__new__(kind)
        for name in (name for name, member in vars(kind).items() if isinstance(member, property)):
            with pytest.raises(TypeError):
                getattr(unmade, name)


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: ridgeway.PinholeCamera(widht=3), r"'widht'; it is PinholeCamera\(width=320, "),
        (lambda: ridgeway.build("x.bt", voxelsize=0.1), "did you mean 'voxel_size'"),
        (lambda: ridgeway.ScanWriter(), r"'folder'; it is ScanWriter\(folder\)"),
        (lambda: ridgeway.LiveRoadmap(0.2), r"it is LiveRoadmap\(name=value, ...\)"),
        (lambda: ridgeway.Roadmap(), "is not made by calling it"),
    ],
)
def test_what_makes_no_object_is_told_in_words_of_python(make, words):
    with pytest.raises(TypeError, match=words) as refused:
        make()
    assert "_core" not in str(refused.value) and "handle" not in str(refused.value)


def test_methods_of_nothing_are_refused():
    """Whatever is asked of None answers, and does not read what is not there."""
    count = 0
    for kind in classes():
        for name, member in vars(kind).items():
            ask = member.fget if isinstance(member, property) else getattr(kind, name)
            if not callable(ask) or isinstance(member, staticmethod) or name == "__new__":
                continue
            if name == "__eq__":
                assert ask(None) is NotImplemented
                continue
            with pytest.raises((TypeError, RuntimeError)):
                ask(None)
            count += 1
    assert count > 200
    for kind in (ridgeway.Alternatives, ridgeway.DepthSequence, ridgeway.ScanSequence):
        with pytest.raises(TypeError):
            kind.__iter__(None)


def test_sequences_are_iterated_and_take_whole_numbers_and_slices(roadmap):
    routes = roadmap.alternatives(START, GOAL)
    assert [route.length for route in routes] == [routes[i].length for i in range(len(routes))]
    assert routes[-1].length == routes[len(routes) - 1].length
    with pytest.raises(IndexError, match="there are"):
        routes[99]
    with pytest.raises(TypeError, match="index: expected a whole number"):
        routes["1"]
    with pytest.raises(TypeError, match="slice indices"):
        routes[:0.5]
    assert [route.length for route in routes[:1]] == [routes[0].length]


def test_masked_arrays_are_refused(rooms, roadmap):
    masked = np.ma.array(rooms, mask=rooms == ridgeway.OCCUPIED)
    with pytest.raises(TypeError, match=r"states: is a masked array.*filled"):
        ridgeway.OccupancyMap.from_numpy(masked, 0.1)
    with pytest.raises(TypeError, match="goals: is a masked array"):
        roadmap.plan_many((1, 1, 1), np.ma.array([[5, 3, 1]], mask=[[0, 0, 1]]))
