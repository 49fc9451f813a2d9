// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <nlohmann/json.hpp>

// Takes long to compile: once, in json.cpp, and not in every source.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
