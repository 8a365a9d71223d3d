// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace palpable::session {

/// What a person may change while touching. Values that are not set come from the scene's materials or the
/// law; the device's own limits lower them, and TouchSession::notices() says so.
struct TouchSettings {
  /// rolling, sobel, penalty, averaged, proxy, grid, tracing or groove. A device with two degrees of freedom
  /// feels `rolling` instead of laws that need the third.
  std::string law = "proxy";
  /// N/m; for rolling and sobel k_g in newtons.
  std::optional<double> stiffness;
  std::optional<double> damping_Ns_per_m;
  std::optional<double> static_friction;
  std::optional<double> dynamic_friction;
  double probe_radius_m = 0.001;
  /// The relief's height is multiplied by this; 0…4, negative engraves: -4…4.
  double depth = 1.0;

  bool operator==(const TouchSettings&) const = default;
};

}  // namespace palpable::session
