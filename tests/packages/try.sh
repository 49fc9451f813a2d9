#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
#
# As root in a bare Debian 12 with the packages in /root/packages: installs them as a user would, the
# program and the Python module without any compiler, then the development files, and uses each.
set -euxo pipefail
export DEBIAN_FRONTEND=noninteractive
source=/root/ridgeway
work=$(mktemp -d)
cd "$work"

apt-get update
apt-get install -y --no-install-recommends /root/packages/ridgeway_*.deb /root/packages/python3-ridgeway_*.deb
if command -v g++ || [[ -d /usr/include/eigen3 ]]; then exit 1; fi  # they need none of it

ridgeway build "$source/data/fr_079.bt" -o office.ridge --min-clearance 0.3
ridgeway plan office.ridge --from 1.3,-2.8,1.2 --to 26,-0.1,1.3 --json >plan.json
echo "== the program builds and plans"
test -s /usr/share/man/man1/ridgeway-build.1 -o -s /usr/share/man/man1/ridgeway-build.1.gz || grep -q path-exclude /etc/dpkg/dpkg.cfg.d/*
test -s /usr/share/bash-completion/completions/ridgeway
echo "== man pages and completion are there"

python3 - "$source/data/fr_079.bt" <<'END'
import json, sys
import numpy as np
import ridgeway
roadmap = ridgeway.build(sys.argv[1], min_clearance=0.3)
roadmap.save("python.ridge")
assert open("python.ridge", "rb").read() == open("office.ridge", "rb").read()
plan = roadmap.plan((1.3, -2.8, 1.2), (26, -0.1, 1.3))
assert np.array_equal(plan.waypoints, json.load(open("plan.json"))["waypoints"])
print("== python3 imports ridgeway", ridgeway.__version__, "and makes the same file and plan")
END
ridgeway world house -o house.yaml
printf 'name: one\nmeshes:\n  - {file: box.obj}\n' >mesh.yaml
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >box.obj
python3 -c 'import ridgeway; assert ridgeway.load_world("mesh.yaml").occupancy(0.1, ((-1, -1, -1), (2, 2, 2))).counts["occupied"] > 50'
echo "== python3 reads meshes by the program of the package"

apt-get install -y --no-install-recommends /root/packages/ridgeway-dev_*.deb /root/packages/libridgeway*.deb /root/packages/ridgeway-doc_*.deb \
  g++ cmake make pkg-config libzstd-dev
for file in docs/how-it-works.md html/index.html html/formats.html; do
  test -s "/usr/share/doc/ridgeway-doc/$file" || grep -q path-exclude /etc/dpkg/dpkg.cfg.d/*
done
mkdir consumer
cp "$source/tests/consumer/core.cpp" "$source/tests/consumer/ridge.cpp" consumer
cat >consumer/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES CXX)
find_package(ridgeway REQUIRED COMPONENTS core ridge)
add_executable(core core.cpp)
target_link_libraries(core PRIVATE ridgeway::ridgeway)
add_executable(ridge ridge.cpp)
target_link_libraries(ridge PRIVATE ridgeway::ridgeway ridgeway::ridge)
find_package(ridgeway REQUIRED COMPONENTS shared)
add_executable(shared ridge.cpp)
target_link_libraries(shared PRIVATE ridgeway::shared)
END
cmake -S consumer -B build
cmake --build build
version=$(dpkg-query -W -f '${Version}' ridgeway-dev)
build/core "$version"
build/ridge
build/shared
ldd build/shared > libraries.txt  # a pipe that grep -q leaves early would be an error
grep -q 'libridgeway.so.* => /' libraries.txt
echo "== a consumer of find_package builds and runs"
g++ -std=c++20 consumer/ridge.cpp -o by-pkg-config $(pkg-config --cflags --libs ridgeway-ridge)
./by-pkg-config
g++ -std=c++20 consumer/ridge.cpp -o shared-by-pkg-config $(pkg-config --cflags --libs ridgeway-shared)
./shared-by-pkg-config
echo "== and one of pkg-config"
