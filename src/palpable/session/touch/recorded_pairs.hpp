// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/session/touch/matched_source.hpp"

#include <filesystem>
#include <memory>

namespace palpable::session {

/// Passes pairs on, and writes each that is taken to `folder` (made if it is missing) as NUMBER.left.png and
/// NUMBER.right.png, both or none, on a thread of its own, so that frames:FOLDER shows them again. Pairs that
/// come faster than they can be written are left out, which notice() says once; so it says that one could not
/// be written, after which none is. Errors: usage if the folder holds frames already; failed, with the
/// system's reason, if it cannot be made.
Result<std::unique_ptr<PairSource>> recorded_pairs(std::unique_ptr<PairSource> pairs,
                                                   const std::filesystem::path& folder);

}  // namespace palpable::session
