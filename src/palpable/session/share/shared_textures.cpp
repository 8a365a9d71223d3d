// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/share/shared_textures.hpp"

#include "palpable/device/local_surface.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace palpable::session {

bool SharedTextures::put(const device::LocalTexture& texture) {
  models::TouchTexture own;
  own.kind = static_cast<models::TouchTexture::Kind>(texture.kind);
  own.pitch_m = texture.pitch_m;
  own.height_m = texture.height_m;
  own.angle_rad = texture.angle_rad;
  own.tile = texture.tile;
  const bool is_known =
      own.kind > models::TouchTexture::Kind::none && own.kind <= models::TouchTexture::Kind::picture;
  const bool is_numbered = texture.number > 0 && texture.number <= device::kMostTextures;
  if (!is_known || !is_numbered || !models::is_valid(own)) return false;
  const std::lock_guard lock(mutex_);
  materials_.resize(std::max<std::size_t>(materials_.size(), texture.number));
  materials_[texture.number - 1U].texture = std::move(own);
  ++version_;
  return true;
}

std::uint32_t SharedTextures::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

haptics::Textures SharedTextures::textures() const {
  const std::lock_guard lock(mutex_);
  return haptics::Textures(materials_);
}

double SharedTextures::stiffening(std::uint16_t number) const {
  const std::lock_guard lock(mutex_);
  return number > 0 && number <= materials_.size()
             ? haptics::texture_stiffening(materials_[number - 1U].texture)
             : 1.0;
}

}  // namespace palpable::session
