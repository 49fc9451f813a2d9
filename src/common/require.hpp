// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>

#include "number_text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::detail {

/// Throws InputError naming a field and its value, unless the condition holds.
template <typename Number>
void require(bool holds, const char* field, Number value, const std::string& remedy) {
  if (!holds) throw InputError(field, "is " + number_text(value), remedy);
}

}  // namespace ridgeway::detail
