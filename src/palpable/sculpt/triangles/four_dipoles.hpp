// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace palpable::sculpt {

/// Four groups of triangles seen from afar, in single precision, relative to an origin near them: the first
/// term of the winding number's expansion (Barill et al. 2018), computed for all at once. An unset one has no
/// triangles.
class FourDipoles {
 public:
  static constexpr std::size_t kCount = 4;

  /// Summed area vectors, their centre from the origin, and the distance beyond which the group may be
  /// replaced by them.
  void set(std::size_t lane, Vec3 area_m2, Vec3 centre_m, double far_m) {
    put(area_, lane, area_m2);
    put(centre_, lane, centre_m);
    far2_[lane] = static_cast<float>(far_m * far_m);
  }

  struct Seen {
    /// The far groups' solid angles, summed; near ones count as 0.
    float far_angle = 0.0F;
    /// Bit k: group k is near.
    unsigned near = 0;
  };
  /// `p`: from the origin.
  Seen seen_from(const std::array<float, 3>& p) const {
    const Triple way{centre_[0] - p[0], centre_[1] - p[1], centre_[2] - p[2]};
    const Four distance2 = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
    const Four height = area_[0] * way[0] + area_[1] * way[1] + area_[2] * way[2];
    Seen seen;
    for (std::size_t lane = 0; lane < kCount; ++lane) {
      if (distance2[lane] <= far2_[lane])
        seen.near |= 1U << lane;
      else
        seen.far_angle += height[lane] / (distance2[lane] * std::sqrt(distance2[lane]));
    }
    return seen;
  }

 private:
  /// Of GCC and Clang: one register, every operation on all four.
  using Four = float __attribute__((vector_size(kCount * sizeof(float))));
  using Triple = std::array<Four, 3>;
  static void put(Triple& t, std::size_t lane, Vec3 v) {
    t[0][lane] = static_cast<float>(v.x);
    t[1][lane] = static_cast<float>(v.y);
    t[2][lane] = static_cast<float>(v.z);
  }

  static constexpr float kFar = 1e9F;
  Triple area_{};
  Triple centre_{Four{kFar, kFar, kFar, kFar}, Four{}, Four{}};
  /// Below 0: never near.
  Four far2_{-1.0F, -1.0F, -1.0F, -1.0F};
};

}  // namespace palpable::sculpt
