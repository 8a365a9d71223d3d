// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/second_view_codec.hpp"

#include "palpable/formats/picture/jpeg.hpp"
#include "palpable/formats/picture/jpeg_encoder.hpp"
#include "palpable/formats/picture/png.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

constexpr const char* kPicture = "second-view.jpg";
constexpr const char* kShift = "second-view-shift.png";
// Of the picture for one eye: a tenth of the size of a PNG.
constexpr int kQuality = 90;

Result<std::vector<std::byte>> taken(const std::string& name, ZipMembers& members) {
  auto node = members.extract(name);
  if (node.empty()) return invalid_input("lacks its member " + name);
  return std::move(node.mapped());
}

}  // namespace

Result<void> write_second_view(const models::SecondView& view, nlohmann::json& description,
                               ZipMembers& members) {
  auto picture = encode_jpeg(view.picture, kQuality);
  if (!picture) return std::move(picture).error();
  auto shift = encode_png(view.shift);
  if (!shift) return std::move(shift).error();
  members[kPicture] = *std::move(picture);
  members[kShift] = *std::move(shift);
  description = {{"picture", kPicture}, {"shift", kShift}};
  return {};
}

Result<models::SecondView> read_second_view(const nlohmann::json& description, ZipMembers& members) {
  const auto picture_file = taken(description.at("picture").get<std::string>(), members);
  if (!picture_file) return picture_file.error();
  const auto shift_file = taken(description.at("shift").get<std::string>(), members);
  if (!shift_file) return shift_file.error();
  const auto picture = decode_jpeg(*picture_file);
  if (!picture) return invalid_input("its second picture " + picture.error().message);
  const auto shift = decode_png(*shift_file);
  if (!shift) return invalid_input("its second picture's shift " + shift.error().message);
  if (shift->channels != 1 || shift->bits != 16)
    return invalid_input("holds a second picture's shift that is not a 16-bit grey picture");
  models::SecondView view{rgb8(*picture), Raster<std::uint16_t>(shift->width, shift->height)};
  constexpr float kMost = 65535.0F;
  std::transform(shift->samples.begin(), shift->samples.end(), view.shift.values().begin(),
                 [](float v) { return static_cast<std::uint16_t>(std::lround(kMost * v)); });
  return view;
}

}  // namespace palpable::formats
