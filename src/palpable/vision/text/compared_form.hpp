// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace palpable::vision {

/// The letters and digits of a name, without case, accents, blanks and marks: what is compared. Letters
/// outside Latin stay as they are (UTF-8).
std::string compared_form(std::string_view name);

}  // namespace palpable::vision
