# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""How pip builds the package (PEP 517): by CMake, in build/wheel, without anything to download.

Variables: CMAKE_ARGS for CMake, RIDGEWAY_JOBS for the number of parallel jobs,
RIDGEWAY_WHEEL_BUILD for another build folder.
"""

import base64
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("RIDGEWAY_WHEEL_BUILD", ROOT / "build" / "wheel"))

WHEEL = "Wheel-Version: 1.0\nGenerator: ridgeway\nRoot-Is-Purelib: false\nTag: {tag}\n"


def version():
    """That of the top CMakeLists.txt, where alone it is written."""
    return re.search(r"^\s*VERSION ([0-9.]+)$", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def metadata():
    return (
        f"Metadata-Version: 2.1\nName: ridgeway\nVersion: {version()}\n"
        "Summary: Turns 3D voxel maps into a sparse planning graph, and plans on it\n"
        "License: BSD-3-Clause\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
        "Provides-Extra: plot\nRequires-Dist: matplotlib; extra == 'plot'\n"
        "Provides-Extra: graph\nRequires-Dist: networkx; extra == 'graph'\n"
        "Description-Content-Type: text/markdown\n\n" + (ROOT / "README.md").read_text(encoding="utf-8")
    )


def run(*words):
    print("+", shlex.join(map(str, words)), flush=True)
    subprocess.run([str(word) for word in words], check=True)


def build_package():
    """The folder that holds the package `ridgeway`, as it is installed."""
    off = [f"-DRIDGEWAY_BUILD_{part}=OFF" for part in ("APPS", "TESTS", "BENCH", "EXAMPLES", "SAMPLING")]
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    run("cmake", "-S", ROOT, "-B", BUILD, *generator, *off, "-DRIDGEWAY_BUILD_PYTHON=ON",
        "-DRIDGEWAY_PYTHON_DIR=.", "-DCMAKE_BUILD_TYPE=Release", f"-DPYTHON_EXECUTABLE={sys.executable}",
        f"-DPYBIND11_PYTHON_VERSION={sys.version_info.major}.{sys.version_info.minor}",
        *shlex.split(os.environ.get("CMAKE_ARGS", "")))
    jobs = os.environ.get("RIDGEWAY_JOBS", str(os.cpu_count()))
    run("cmake", "--build", BUILD, "-j", jobs, "--target", "ridgeway_python", "ridgeway_mesh_reader")
    staging = BUILD / "staging"
    shutil.rmtree(staging, ignore_errors=True)
    run("cmake", "--install", BUILD, "--component", "python", "--strip", "--prefix", staging)
    reader = next(path for path in BUILD.rglob("ridgeway-mesh-reader") if path.is_file())
    shutil.copy2(reader, staging / "ridgeway")
    return staging


class Wheel:
    """A zip file that lists what is in it."""

    def __init__(self, path):
        self.zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.info = f"ridgeway-{version()}.dist-info"
        self.record = []

    def add(self, name, data, mode=0o644):
        entry = zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0))  # the same bytes each time
        entry.external_attr = (0o100000 | mode) << 16
        entry.compress_type = zipfile.ZIP_DEFLATED
        self.zip.writestr(entry, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(data)}\n")

    def close(self):
        self.add(f"{self.info}/METADATA", metadata().encode())
        self.add(f"{self.info}/WHEEL", WHEEL.format(tag=tag()).encode())
        self.add(f"{self.info}/LICENSE", (ROOT / "LICENSE").read_bytes())
        name = f"{self.info}/RECORD"
        self.zip.writestr(name, "".join(self.record) + f"{name},,\n")
        self.zip.close()


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """What pip asks for first, without a build."""
    info = f"ridgeway-{version()}.dist-info"
    folder = pathlib.Path(metadata_directory) / info
    folder.mkdir()
    (folder / "METADATA").write_text(metadata(), encoding="utf-8")
    (folder / "WHEEL").write_text(WHEEL.format(tag=tag()))
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    staging = build_package()
    name = f"ridgeway-{version()}-{tag()}.whl"
    wheel = Wheel(pathlib.Path(wheel_directory) / name)
    for path in sorted((staging / "ridgeway").rglob("*")):
        if path.is_file():
            wheel.add(str(path.relative_to(staging)), path.read_bytes(), path.stat().st_mode & 0o777)
    wheel.close()
    return name


def build_sdist(sdist_directory, config_settings=None):
    """What git knows, without the data of tests that is large."""
    base = f"ridgeway-{version()}"
    name = base + ".tar.gz"
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True).stdout
    with tarfile.open(pathlib.Path(sdist_directory) / name, "w:gz") as archive:
        for file in sorted(filter(None, listed.decode().split("\0"))):
            archive.add(ROOT / file, f"{base}/{file}")
        (BUILD / "PKG-INFO").parent.mkdir(parents=True, exist_ok=True)
        (BUILD / "PKG-INFO").write_text(metadata(), encoding="utf-8")
        archive.add(BUILD / "PKG-INFO", f"{base}/PKG-INFO")
    return name
