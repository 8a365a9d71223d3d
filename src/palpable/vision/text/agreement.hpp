// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/text/tesseract.hpp"

#include <string>
#include <vector>

namespace palpable::vision {

/// Readings that say the same, but for case, accents and thin letters.
struct ReadingVote {
  /// compared_form() of what `best` says.
  std::string form;
  /// The surest of those that say the heaviest of the forms that are alike.
  Reading best;
  int count = 0;
  /// Sum of the squares of their confidences.
  double weight = 0.0;
};

/// The votes of all readings that have a text. A reading with single letters, digits or marks as its first or
/// last words ("Mill Lane 4"), which an arrow beside the name may be, votes for the name alone, where at
/// least as many readings say the name with other ones or none. Forms that differ by the thin letters i, j, l
/// and the digit 1 only
/// ("Kohiplatz", "Kohlplatz") are alike: they are one vote. Any thread.
std::vector<ReadingVote> votes_of_readings(const std::vector<Reading>& readings);

}  // namespace palpable::vision
