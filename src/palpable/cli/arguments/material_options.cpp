// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/material_options.hpp"

#include "palpable/core/text/number_text.hpp"
#include "palpable/core/text/plain_text.hpp"
#include "palpable/models/material/material_check.hpp"
#include "palpable/models/scene/place_name.hpp"
#include "palpable/sculpt/relief/texture_tile.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), "--material"}; }

struct Property {
  std::string_view key;
  double least;
  double most;
  /// Sets the value in the material's own unit.
  void (*set)(models::Material& material, double value);
};

constexpr Property kProperties[]{
    {"stiffness", 1e-6, models::kMostStiffness_N_per_m,
     [](models::Material& m, double v) { m.stiffness_N_per_m = v; }},
    {"damping", 0.0, models::kMostDamping_Ns_per_m,
     [](models::Material& m, double v) { m.damping_Ns_per_m = v; }},
    {"friction", 0.0, models::kMostFriction, [](models::Material& m, double v) { m.static_friction = v; }},
    {"sliding", 0.0, models::kMostFriction, [](models::Material& m, double v) { m.dynamic_friction = v; }},
    {"pitch", 0.1, 20.0, [](models::Material& m, double v) { m.texture.pitch_m = 1e-3 * v; }},
    {"size", 0.1 * models::kPictureForms, 20.0 * models::kPictureForms,
     [](models::Material& m, double v) { m.texture.pitch_m = 1e-3 * v / models::kPictureForms; }},
    {"height", 0.0, 1.0, [](models::Material& m, double v) { m.texture.height_m = 1e-3 * v; }},
    {"angle", -360.0, 360.0,
     [](models::Material& m, double v) { m.texture.angle_rad = v / 180.0 * std::numbers::pi; }}};

std::string property_names() {
  std::string names;
  for (const Property& p : kProperties) names += fmt::format(", {}", p.key);
  return names;
}

using Pictures = std::map<std::string, std::shared_ptr<const Image>>;

/// A picture that was read before, or is read now.
Result<std::shared_ptr<const Image>> picture_from(const std::string& file, Pictures& pictures) {
  if (const auto known = pictures.find(file); known != pictures.end()) return known->second;
  auto picture = sources::read_picture(file);
  if (!picture) return picture.error();
  return pictures[file] = std::make_shared<const Image>(*std::move(picture));
}

/// Sets a texture by name, or from a picture file.
Result<void> apply_texture(std::string_view value, models::TouchTexture& texture, Pictures& pictures) {
  const auto kind = models::texture_kind_from(value);
  if (kind && *kind != models::TouchTexture::Kind::picture) {
    texture.kind = *kind;
    return {};
  }
  const std::string file(value);
  if (file.find('.') == std::string::npos)
    return usage(fmt::format(
        "'{}' is not a texture: give none, grain, ridges, bumps or the file name of a picture", value));
  const auto picture = picture_from(file, pictures);
  if (!picture) return picture.error();
  auto tile = sculpt::texture_tile(**picture);
  if (!tile) return Error{tile.error().code, tile.error().message, file};
  texture.kind = models::TouchTexture::Kind::picture;
  texture.tile = std::move(*tile);
  return {};
}

/// Errors: usage for a name that cannot be said or shown.
Result<void> check_name(std::string_view name) {
  if (name.empty()) return usage("a material's name is empty");
  if (name.size() > models::kMaxPlaceNameBytes)
    return usage(fmt::format("a material's name has at most {} bytes", models::kMaxPlaceNameBytes));
  if (!is_utf8(name)) return usage("a material's name is not UTF-8");
  if (has_control_characters(name) || name.find('\n') != std::string_view::npos)
    return usage("a material's name holds control characters");
  return {};
}

Result<void> apply_pair(std::string_view pair, models::Material& material, Pictures& pictures) {
  const auto equals = pair.find('=');
  if (equals == std::string_view::npos) return usage(fmt::format("'{}' is not key=value", pair));
  const std::string_view key = pair.substr(0, equals);
  const std::string_view value = pair.substr(equals + 1);
  if (key == "name") {
    if (const auto valid = check_name(value); !valid) return valid;
    material.name = value;
    return {};
  }
  if (key == "texture") return apply_texture(value, material.texture, pictures);
  const auto* property = std::find_if(std::begin(kProperties), std::end(kProperties),
                                      [key](const Property& p) { return p.key == key; });
  if (property == std::end(kProperties))
    return usage(fmt::format("a material has no '{}': its keys are name, texture{}", key, property_names()));
  const auto number = finite_number(value);
  if (!number || *number < property->least || *number > property->most)
    return usage(fmt::format("{} must be {:g} to {:g}", key, property->least, property->most));
  property->set(material, *number);
  return {};
}

/// What was set of which label.
using KeysOfLabels = std::set<std::pair<std::size_t, std::string>>;

