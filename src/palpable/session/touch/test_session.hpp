// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/touch/headless.hpp"

#include <cmath>
#include <memory>
#include <utility>

// Helpers for tests of touches without the page.
namespace palpable::session {

/// A relief of 100 x 80 mm with smooth hills of height 0 to `height_m`.
inline models::Scene hilly_scene(double height_m) {
  Raster<float> samples(100, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x)
      samples(x, y) = static_cast<float>(height_m * (1.0 + std::sin(0.15 * x) * std::cos(0.11 * y)) / 2.0);
  auto relief = models::Relief::from_samples(std::move(samples), 0.001);
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(std::move(*relief));
  return scene;
}

/// A relief of samples 1 mm apart and 1 mm high.
inline models::Scene flat_scene(int columns, int rows) {
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(columns, rows, 0.001F), 0.001));
  return scene;
}

/// Options that need no privileges: no real-time priority, no locked memory.
inline HeadlessOptions unprivileged(double seconds) {
  HeadlessOptions options;
  options.seconds = seconds;
  options.session.servo.realtime_priority = 0;
  options.session.servo.memory = haptics::Memory::leave;
  return options;
}

}  // namespace palpable::session
