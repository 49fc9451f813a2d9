# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""What is around the compiled part: stubs, docstrings, pictures, man pages, completion."""

import importlib.util
import inspect
import os
import subprocess
import sys

import numpy as np
import pytest

import ridgeway
from conftest import GOAL, START


def load(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def public():
    for name in ridgeway.__all__:
        value = getattr(ridgeway, name)
        yield name, value
        if inspect.isclass(value) and value.__module__ == "ridgeway":
            for inner, member in vars(value).items():
                if not inner.startswith("_"):
                    yield f"{name}.{inner}", member


def test_the_stub_is_that_of_the_module(source):
    made = load(source / "python/packaging/make_stub.py").make()
    assert (source / "python/ridgeway/_core.pyi").read_text() == made, "run python/packaging/make_stub.py"


def test_the_types_are_sound(source, tmp_path):
    pytest.importorskip("mypy")
    script = tmp_path / "user.py"
    script.write_text(
        "import numpy as np\nimport ridgeway\n"
        "roadmap = ridgeway.build('a.bt', min_clearance=0.3, voxel_size=0.1)\n"
        "plan = roadmap.plan((0, 0, 1), np.zeros(3), radius=0.4)\n"
        "reveal_type(plan.length)\nreveal_type(roadmap.graph.edges.shape)\n"
        "roadmap.plan((0, 0, 1), np.zeros(3), radius='0.4')\n"
        "roadmap.plan((0, 0, 1), np.zeros(3), raduis=0.4)\n")
    package = os.path.dirname(os.path.dirname(ridgeway.__file__))
    done = subprocess.run([sys.executable, "-m", "mypy", "--ignore-missing-imports", "--cache-dir",
                           tmp_path / "cache", script], capture_output=True, text=True,
                          env={**os.environ, "MYPYPATH": package})
    errors = [line for line in done.stdout.splitlines() if ": error:" in line]
    assert len(errors) == 2, done.stdout
    assert '"radius"' in errors[0] and '"raduis"' in errors[1]
    assert 'Revealed type is "builtins.float"' in done.stdout


def test_everything_public_is_described():
    bare = [name for name, value in public()
            if callable(value) and not getattr(value, "__doc__", None)]
    assert bare == []
    for name in ("build", "load_map", "compute_esdf"):
        assert "metres" in getattr(ridgeway, name).__doc__
    for name, value in public():
        if inspect.isbuiltin(value):
            assert inspect.signature(value) is not None, name


def test_numpy_alone_is_needed():
    script = ("import sys\nfor name in ('matplotlib', 'networkx'): sys.modules[name] = None\n"
              "import ridgeway; print(ridgeway.__version__)")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ridgeway.__version__


def test_floor_plans_are_drawn(roadmap, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import ridgeway.plot

    flight = roadmap.trajectory(roadmap.plan(START, GOAL))
    drawn = ridgeway.plot.floor_plan(roadmap, flight, height=1.0).get_legend().get_texts()[0].get_text()
    assert float(drawn.split()[0]) == pytest.approx(roadmap.plan(START, GOAL).length, rel=0.2)
    axes = ridgeway.plot.floor_plan(roadmap, roadmap.plan(START, GOAL), height=1.0)
    axes.figure.savefig(tmp_path / "plan.png")
    assert (tmp_path / "plan.png").stat().st_size > 5000
    assert axes.get_xlim() == (0.0, pytest.approx(6.4)) and len(axes.lines) == 3
    shades = axes.images[0].get_array()
    assert shades.shape[:2] == (44, 64) and shades[10, 30].tolist() != shades[10, 31].tolist()
    # Unless told, at a height where the robot flies, not in the floor.
    assert ridgeway.plot.floor_plan(roadmap, [[1, 1, 0.9], [2, 1, 1.1]]).get_title().endswith("at 1.05 m")
    assert 0.3 < float(ridgeway.plot.floor_plan(roadmap).get_title().split()[-2]) < 2.1
    with pytest.raises(ridgeway.InputError, match="height: is 99 .* to 2.40"):
        ridgeway.plot.floor_plan(roadmap, height=99)
    with pytest.raises(ridgeway.InputError, match="paths: expected PlanResult, Trajectory or points"):
        ridgeway.plot.floor_plan(roadmap, roadmap.plan(START, GOAL), 1.2)
    several = roadmap.alternatives(START, GOAL, 2)
    assert len(ridgeway.plot.floor_plan(roadmap, several).lines) == 3 * len(several)
    assert len(ridgeway.plot.floor_plan(roadmap, list(several)).lines) == 3 * len(several)

    plane = np.full((40, 30), ridgeway.FREE, np.uint8)
    plane[[0, -1]] = plane[:, [0, -1]] = ridgeway.OCCUPIED
    planar = ridgeway.build(ridgeway.OccupancyMap.from_numpy(plane, 0.1), min_clearance=0.2)
    axes = ridgeway.plot.floor_plan(planar, planar.plan((1, 1, 0), (3, 2, 0)))
    assert axes.images[0].get_array().shape[:2] == (30, 40)
    assert axes.get_xlim() == (0.0, 4.0) and axes.get_ylim() == (0.0, 3.0)


@pytest.fixture(scope="module")
def manual(source, program, tmp_path_factory):
    folder = tmp_path_factory.mktemp("manual")
    subprocess.run([sys.executable, source / "apps/ridgeway/manual.py", program, folder], check=True)
    return folder


def test_man_pages_name_every_option(program, manual):
    import json

    top = json.loads(subprocess.run([program, "--help", "--json"], capture_output=True, check=True).stdout)

    def visit(words, command):
        text = (manual / ("-".join(words) + ".1")).read_text()
        for option in command["options"]:
            shown = option["name"].upper() if option["positional"] else option["name"].replace("-", "\\-")
            assert shown in text, (words, option["name"])
        for inner in command["commands"]:
            visit(words + [inner["name"]], inner)

    visit(["ridgeway"], top)
    for page in manual.glob("*.1"):
        done = subprocess.run(["man", "--warnings", "-l", page], capture_output=True, text=True,
                              env={**os.environ, "MANPAGER": "cat", "LC_ALL": "C.UTF-8"})
        assert done.returncode != 0 or done.stderr == "", page


@pytest.mark.parametrize(
    "words, expected",
    [
        (["ridgeway", "bui"], {"build"}),
        (["ridgeway", "build", "--min-c"], {"--min-clearance"}),
        (["ridgeway", "build", "--unknown", "o"], {"obstacle"}),
        (["ridgeway", "bench", "ma"], {"maze"}),
        (["ridgeway", "bench", "maze", "--thr"], {"--threads"}),
        (["ridgeway", "plan", "x.ridge", "--planner", "rrts"], {"rrtstar"}),
        (["ridgeway", "world", "ma"], {"maze"}),
        (["ridgeway", "build", "--voxel-size", "0"], set()),
    ],
)
def test_bash_completes(manual, tmp_path, words, expected):
    script = (f"source {manual}/ridgeway.bash; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; "
              "_ridgeway; printf '%s\\n' \"${COMPREPLY[@]}\"")
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=tmp_path, check=True)
    assert set(done.stdout.split()) == expected and done.stderr == ""


def test_misspelt_words_are_answered(program):
    for words, meant in ((["biuld"], "build"), (["plan", "--raduis", "1"], "--radius"),
                         (["build", "--unknown", "obstackle"], "obstacle")):
        done = subprocess.run([program, *words], capture_output=True, text=True)
        assert done.returncode == 1 and f"did you mean {meant}?" in done.stderr, done.stderr
