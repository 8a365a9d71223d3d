// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/isolated/isolated.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::sources::decoder {

/// Loads what a job needs from the disk before the process is restricted: plug-ins of its library.
void prepare(isolated::Job job);

/// The reply to a job: the decoded value or an error, as isolated/flat.hpp lays it out. May crash or hang on
/// a hostile file: only for the decoder process and the fuzzers.
std::vector<std::byte> run(isolated::Job job, std::span<const std::byte> file);

}  // namespace palpable::sources::decoder
