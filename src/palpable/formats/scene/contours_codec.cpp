// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/image.hpp"
#include "palpable/core/text/json_integer.hpp"
#include "palpable/formats/packing/float_block.hpp"
#include "palpable/formats/scene/model_codec.hpp"

#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

constexpr const char* kEdges = "edges.f32.zst";

}  // namespace

Result<void> write_contours(const models::Contours& contours, nlohmann::json& description,
                            ZipMembers& members) {
  const models::BoundaryMap& map = contours.boundaries;
  nlohmann::json grooves;
  if (auto written = write_relief(*contours.grooves, grooves, members); !written) return written;
  // Plane by plane, since neighbours in a plane are similar.
  std::vector<float> planes;
  planes.reserve(2 * map.edges().count());
  for (const models::BoundaryPixel& p : map.edges().values()) planes.push_back(p.c2);
  for (const models::BoundaryPixel& p : map.edges().values()) planes.push_back(p.s2);
  auto packed = pack_floats(planes, static_cast<std::size_t>(map.edges().width()));
  if (!packed) return std::move(packed).error();
  members[kEdges] = *std::move(packed);
  description = {{"columns", map.edges().width()},
                 {"rows", map.edges().height()},
                 {"pixel_m", map.pixel_m()},
                 {"radius_px", map.radius_px()},
                 {"threshold", map.origin().threshold},
                 {"boundary_fraction", map.origin().boundary_fraction},
                 {"edges", kEdges},
                 {"grooves", grooves}};
  return {};
}

Result<models::Model> read_contours(const nlohmann::json& description, const ZipMembers& members) {
  const auto columns = integer_from<std::int64_t>(description.at("columns"));
  const auto rows = integer_from<std::int64_t>(description.at("rows"));
  if (auto size = check_picture_size(columns, rows); !size) return std::move(size).error();
  const auto member = members.find(description.at("edges").get<std::string>());
  if (member == members.end()) return invalid_input("lacks the edges of its contours");
  Raster<models::BoundaryPixel> edges(static_cast<int>(columns), static_cast<int>(rows));
  const auto planes = unpack_floats(member->second, 2 * edges.count(), static_cast<std::size_t>(columns));
  if (!planes) return planes.error();
  for (std::size_t i = 0; i < edges.count(); ++i)
    edges.values()[i] = {(*planes)[i], (*planes)[i + edges.count()]};
  const models::BoundaryOrigin origin{description.at("threshold").get<double>(),
                                      description.at("boundary_fraction").get<double>()};
  auto map = models::BoundaryMap::from_edges(std::move(edges), description.at("pixel_m").get<double>(),
                                             description.at("radius_px").get<double>(), origin, Work{});
  if (!map) return std::move(map).error();
  const auto grooves = read_relief(description.at("grooves"), members);
  if (!grooves) return grooves.error();
  return models::Model(std::make_shared<const models::Contours>(
      models::Contours{*std::move(map), std::get<std::shared_ptr<const models::Relief>>(*grooves)}));
}

}  // namespace palpable::formats
