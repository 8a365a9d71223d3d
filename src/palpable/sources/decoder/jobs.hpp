// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/isolated/isolated.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::sources::decoder {

/// Loads a job's plug-ins from the disk before the process is restricted.
void prepare(isolated::Job job);

/// Runs a job and returns its reply: the decoded value or an error, in the layout of isolated/flat.hpp. It
/// may crash or hang on a malicious file: only for the decoder process and the fuzzers.
std::vector<std::byte> run(isolated::Job job, std::span<const std::byte> file);

}  // namespace palpable::sources::decoder
