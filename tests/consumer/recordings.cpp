// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdlib>
#include <iostream>

#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

// Opens a recording and a map that are not there, which links all that reading them needs.
int main() {
  int refused = 0;
  try {
    ridgeway::open_sequence("no_such_folder");
  } catch (const ridgeway::InputError& error) {
    std::cout << error.what() << '\n';
    ++refused;
  }
  try {
    ridgeway::load_map("no_such_map.bt", {});
  } catch (const ridgeway::InputError& error) {
    std::cout << error.what() << '\n';
    ++refused;
  }
  return refused == 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
