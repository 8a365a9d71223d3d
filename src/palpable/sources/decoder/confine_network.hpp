// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable::sources::decoder {

/// Permanently restricts this process, which reads a network stream, and so must be able to open connections:
/// limits of memory and descriptors; no byte is written into a file; no other program is started, no other
/// process is seen, and nobody can connect to it. Of files it reads only what looking up a host's name and
/// trusting a certificate need (Landlock, from Linux 5.13 on; on older kernels, and if it is off, files can
/// be read). Sanitizer builds keep the memory and system calls that the sanitizer needs. Call once, before a
/// connection is opened. False: a limit was refused.
bool confine_to_network(std::uint64_t memory_bytes);

}  // namespace palpable::sources::decoder
