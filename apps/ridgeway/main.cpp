// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <csignal>

#include "interruption.hpp"
#include "run.hpp"

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is then an error of its writer
  ridgeway::cli::watch_for_interruption();
  return ridgeway::cli::run(argc, argv);
}
