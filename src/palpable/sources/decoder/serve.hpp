// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/decoder/jobs.hpp"

namespace palpable::sources::decoder {

/// What a decoder program does: its libraries make its start long, so each kind of file has its own program.
struct Decoder {
  RunJob run = nullptr;
  /// Loads plug-ins from the disk before the process is restricted; nullptr: there are none.
  void (*prepare)() = nullptr;
};

/// The whole of a decoder program: restricts this process (confine.hpp), runs the job that the arguments name
/// (isolated/protocol.hpp), and ends with an exit code of the protocol, without running destructors.
[[noreturn]] void serve(int argc, char** argv, const Decoder& decoder);

}  // namespace palpable::sources::decoder
