# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""Ctrl-C, progress, threads, memory, and what a call costs."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import ridgeway
from conftest import GOAL, START, two_rooms


def test_progress_is_told_and_cancels(rooms):
    grid = ridgeway.OccupancyMap.from_numpy(rooms, 0.1)
    told = []
    ridgeway.build(grid, min_clearance=0.25, progress=lambda stage, share: told.append((stage, share)))
    assert told[0][0] == "esdf" and told[-1] == ("done", 1.0)
    assert [share for _, share in told] == sorted(share for _, share in told)
    with pytest.raises(ridgeway.Cancelled):
        ridgeway.build(grid, min_clearance=0.25, progress=lambda stage, share: stage != "kernel")
    with pytest.raises(ZeroDivisionError):  # what the function throws comes out
        ridgeway.build(grid, min_clearance=0.25, progress=lambda stage, share: 1 / 0)
    assert ridgeway.build(grid, min_clearance=0.25).plan(START, GOAL)


INTERRUPTED = """
import ridgeway, sys, time
try:
    print("go", flush=True)
    {work}
    print("done")
except KeyboardInterrupt:
    print("interrupted")
"""
SETUP = """
import numpy as np, ridgeway
roadmap = ridgeway.build({file!r}, min_clearance=0.3, voxel_size=0.2)
points = roadmap.diagram.points
"""


@pytest.mark.parametrize(
    "setup, work",
    [
        ("", "while True: ridgeway.build({file!r}, min_clearance=0.3)"),
        (SETUP, "while True: roadmap.plan_many(points[:100].repeat(1000, 0), points[-1], planner='esdf')"),
        (SETUP, "while True: roadmap.check(queries=100000)"),
    ],
)
def test_interrupts_are_heard_within_long_calls(real_file, setup, work):
    script = (setup + INTERRUPTED.replace("{work}", work)).replace("{file!r}", repr(str(real_file)))
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "go\n"
    time.sleep(0.7)
    process.send_signal(signal.SIGINT)
    began = time.monotonic()
    output, _ = process.communicate(timeout=120)
    assert output == "interrupted\n"
    assert time.monotonic() - began < 60


SPACE = """
import numpy as np, ridgeway
rng = np.random.default_rng(1)
states = np.where(rng.random(({side},) * 3) < 0.001, ridgeway.OCCUPIED, ridgeway.FREE)
space = ridgeway.OccupancyMap.from_numpy(states, 0.1)
"""


@pytest.mark.parametrize(
    "side, setup, work",
    [
        (320, "", "ridgeway.build(space, min_clearance=0.3)"),
        (320, "", "[ridgeway.compute_esdf(space) for _ in range(100)]"),
        (224, "esdf = ridgeway.compute_esdf(space)", "ridgeway.compute_skeleton(esdf, 0.3)"),
        (320, "", "[space.transformed(np.eye(4), 0.1) for _ in range(100)]"),
        (320, "", "[ridgeway.OccupancyMap.from_numpy(states, 0.1) for _ in range(1000)]"),
    ],
)
def test_interrupts_are_heard_within_a_stage(side, setup, work):
    """Each takes many seconds, in its stages, where it is left alone."""
    script = SPACE.replace("{side}", str(side)) + setup + INTERRUPTED.replace("{work}", work)
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "go\n"
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=120)
    assert output == "interrupted\n"


@pytest.mark.parametrize(
    "work",
    [
        "roadmap.plan((1, 1, 1), (5, 3, 1))",
        "ridgeway.build(space, min_clearance=0.2)",
        "ridgeway.build(space, min_clearance=0.2, progress=lambda stage, share: [0 for _ in range(10000)])",
        "space.to_numpy()",
    ],
)
def test_programs_end_while_daemons_are_at_work(work):
    script = SPACE.replace("{side}", "64") + f"""
import threading, time
roadmap = ridgeway.build(space, min_clearance=0.2)
def work():
    while True:
        {work}
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
print("done")
"""
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    assert (ended.returncode, ended.stdout) == (0, "done\n"), ended.stderr


def test_numpy_says_no_as_python_does(rooms):
    occupancy = ridgeway.OccupancyMap.from_numpy(rooms, 0.1)
    for no in (False, np.False_, np.array(1.0) < 0):
        with pytest.raises(ridgeway.Cancelled):
            ridgeway.build(occupancy, min_clearance=0.25, progress=lambda stage, share: no)
    for yes in (None, True, np.True_, 0):
        ridgeway.build(occupancy, min_clearance=0.25, progress=lambda stage, share: yes)


def test_other_threads_run_meanwhile(real_file):
    stop, turns = threading.Event(), []

    def count():
        while not stop.is_set():
            turns.append(time.monotonic())
            time.sleep(0.002)

    grid = ridgeway.load_map(real_file, voxel_size=0.1)
    thread = threading.Thread(target=count)
    thread.start()
    began = time.monotonic()
    ridgeway.build(grid, min_clearance=0.3)
    ended = time.monotonic()
    stop.set()
    thread.join()
    inside = [t for t in turns if began < t < ended]
    assert len(inside) >= 0.1 * (ended - began) / 0.002


MEMORY = """
import numpy as np, resource, ridgeway, sys
def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
side = int(sys.argv[1])
states = np.full((side, side, side), ridgeway.FREE)
states[::16, ::16] = ridgeway.OCCUPIED
small = ridgeway.OccupancyMap.from_numpy(states[:16, :16, :16], 0.1)  # threads and libraries
before = peak()
grid = ridgeway.OccupancyMap.from_numpy(states.transpose(2, 0, 1), 0.1)
print((peak() - before) / states.size)
assert grid.counts["free"] + grid.counts["occupied"] == states.size
"""


def test_an_array_becomes_a_map_without_a_second_copy():
    """A byte a voxel for the map itself, and a quarter for its layout: another copy would be a
    byte more."""
    output = subprocess.run([sys.executable, "-c", MEMORY, "400"], capture_output=True, text=True, check=True)
    bytes_per_voxel = float(output.stdout)
    print(f"{bytes_per_voxel:.2f} bytes a voxel")
    assert bytes_per_voxel < 1.6


@pytest.mark.skipif(bool(os.environ.get("RIDGEWAY_SANITIZED")), reason="sanitizers slow it down")
def test_a_plan_from_python_costs_little_more(real):
    """Beside the same queries in one call, whose loop is C++'s: some two microseconds of 25. A share
    of processor time, at the median of alternating rounds, as machines differ."""
    count = 3000
    start, goal = (1.3, -2.8, 1.2), (26.0, -0.1, 1.3)
    goals = np.tile(goal, (count, 1))

    def one_by_one():
        for _ in range(count):
            real.plan(start, goal)

    def at_once():
        real.plan_many(start, goals, threads=1)

    def cost(work):
        began = time.process_time()
        work()
        return (time.process_time() - began) / count * 1e6

    ratios = sorted(cost(one_by_one) / cost(at_once) for _ in range(15))
    print(f"{ratios[7]:.3f} times the cost at the median")
    assert ratios[7] < 1.15
