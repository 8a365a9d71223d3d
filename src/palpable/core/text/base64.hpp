// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable {

/// Bytes in base 64 with padding (RFC 4648, section 4), as data: addresses hold them.
std::string base64(std::span<const std::byte> bytes);

/// The bytes of such a text; nullopt for another length than a multiple of 4, a character that is no digit,
/// or padding elsewhere than at the end.
std::optional<std::vector<std::byte>> from_base64(std::string_view text);

}  // namespace palpable
