// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace palpable::formats {

/// Most materials of a scene.
inline constexpr std::size_t kMaxMaterials = 256;

}  // namespace palpable::formats
