// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace palpable::haptics {

/// The memory that a servo and its guardian process share: counts the servo's ticks.
using SharedBeats = std::atomic<std::uint64_t>;

/// What the guardian writes into a pipe when it watches. To be changed with SharedBeats, the arguments or the
/// descriptors of the guardian, so that another version's is refused.
inline constexpr std::uint64_t kGuardianReady = 0x50414c5047443031;

}  // namespace palpable::haptics
