// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/json_integer.hpp"
#include "palpable/formats/packing/byte_block.hpp"
#include "palpable/formats/scene/field_streams.hpp"
#include "palpable/formats/scene/model_codec.hpp"
#include "palpable/formats/scene/solid_field_json.hpp"
#include "palpable/formats/scene/superquadric_json.hpp"
#include "palpable/formats/scene/vec3_json.hpp"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

using models::FieldGrid;

constexpr const char* kCells = "cells.field.zst";
/// The storage layout of the cells: the streams of field_streams.hpp one after the other, each compressed by
/// zstd.
constexpr int kLayout = 3;
/// The older layout without compact leaves, which is still read.
constexpr int kLayoutBefore = 2;
constexpr std::size_t kMostBytes = std::size_t{1} << 31U;

Error damaged() { return invalid_input("holds a field that is damaged or cut off"); }

}  // namespace

Result<void> write_field(const models::Field& field, nlohmann::json& description, ZipMembers& members) {
  const FieldStreams streams = streams_of(field.distance.grid(), field.distance.tree());
  const FieldGrid& grid = field.distance.grid();
  description = {{"origin_m", json_of(grid.origin_m)},
                 {"cell_m", grid.cell_m},
                 {"levels", grid.levels},
                 {"roots", grid.roots},
                 {"error_bound_m", field.distance.errors().bound_m},
                 {"error_p99_m", field.distance.errors().p99_m},
                 {"error_max_m", field.distance.errors().max_m},
                 {"layout", kLayout},
                 {"cells", kCells}};
  Bytes member;
  nlohmann::json sizes = nlohmann::json::array();
  for (const auto& part : streams.bytes) {
    const auto bytes = pack_bytes(part);
    if (!bytes) return bytes.error();
    sizes.push_back(bytes->size());
    member.insert(member.end(), bytes->begin(), bytes->end());
  }
  description["parts"] = sizes;
  describe_solid(field, description);
  members[kCells] = std::move(member);
  return {};
}

Result<models::Model> read_field(const nlohmann::json& description, const ZipMembers& members) {
  const auto member = members.find(description.at("cells").get<std::string>());
  if (member == members.end()) return invalid_input("lacks the cells of its field");
  const int layout = integer_from<int>(description.at("layout"));
  if (layout != kLayout && layout != kLayoutBefore)
    return invalid_input("holds a field in a layout that is not known here: make it again");
  FieldGrid grid;
  grid.origin_m = vec3_from(description.at("origin_m"));
  grid.cell_m = description.at("cell_m").get<double>();
  grid.levels = integer_from<int>(description.at("levels"));
  grid.roots = three_integers_from<int>(description.at("roots"));
  if (grid.levels < 0 || grid.levels > 10) return damaged();
  for (const int n : grid.roots)
    if (n < 1 || n > (1 << 20)) return damaged();
  const auto sizes = integers_from<std::size_t>(description.at("parts"));
  if (sizes.size() != (layout == kLayout ? FieldStreams::kCount : FieldStreams::kCountBefore))
    return damaged();
  FieldStreams streams;
  std::span<const std::byte> left(member->second);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] > left.size()) return damaged();
    auto bytes = unpack_bytes(left.first(sizes[i]), kMostBytes);
    if (!bytes) return bytes.error();
    streams.bytes[i] = std::move(*bytes);
    left = left.subspan(sizes[i]);
  }
  auto tree = tree_from(grid, streams);
  if (!tree) return tree.error();
  models::FieldErrors errors{description.at("error_bound_m").get<double>(),
                             description.at("error_p99_m").get<double>(),
                             description.at("error_max_m").get<double>()};
  auto distance = models::DistanceField::from_tree(grid, std::move(*tree), errors);
  if (!distance) return distance.error();
  return model_from(*std::move(distance), description);
}

}  // namespace palpable::formats
