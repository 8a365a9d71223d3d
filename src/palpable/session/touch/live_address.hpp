// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <string>

namespace palpable::session {

/// Whether a command's input is the address of a live source, whatever its scheme.
bool is_live_address(const std::string& input);

/// What an address of frames says.
struct FramesAddress {
  std::string folder;
  double rate_hz = 30.0;
  bool repeats = false;
};

/// Parses frames:FOLDER?fps=30&loop=0. Errors: usage for another scheme, or an unknown or wrong option.
Result<FramesAddress> parse_frames_address(const std::string& address);

}  // namespace palpable::session
