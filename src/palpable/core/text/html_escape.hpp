// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace palpable {

/// The text with the four characters that mean something in HTML replaced, for text and quoted attributes.
std::string html_escaped(std::string_view text);

}  // namespace palpable
