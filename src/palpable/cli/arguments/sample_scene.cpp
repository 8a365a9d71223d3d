// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/sample_scene.hpp"

#include "palpable/cli/input_files.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"

#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::cli {
namespace {

/// sculpture.json: "title", "description" and "objects", the names of the values of sculpture_labels.png.
Result<SceneArguments> with_words(SceneArguments arguments, const std::filesystem::path& folder) {
  const auto path = folder / "sculpture.json";
  const auto file = read_file(path);
  if (!file) return file.error();
  try {
    const auto words = nlohmann::json::parse(as_text(*file));
    if (arguments.title.title.empty()) arguments.title.title = words.at("title").get<std::string>();
    if (arguments.title.description.empty())
      arguments.title.description = words.at("description").get<std::string>();
    // The labels are those of the left picture.
    if (!arguments.material.labels.empty() || arguments.make.texture == "front") return arguments;
    std::vector<std::string> materials;
    for (const auto& name : words.at("objects"))
      materials.push_back(fmt::format("{}:name={}", materials.size(), name.get<std::string>()));
    arguments.material.labels = (folder / "sculpture_labels.png").string();
    // The user's materials come after the sample's own, so that they take precedence.
    materials.insert(materials.end(), arguments.material.materials.begin(),
                     arguments.material.materials.end());
    arguments.material.materials = std::move(materials);
    return arguments;
  } catch (const nlohmann::json::exception&) {
    return invalid_input("is damaged", path.string());
  }
}

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

Result<void> resolve_sample(MakeArguments& make, TitleArguments& title) {
  if (make.inputs.size() != 1 || make.inputs.front() != kMapSample) return {};
  const auto folder = folder_with("town.osm");
  if (!folder) return not_installed();
  make.inputs = {(*folder / "town.osm").string()};
  constexpr double kWidth_m = 300.0;
  if (make.map.center.empty()) make.map.center = "50,-30";
  if (!make.map.window_m) make.map.window_m = kWidth_m;
  if (title.title.empty()) title.title = "Oldbridge, a town that does not exist";
  if (title.description.empty())
    title.description =
        "High Street leads from the west to the roundabout Clock Circle; Ferry Steps lead down to the river.";
  return {};
}

Result<SceneArguments> with_sample(SceneArguments arguments) {
  const auto folder = folder_with("sculpture_left.png");
  if (!folder) return not_installed();
  arguments.make.inputs = {(*folder / "sculpture_left.png").string(),
                           (*folder / "sculpture_right.png").string()};
  if (arguments.make.stereo.calibration.empty())
    arguments.make.stereo.calibration = (*folder / "sculpture_calib.txt").string();
  return with_words(std::move(arguments), *folder);
}

}  // namespace palpable::cli
