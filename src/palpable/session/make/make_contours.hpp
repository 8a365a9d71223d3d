// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/make/make_scene.hpp"

namespace palpable::session {

/// The boundaries of one picture, as a map to trace and as grooves. A picture of more than four million
/// pixels is reduced first, with a note: 2000 pixels across a hand's breadth are finer than a finger. Errors:
/// as make_scene().
Result<MadeScene> contours_from_picture(const MakeOptions& options, const Work& work);

}  // namespace palpable::session
