// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/json_integer.hpp"
#include "palpable/formats/packing/byte_block.hpp"
#include "palpable/formats/scene/model_codec.hpp"

#include <array>
#include <memory>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

constexpr const char* kOccupied = "occupied.bits.zst";

}  // namespace

Result<void> write_grid(const models::Grid& grid, nlohmann::json& description, ZipMembers& members) {
  nlohmann::json from_above;
  if (auto written = write_relief(*grid.from_above, from_above, members); !written) return written;
  const models::Occupancy o = grid.occupancy.occupancy();
  // Eight points per byte, x fastest, lowest bit first.
  std::vector<std::uint8_t> bits((o.points() + 7) / 8);
  for (std::size_t i = 0; i < o.points(); ++i)
    bits[i / 8] = static_cast<std::uint8_t>(bits[i / 8] | (o.occupied[i] << (i % 8)));
  auto packed = pack_bytes(bits);
  if (!packed) return std::move(packed).error();
  members[kOccupied] = *std::move(packed);
  description = {{"counts", o.counts},
                 {"origin_m", {o.origin_m.x, o.origin_m.y, o.origin_m.z}},
                 {"spacing_m", o.spacing_m},
                 {"occupied", kOccupied},
                 {"from_above", from_above}};
  return {};
}

Result<models::Model> read_grid(const nlohmann::json& description, const ZipMembers& members) {
  models::Occupancy o;
  o.counts = three_integers_from<int>(description.at("counts"));
  double points = 1.0;
  for (const int count : o.counts) {
    if (count < 2) return invalid_input("states a grid without extent");
    points *= count;
  }
  if (points > static_cast<double>(models::kMaxGridPoints))
    return invalid_input("states a grid larger than is read");
  const auto origin = description.at("origin_m").get<std::array<double, 3>>();
  o.origin_m = {origin[0], origin[1], origin[2]};
  o.spacing_m = description.at("spacing_m").get<double>();
  const auto member = members.find(description.at("occupied").get<std::string>());
  if (member == members.end()) return invalid_input("lacks the points of its grid");
  const auto count = static_cast<std::size_t>(points);
  const auto bits = unpack_bytes(member->second, (count + 7) / 8);
  if (!bits) return bits.error();
  if (bits->size() != (count + 7) / 8) return invalid_input("holds a grid of another size than it states");
  o.occupied.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    o.occupied[i] = static_cast<std::uint8_t>(((*bits)[i / 8] >> (i % 8)) & 1U);
  auto occupancy = models::OccupancyGrid::from(o, Work{});
  if (!occupancy) return std::move(occupancy).error();
  const auto from_above = read_relief(description.at("from_above"), members);
  if (!from_above) return from_above.error();
  return models::Model(std::make_shared<const models::Grid>(
      models::Grid{*std::move(occupancy), std::get<std::shared_ptr<const models::Relief>>(*from_above)}));
}

}  // namespace palpable::formats
