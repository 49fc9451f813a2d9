# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""Every block of code of README.md and docs/ does what the page says."""

import importlib.util
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import urllib.request

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("pages", SOURCE / "docs/site/pages.py")
pages = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(pages)

PAGES = [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]
# What pages call the maps and recordings that come with Ridgeway.
FILES = {
    "office.bt": "data/fr_079.bt",
    "levine.stl": "data/levine.stl",
    "house_025_sparse_graph.pb": "data/house_025_sparse_graph.pb",
    "recording": "data/house_depth",
    "house_depth": "data/house_depth",
    "worlds": "worlds",
}


def blocks_of(page, *languages):
    return [block for block in pages.parse(page)[1] if block.language in languages]


def with_blocks(*languages, runs=True):
    """The pages that have such blocks, named for pytest."""
    found = [page for page in PAGES if any(block.runs == runs for block in blocks_of(page, *languages))]
    return pytest.mark.parametrize("page", found, ids=lambda page: str(page.relative_to(SOURCE)))


@pytest.fixture
def folder(program, tmp_path, monkeypatch):
    """Where the blocks of a page run, with its files, and the program as `ridgeway` and in build/bin."""
    for name, file in FILES.items():
        (tmp_path / name).symlink_to(SOURCE / file)
    (tmp_path / "build").mkdir()
    programs = pathlib.Path(os.path.abspath(program)).parent
    (tmp_path / "build/bin").symlink_to(programs)
    monkeypatch.setenv("PATH", f"{programs}:{pathlib.Path(sys.executable).parent}:/usr/bin:/bin")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def serves(command):
    """The page is there under the address that the command prints, until it is interrupted."""
    server = subprocess.Popen(["bash", "-c", "exec " + command], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
    try:
        address = next(found for found in (re.search(r"http://127[^ \n]*", line) for line in server.stdout) if found)
        with urllib.request.urlopen(address[0], timeout=60) as page:
            assert page.status == 200
    finally:
        server.send_signal(signal.SIGINT)
        server.communicate(timeout=60)


def expect_in_order(expected, printed, where):
    """Each line that a page expects is printed, in this order; `...` stands for anything."""
    lines = iter(" ".join(line.split()) for line in printed.splitlines())
    for line in expected:
        pattern = ".*".join(map(re.escape, " ".join(line.split()).split("...")))
        assert any(re.fullmatch(pattern, each) for each in lines), f"{where}: not printed: {line}\n{printed}"


@with_blocks("sh")
def test_commands_run_as_printed(page, folder):
    """All blocks of a page in order, in one folder. Lines after `#>` are among what is printed."""
    for block in blocks_of(page, "sh"):
        if not block.runs:
            continue
        lines = block.text.splitlines()
        served = [line for line in lines if re.search(r"\bridgeway view ", line)]
        script = "\n".join(line for line in lines if line not in served)
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        where = f"{page.name}:{block.line}"
        assert done.returncode == 0, f"{where}\n{done.stdout}"
        expect_in_order(re.findall(r"^#> (.*)$", block.text, re.M), done.stdout, where)
        for line in served:  # until it is interrupted
            serves(line.replace(" --open", " --port 0"))


@with_blocks("python")
def test_python_prints_what_is_printed(page, folder):
    """All blocks of a page in order, as in a notebook. Lines after `#>` are what is printed."""
    if "plot" in page.read_text(encoding="utf-8"):
        pytest.importorskip("matplotlib").use("Agg")
    printed, expected, scope = [], [], {"print": lambda *words: printed.append(" ".join(map(str, words)))}
    for block in blocks_of(page, "python"):
        code = compile("\n" * block.line + block.text, str(page), "exec")
        if block.runs:
            exec(code, scope)
            expected += re.findall(r"#> (.*)", block.text)
    assert printed == expected, [(a, b) for a, b in zip(printed, expected) if a != b]


@with_blocks("sh", runs=False)
def test_what_cannot_run_here_is_a_script(page):
    for block in blocks_of(page, "sh"):
        subprocess.run(["bash", "-n", "-c", block.text], check=True)


def test_data_in_pages_can_be_read():
    for page in PAGES:
        for block in blocks_of(page, "json"):
            json.loads(block.text)


def test_cpp_of_pages_compiles(tmp_path):
    """All of it in one translation unit, a function a page. README's is compiled and run by
    tests/readme."""
    compiler = os.environ.get("RIDGEWAY_CXX", "c++")
    libraries = ["eigen3", "ompl"]
    flags = subprocess.run(["pkg-config", "--cflags", *libraries], capture_output=True, text=True)
    binary = pathlib.Path(os.environ.get("RIDGEWAY_BINARY_DIR", SOURCE / "build"))
    includes, bodies = [f'#include "{SOURCE}/tests/readme/pages_context.hpp"'], []
    for page in PAGES[1:]:
        body = ""
        for block in blocks_of(page, "cpp"):
            lines = block.text.splitlines()
            includes += [line for line in lines if line.startswith("#include")]
            body += f'#line {block.line + 1} "{page.relative_to(SOURCE)}"\n'
            body += "\n".join("" if line.startswith("#include") else line for line in lines) + "\n"
        if body:
            bodies.append(f"void page_{len(bodies)}() {{\n{body}}}\n")
    assert len(bodies) >= 4
    folders = [flag for flag in flags.stdout.split() if flag.startswith("-I")]
    unit = tmp_path / "pages.cpp"
    unit.write_text("\n".join(includes) + "\n" + "\n".join(bodies))
    done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wno-unused", f"-I{SOURCE}/include",
                           f"-I{binary}/include", *folders, unit], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_broken_page_is_told(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("# A page\n[a](page.md#a-page) [b](none.md) [c](#none) `[d](none.md)`\n`src/none.cpp`\n```\n```\n")
    lines, blocks = pages.parse(page)
    names = {page: set(pages.anchors(line for _, line in lines))}
    faults = [*pages.faults_of_links(page, lines, names), *pages.faults_of_names(lines),
              *pages.faults_of_blocks(blocks)]
    assert [(number, what.split(":")[0]) for number, what in faults] == [
        (2, "no file none.md"), (2, "no heading #none"), (3, "no file src/none.cpp"), (4, "a fence of ''")]


def test_links_and_fences_hold():
    done = subprocess.run([sys.executable, SOURCE / "docs/site/pages.py", "check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def keys_of(value):
    """Of objects in objects and lists too, but not of `config`, which is a record of options."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            if key != "config":
                yield from keys_of(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from keys_of(inner)


def test_every_key_and_column_is_in_the_page_of_outputs(folder):
    text = "\n".join(line for _, line in pages.parse(SOURCE / "docs/outputs.md")[0])
    named = set(re.findall(r"[a-z_]\w*", " ".join(re.findall(r"`[^`]+`", text))))
    ends = "--from 1,1,1.2 --to 14.2,6,1.2"
    commands = [
        "build worlds/house.yaml -o a.ridge --voxel-size 0.2",
        "info a.ridge", "info a.ridge --at 1,1,1.2", "info levine.stl", "info house_025_sparse_graph.pb",
        f"plan a.ridge {ends}", f"plan a.ridge {ends} --radius 0.9", f"plan a.ridge {ends} --alternatives 2",
        f"plan a.ridge {ends} --to 2,1,1.2", f"plan a.ridge {ends} --to 2,1,1.2 --nearest",
        f"plan a.ridge {ends} --planner rrtconnect", "plan a.ridge --from 1,1,0.3 --to 2,1,1.2 --escape",
        "plan a.ridge --from 1,1,0.1 --to 2,1,1.2 --snap 1",
        f"trajectory a.ridge {ends} -o flight.csv", "check a.ridge --queries 5", "export a.ridge -o a.graphml",
        "fuse recording -o fused.ridge --voxel-size 0.2", "info fused.ridge",
        "live recording -o live.ridge --voxel-size 0.2 --csv live.csv",
        "explore worlds/house.yaml -o e.ridge --start 1.2,1.2,1.5 --budget 5 --flight drone.csv --volume volume.csv",
        "simulate worlds/house.yaml -o images --frames 1", "world house -o house.yaml",
    ]
    unnamed = {}
    for command in commands:
        done = subprocess.run(["ridgeway", *command.split(), "--json"], capture_output=True, text=True)
        assert done.returncode in (0, 2), done.stderr
        unnamed[command] = set(keys_of(json.loads(done.stdout))) - named
    for table in pathlib.Path(folder).glob("*.csv"):
        unnamed[table.name] = set(table.read_text().splitlines()[0].split(",")) - named
    assert len(unnamed) == len(commands) + 4
    assert {where: sorted(keys) for where, keys in unnamed.items() if keys} == {}
