// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "json.hpp"

template class nlohmann::basic_json<nlohmann::ordered_map>;
