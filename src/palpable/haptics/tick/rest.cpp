// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/rest.hpp"

namespace palpable::haptics {

void RestDetector::update(const TouchSample& sample, double dt_s) noexcept {
  if (is_same(sample)) {
    rested_s_ += dt_s;
    return;
  }
  began_ = sample;
  rested_s_ = 0.0;
}

bool RestDetector::is_same(const TouchSample& sample) const noexcept {
  return sample.status == began_.status && sample.flags == began_.flags && sample.label == began_.label &&
         sample.buttons == began_.buttons && sample.scene_id == began_.scene_id &&
         norm(sample.position - began_.position) < kMoved_m &&
         norm(sample.written_force_N - began_.written_force_N) < kForce_N;
}

}  // namespace palpable::haptics
