// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace palpable {

/// A text without the names and passwords of its addresses: SCHEME://NAME:PASSWORD@HOST becomes
/// SCHEME://HOST, whatever the scheme, up to the last @ before a blank. For what is shown, logged or
/// recorded.
std::string without_passwords(std::string_view text);

}  // namespace palpable
