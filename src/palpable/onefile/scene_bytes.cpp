// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/scene_bytes.hpp"

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/formats/packing/float_planes.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/onefile/byte_archive.hpp"
#include "palpable/onefile/model_bytes.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace palpable::onefile {

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<MapPoint> point) {
  archive(point.x, point.y);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<MapStreet> street) {
  archive(street.name, street.width_px, street.points, street.felt);
  archive.choice(street.kind, static_cast<unsigned>(MapStreet::Kind::path) + 1);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<MapJunction> junction) {
  archive(junction.at, junction.degree, junction.roundabout);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<MapArea> area) {
  archive(area.outline);
  archive.choice(area.kind, static_cast<unsigned>(MapArea::Kind::green) + 1);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<MapPlace> place) {
  archive(place.name, place.at, place.outline, place.tactile_paving, place.felt);
  archive.choice(place.kind, static_cast<unsigned>(MapPlace::Kind::entrance) + 1);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<MapLabel> label) {
  archive(label.text, label.confidence, label.angle_deg, label.box, label.names_street);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<StreetMap> map) {
  archive(map.width_px, map.height_px, map.metres_per_px, map.streets, map.junctions, map.areas, map.labels,
          map.places);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<models::Material> material) {
  archive(material.name, material.stiffness_N_per_m, material.damping_Ns_per_m, material.static_friction,
          material.dynamic_friction, material.texture.pitch_m, material.texture.height_m,
          material.texture.angle_rad);
  archive.choice(material.texture.kind, static_cast<unsigned>(models::TouchTexture::Kind::picture) + 1);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<models::Provenance> source) {
  archive(source.inputs, source.method, source.made_by);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<Place> place) {
  archive(place.x_m, place.y_m);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<models::PlaceName> name) {
  archive(name.name, name.sentence, name.at, name.line);
  archive.choice(name.extent, static_cast<unsigned>(models::PlaceName::Extent::label) + 1);
}

/// All but the model, the labels, the textures' pictures and the map.
template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<models::Scene> scene) {
  archive(scene.materials, scene.scene_from_input.rotation, scene.scene_from_input.translation_m,
          scene.scene_from_input.scale, scene.source, scene.title, scene.description, scene.warnings,
          scene.names);
  archive.choice(scene.pose, static_cast<unsigned>(models::SolidPose::flat) + 1);
}

namespace {

/// The first bytes; the number is raised when anything else here changes.
const std::string kMark = "palpable one-file scene 3";

Error damaged_scene() { return invalid_input("holds a scene that is damaged or cut off"); }

/// A texture's picture has a fixed size, and is empty for other kinds.
bool read_tile(ByteInput& in, models::TouchTexture& texture) {
  const auto planes = in.block();
  if (planes.size() % 4 != 0) return false;
  texture.tile = formats::floats_of(planes, models::kTextureSide);
  return true;
}

bool read_labels(ByteInput& in, Raster<std::uint8_t>& labels) {
  int width = 0, height = 0;
  in(width, height);
  const auto bytes = as_text(in.block());
  if (!in.ok()) return false;
  if (bytes.empty()) return true;
  if (!check_picture_size(width, height)) return false;
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) != bytes.size()) return false;
  labels = {width, height, std::vector<std::uint8_t>(bytes.begin(), bytes.end())};
  return true;
}

/// The second view's shift; its picture is not among the bytes.
bool read_shift(ByteInput& in, models::Scene& scene) {
  int width = 0, height = 0;
  in(width, height);
  const auto bytes = in.block();
  if (!in.ok()) return false;
  if (bytes.empty()) return true;
  if (!check_picture_size(width, height)) return false;
  Raster<std::uint16_t> shift(width, height);
  if (bytes.size() != std::as_writable_bytes(shift.values()).size()) return false;
  std::copy(bytes.begin(), bytes.end(), std::as_writable_bytes(shift.values()).begin());
  scene.second_view = std::make_shared<const models::SecondView>(models::SecondView{{}, std::move(shift)});
  return true;
}

}  // namespace

std::vector<std::byte> encode_scene_bytes(const models::Scene& scene) {
  ByteOutput out;
  out(kMark);
  write_model(out, scene.model);
  out(scene);
  for (const auto& material : scene.materials)
    out.block(formats::planes_of(material.texture.tile, models::kTextureSide));
  out(scene.labels.width(), scene.labels.height());
  out.block(std::as_bytes(scene.labels.values()));
  const auto second = scene.second_view != nullptr ? scene.second_view->shift : Raster<std::uint16_t>();
  out(second.width(), second.height());
  out.block(std::as_bytes(second.values()));
  out(scene.map != nullptr);
  if (scene.map != nullptr) out(*scene.map);
  const auto bytes = out.bytes();
  return {bytes.begin(), bytes.end()};
}

Result<models::Scene> decode_scene_bytes(std::span<const std::byte> bytes) {
  ByteInput in(bytes);
  std::string mark;
  in(mark);
  if (!in.ok() || mark != kMark) return invalid_input("holds no scene that this page can read");
  auto model = read_model(in);
  if (!model) return model.error();
  models::Scene scene;
  scene.model = *std::move(model);
  in(scene);
  for (auto& material : scene.materials)
    if (!read_tile(in, material.texture)) return damaged_scene();
  if (!read_labels(in, scene.labels)) return damaged_scene();
  if (!read_shift(in, scene)) return damaged_scene();
  bool has_map = false;
  in(has_map);
  StreetMap map;
  if (has_map) in(map);
  if (!in.ok() || !in.at_end()) return damaged_scene();
  if (has_map) scene.map = std::make_shared<const StreetMap>(std::move(map));
  if (auto valid = formats::check_scene(scene); !valid) return valid.error();
  return scene;
}

}  // namespace palpable::onefile
