// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/json_integer.hpp"
#include "palpable/formats/packing/float_block.hpp"
#include "palpable/formats/scene/model_codec.hpp"
#include "palpable/formats/scene/solid_field_json.hpp"
#include "palpable/formats/scene/superquadric_json.hpp"
#include "palpable/formats/scene/vec3_json.hpp"

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

using models::DenseContent;

/// One member for each component, since neighbours of one component differ little.
constexpr std::array kMembers{"distance.f32.zst", "force_x.f32.zst", "force_y.f32.zst", "force_z.f32.zst"};
constexpr const char* kDistance = "distance";
constexpr const char* kDistanceAndForce = "distance and force";

}  // namespace

Result<void> write_dense_field(const models::FieldOnLattice& field, nlohmann::json& description,
                               ZipMembers& members) {
  const models::DenseField& dense = field.distance;
  const models::Lattice& lattice = dense.lattice();
  const std::size_t floats = models::floats_of(dense.content());
  description = {{"origin_m", json_of(lattice.origin_m)},
                 {"spacing_m", lattice.spacing_m},
                 {"counts", lattice.counts},
                 {"content", floats == 1 ? kDistance : kDistanceAndForce},
                 {"error_p99_m", dense.errors().p99_m},
                 {"error_max_m", dense.errors().max_m}};
  for (std::size_t number = 0; number < floats; ++number) {
    auto packed = pack_floats(std::span(dense.values()).subspan(number),
                              static_cast<std::size_t>(lattice.counts[0]), floats);
    if (!packed) return std::move(packed).error();
    members[kMembers[number]] = *std::move(packed);
    description["values"].push_back(kMembers[number]);
  }
  describe_solid(field, description);
  return {};
}

Result<models::Model> read_dense_field(const nlohmann::json& description, const ZipMembers& members) {
  models::Lattice lattice;
  lattice.origin_m = vec3_from(description.at("origin_m"));
  lattice.spacing_m = description.at("spacing_m").get<double>();
  lattice.counts = three_integers_from<int>(description.at("counts"));
  const auto content_name = description.at("content").get<std::string>();
  if (content_name != kDistance && content_name != kDistanceAndForce)
    return invalid_input("holds a dense field of '" + content_name + "', which is not known here");
  const DenseContent content =
      content_name == kDistance ? DenseContent::distance : DenseContent::distance_and_force;
  const std::size_t floats = models::floats_of(content);
  double bytes = static_cast<double>(sizeof(float) * floats);
  for (const int count : lattice.counts) {
    if (count < 2) return invalid_input("states a dense field without extent");
    bytes *= count;
  }
  constexpr double kMostBytes = 4294967296.0;
  if (bytes > kMostBytes) return invalid_input("states a dense field larger than is read");
  const auto names = description.at("values").get<std::vector<std::string>>();
  if (names.size() != floats) return invalid_input("lacks numbers of its dense field");
  std::vector<float> values;
  for (std::size_t number = 0; number < floats; ++number) {
    const auto member = members.find(names[number]);
    if (member == members.end()) return invalid_input("lacks numbers of its dense field");
    auto part = unpack_floats(member->second, lattice.places(), static_cast<std::size_t>(lattice.counts[0]));
    if (!part) return part.error();
    if (floats == 1) {
      values = *std::move(part);
      break;
    }
    values.resize(floats * part->size());
    for (std::size_t i = 0; i < part->size(); ++i) values[floats * i + number] = (*part)[i];
  }
  auto dense = models::DenseField::from(
      lattice, content, std::move(values),
      {0.0, description.at("error_p99_m").get<double>(), description.at("error_max_m").get<double>()});
  if (!dense) return dense.error();
  return model_from(*std::move(dense), description);
}

}  // namespace palpable::formats
