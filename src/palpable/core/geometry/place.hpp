// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable {

/// A place seen from above, scene frame, metres.
struct Place {
  double x_m = 0.0;
  double y_m = 0.0;
  bool operator==(const Place&) const = default;
};

}  // namespace palpable
