// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace palpable::vision {

/// The letters and digits of a name, without case, accents, blanks and marks: what is compared. Letters
/// outside Latin stay as they are (UTF-8).
std::string compared_form(std::string_view name);

/// One minus the edit distance (core/text/edit_distance.hpp) of two compared forms, as a part of the longer
/// one's bytes; 0 ... 1, and 0 if both are empty.
double similarity_of(std::string_view a, std::string_view b);

/// The name of a gazetteer that is most similar to what was read; nullopt if none is as similar as `least`.
std::optional<std::string> nearest_name(std::string_view read, std::span<const std::string> gazetteer,
                                        double least);

}  // namespace palpable::vision
