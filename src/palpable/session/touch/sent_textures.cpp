// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/sent_textures.hpp"

#include "palpable/device/local_surface.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace palpable::session {

std::vector<device::LocalTexture> sent_textures(const std::vector<models::Material>& materials) {
  std::vector<device::LocalTexture> list;
  const std::size_t count = std::min<std::size_t>(materials.size(), device::kMostTextures);
  for (std::size_t label = 0; label < count; ++label) {
    const models::TouchTexture& texture = materials[label].texture;
    if (texture.kind != models::TouchTexture::Kind::none)
      list.push_back({static_cast<std::uint16_t>(label + 1), static_cast<std::uint8_t>(texture.kind),
                      texture.pitch_m, texture.height_m, texture.angle_rad, texture.tile});
  }
  return list;
}

}  // namespace palpable::session
