// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::session {

/// Adds the file to an error that has no place. An interruption has no place.
inline Error at_place(Error error, const std::filesystem::path& place) {
  if (error.place.empty() && error.code != ErrorCode::interrupted) error.place = place.string();
  return error;
}

/// Several files in one phrase: "left.png and right.png".
inline std::string names_of(const std::vector<std::filesystem::path>& files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "" : " and ") + file.string();
  return names;
}

}  // namespace palpable::session
