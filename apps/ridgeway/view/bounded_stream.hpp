// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <functional>

namespace ridgeway::cli {

/// A connection on which one request is read and answered, within bounds on bytes and time for the
/// whole of it: httplib bounds the time between two bytes and the length of a line only, so that
/// who sends a byte now and then would hold a thread, and who sends lines without end the memory.
class BoundedStream : public httplib::Stream {
 public:
  /// How long things may take.
  struct Patience {
    std::chrono::milliseconds request{5'000}, answer{60'000};
    std::chrono::milliseconds pause{20'000};  ///< until some of an endless answer is taken
    std::chrono::milliseconds end{200};       ///< of finish()
  };

  /// `is_over`: asked several times a second; then nothing more is read or written.
  BoundedStream(int socket, const std::function<bool()>& is_over)
      : BoundedStream(socket, is_over, Patience()) {}
  BoundedStream(int socket, const std::function<bool()>& is_over, const Patience& patience);

  /// The answer has no end: it may take for ever, as long as the other side takes something of what
  /// there is within `Patience::pause`.
  void begin_endless_answer() { is_endless_ = true; }

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

  /// Closes for writing, and takes what still arrives for a moment: the kernel would else tell the
  /// other side of an error before it has read the answer.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool wait_for(short events, Clock::time_point until) const;

  const int socket_;
  const std::function<bool()>& is_over_;
  const Patience patience_;
  Clock::time_point read_until_, write_until_;
  bool is_endless_ = false;
  std::size_t received_ = 0;
  std::array<char, 4096> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what is in the buffer
};

}  // namespace ridgeway::cli
