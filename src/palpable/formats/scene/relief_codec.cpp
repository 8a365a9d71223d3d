// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/image.hpp"
#include "palpable/core/text/json_integer.hpp"
#include "palpable/formats/packing/float_block.hpp"
#include "palpable/formats/scene/model_codec.hpp"

#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

constexpr const char* kHeights = "heights.f32.zst";

}  // namespace

Result<void> write_relief(const models::Relief& relief, nlohmann::json& description, ZipMembers& members) {
  const Raster<float>& heights = relief.samples_m();
  auto packed = pack_floats(heights.values(), static_cast<std::size_t>(heights.width()));
  if (!packed) return std::move(packed).error();
  members[kHeights] = *std::move(packed);
  description = {{"columns", heights.width()},
                 {"rows", heights.height()},
                 {"pixel_m", relief.pixel_m()},
                 {"heights", kHeights}};
  return {};
}

Result<models::Model> read_relief(const nlohmann::json& description, const ZipMembers& members) {
  const auto columns = integer_from<std::int64_t>(description.at("columns"));
  const auto rows = integer_from<std::int64_t>(description.at("rows"));
  if (auto size = check_picture_size(columns, rows); !size) return std::move(size).error();
  const auto member = members.find(description.at("heights").get<std::string>());
  if (member == members.end()) return invalid_input("lacks the heights of its relief");
  Raster<float> heights(static_cast<int>(columns), static_cast<int>(rows));
  const auto values = unpack_floats(member->second, heights.count(), static_cast<std::size_t>(columns));
  if (!values) return values.error();
  std::copy(values->begin(), values->end(), heights.values().begin());
  auto relief = models::Relief::from_samples(std::move(heights), description.at("pixel_m").get<double>());
  if (!relief) return std::move(relief).error();
  return models::Model(std::make_shared<const models::Relief>(*std::move(relief)));
}

}  // namespace palpable::formats
