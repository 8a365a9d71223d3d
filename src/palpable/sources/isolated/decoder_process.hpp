// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/child_process.hpp"

#include <chrono>
#include <optional>

#include <sys/types.h>

namespace palpable::sources::isolated {

/// How a decoder process ended.
struct DecoderEnd {
  /// Whether it had reported that it begins to read: what happened before is no fault of the file.
  bool began = false;
  /// False if it was ended from here: it ran too long, or neither computed nor waited for the processor for
  /// kIdlePatience.
  bool in_time = true;
  /// Its status (waitpid()), if the system reported one.
  std::optional<int> status;
};

/// A decoder waits for nothing and nobody, so one that rests hangs.
inline constexpr std::chrono::seconds kIdlePatience{10};

/// Waits until `process`, the leader of its process group, has ended; ends the group if it takes longer than
/// `time` or rests for kIdlePatience, whatever the program does: it may be another one than the decoder that
/// was built. `alive` is the reading end of the pipe on which it reports.
DecoderEnd wait_for_end(pid_t process, Descriptor alive, std::chrono::seconds time);

}  // namespace palpable::sources::isolated
