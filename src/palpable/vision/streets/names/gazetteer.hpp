// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/vision/text/compared_form.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::vision {

/// Greatest number of names in a gazetteer, and of bytes in a name; longer lines are skipped.
inline constexpr std::size_t kMaxNames = 1'000'000, kMaxNameBytes = 200;

/// The lines of a text that are not empty. Errors (invalid_input, without a place): no names, or more than
/// kMaxNames.
Result<std::vector<std::string>> parse_gazetteer(std::string_view text);

/// One minus the edit distance (core/text/edit_distance.hpp) of two compared forms, as a part of the longer
/// one's bytes; 0 ... 1, and 0 if both are empty.
double similarity_of(std::string_view a, std::string_view b);

/// The name of a gazetteer that is most similar to what was read; nullopt if none is as similar as `least`.
std::optional<std::string> nearest_name(std::string_view read, std::span<const std::string> gazetteer,
                                        double least);

}  // namespace palpable::vision
