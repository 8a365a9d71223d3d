// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/isolated/isolated.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources::decoder {

/// Loads a job's plug-ins from the disk before the process is restricted.
void prepare(isolated::Job job);

/// Takes a reply in the layout of isolated/flat.hpp, part by part, so that a picture's samples are never kept
/// as a whole.
class ReplySink {
 public:
  ReplySink() = default;
  virtual ~ReplySink() = default;
  ReplySink(const ReplySink&) = delete;
  ReplySink& operator=(const ReplySink&) = delete;

  /// False if no more is taken.
  virtual bool put(std::span<const std::byte> part) = 0;
  /// Forgets what was put, for an error that takes its place. False if it cannot.
  virtual bool restart() = 0;
};

/// Runs a job and puts its reply: the decoded value or an error. False if the reply was not taken. It may
/// crash or hang on a malicious file: only for the decoder process and the fuzzers.
bool run(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);

}  // namespace palpable::sources::decoder
