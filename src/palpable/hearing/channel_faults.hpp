// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/sound/sound.hpp"

namespace palpable::hearing {

/// Whether each channel can be of a microphone of its own. Errors: invalid_input, for a channel that is zero
/// throughout though another one is not, and for two channels that are equal and not zero: directions from
/// them are wrong, with a high confidence.
Result<void> check_channels(const Sound& sound);

}  // namespace palpable::hearing
