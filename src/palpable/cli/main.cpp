// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/run.hpp"

int main(int argc, char** argv) { return palpable::cli::run(argc, argv); }
