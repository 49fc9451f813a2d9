// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/bounded_stream.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <string>
#include <thread>

namespace ridgeway::cli {
namespace {

using namespace std::chrono_literals;

/// A stream, and the socket of who is at its other end.
class BoundedStreamTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0);
    const int little = 4096;  // the kernel's own room would take megabytes before anybody waits
    ASSERT_EQ(::setsockopt(ends_[0], SOL_SOCKET, SO_SNDBUF, &little, sizeof little), 0);
  }
  void TearDown() override {
    for (const int end : ends_) ::close(end);
  }

  BoundedStream stream(const BoundedStream::Patience& patience) {
    return {ends_[0], is_over_, patience};
  }
  /// All of it; false once the stream takes no more.
  static bool send(BoundedStream& stream, const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t taken = stream.write(bytes.data() + sent, bytes.size() - sent);
      if (taken <= 0) return false;
      sent += static_cast<std::size_t>(taken);
    }
    return true;
  }

  std::array<int, 2> ends_{};
  bool is_finished_ = false;
  const std::function<bool()> is_over_ = [this] { return is_finished_; };
  const std::string event_ = std::string(20'000, 'x');
};

TEST_F(BoundedStreamTest, AFollowerWhoTakesNothingIsDropped) {
  BoundedStream followed = stream({.pause = 30ms});
  followed.begin_endless_answer();
  int sent = 0;
  while (sent < 1000 && send(followed, event_)) ++sent;
  EXPECT_LT(sent, 1000);
}

TEST_F(BoundedStreamTest, AFollowerWhoTakesSomethingIsKeptForLongerThanAnyAnswerMayTake) {
  // Neither the time for an answer is left, nor that for a request.
  BoundedStream followed = stream({.request = 0ms, .answer = 0ms, .pause = 20s});
  followed.begin_endless_answer();
  constexpr int kEvents = 20;
  const std::size_t expected = kEvents * event_.size();
  std::size_t got = 0;
  std::thread follower([&] {
    std::array<char, 3000> some{};
    while (got < expected) {
      const ssize_t size = ::recv(ends_[1], some.data(), some.size(), 0);
      if (size <= 0) break;
      got += static_cast<std::size_t>(size);
    }
  });
  int sent = 0;
  while (sent < kEvents && send(followed, event_)) ++sent;
  ::shutdown(ends_[0], SHUT_WR);
  follower.join();
  EXPECT_EQ(sent, kEvents);
  EXPECT_EQ(got, expected);
}

TEST_F(BoundedStreamTest, AnAnswerThatIsNotTakenIsGivenUp) {
  BoundedStream answered = stream({.answer = 30ms});
  int sent = 0;
  while (sent < 1000 && send(answered, event_)) ++sent;
  EXPECT_LT(sent, 1000);
}

TEST_F(BoundedStreamTest, ARequestThatDoesNotComeIsGivenUp) {
  BoundedStream asked = stream({.request = 30ms});
  std::array<char, 8> bytes{};
  ASSERT_EQ(::send(ends_[1], "GET", 3, 0), 3);
  EXPECT_EQ(asked.read(bytes.data(), bytes.size()), 3);
  EXPECT_LT(asked.read(bytes.data(), bytes.size()), 0);
}

TEST_F(BoundedStreamTest, NothingIsSentOrReadWhenAllIsOver) {
  BoundedStream followed = stream({});
  followed.begin_endless_answer();
  is_finished_ = true;
  EXPECT_FALSE(send(followed, event_));
  std::array<char, 8> bytes{};
  EXPECT_LT(followed.read(bytes.data(), bytes.size()), 0);
}

}  // namespace
}  // namespace ridgeway::cli
