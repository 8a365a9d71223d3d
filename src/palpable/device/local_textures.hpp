// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace palpable::device {

/// A texture that surfaces name by its number (LaidTexture), in the terms of models::TouchTexture, which
/// describes the values and their ranges.
struct LocalTexture {
  /// 1 to kMostTextures.
  std::uint16_t number = 0;
  std::uint8_t kind = 0;
  double pitch_m = 0.0;
  double height_m = 0.0;
  double angle_rad = 0.0;
  std::vector<float> tile = {};

  bool operator==(const LocalTexture&) const = default;
};

/// The textures of a scene, for a device that renders surfaces itself. Any thread; not for the tick path.
class LocalTextures {
 public:
  struct List {
    /// Advanced by each put().
    std::uint32_t version = 0;
    std::vector<LocalTexture> textures;
  };
  void put(std::vector<LocalTexture> textures) {
    const std::lock_guard lock(mutex_);
    list_ = {list_.version + 1, std::move(textures)};
  }
  List list() const {
    const std::lock_guard lock(mutex_);
    return list_;
  }
  std::uint32_t version() const {
    const std::lock_guard lock(mutex_);
    return list_.version;
  }

 private:
  mutable std::mutex mutex_;
  List list_;
};

}  // namespace palpable::device
