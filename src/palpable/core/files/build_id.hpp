// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace palpable {

/// The identifier that the linker gave to the running program: a hash of its content, in hexadecimal (the ELF
/// note .note.gnu.build-id, which `file` and `readelf -n` print). Empty if it has none.
std::string build_id();

}  // namespace palpable
