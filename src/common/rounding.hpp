// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

namespace ridgeway::detail {

/// The least clearance at which a robot of a radius fits: what it touches it does not collide with,
/// and rounding is no matter. FreeSpace and least_clearance() have the same slack.
inline double least_fit(double radius) { return radius * (1.0 - 1e-9); }

/// Whether a clearance is that of a robot of a radius, but for rounding.
inline bool is_as_wide(double clearance, double radius) { return clearance >= least_fit(radius); }

}  // namespace ridgeway::detail
