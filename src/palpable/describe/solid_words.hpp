// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/scene/scene.hpp"

#include <string>
#include <vector>

namespace palpable::describe {

/// A solid as the user meets it.
struct SolidView {
  /// Its surface towards the user.
  const models::Relief* surface = nullptr;
  /// Where its box begins along z, metres, and the size of that box.
  double base_m = 0.0;
  Vec3 size_m;
  models::SolidPose pose = models::SolidPose::upright;
  /// The middle of that box; regions and offsets are relative to it.
  Place middle = {};
  /// The place of the surface's own origin.
  Place surface_at = {};
};

/// Describes a solid in three parts. First: `heading` (the name with a full stop), size, what is seen of it
/// (pieces, outline, openings), parts, and the place nearest to the user, which is the highest one of a
/// flat solid. Second: the offset from `probe` to that place, and each part and opening. Third: mean heights
/// of nine parts of its box. Heights are above the solid's base, or for an upright solid from its back.
std::vector<std::string> solid_parts(const SolidView& solid, const std::string& heading, Place probe);

}  // namespace palpable::describe
