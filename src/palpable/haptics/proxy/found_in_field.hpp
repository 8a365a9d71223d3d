// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/field/field_window.hpp"

namespace palpable::haptics {

/// What the queries of a touch found of its solid, which spares later ones a search or an evaluation. It
/// changes no result, so a tick can take it from its rehearsal (rehearsal.hpp). All zero, or
/// default-initialised = nothing is known.
struct FoundInField {
  /// The leaves at the proxy.
  models::FieldWindow window;
  /// A ball that is inside the solid: a hand in it needs no evaluation to know that it is not in the air.
  Vec3 inside_at_m;
  double inside_m = 0.0;
};

}  // namespace palpable::haptics
