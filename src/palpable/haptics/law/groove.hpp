// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law.hpp"

namespace palpable::haptics {

/// The boundaries of a picture as grooves in a plate, rendered by `proxy`: passive, for exploration by touch
/// alone.
extern const LawDescription kGrooveLaw;

}  // namespace palpable::haptics
