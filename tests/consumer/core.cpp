// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "ridgeway/ridgeway.hpp"

int main(int argc, char** argv) {
  if (argc != 2 || std::string_view(argv[1]) != ridgeway::kVersion) {
    std::cerr << "the installed headers are of version " << ridgeway::kVersion << '\n';
    return EXIT_FAILURE;
  }
  const ridgeway::BlockLayout layout({{0, 0, 0}, {1, 0, 0}});
  return layout.voxel_count() == 1024 ? EXIT_SUCCESS : EXIT_FAILURE;
}
