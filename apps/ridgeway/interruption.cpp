// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "interruption.hpp"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <string_view>

#include "files/temporary.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::cli {
namespace {

// Seconds until the process ends without being heard.
constexpr unsigned kPatience = 2;
constexpr unsigned kPatienceForResults = 15;
constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> received{0};
std::atomic<unsigned> patience{kPatience};
pthread_t main_thread;  // set before there are handlers
pid_t process;

/// Runs in the main thread, which alone writes files, so that none is made while they are removed.
/// Only what is safe in a handler is called.
void handle(int signal) {
  if (::getpid() != process) ::_exit(128 + signal);  // a child: the files are its parent's
  if (::pthread_equal(::pthread_self(), main_thread) == 0) {
    ::pthread_kill(main_thread, signal);
    return;
  }
  int none = 0;
  if (signal != SIGALRM && received.compare_exchange_strong(none, signal)) {
    ::alarm(patience);
    return;
  }
  remove_temporaries();
  constexpr std::string_view kWord = "ridgeway: interrupted\n";
  if (::write(STDERR_FILENO, kWord.data(), kWord.size()) < 0) {  // nobody is there to be told
  }
  ::_exit(interrupted_exit_code());
}

}  // namespace

void watch_for_interruption() {
  static_assert(std::atomic<int>::is_always_lock_free);
  main_thread = ::pthread_self();
  process = ::getpid();
  struct sigaction action = {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  ::sigfillset(&action.sa_mask);
  ::sigaction(SIGALRM, &action, nullptr);
  for (const int signal : kSignals) {
    struct sigaction before = {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
}

bool is_interrupted() { return received != 0; }

void wait_for_results() { patience = kPatienceForResults; }

void stop_if_interrupted() {
  if (is_interrupted()) throw Cancelled();
}

int interrupted_exit_code() { return 128 + received; }

}  // namespace ridgeway::cli
