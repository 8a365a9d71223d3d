// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

/// For tests: the tick pipeline of a law with a scripted device.
struct Loop {
  explicit Loop(std::shared_ptr<const Touchable> touchable, const TickOptions& options = {}) {
    program.touchable = std::move(touchable);
    tick = std::make_unique<TickPipeline>(device, program, options, events);
  }
  const TouchSample& run(int ticks) {
    for (int i = 0; i < ticks; ++i) sample = &tick->step(kT_s * static_cast<double>(n++), kT_s);
    return *sample;
  }
  Vec3 written() const { return device.written.back(); }
  int count(TouchEvent::Kind kind) {
    int found = 0;
    while (const auto event = events.take()) found += event->kind == kind ? 1 : 0;
    return found;
  }

  ScriptedDevice device;
  HapticScene program;
  Ring<TouchEvent> events{1024};
  std::unique_ptr<TickPipeline> tick;
  const TouchSample* sample = nullptr;
  std::int64_t n = 0;
};

inline std::shared_ptr<const Touchable> plane(double stiffness = 500.0, std::uint64_t family = 1) {
  return std::make_shared<SpringSurface>(flat, stiffness, 0.0, family);
}

}  // namespace palpable::haptics
