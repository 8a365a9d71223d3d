// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/unused_parameters.hpp"

#include "palpable/cli/arguments/parameter_groups.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/recipes/relief/regions.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

using sources::InputKind;

/// A scene, and what it was made from.
struct MadeFrom {
  const MakeArguments& arguments;
  const session::MakeOptions& options;
  InputKind input;
  const std::string& made;

  bool has_several_depth_maps() const { return session::holds_depth_maps(options.input); }
  bool is_contours() const { return made == "contours"; }
  /// Made from the depth of one camera.
  bool is_seen() const {
    return (input == InputKind::stereo || input == InputKind::depth) && !is_contours() &&
           !has_several_depth_maps();
  }
  /// The model of a map is a relief.
  bool is_map() const {
    return input == InputKind::map || (options.as == session::MakeAs::map && input != InputKind::scene);
  }
  bool is_field() const { return made == "field" || made == "dense-field"; }
};

/// Whether the parameters of a step have an effect on the scene.
struct StepUse {
  std::string_view step;
  bool (*is_used)(const MadeFrom&);
};

constexpr std::array kSteps{
    StepUse{"contours", [](const MadeFrom& m) { return m.is_contours() && m.input != InputKind::scene; }},
    StepUse{"grooves", [](const MadeFrom& m) { return m.is_contours() && m.input != InputKind::scene; }},
    StepUse{"detail", [](const MadeFrom& m) { return m.is_seen(); }},
    StepUse{"depth_camera",
            [](const MadeFrom& m) { return m.input == InputKind::depth && !m.has_several_depth_maps(); }},
    StepUse{"ground", [](const MadeFrom& m) { return m.is_seen(); }},
    StepUse{"background", [](const MadeFrom& m) { return m.is_seen(); }},
    StepUse{"placement",
            [](const MadeFrom& m) {
              return m.input == InputKind::mesh || m.input == InputKind::points ||
                     m.input == InputKind::shapes || m.input == InputKind::level_set ||
                     m.input == InputKind::video || m.has_several_depth_maps();
            }},
    // The field of a scene may have been made from its relief.
    StepUse{"field",
            [](const MadeFrom& m) {
              return m.is_field() && (m.input != InputKind::scene || m.options.as == session::MakeAs::field);
            }},
    StepUse{"fusion",
            [](const MadeFrom& m) {
              return m.is_field() && (m.input == InputKind::video || m.has_several_depth_maps());
            }},
    StepUse{"video", [](const MadeFrom& m) { return m.input == InputKind::video; }},
    StepUse{"sheet", [](const MadeFrom& m) { return m.input == InputKind::mesh && m.made == "relief"; }},
    // An extract's streets and names are known.
    StepUse{"map", [](const MadeFrom& m) { return m.is_map() && m.input != InputKind::map; }},
    StepUse{"map_relief", [](const MadeFrom& m) { return m.is_map(); }},
    // They belong to the commands fit-shapes and fit.
    StepUse{"shapes", [](const MadeFrom&) { return false; }},
    StepUse{"verdict", [](const MadeFrom&) { return false; }}};

/// A name of parts with dots between them: "detail" and "bilateral" of "detail.bilateral.range".
std::string_view first_part(std::string_view name) { return name.substr(0, name.find('.')); }
std::string_view second_part(std::string_view name) {
  const std::size_t dot = name.find('.');
  return dot == std::string_view::npos ? std::string_view() : first_part(name.substr(dot + 1));
}

bool is_parameter_of_stereo(const std::string& name, const MadeFrom& from) {
  vision::StereoOptions options;
  const auto known =
      vision::parameters_of(options, from.options.recipes.stereo.method.value_or(recipes::default_method()));
  return std::any_of(known.begin(), known.end(), [&](const Parameter& p) { return p.name == name; });
}

std::string_view name_of(vision::ContourMethod method) {
  switch (method) {
    case vision::ContourMethod::standard:
      return "--contour-method standard";
    case vision::ContourMethod::best:
      return "--quality best";
    default:
      return "--contour-method paper";
  }
}

/// The choice because of which a parameter of a step that is used has no effect; nullopt if it has one.
std::optional<std::string> excluding_choice(std::string_view name, const MadeFrom& from) {
  const std::string_view step = first_part(name), method = second_part(name);
  const recipes::ReliefRecipe& relief = from.options.recipes.relief;
  if (step == "detail" && from.arguments.detail != kCompareDetails && method != from.arguments.detail)
    return "with --detail " + from.arguments.detail;
  if (step == "ground" && !recipes::asks_for_regions(relief)) return "without --ground or --background";
  if (step == "background" && relief.background == recipes::BackgroundTreatment::keep)
    return "without --background remove";
  if (step != "contours") return std::nullopt;
  const vision::ContourMethod chosen = from.options.recipes.contours.contours.method;
  // The method best starts from the standard one.
  const bool excluded = (method == "best" && chosen != vision::ContourMethod::best) ||
                        (method == "standard" && chosen == vision::ContourMethod::paper);
  if (excluded) return fmt::format("with {}", name_of(chosen));
  return std::nullopt;
}

}  // namespace

UnusedParameters unused_parameters(const MakeArguments& arguments, const session::MakeOptions& options,
                                   InputKind input, const std::string& made) {
  const MadeFrom from{arguments, options, input, made};
  UnusedParameters unused;
  std::map<std::string, std::vector<std::string>> by_choice;
  for (const std::string& assignment : arguments.stereo.parameters) {
    const std::string name = assignment.substr(0, assignment.find('='));
    const auto* const use = std::find_if(kSteps.begin(), kSteps.end(),
                                         [&](const StepUse& step) { return step.step == first_part(name); });
    // A parameter of the stereo method has no prefix, and `background` is also the name of a part of one.
    const bool of_stereo = is_parameter_of_stereo(name, from);
    const bool used = of_stereo             ? input == InputKind::stereo && !from.is_contours()
                      : use != kSteps.end() ? use->is_used(from)
                                            : true;
    if (!used)
      unused.of_other_scenes.push_back(name);
    else if (const auto choice = of_stereo ? std::nullopt : excluding_choice(name, from))
      by_choice[*choice].push_back(name);
  }
  for (const auto& [choice, names] : by_choice)
    unused.sentences.push_back(fmt::format("{} {} no effect {}.", describe::listed(names),
                                           names.size() == 1 ? "has" : "have", choice));
  return unused;
}

}  // namespace palpable::cli
