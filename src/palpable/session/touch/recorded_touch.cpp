// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_touch.hpp"

#include "palpable/session/touch/haptic_scene.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace palpable::session {
namespace {

using RecordedJson = nlohmann::ordered_json;

RecordedJson law_to_json(const haptics::LawParameters& law) {
  const auto given = [](const std::optional<double>& value) {
    return value ? RecordedJson(*value) : RecordedJson(nullptr);
  };
  RecordedJson json{{"law", haptics::name_of(law.law)}};
  for (const haptics::LawParameter& parameter : haptics::description_of(law.law).parameters)
    json[std::string(parameter.name)] = given(law.*parameter.value);
  return json;
}

haptics::LawParameters law_from_json(const RecordedJson& json) {
  haptics::LawParameters parameters;
  const auto law = haptics::law_from(json.at("law").get<std::string>());
  if (!law) throw std::invalid_argument("law");
  parameters.law = *law;
  for (const haptics::LawParameter& parameter : haptics::description_of(*law).parameters) {
    const auto found = json.find(std::string(parameter.name));
    if (found != json.end() && !found->is_null()) parameters.*parameter.value = found->get<double>();
  }
  return parameters;
}

RecordedJson texture_to_json(const models::TouchTexture& texture) {
  if (texture.kind == models::TouchTexture::Kind::none) return nullptr;
  return {{"kind", models::name_of(texture.kind)},
          {"pitch_m", texture.pitch_m},
          {"height_m", texture.height_m},
          {"angle_rad", texture.angle_rad}};
}

RecordedJson material_to_json(const models::Material& material) {
  return {{"name", material.name},
          {"stiffness_N_per_m", material.stiffness_N_per_m},
          {"damping_Ns_per_m", material.damping_Ns_per_m},
          {"static_friction", material.static_friction},
          {"dynamic_friction", material.dynamic_friction},
          {"texture", texture_to_json(material.texture)}};
}

models::Material material_from_json(const RecordedJson& json) {
  models::Material material;
  material.name = json.at("name").get<std::string>();
  material.stiffness_N_per_m = json.at("stiffness_N_per_m").get<double>();
  material.damping_Ns_per_m = json.at("damping_Ns_per_m").get<double>();
  material.static_friction = json.at("static_friction").get<double>();
  material.dynamic_friction = json.at("dynamic_friction").get<double>();
  const auto texture = json.find("texture");
  if (texture == json.end() || texture->is_null()) return material;
  const auto name = texture->at("kind").get<std::string>();
  const auto kind = models::texture_kind_from(name);
  if (!kind) throw std::invalid_argument("texture");
  material.texture.kind = *kind;
  material.texture.pitch_m = texture->at("pitch_m").get<double>();
  material.texture.height_m = texture->at("height_m").get<double>();
  material.texture.angle_rad = texture->at("angle_rad").get<double>();
  return material;
}

Transform<SceneFrame, DeviceFrame> place_from_json(const RecordedJson& json) {
  Transform<SceneFrame, DeviceFrame> place;
  place.rotation = json.at("rotation").get<std::array<double, 9>>();
  const auto& t = json.at("translation_m");
  place.translation_m = {t.at(0).get<double>(), t.at(1).get<double>(), t.at(2).get<double>()};
  place.scale = json.at("scale").get<double>();
  return place;
}

RecordedJson guide_to_json(const models::RouteGuide& guide) {
  return {{"line_m", guide.line_m},
          {"force_N", guide.force_N},
          {"reach_m", guide.reach_m},
          {"ahead_m", guide.ahead_m}};
}

models::RouteGuide guide_from_json(const RecordedJson& json) {
  models::RouteGuide guide{json.at("line_m").get<std::vector<std::array<double, 2>>>(),
                           json.at("force_N").get<double>(), json.at("reach_m").get<double>(),
                           json.at("ahead_m").get<double>()};
  if (!models::is_valid(guide)) throw std::invalid_argument("guide");
  return guide;
}

RecordedTouch touch_from_json(const RecordedJson& json) {
  RecordedTouch touch;
  touch.law = law_from_json(json);
  touch.asked_for = json.contains("asked_for") ? law_from_json(json.at("asked_for")) : touch.law;
  touch.height_factor = json.at("depth").get<double>();
  const auto transient = haptics::transient_kind_from(json.value("transient", "none"));
  if (!transient) throw std::invalid_argument("contact transient");
  touch.transient = *transient;
  for (const auto& material : json.at("materials")) touch.materials.push_back(material_from_json(material));
  if (json.contains("guide")) touch.guide = guide_from_json(json.at("guide"));
  touch.hashes.scene = json.at("scene_hash").get<std::string>();
  touch.hashes.shape = json.value("shape_hash", "");
  touch.inputs = json.value("scene_inputs", std::vector<std::string>{});
  touch.method = json.value("scene_method", "");
  touch.scene_from_device = place_from_json(json.at("scene_from_device"));
  return touch;
}

}  // namespace

std::string touch_json(const RecordedTouch& touch) {
  RecordedJson json = law_to_json(touch.law);
  const auto& place = touch.scene_from_device;
  json["asked_for"] = law_to_json(touch.asked_for);
  json["depth"] = touch.height_factor;
  json["transient"] = haptics::name_of(touch.transient);
  json["materials"] = RecordedJson::array();
  for (const auto& material : touch.materials) json["materials"].push_back(material_to_json(material));
  if (touch.guide) json["guide"] = guide_to_json(*touch.guide);
  json["scene_hash"] = touch.hashes.scene;
  json["shape_hash"] = touch.hashes.shape;
  json["scene_inputs"] = touch.inputs;
  json["scene_method"] = touch.method;
  json["scene_from_device"] = {
      {"rotation", place.rotation},
      {"translation_m", {place.translation_m.x, place.translation_m.y, place.translation_m.z}},
      {"scale", place.scale}};
  return json.dump(-1, ' ', false, RecordedJson::error_handler_t::replace);
}

Result<RecordedTouch> parse_touch(const std::string& json) {
  try {
    return touch_from_json(RecordedJson::parse(json));
  } catch (const RecordedJson::exception&) {
    return invalid_input("describes what was touched in an unknown way");
  } catch (const std::invalid_argument& what) {
    return invalid_input(std::string("names a ") + what.what() + " that this program does not know");
  }
}

bool is_of(const RecordedTouch& touch, const SceneHash& hash) {
  return touch.hashes.shape.empty() ? touch.hashes.scene == hash.scene : touch.hashes.shape == hash.shape;
}

Result<haptics::HapticScene> remade_scene(const RecordedTouch& touch, const models::Scene& scene,
                                          std::uint32_t id, haptics::DilatedRelief& kept) {
  auto scaled = with_height_factor(scene, touch.height_factor);
  if (!scaled) return std::move(scaled).error();
  if (scaled->materials.size() != touch.materials.size())
    return invalid_input("has another number of materials than the scene that was touched");
  for (std::size_t i = 0; i < touch.materials.size(); ++i) {
    auto tile = std::move(scaled->materials[i].texture.tile);
    scaled->materials[i] = touch.materials[i];
    scaled->materials[i].texture.tile = std::move(tile);
  }
  scaled->guide = touch.guide ? std::make_shared<const models::RouteGuide>(*touch.guide) : nullptr;
  auto touchable = haptics::make_touchable(*scaled, touch.law, &kept);
  if (!touchable) return std::move(touchable).error();
  return haptics::HapticScene{std::move(*touchable), touch.scene_from_device, id,
                              haptics::transient_of(touch.transient)};
}

}  // namespace palpable::session
