// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include "ridgeway/common/error.hpp"

namespace ridgeway {

/// Walks over the bytes of a file and names file and offset where they end too early.
class ByteReader {
 public:
  /// `bytes` is the whole file and must outlive the reader; `name` stands in errors.
  ByteReader(std::string_view bytes, std::string name, std::size_t offset = 0)
      : bytes_(bytes), name_(std::move(name)), offset_(offset) {}

  std::size_t offset() const { return offset_; }
  std::size_t remaining() const { return bytes_.size() - offset_; }
  std::string_view rest() const { return bytes_.substr(offset_); }
  const std::string& name() const { return name_; }

  /// The next value as it lies in the file; `turned` where its byte order is not the machine's.
  template <typename Value>
  Value take(bool turned = false) {
    require(sizeof(Value));
    std::array<char, sizeof(Value)> raw;
    std::memcpy(raw.data(), bytes_.data() + offset_, raw.size());
    if (turned) std::reverse(raw.begin(), raw.end());
    offset_ += raw.size();
    Value value;
    std::memcpy(&value, raw.data(), raw.size());
    return value;
  }

  void skip(std::size_t count) {
    require(count);
    offset_ += count;
  }

  /// Goes to an offset within the file.
  void move_to(std::size_t offset) { offset_ = offset; }

  /// The next line without its end ("\n" or "\r\n").
  std::string_view take_line() {
    if (remaining() == 0) require(1);
    const std::size_t end = std::min(bytes_.find('\n', offset_), bytes_.size());
    std::string_view line = bytes_.substr(offset_, end - offset_);
    offset_ = std::min(end + 1, bytes_.size());
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  /// Throws unless that many bytes follow.
  void require(std::size_t count) const {
    if (remaining() < count) {
      fail("ends too early: " + std::to_string(count) + " more bytes are needed and " +
               std::to_string(remaining()) + " are left",
           "the file is cut short, fetch or write it again");
    }
  }

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw InputError(name_, what + ", at byte " + std::to_string(offset_), remedy);
  }

 private:
  std::string_view bytes_;
  std::string name_;
  std::size_t offset_;
};

}  // namespace ridgeway
