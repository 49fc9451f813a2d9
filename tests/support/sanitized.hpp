// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

namespace ridgeway::testing {

/// Whether this program runs under the address or the thread sanitizer, which bring an allocator of
/// their own: limits on memory do not hold there, and the C library does not count what is taken.
#if defined(__has_feature)  // clang
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

}  // namespace ridgeway::testing
