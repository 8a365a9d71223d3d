// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/local_textures.hpp"
#include "palpable/models/material/material.hpp"

#include <vector>

namespace palpable::session {

/// The textures of prepared materials, as they are sent to a device that renders surfaces itself.
std::vector<device::LocalTexture> sent_textures(const std::vector<models::Material>& materials);

}  // namespace palpable::session
