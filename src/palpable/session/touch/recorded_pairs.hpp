// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/session/touch/matched_source.hpp"

#include <filesystem>
#include <memory>

namespace palpable::session {

/// Passes pairs on, and writes each that is taken to `folder` as NUMBER.left.png and NUMBER.right.png, both
/// or none (FrameRecorder). Errors: as FrameRecorder::open().
Result<std::unique_ptr<PairSource>> recorded_pairs(std::unique_ptr<PairSource> pairs,
                                                   const std::filesystem::path& folder);

}  // namespace palpable::session
