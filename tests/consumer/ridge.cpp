// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdlib>
#include <iostream>

#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/ridge/ridge_file.hpp"

// Loads a roadmap that is not there and would plan on it, which links all that this needs.
int main() {
  try {
    const ridgeway::Roadmap roadmap = ridgeway::load_roadmap("no_such_file.ridge");
    ridgeway::plan(roadmap, {0.0, 0.0, 1.0}, {1.0, 0.0, 1.0});
  } catch (const ridgeway::InputError& error) {
    std::cout << error.what() << '\n';
    return EXIT_SUCCESS;
  }
  return EXIT_FAILURE;
}
