// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/browser.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>

#include "console.hpp"

namespace ridgeway::cli {

bool open_in_browser(const std::string& address) {
  std::string program = "xdg-open", argument = address;
  const std::array<char*, 3> words = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  // It must not write into our output, nor read what is typed here.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  pid_t process = 0;
  const int error =
      ::posix_spawnp(&process, program.c_str(), &actions, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error == 0;
}

std::string address_of(int port) { return "http://127.0.0.1:" + std::to_string(port) + "/"; }

void open_page(const std::string& address, const Globals& globals) {
  if (!open_in_browser(address))
    warn(globals, "no browser could be started: open " + address + " in one");
}

}  // namespace ridgeway::cli
