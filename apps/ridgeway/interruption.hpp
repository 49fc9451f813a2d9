// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/common/error.hpp"

namespace ridgeway::cli {

/// From here on Ctrl-C, SIGTERM and SIGHUP ask for an end. Stages that report progress are
/// cancelled by it; where nothing has heard of it within two seconds, or at a second signal, the
/// temporary files are removed and the process ends. Signals that are ignored (nohup) stay so.
void watch_for_interruption();

bool is_interrupted();

/// Lets an interrupted process have longer, to show what it has.
void wait_for_results();

/// Throws Cancelled once an end was asked for.
void stop_if_interrupted();

/// Runs what has results worth showing when it is interrupted, which is waited for longer; returns
/// whether it came to its end.
template <typename Work>
bool completes(const Work& work) {
  wait_for_results();
  try {
    work();
    return true;
  } catch (const Cancelled&) {
    return false;
  }
}

/// 128 and the number of the signal, as shells count.
int interrupted_exit_code();

}  // namespace ridgeway::cli
