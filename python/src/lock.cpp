// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "lock.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace ridgeway::python {
namespace {

constexpr std::chrono::milliseconds kToComeBack(20);

std::atomic<int> away{0};  // threads that are without the lock
std::atomic<bool> is_ending{false};
std::thread::id ending;  // the thread that ends the program: it goes on

/// Python calls this once all threads but daemons have ended, before it turns those away.
void end() {
  ending = std::this_thread::get_id();
  is_ending = true;
  if (away == 0) return;
  // Who was about to take the lock is let in.
  const py::gil_scoped_release release;
  std::this_thread::sleep_for(kToComeBack);
}

}  // namespace

void wait_where_python_ends() {
  while (is_ending && std::this_thread::get_id() != ending) pause();
}

Unlocked::Away::Away() { ++away; }
Unlocked::Away::~Away() { --away; }

void watch_for_the_end() { py::module_::import("atexit").attr("register")(py::cpp_function(&end)); }

}  // namespace ridgeway::python
