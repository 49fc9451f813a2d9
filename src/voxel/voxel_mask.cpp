// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

template class SharedPages<MaskBlock>;

}  // namespace ridgeway::detail
