// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/terminal_keys.hpp"
#include "palpable/describe/place_words.hpp"
#include "palpable/session/touch/touch_settings.hpp"

#include <cstddef>
#include <string>

namespace palpable::cli {

/// A probe that keys move over a scene, and what is said of it; the same keys, steps and words as on the
/// page.
class KeyExplorer {
 public:
  /// What the key means for the touch around it.
  enum class Request { nothing, pause, end };

  /// Carries the key out. `words`: what to say now, or empty.
  Request press(const TerminalKey& key, const models::Scene& scene, double depth, std::string& words);
  /// Where the hand is: the middle of the ball that touches, at rest on the surface or pressed below it.
  Point<SceneFrame> hand(const models::Scene& scene, const session::TouchSettings& settings) const;

  /// The keys, a line each.
  static std::string help(const models::Scene& scene);

 private:
  std::string move(double dx_m, double dy_m, const models::Scene& scene, double depth);
  std::string press_by(double depth_m, const models::Scene& scene);

  describe::Place place_;
  double press_m_ = kRestingPress_m;
  /// The part of the description that comes next.
  std::size_t next_part_ = 0;
  static constexpr double kRestingPress_m = 0.0015;
};

/// Whether the key moves the probe in the plane: of several that wait, the words of the last one say enough.
bool is_move(const TerminalKey& key);

}  // namespace palpable::cli
