// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/formats/scene/scene_limits.hpp"
#include "palpable/models/material/material_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace palpable::formats {
namespace {

bool is_valid(const Transform<SceneFrame, models::InputFrame>& t) {
  // Far beyond any input, and far from where a product of them overflows.
  constexpr double kMost = 1e12;
  const auto within = [](double v) { return std::abs(v) <= kMost; };
  return std::all_of(t.rotation.begin(), t.rotation.end(), within) && within(t.translation_m.x) &&
         within(t.translation_m.y) && within(t.translation_m.z) && t.scale > 0.0 && within(t.scale);
}

bool is_sha256(const std::string& text) {
  constexpr std::size_t kDigits = 64;
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool is_valid(const models::Provenance& source) {
  const auto fits = [](const std::string& word) { return word.size() <= models::kMaxCommandWordBytes; };
  return source.command.size() <= models::kMaxCommandWords &&
         std::all_of(source.command.begin(), source.command.end(), fits) &&
         source.files.size() <= models::kMaxSourceFiles &&
         std::all_of(source.files.begin(), source.files.end(), [&](const models::SourceFile& file) {
           return !file.name.empty() && fits(file.name) && is_sha256(file.sha256);
         });
}

}  // namespace

Result<void> check_scene(const models::Scene& scene) {
  if (scene.materials.empty() || scene.materials.size() > kMaxMaterials)
    return invalid_input("a scene has between 1 and 256 materials");
  if (!std::all_of(scene.materials.begin(), scene.materials.end(), [](const auto& m) { return is_valid(m); }))
    return invalid_input(
        "a material's stiffness, damping or friction is negative, too large or not a number, or its texture "
        "out of range");
  if (!is_valid(scene.scene_from_input))
    return invalid_input("the scene's place in its input is not a number, or too large");
  if (scene.title.size() > models::kMaxTitleBytes || scene.title.find('\n') != std::string::npos)
    return invalid_input("a scene's title is one line of at most 200 bytes");
  if (scene.description.size() > models::kMaxDescriptionBytes)
    return invalid_input("a scene's description has at most 4000 bytes");
  if (scene.warnings.size() > models::kMaxWarnings ||
      std::any_of(scene.warnings.begin(), scene.warnings.end(),
                  [](const std::string& words) { return words.size() > models::kMaxWarningBytes; }))
    return invalid_input("a scene has at most 16 warnings of at most 1000 bytes");
  if (scene.names.size() > models::kMaxPlaceNames ||
      !std::all_of(scene.names.begin(), scene.names.end(),
                   [](const models::PlaceName& name) { return models::is_valid(name); }))
    return invalid_input(
        "a scene has at most 500 names, each one line of at most 400 bytes with a sentence of at most 2000, "
        "without characters that control a display");
  if (!is_valid(scene.source))
    return invalid_input(
        "the command or the files that a scene was made from are too many, too long or no "
        "SHA-256");
  const bool labelled = std::all_of(scene.labels.values().begin(), scene.labels.values().end(),
                                    [&](std::uint8_t label) { return label < scene.materials.size(); });
  if (!labelled) return invalid_input("the map of materials names one that the scene does not have");
  return {};
}

}  // namespace palpable::formats
