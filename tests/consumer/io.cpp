// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdlib>
#include <iostream>

#include "ridgeway/common/error.hpp"
#include "ridgeway/io/ridge_file.hpp"

// Loads a roadmap that is not there, which links all that loading needs.
int main() {
  try {
    ridgeway::load_roadmap("no_such_file.ridge");
  } catch (const ridgeway::InputError& error) {
    std::cout << error.what() << '\n';
    return EXIT_SUCCESS;
  }
  return EXIT_FAILURE;
}
