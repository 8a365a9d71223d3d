// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

// The protocol between the two processes. Arguments of a decoder program: the version, the job's name, bytes
// of memory, bytes of the reply, seconds of processor time.
namespace palpable::sources::isolated {

/// Must change with every change of the constants below or of a reply's layout.
inline constexpr std::string_view kProtocolVersion = "3";

// Descriptors with which the decoder process starts; all others are closed.
inline constexpr int kInputDescriptor = 3;
inline constexpr int kReplyDescriptor = 4;
/// A pipe that is open while the process lives. It writes one byte when it has limited itself and begins to
/// read the file: an end before that is no fault of the file.
inline constexpr int kAliveDescriptor = 5;

// Exit codes of the decoder process; with kReplied there is a reply, which may be an error.
inline constexpr int kReplied = 0;
inline constexpr int kWrongVersion = 10;
inline constexpr int kNotConfined = 11;
inline constexpr int kNotWritten = 12;
inline constexpr int kNoInput = 13;
inline constexpr int kNoThread = 14;

}  // namespace palpable::sources::isolated
