// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/sample_scene.hpp"

#include "palpable/cli/input_files.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::cli {
namespace {

/// What a resolved sample sets.
struct Asked {
  MakeArguments& make;
  TitleArguments& title;
  MaterialArguments& material;
};

void set_words(TitleArguments& arguments, const std::string& title, const std::string& description) {
  if (arguments.title.empty()) arguments.title = title;
  if (arguments.description.empty()) arguments.description = description;
}

/// sculpture.json: "title", "description" and "objects", the names of the values of sculpture_labels.png.
Result<void> set_sculpture_words(const Asked& asked, const std::filesystem::path& folder) {
  const auto path = folder / "sculpture.json";
  const auto file = read_file(path);
  if (!file) return file.error();
  try {
    const auto words = nlohmann::json::parse(as_text(*file));
    set_words(asked.title, words.at("title").get<std::string>(), words.at("description").get<std::string>());
    // The labels are those of the left picture.
    if (!asked.material.labels.empty() || asked.make.texture == "front") return {};
    std::vector<std::string> materials;
    for (const auto& name : words.at("objects"))
      materials.push_back(fmt::format("{}:name={}", materials.size(), name.get<std::string>()));
    asked.material.labels = (folder / "sculpture_labels.png").string();
    // The user's materials come after the sample's own, so that they take precedence.
    materials.insert(materials.end(), asked.material.materials.begin(), asked.material.materials.end());
    asked.material.materials = std::move(materials);
    return {};
  } catch (const nlohmann::json::exception&) {
    return invalid_input("is damaged", path.string());
  }
}

Result<void> set_sculptures(const Asked& asked, const std::filesystem::path& folder) {
  asked.make.inputs = {(folder / "sculpture_left.png").string(), (folder / "sculpture_right.png").string()};
  if (asked.make.stereo.calibration.empty())
    asked.make.stereo.calibration = (folder / "sculpture_calib.txt").string();
  return set_sculpture_words(asked, folder);
}

Result<void> set_drawing(const Asked& asked, const std::filesystem::path& folder) {
  asked.make.inputs = {(folder / "boat.png").string()};
  set_words(
      asked.title, "A sailing boat",
      "A line drawing. A boat with two sails on its mast is in the middle, the sun at the upper right, and "
      "a wavy line at the bottom is the sea.");
  return {};
}

Result<void> set_church(const Asked& asked, const std::filesystem::path& folder) {
  asked.make.inputs = {(folder / "church.obj").string()};
  set_words(
      asked.title, "A church",
      "A small church, seen from its side. A tower with a spire is at the left, the nave with its roof in "
      "the middle with a porch in front, and a round apse at the right.");
  return {};
}

Result<void> set_map(const Asked& asked, const std::filesystem::path& folder) {
  asked.make.inputs = {(folder / "town.osm").string()};
  constexpr double kWidth_m = 300.0;
  if (asked.make.map.center.empty()) asked.make.map.center = "50,-30";
  if (!asked.make.map.window_m) asked.make.map.window_m = kWidth_m;
  set_words(
      asked.title, "Oldbridge, a town that does not exist",
      "High Street leads from the west to the roundabout Clock Circle; Ferry Steps lead down to the river.");
  return {};
}

struct KnownSample {
  std::string_view name;
  /// One of its files, by which its folder is found.
  const char* file;
  Result<void> (*set)(const Asked& asked, const std::filesystem::path& folder);
};
constexpr std::array kSamples{KnownSample{"sculptures", "sculpture_left.png", set_sculptures},
                              KnownSample{"drawing", "boat.png", set_drawing},
                              KnownSample{"church", "church.obj", set_church},
                              KnownSample{"map", "town.osm", set_map}};

std::optional<std::filesystem::path> folder_with(const char* file) {
  std::error_code ignored;
  for (const std::filesystem::path& folder : sample_folders())
    if (std::filesystem::exists(folder / file, ignored)) return folder;
  return std::nullopt;
}

Error not_installed() {
  return {ErrorCode::failed, "the sample that comes with palpable is not installed", PALPABLE_SAMPLES};
}

}  // namespace

Result<void> resolve_sample(MakeArguments& make, TitleArguments& title, MaterialArguments& material) {
  if (make.inputs.size() != 1 || !make.inputs.front().starts_with(kSamplePrefix)) return {};
  const std::string_view name = std::string_view(make.inputs.front()).substr(kSamplePrefix.size());
  const auto* const known = std::find_if(kSamples.begin(), kSamples.end(),
                                         [&](const KnownSample& one) { return one.name == name; });
  if (known == kSamples.end())
    return Error{ErrorCode::usage, "there is no such sample: they are sculptures, drawing, church and map",
                 make.inputs.front()};
  const auto folder = folder_with(known->file);
  if (!folder) return not_installed();
  return known->set({make, title, material}, *folder);
}

}  // namespace palpable::cli
