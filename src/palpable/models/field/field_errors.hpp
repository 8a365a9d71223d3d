// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable::models {

/// The builder's error bound and its measured errors, stored with the field.
struct FieldErrors {
  /// The bound near the surface where the distance is smooth; 0 if there is none.
  double bound_m = 0.0;
  /// At random places near the surface: 99th percentile and greatest.
  double p99_m = 0.0;
  double max_m = 0.0;
};

}  // namespace palpable::models
