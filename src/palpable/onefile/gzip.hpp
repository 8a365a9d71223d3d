// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::onefile {

/// One gzip member (RFC 1952) with the bytes' CRC-32, without a name or time: browsers unpack it, and detect
/// damage.
std::vector<std::byte> gzip(std::span<const std::byte> bytes);

}  // namespace palpable::onefile
