// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

// Names that a person asks for, among those that there are.
namespace palpable::describe {

/// Without capitals (ASCII), and without blanks at the ends.
std::string small_letters(std::string text);

/// Which of the names a text means: one that is the same, begins so, or is spelled nearly so. Equal names are
/// one, the first. With several, all of them; with none, nothing.
struct MeantNames {
  std::vector<std::size_t> names;
  /// Whether it is the whole name.
  bool is_whole = false;
};
MeantNames meant_names(const std::string& asked, const std::vector<std::string>& names);

/// Names of which at most half of the letters differ, the most similar first; equal ones once.
std::vector<std::size_t> similar_names(const std::string& asked, const std::vector<std::string>& names);

/// More names than this are only counted.
inline constexpr std::size_t kMostNamesSaid = 8;
/// "High Street, Mill Lane and 3 more"; `which`: indices of names.
std::string some_of(const std::vector<std::size_t>& which, const std::vector<std::string>& names);

}  // namespace palpable::describe
