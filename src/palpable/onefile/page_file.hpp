// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <string>

namespace palpable::onefile {

/// One page, complete in itself: the scene, its picture and words, and the models and laws that touch it.
/// Errors: failed, if this program was built without emscripten, with what to do; those of the picture's
/// encoders.
Result<std::string> encode_page(const models::Scene& scene);

}  // namespace palpable::onefile
