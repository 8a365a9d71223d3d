// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/tick/servo_types.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace palpable::haptics {

/// Every scene that a servo may still use. One thread at a time.
class KeptScenes {
 public:
  using Released = std::vector<std::unique_ptr<const HapticScene>>;

  const HapticScene& keep(HapticScene scene) {
    scenes_.push_back(std::make_unique<const HapticScene>(std::move(scene)));
    return *scenes_.back();
  }
  const HapticScene& first() const { return *scenes_.front(); }
  /// Moves a scene that the servo no longer uses to the end of `out`, whose destruction may take long: models
  /// may be large.
  void release(const HapticScene* old, Released& out) {
    const auto found =
        std::find_if(scenes_.begin(), scenes_.end(), [&](const auto& p) { return p.get() == old; });
    if (found == scenes_.end()) return;
    out.push_back(std::move(*found));
    scenes_.erase(found);
  }

 private:
  std::vector<std::unique_ptr<const HapticScene>> scenes_;
};

}  // namespace palpable::haptics
