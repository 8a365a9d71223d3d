// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace palpable::formats {

/// Where on a drawing there is room for labels beside its lines. Lengths in metres; the origin is the middle
/// of the drawing, x right, y up.
class LabelSpace {
 public:
  /// Labels keep `gap_m` from their own line and one and a half times as far from others.
  LabelSpace(double width_m, double height_m, double gap_m);

  /// A line of this half width belongs to the owner; call it for all lines first.
  void add_line(const Polyline& line, double half_width_m, std::size_t owner);
  /// Nothing may be at that place.
  void block(Vec3 middle, double width_m, double height_m);

  /// The middle of a free box beside one of the owner's lines, tried from the middle of the longest one
  /// outwards. The box is taken then. nullopt if there is no room.
  std::optional<Vec3> take_room(const std::vector<Polyline>& lines, double half_width_m, std::size_t owner,
                                double box_width_m, double box_height_m);

  /// The middle of the free box that is nearest to a place, at most `reach_m` away, and that `accepts` its
  /// middle. The box is taken then. nullopt if there is none.
  std::optional<Vec3> take_room_near(Vec3 at, double reach_m, double box_width_m, double box_height_m,
                                     const std::function<bool(Vec3)>& accepts);

 private:
  /// Without an owner the box keeps `gap_m` from all lines.
  bool is_free(Vec3 middle, double width_m, double height_m, std::optional<std::size_t> owner) const;
  template <class Visit>
  bool all_in(Vec3 middle, double width_m, double height_m, const Visit& visit) const;

  double width_m_, height_m_, gap_m_;
  /// 0: free; -1: taken or near several lines; else near the line of that owner, plus one.
  Raster<std::int32_t> near_;
  Raster<std::uint8_t> taken_;
};

}  // namespace palpable::formats
