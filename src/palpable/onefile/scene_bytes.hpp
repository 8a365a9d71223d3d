// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::onefile {

/// A scene without its pictures, as bytes that are read without any outside library. Only the program that
/// wrote them reads them: they are inside one page together with it. The scene must be valid
/// (formats::check_scene()). Deterministic.
std::vector<std::byte> encode_scene_bytes(const models::Scene& scene);

/// The same scene, whose model gives the same forces bit by bit. Errors: invalid_input for bytes that are
/// damaged, cut off or of another version, before more memory is taken than they can fill.
Result<models::Scene> decode_scene_bytes(std::span<const std::byte> bytes);

}  // namespace palpable::onefile
