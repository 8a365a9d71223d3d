// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/serve.hpp"

int main(int argc, char** argv) {
  palpable::sources::decoder::serve(argc, argv, {palpable::sources::decoder::run_calibration_job});
}
