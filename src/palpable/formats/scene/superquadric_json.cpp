// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/superquadric_json.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/scene/vec3_json.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostShapes = 256;

}  // namespace

Json json_of(const models::Superquadric& s) {
  const Vec3 t = s.scene_from_shape.translation_m;
  return {{"type", "superquadric"},        {"size_m", {s.size_m.x, s.size_m.y, s.size_m.z}},
          {"exponents", {s.e1, s.e2}},     {"rotation", models::quaternion_of(s.scene_from_shape.rotation)},
          {"position_m", {t.x, t.y, t.z}}, {"taper", {s.taper_x, s.taper_y}},
          {"bend", s.bend_per_m},          {"bend_angle_rad", s.bend_angle_rad}};
}

Result<models::Superquadric> superquadric_from(const Json& json) {
  if (json.value("type", "superquadric") != "superquadric")
    return invalid_input("only superquadrics are known as primitives");
  for (const char* key : {"size_m", "exponents", "position_m"})
    if (!json.contains(key)) return invalid_input(std::string("lacks ") + key);
  models::Superquadric s;
  s.size_m = vec3_from(json.at("size_m"));
  const auto exponents = json.at("exponents").get<std::array<double, 2>>();
  s.e1 = exponents[0], s.e2 = exponents[1];
  const auto taper = json.value("taper", std::array<double, 2>{0.0, 0.0});
  s.taper_x = taper[0], s.taper_y = taper[1];
  s.bend_per_m = json.value("bend", 0.0);
  s.bend_angle_rad = json.value("bend_angle_rad", 0.0);
  auto q = json.value("rotation", std::array<double, 4>{1.0, 0.0, 0.0, 0.0});
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(length - 1.0) < 1e-3)) return invalid_input("a rotation must be a unit quaternion");
  for (double& v : q) v /= length;
  s.scene_from_shape.rotation = models::rotation_of(q);
  s.scene_from_shape.translation_m = vec3_from(json.at("position_m"));
  if (const auto valid = models::check_superquadric(s); !valid) return valid.error();
  return s;
}

Result<std::vector<models::Superquadric>> superquadrics_from(const Json& json) {
  const Json& list = json.at("primitives");
  if (!list.is_array() || list.empty() || list.size() > kMostShapes)
    return invalid_input("must hold 1 to 256 primitives");
  std::vector<models::Superquadric> shapes;
  for (const Json& one : list) {
    auto shape = superquadric_from(one);
    if (!shape)
      return invalid_input("primitive " + std::to_string(shapes.size() + 1) + ": " + shape.error().message);
    shapes.push_back(std::move(*shape));
  }
  return shapes;
}

Result<std::vector<models::Superquadric>> decode_superquadrics(std::span<const std::byte> file) {
  try {
    return superquadrics_from(Json::parse(as_text(file)));
  } catch (const Json::parse_error& e) {
    return invalid_input("is no JSON from byte " + std::to_string(e.byte) + " on");
  } catch (const Json::exception&) {
    return invalid_input("is not a list of primitives: one of its values is missing or of another kind");
  }
}

Result<std::vector<models::Superquadric>> read_superquadrics(const std::filesystem::path& path) {
  // 256 of them take a tenth of it.
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 20U;
  const auto file = read_file(path, kMaxBytes);
  if (!file) return file.error();
  auto shapes = decode_superquadrics(*file);
  if (!shapes) shapes.error().place = path.string();
  return shapes;
}

}  // namespace palpable::formats
