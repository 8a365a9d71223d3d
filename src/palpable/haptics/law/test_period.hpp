// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable::haptics {

/// For tests: the period of a loop at 1 kHz.
inline constexpr double kT_s = 0.001;

}  // namespace palpable::haptics
