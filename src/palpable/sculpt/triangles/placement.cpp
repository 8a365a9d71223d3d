// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace palpable::sculpt {
namespace {

/// Far beyond any solid, and far from where its scale overflows.
constexpr double kLeastExtent_m = 1e-12;
constexpr double kMostExtent_m = 1e15;

bool along_one_axis(AxisDirection a, AxisDirection b) { return dot(unit_vector(a), unit_vector(b)) != 0.0; }

Vec3 rotated(const std::array<double, 9>& r, Vec3 p) {
  return {r[0] * p.x + r[1] * p.y + r[2] * p.z, r[3] * p.x + r[4] * p.y + r[5] * p.z,
          r[6] * p.x + r[7] * p.y + r[8] * p.z};
}

bool is_map(Vec3 upright_size, double level, const PlacementOptions& options) {
  return upright_size.y < options.map_height * std::min(upright_size.x, upright_size.z) &&
         level >= options.map_level;
}

Lay automatic_lay(Vec3 upright_size, double level, const PlacementOptions& options) {
  const bool is_plate = upright_size.y < options.plate_height * std::min(upright_size.x, upright_size.z);
  return is_plate || is_map(upright_size, level, options) ? Lay::flat : Lay::upright;
}

/// Whether a solid is near enough to the origin to be found by a hand that starts above the origin.
bool lies_about_origin(const Box& box, const PlacementOptions& options) {
  const Vec3 extent = box.size_m(), middle = 0.5 * (box.least_m + box.most_m);
  const double most_m = options.most_off_centre * std::max({extent.x, extent.y, extent.z});
  return std::max(std::abs(middle.x), std::abs(middle.y)) <= most_m && std::abs(middle.z) <= 2.0 * most_m;
}

}  // namespace

AxisDirection front_of(AxisDirection up) {
  switch (up) {
    case AxisDirection::plus_z:
      return AxisDirection::minus_y;
    case AxisDirection::minus_z:
      return AxisDirection::plus_y;
    default:
      return AxisDirection::plus_z;
  }
}

bool suits_a_hand(Vec3 extent_m, const PlacementOptions& options) {
  const double longest_m = std::max({extent_m.x, extent_m.y, extent_m.z});
  return longest_m >= options.least_side_m && longest_m <= options.most_side_m;
}

double level_share(const Mesh& mesh, AxisDirection up) {
  double level = 0.0, area = 0.0;
  for (const auto& t : mesh.triangles) {
    const bool is_valid = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return v < mesh.vertices_m.size() && is_finite(mesh.vertices_m[v]);
    });
    if (!is_valid) continue;
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 doubled = cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    level += std::abs(dot(doubled, unit_vector(up)));
    area += norm(doubled);
  }
  return area > 0.0 ? level / area : 0.0;
}

std::vector<Parameter> parameters_of(PlacementOptions& o) {
  return {
      {"plate_height", &o.plate_height, {0.0, 1.0}, "", "greatest height of a plate over its width"},
      {"map_height", &o.map_height, {0.0, 1.0}, "", "greatest height of a map over its width"},
      {"map_level", &o.map_level, {0.0, 1.0}, "", "least share of a map's surface that is level"},
      {"least_side_m", &o.least_side_m, {0.001, 1.0}, "m", "longest side of the smallest solid for a hand"},
      {"most_side_m", &o.most_side_m, {0.001, 1.0}, "m", "longest side of the largest solid for a hand"},
      {"most_off_centre",
       &o.most_off_centre,
       {0.0, 10.0},
       "",
       "distance from the origin over the longest side beyond which a solid is centred"}};
}

std::array<double, 9> turn_towards_person(AxisDirection towards, AxisDirection up) {
  const Vec3 z = unit_vector(towards);
  const Vec3 y = along_one_axis(towards, up) ? -unit_vector(front_of(up)) : unit_vector(up);
  const Vec3 x = cross(y, z);
  return {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
}

Box turned(const Box& box, const std::array<double, 9>& rotation) {
  const Vec3 a = rotated(rotation, box.least_m);
  Box out{a, a};
  out.grow(rotated(rotation, box.most_m));
  return out;
}

Transform<SceneFrame, models::InputFrame> fitted(const Box& box, const std::array<double, 9>& rotation,
                                                 Vec3 size_m) {
  const Box lying = turned(box, rotation);
  const Vec3 extent = lying.size_m();
  double scale = std::numeric_limits<double>::max();
  for (const auto& [have, want] :
       {std::pair(extent.x, size_m.x), std::pair(extent.y, size_m.y), std::pair(extent.z, size_m.z)})
    if (have > 0.0) scale = std::min(scale, want / have);
  Transform<SceneFrame, models::InputFrame> transform;
  transform.rotation = rotation;
  transform.scale = scale;
  const Vec3 middle = 0.5 * (lying.least_m + lying.most_m);
  transform.translation_m = -scale * Vec3{middle.x, middle.y, lying.least_m.z};
  return transform;
}

Result<void> check_size_m(Vec3 size_m) {
  for (const double side : {size_m.x, size_m.y, size_m.z})
    if (!(side >= 0.001 && side <= 1.0))
      return Error{ErrorCode::usage, "the size's sides must be 1 to 1000 mm", {}};
  return {};
}

Result<Placement> placement_of(const Box& box, const PlacementOptions& options, double level) {
  const Vec3 extent = box.size_m();
  if (!is_finite(box.least_m) || !is_finite(box.most_m) || !(norm(extent) > 0.0))
    return invalid_input("is a solid without a finite extent");
  if (norm(extent) < kLeastExtent_m || norm(extent) > kMostExtent_m)
    return invalid_input(
        "is a solid whose extent is below 1e-12 or above 1e15 of its units: save it in another unit");
  if (options.size_m)
    if (const auto valid = check_size_m(*options.size_m); !valid) return valid.error();
  if (const auto valid = check_ranges(options); !valid) return valid.error();
  Placement placement;
  placement.up = options.up.value_or(options.convention.up);
  // Where the axes stay as they are.
  const bool towards_person = along_one_axis(placement.up, AxisDirection::plus_z);
  placement.lay = towards_person ? Lay::flat : Lay::upright;
  const bool nothing_asked = !options.size_m && !options.up && options.lay == Lay::automatic;
  if (nothing_asked && options.default_size == DefaultSize::own) return placement;
  const auto upright = turn_towards_person(front_of(placement.up), placement.up),
             flat = turn_towards_person(placement.up, placement.up);
  const Vec3 upright_size = turned(box, upright).size_m();
  if (nothing_asked && suits_a_hand(extent, options)) {
    if (!towards_person && is_map(upright_size, level, options)) {
      placement.fitted = placement.moved = true;
      placement.lay = Lay::flat;
      placement.scene_from_input = fitted(box, flat, turned(box, flat).size_m());
      return placement;
    }
    if (lies_about_origin(box, options)) return placement;
    placement.fitted = placement.moved = true;
    const Vec3 middle = 0.5 * (box.least_m + box.most_m);
    placement.scene_from_input.translation_m = -Vec3{middle.x, middle.y, box.least_m.z};
    return placement;
  }
  placement.lay = options.lay == Lay::automatic ? automatic_lay(upright_size, level, options) : options.lay;
  const auto rotation = placement.lay == Lay::upright ? upright : flat;
  placement.fitted = true;
  placement.scene_from_input = fitted(box, rotation, options.size_m.value_or(kWorkingVolume_m));
  return placement;
}

}  // namespace palpable::sculpt
