// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/proxy_force.hpp"

namespace palpable::haptics {

/// What a touch takes along to another surface or law: where its proxy held the hand, and how.
struct HandOver {
  /// The proxy holds the hand at `place`; false: there is nothing to take along.
  bool touching = false;
  bool slipping = false;
  Point<SceneFrame> place;
  /// The hand in the last tick.
  Point<SceneFrame> hand;
  ContactMemory memory;
};

}  // namespace palpable::haptics
