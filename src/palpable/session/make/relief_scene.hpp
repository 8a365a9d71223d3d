// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/make/make_scene.hpp"

#include <string>

namespace palpable::session {

/// A scene that is this relief, made from options.inputs by `method`. `width` and `height` are the input
/// picture's, px.
models::Scene relief_scene(models::Relief relief, const MakeOptions& options, int width, int height,
                           std::string method);

}  // namespace palpable::session
