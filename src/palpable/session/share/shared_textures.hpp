// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/local_textures.hpp"
#include "palpable/haptics/effect/texture.hpp"
#include "palpable/models/material/material.hpp"

#include <cstdint>
#include <mutex>
#include <vector>

namespace palpable::session {

/// The textures that came from another computer, for the law of this one's loop. Any thread; not for the tick
/// path.
class SharedTextures {
 public:
  /// False: no such texture; nothing is changed.
  bool put(const device::LocalTexture& texture);
  /// Advanced by each put().
  std::uint32_t version() const;
  haptics::Textures textures() const;
  /// haptics::texture_stiffening() of the texture with this number; 1 for 0 and for unknown ones.
  double stiffening(std::uint16_t number) const;

 private:
  mutable std::mutex mutex_;
  std::uint32_t version_ = 0;
  /// By the number less one.
  std::vector<models::Material> materials_;
};

}  // namespace palpable::session
