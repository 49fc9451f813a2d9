// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>
#include <string_view>

namespace ridgeway::fuzz {

/// A reader of files, given any bytes. It may return or throw InputError; anything else is a
/// finding.
struct Reader {
  std::string_view name;
  void (*read)(std::string_view bytes);
};

std::span<const Reader> all_readers();

}  // namespace ridgeway::fuzz
