// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdlib>
#include <iostream>

#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"

// Opens a map that is not there, which links all that reading maps of any format needs.
int main() {
  try {
    ridgeway::load_map("no_such_map.bt", {});
  } catch (const ridgeway::InputError& error) {
    std::cout << error.what() << '\n';
    return EXIT_SUCCESS;
  }
  return EXIT_FAILURE;
}
