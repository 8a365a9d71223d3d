// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace palpable {

/// Bytes in base 64 with padding (RFC 4648, section 4), as data: addresses hold them.
std::string base64(std::span<const std::byte> bytes);

}  // namespace palpable
