// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable::vision {

/// The papers' stereo methods and our own (docs/stereo.md); their options are in methods/.
enum class StereoMethod { scanline, graph_cut, segments, pyramid, fast, best };

}  // namespace palpable::vision
