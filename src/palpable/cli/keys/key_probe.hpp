// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/keys/terminal_keys.hpp"
#include "palpable/describe/commentary.hpp"
#include "palpable/describe/found_places.hpp"
#include "palpable/describe/place_words.hpp"
#include "palpable/session/touch/touch_settings.hpp"

#include <cstddef>
#include <string>

namespace palpable::cli {

/// A probe that is moved over a scene by keys, and its spoken output; with the same keys, steps and words as
/// on the page.
class KeyProbe {
 public:
  /// What a key requests from the touch.
  enum class Request {
    nothing,
    pause,
    end,
    zoom_in,
    zoom_out,
    list_names,
    type_name,
    find_name,
    say_way,
    undo_name,
    save
  };

  /// Executes a key. `words`: what to say now, or empty.
  Request press(const TerminalKey& key, const models::Scene& scene, double height_factor, std::string& words);
  /// Moves it to the place where a touch of this scene begins.
  void begin(const models::Scene& scene) { place_ = describe::start_place(scene); }
  /// Where it is, seen from above.
  describe::Place place() const { return place_; }
  /// The hand's position: the centre of the touching ball, on the surface or pressed below it.
  Point<SceneFrame> hand(const models::Scene& scene, const session::TouchSettings& settings) const;

  /// The keys, one line each.
  static std::string help(const models::Scene& scene);

 private:
  std::string move(double dx_m, double dy_m, const models::Scene& scene, double height_factor);
  std::string to_surface(const models::Scene& scene, double height_factor);
  std::string press_by(double further_m, const models::Scene& scene);

  describe::Place place_;
  /// Knows which sentences of names were told.
  describe::Commentary commentary_;
  double press_m_ = kRestingPress_m;
  /// The next part of the description.
  std::size_t next_part_ = 0;
  static constexpr double kRestingPress_m = 0.0015;
};

/// Whether the key moves the probe in the plane. Of several waiting moves, only the last one is described.
bool is_move(const TerminalKey& key);

}  // namespace palpable::cli
