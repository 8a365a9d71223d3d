// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/probe_rows.hpp"

#include "palpable/haptics/law/law_options.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/servo/tool_path.hpp"

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

namespace palpable::onefile {
namespace {

using nlohmann::json;

Error wrong_usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

Result<haptics::Law> law_of(const json& options, const models::Scene& scene) {
  const auto laws = haptics::laws_for(scene);
  const auto given = options.find("law");
  if (given == options.end()) return laws.front();
  if (!given->is_string()) return wrong_usage("the law must be a name");
  const auto law = haptics::law_from(given->get<std::string>());
  if (!law || std::find(laws.begin(), laws.end(), *law) == laws.end())
    return wrong_usage("the scene, a " + models::kind_of(scene.model) + ", has no law " +
                       given->get<std::string>());
  return *law;
}

bool is_option_of_a_law(std::string_view option) {
  haptics::LawParameters unused;
  const auto all = haptics::all_laws();
  return std::any_of(all.begin(), all.end(),
                     [&](const auto* law) { return haptics::set_by_option(unused, *law, option, 0.0); });
}

Result<haptics::LawParameters> parameters_of(const json& options, const models::Scene& scene) {
  const auto law = law_of(options, scene);
  if (!law) return law.error();
  haptics::LawParameters parameters;
  parameters.law = *law;
  const haptics::LawDescription& description = haptics::description_of(*law);
  for (const auto& [option, value] : options.items()) {
    if (option == "law") continue;
    if (!is_option_of_a_law(option)) return wrong_usage("no law has the option " + option);
    if (!value.is_number()) return wrong_usage("the option " + option + " must be a number");
    const auto number = value.get<double>();
    if (option == "radius" && number > 0.0 && haptics::touches_with_a_point(description))
      return wrong_usage("the law " + std::string(description.name) +
                         " touches with a point: give no radius");
    haptics::set_by_option(parameters, description, option, number);
  }
  return parameters;
}

}  // namespace

Result<std::vector<ForceRow>> probe_rows(const models::Scene& scene, std::string_view options,
                                         std::span<const ProbeRow> rows) {
  const json given = json::parse(options, nullptr, false);
  if (!given.is_object()) return wrong_usage("the options must be an object");
  const auto parameters = parameters_of(given, scene);
  if (!parameters) return parameters.error();
  std::vector<haptics::ToolPose> poses(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    poses[i].t_s = rows[i][0];
    poses[i].scene_from_tool.translation_m = {rows[i][1], rows[i][2], rows[i][3]};
  }
  if (auto valid = haptics::check_poses(poses); !valid) return valid.error();
  const auto touchable = haptics::make_touchable(scene, *parameters);
  if (!touchable) return touchable.error();
  std::vector<ForceRow> forces;
  forces.reserve(rows.size());
  const haptics::ToolPlace point{};
  haptics::probe_tools(**touchable, {&point, 1}, poses,
                       [&](const haptics::ToolPose&, const haptics::ToolOutput& output) {
                         const Vec3 f = output.force_N.v;
                         forces.push_back({f.x, f.y, f.z, output.contact ? 1.0 : 0.0});
                       });
  return forces;
}

}  // namespace palpable::onefile
