// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/material_codec.hpp"

#include "palpable/formats/picture/png.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace palpable::formats {
namespace {

using models::TouchTexture;
using nlohmann::json;

/// The tile as a 16-bit grey picture, where 32768 means 0.
constexpr double kMiddle = 32768.0, kHeight = 32767.0;

Result<std::vector<std::byte>> encode_tile(const std::vector<float>& tile) {
  Raster<std::uint16_t> picture(models::kTextureSide, models::kTextureSide);
  std::transform(tile.begin(), tile.end(), picture.values().begin(), [](float v) {
    return static_cast<std::uint16_t>(
        std::lround(kMiddle + kHeight * std::clamp(static_cast<double>(v), -1.0, 1.0)));
  });
  return encode_png(picture);
}

Result<std::vector<float>> decode_tile(const Bytes& member) {
  const auto image = decode_png(member);
  if (!image) return invalid_input("its texture " + image.error().message);
  if (image->channels != 1 || image->width != models::kTextureSide || image->height != models::kTextureSide)
    return invalid_input("holds a texture that is not a grey picture of 64 x 64");
  std::vector<float> tile(image->samples.size());
  std::transform(image->samples.begin(), image->samples.end(), tile.begin(), [](float v) {
    return static_cast<float>(std::clamp((65535.0 * static_cast<double>(v) - kMiddle) / kHeight, -1.0, 1.0));
  });
  return tile;
}

/// An unknown kind, perhaps of a later version, is ignored: the scene is felt without its texture.
Result<TouchTexture> read_texture(const json& j, ZipMembers& members) {
  TouchTexture texture;
  if (j.contains("tile")) {
    const auto name = j.at("tile").get<std::string>();
    const auto node = members.extract(name);
    if (node.empty()) return invalid_input("lacks its member " + name);
    auto tile = decode_tile(node.mapped());
    if (!tile) return std::move(tile).error();
    texture.tile = *std::move(tile);
  }
  texture.kind =
      models::texture_kind_from(j.at("kind").get<std::string>()).value_or(TouchTexture::Kind::none);
  texture.pitch_m = j.at("pitch_m").get<double>();
  texture.height_m = j.at("height_m").get<double>();
  texture.angle_rad = j.at("angle_rad").get<double>();
  return texture;
}

}  // namespace

Result<json> write_material(const models::Material& m, std::size_t number, ZipMembers& members) {
  json j{{"name", m.name},
         {"stiffness_N_per_m", m.stiffness_N_per_m},
         {"damping_Ns_per_m", m.damping_Ns_per_m},
         {"static_friction", m.static_friction},
         {"dynamic_friction", m.dynamic_friction}};
  const TouchTexture& t = m.texture;
  if (t.kind == TouchTexture::Kind::none) return j;
  j["texture"] = {{"kind", std::string(models::name_of(t.kind))},
                  {"pitch_m", t.pitch_m},
                  {"height_m", t.height_m},
                  {"angle_rad", t.angle_rad}};
  if (t.kind != TouchTexture::Kind::picture) return j;
  auto tile = encode_tile(t.tile);
  if (!tile) return std::move(tile).error();
  const std::string name = "material-" + std::to_string(number) + ".png";
  members[name] = *std::move(tile);
  j["texture"]["tile"] = name;
  return j;
}

Result<models::Material> read_material(const json& j, ZipMembers& members) {
  models::Material material{j.at("name").get<std::string>(),        j.at("stiffness_N_per_m").get<double>(),
                            j.at("damping_Ns_per_m").get<double>(), j.at("static_friction").get<double>(),
                            j.at("dynamic_friction").get<double>(), {}};
  if (!j.contains("texture")) return material;
  auto texture = read_texture(j.at("texture"), members);
  if (!texture) return std::move(texture).error();
  material.texture = *std::move(texture);
  return material;
}

}  // namespace palpable::formats
