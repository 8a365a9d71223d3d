// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/isolated/isolated.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources::decoder {

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

/// Runs a job and puts its reply: the decoded value or an error. False if the reply was not taken, or the job
/// is another program's. It may throw, crash or hang on a malicious file: only for the decoder programs and
/// the fuzzers.
using RunJob = bool (*)(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);

// One function per decoder program.
bool run_calibration_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);
bool run_heif_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);
bool run_map_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);
bool run_mesh_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);
bool run_picture_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);
bool run_video_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply);

/// Runs a job; an exception becomes an error in the reply, but for the std::system_error that the system
/// gives no further thread, which is thrown on.
bool run_guarded(RunJob run, isolated::Job job, std::span<const std::byte> file, ReplySink& reply);

}  // namespace palpable::sources::decoder
