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

/// A reply in the layout of isolated/flat.hpp: its head, then its body, which may be empty. In two parts, so
/// that the samples of a picture are not copied once more.
struct ReplyBytes {
  std::vector<std::byte> head, body;
};

/// Runs a job and returns its reply: the decoded value or an error. It may crash or hang on a malicious file:
/// only for the decoder process and the fuzzers.
ReplyBytes run(isolated::Job job, std::span<const std::byte> file);

}  // namespace palpable::sources::decoder
