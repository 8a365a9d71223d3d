// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/parameter_groups.hpp"

#include "palpable/cli/suggest.hpp"
#include "palpable/core/text/number_text.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

constexpr std::array kGroups{
    ParameterGroup{"contours", "The boundaries of a picture",
                   "drawn shapes, and pictures with added grain and speckle",
                   [](SettableOptions& o) { return vision::parameters_of(o.recipes.contours.contours); }},
    ParameterGroup{"grooves", "How the boundaries are cut into a plate", "a finger's width",
                   [](SettableOptions& o) { return sculpt::parameters_of(o.recipes.contours.grooves); }},
    ParameterGroup{
        "detail", "The detail operators of a relief (--detail)", "rendered depth maps (docs/relief.md)",
        [](SettableOptions& o) { return sculpt::parameters_of(o.recipes.relief.relief.detail_options); }},
    ParameterGroup{"depth_camera", "The noise of a depth camera in a depth map",
                   "generated rooms (docs/relief.md)",
                   [](SettableOptions& o) { return vision::parameters_of(o.recipes.relief.depth_camera); }},
    ParameterGroup{"ground", "The plane that objects stand on (--ground)",
                   "generated pairs of tables and rooms",
                   [](SettableOptions& o) { return vision::parameters_of(o.recipes.relief.ground_options); }},
    ParameterGroup{
        "background", "What lies behind the objects (--background)", "generated pairs of tables and rooms",
        [](SettableOptions& o) { return vision::parameters_of(o.recipes.relief.background_options); }},
    ParameterGroup{"placement", "How a solid is laid and scaled", "solids of known shape, and a city",
                   [](SettableOptions& o) { return sculpt::parameters_of(o.recipes.field.placement); }},
    ParameterGroup{"field", "The field of a solid", "generated solids and scans (docs/fields.md)",
                   [](SettableOptions& o) {
                     auto parameters = sculpt::parameters_of(o.recipes.field.field);
                     append_parameters(parameters, "walls", sculpt::parameters_of(o.recipes.field.walls));
                     append_parameters(parameters, "sheets", sculpt::parameters_of(o.recipes.field.sheets));
                     append_parameters(parameters, "cloud", sculpt::parameters_of(o.recipes.field.cloud));
                     append_parameters(parameters, "prediction",
                                       recipes::parameters_of(o.recipes.field.prediction));
                     return parameters;
                   }},
    ParameterGroup{"fusion", "The fusion of several depth maps",
                   "a ball that simulated cameras see, with noise",
                   [](SettableOptions& o) { return sculpt::parameters_of(o.recipes.fusion); }},
    ParameterGroup{"video", "From a video to its depth", "",
                   [](SettableOptions& o) { return recipes::parameters_of(o.recipes.video); }},
    ParameterGroup{"sheet", "The relief of an open mesh", "a printed map",
                   [](SettableOptions& o) { return sculpt::parameters_of(o.recipes.sheet); }},
    ParameterGroup{"map", "The streets and names of a map's picture (--as map)",
                   "drawn maps of eight styles (docs/maps.md)",
                   [](SettableOptions& o) {
                     auto parameters = vision::parameters_of(o.recipes.map.streets);
                     append_parameters(parameters, "places", models::parameters_of(o.recipes.map.places));
                     return parameters;
                   }},
    ParameterGroup{"map_relief", "The relief of a street map", "rules for tactile maps (docs/maps.md)",
                   [](SettableOptions& o) { return sculpt::parameters_of(o.recipes.map.relief); }},
    ParameterGroup{"shapes", "Superquadrics fitted to points (fit-shapes --fit robust or solina)",
                   "generated figures, unions of superquadrics (docs/superquadrics.md)",
                   [](SettableOptions& o) { return sculpt::parameters_of(o.shapes); }},
    ParameterGroup{"verdict", "When a pair is fit to touch (fit)", "generated pairs, good and degraded",
                   [](SettableOptions& o) { return vision::parameters_of(o.verdict); }}};

}  // namespace

std::span<const ParameterGroup> parameter_groups() { return kGroups; }

const ParameterGroup* find_group(std::string_view name) {
  const auto* const found = std::find_if(kGroups.begin(), kGroups.end(),
                                         [name](const ParameterGroup& group) { return group.name == name; });
  return found != kGroups.end() ? found : nullptr;
}

std::vector<Parameter> parameters_of(const ParameterGroup& group, SettableOptions& options) {
  std::vector<Parameter> parameters;
  append_parameters(parameters, group.name, group.parameters(options));
  return parameters;
}

Result<void> set_parameters(std::span<const std::string> given, std::span<const Parameter> known,
                            std::string_view owner) {
  std::set<std::string> set_before;
  for (const std::string& assignment : given) {
    const auto refused = [&](std::string why) {
      return Error{ErrorCode::usage, std::move(why), "--set " + assignment};
    };
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos) return refused("a parameter is set as NAME=VALUE");
    const std::string name = assignment.substr(0, equals);
    const auto value = finite_number(std::string_view(assignment).substr(equals + 1));
    if (!value) return refused("the value is not a number");
    const auto parameter =
        std::find_if(known.begin(), known.end(), [&](const Parameter& p) { return p.name == name; });
    if (parameter == known.end()) {
      std::vector<std::string> names;
      for (const Parameter& p : known) names.push_back(p.name);
      const auto meant = suggestion(name, names);
      return refused(fmt::format("there is no parameter {}{}; palpable methods {} lists them", name,
                                 meant ? ", did you mean " + *meant + "?" : "", owner));
    }
    if (!set_before.insert(name).second) return refused(name + " is given more than once");
    if (const auto set = set_parameter(*parameter, *value); !set)
      return refused(fmt::format("{} {}", name, set.error().message));
  }
  return {};
}

}  // namespace palpable::cli
