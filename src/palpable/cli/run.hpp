// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable::cli {

/// The whole program: parses the arguments, executes one command and returns the process's exit code (0 done,
/// 1 failed, 2 wrong usage, 3 invalid input, 4 device, 130 interrupted). Prints; catches SIGINT, SIGTERM and
/// SIGHUP; the first of them sets Work::cancel. Call once, from the main thread.
int run(int argc, char** argv);

}  // namespace palpable::cli
