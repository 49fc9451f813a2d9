// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdlib>

#include "ridgeway/common/error.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

// Plans along a path without points, which links all that planning needs.
int main() {
  try {
    ridgeway::plan_trajectory({}, {}, {});
  } catch (const ridgeway::InputError&) {
    return EXIT_SUCCESS;
  }
  return EXIT_FAILURE;
}
