// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/bounded_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace ridgeway::cli {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kLook = 100ms;  // at whether all is over
constexpr std::size_t kMostReceived = 32 << 10;

}  // namespace

BoundedStream::BoundedStream(int socket, const std::function<bool()>& is_over,
                             const Patience& patience)
    : socket_(socket),
      is_over_(is_over),
      patience_(patience),
      read_until_(Clock::now() + patience.request),
      write_until_(Clock::now() + patience.answer) {}

bool BoundedStream::wait_for(short events, Clock::time_point until) const {
  while (!is_over_()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    if (left <= 0ms) return false;
    pollfd asked = {socket_, events, 0};
    const int ready = ::poll(&asked, 1, static_cast<int>(std::min(left, kLook).count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
  return false;
}

ssize_t BoundedStream::read(char* to, std::size_t size) {
  if (begin_ == end_) {
    if (received_ >= kMostReceived || !wait_for(POLLIN, read_until_)) return -1;
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (got <= 0) return got;
    received_ += static_cast<std::size_t>(got);
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
  }
  const std::size_t taken = std::min(size, end_ - begin_);
  std::memcpy(to, buffer_.data() + begin_, taken);
  begin_ += taken;
  return static_cast<ssize_t>(taken);
}

ssize_t BoundedStream::write(const char* from, std::size_t size) {
  const Clock::time_point until = is_endless_ ? Clock::now() + patience_.pause : write_until_;
  for (;;) {
    if (!wait_for(POLLOUT, until)) return -1;
    const ssize_t sent = ::send(socket_, from, size, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent >= 0 || (errno != EAGAIN && errno != EINTR)) return sent;
  }
}

void BoundedStream::finish() {
  ::shutdown(socket_, SHUT_WR);
  const auto until = Clock::now() + patience_.end;
  while (received_ < 4 * kMostReceived && wait_for(POLLIN, until)) {
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (got <= 0) break;
    received_ += static_cast<std::size_t>(got);
  }
}

// Connections are of this machine alone: nobody asks.
void BoundedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";
  port = 0;
}
void BoundedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  get_remote_ip_and_port(ip, port);
}

}  // namespace ridgeway::cli