Result<void> apply_material(std::string_view text, models::Scene& scene, KeysOfLabels& set_before,
                            Pictures& pictures) {
  const auto colon = text.find(':');
  const auto label = finite_number(text.substr(0, colon));
  if (colon == std::string_view::npos || !label || *label < 0 || *label > 255 || *label != std::floor(*label))
    return usage(fmt::format("{} does not begin with a label 0 to 255 and a colon", text));
  const auto index = static_cast<std::size_t>(*label);
  if (scene.materials.size() <= index)
    scene.materials.resize(index + 1, models::Material(scene.materials.front()));
  models::Material& material = scene.materials[index];
  bool sets_static = false, sets_dynamic = false;
  std::string_view rest = text.substr(colon + 1);
  while (!rest.empty()) {
    const auto comma = rest.find(',');
    const std::string_view pair = rest.substr(0, comma);
    const std::string key(pair.substr(0, pair.find('=')));
    if (auto applied = apply_pair(pair, material, pictures); !applied) return applied;
    if (!set_before.emplace(index, key).second)
      return usage(fmt::format("{} of label {} is given more than once", key, index));
    sets_static = sets_static || pair.starts_with("friction=");
    sets_dynamic = sets_dynamic || pair.starts_with("sliding=");
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  if (sets_static && !sets_dynamic)
    material.dynamic_friction = models::kDynamicOfStatic * material.static_friction;
  material.dynamic_friction = std::min(material.dynamic_friction, material.static_friction);
  return {};
}

Result<void> apply_all(const std::vector<std::string>& materials, models::Scene& scene, Pictures& pictures) {
  KeysOfLabels set_before;
  for (const std::string& text : materials)
    if (auto applied = apply_material(text, scene, set_before, pictures); !applied) return applied;
  return {};
}

Result<std::shared_ptr<const Image>> label_picture(const std::string& file, Pictures& pictures) {
  const auto picture = picture_from(file, pictures);
  if (picture && ((*picture)->channels != 1 || (*picture)->bits != 8))
    return invalid_input("a label picture is 8-bit grey: each value is a material's number", file);
  return picture;
}

Result<Raster<std::uint8_t>> labels_from(const std::string& file, const models::Scene& scene,
                                         Pictures& pictures) {
  const auto found = label_picture(file, pictures);
  if (!found) return found.error();
  const Image& picture = **found;
  const auto invalid = [&file](std::string message) { return invalid_input(std::move(message), file); };
  const auto& samples = models::relief_of(scene)->samples_m();
  // The same aspect ratio to within a pixel of the coarser one, whose sides were rounded.
  const double pixel = std::max(1.0, static_cast<double>(picture.width) / samples.width());
  const double height = static_cast<double>(picture.width) * samples.height() / samples.width();
  if (std::abs(height - picture.height) > pixel)
    return invalid(fmt::format("the label picture is {}x{}, but the scene's surface has the shape {}x{}",
                               picture.width, picture.height, samples.width(), samples.height()));
  Raster<std::uint8_t> labels(picture.width, picture.height);
  std::transform(picture.samples.begin(), picture.samples.end(), labels.values().begin(),
                 [](float v) { return static_cast<std::uint8_t>(std::lround(255.0F * v)); });
  const auto highest = *std::max_element(labels.values().begin(), labels.values().end());
  if (highest >= scene.materials.size())
    return invalid(fmt::format("the label picture names the material {}, but the last one is {}", highest,
                               scene.materials.size() - 1));
  return labels;
}

}  // namespace

void add_material_options(Options& options, MaterialArguments& arguments) {
  options.under("Materials");
  options.texts(
      "--material", arguments.materials,
      "LABEL:key=value,… with name, stiffness, damping, friction, sliding, texture "
      "(none, grain, ridges, bumps, or a file: heights or a normal map), pitch or size, and height (mm), "
      "angle (degrees); may be repeated");
  options.text("--labels", arguments.labels,
               "8-bit grey picture of the scene's shape: each value is a material's LABEL");
}

Result<void> read_materials(MaterialArguments& arguments) {
  models::Scene any;
  any.materials.resize(1);
  if (auto applied = apply_all(arguments.materials, any, arguments.pictures); !applied) return applied;
  if (arguments.labels.empty()) return {};
  if (const auto picture = label_picture(arguments.labels, arguments.pictures); !picture)
    return picture.error();
  return {};
}

Result<void> apply_materials(const MaterialArguments& arguments, models::Scene& scene) {
  Pictures pictures = arguments.pictures;
  if (auto applied = apply_all(arguments.materials, scene, pictures); !applied) return applied;
  const bool is_grid = std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model);
  for (const models::Material& m : scene.materials)
    if (m.texture.kind != models::TouchTexture::Kind::none && is_grid)
      return usage("a texture is felt on a relief, on grooves or on a solid, not on a grid");
  if (arguments.labels.empty()) return {};
  auto labels = labels_from(arguments.labels, scene, pictures);
  if (!labels) return labels.error();
  scene.labels = std::move(*labels);
  return {};
}

}  // namespace palpable::cli
