// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/law_options.hpp"

#include "palpable/cli/suggest.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/haptics/law/law_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

namespace palpable::cli {

namespace {

using haptics::LawDescription;
using haptics::LawParameter;

std::string typed_unit(const LawParameter& parameter) {
  return parameter.unit == "m" ? "mm" : std::string(parameter.unit);
}

/// The meaning of an option, and the laws that have it.
struct OptionUse {
  std::string meaning;
  std::vector<std::string_view> laws;
};

struct LawOption {
  std::string name;
  Range range;
  std::vector<OptionUse> uses;
};

void add_use(LawOption& option, const LawDescription& law, const LawParameter& parameter) {
  const double scale = haptics::typed_per_si(parameter);
  option.range.least = std::min(option.range.least, scale * parameter.min);
  option.range.most = std::max(option.range.most, scale * parameter.max);
  std::string meaning(parameter.title);
  if (const auto unit = typed_unit(parameter); !unit.empty()) meaning += ", " + unit;
  const auto same = std::find_if(option.uses.begin(), option.uses.end(),
                                 [&](const OptionUse& use) { return use.meaning == meaning; });
  if (same != option.uses.end()) {
    same->laws.push_back(law.name);
  } else {
    option.uses.push_back({meaning, {law.name}});
  }
}

std::vector<LawOption> options_of_all_laws() {
  std::vector<LawOption> options;
  for (const LawDescription* law : haptics::all_laws())
    for (const LawParameter& parameter : law->parameters) {
      if (parameter.option.empty()) continue;
      auto found = std::find_if(options.begin(), options.end(),
                                [&](const LawOption& o) { return o.name == parameter.option; });
      if (found == options.end()) {
        const double scale = haptics::typed_per_si(parameter);
        options.push_back(
            {std::string(parameter.option), {scale * parameter.min, scale * parameter.max}, {}});
        found = options.end() - 1;
      }
      add_use(*found, *law, parameter);
    }
  return options;
}

/// A number that the law does not have is kept for the law that is used if the scene does not support this
/// one.
void set_number(haptics::LawParameters& parameters, const LawDescription& law, const LawNumber& number) {
  if (haptics::set_by_option(parameters, law, number.option, *number.value)) return;
  for (const LawDescription* other : haptics::all_laws())
    if (haptics::set_by_option(parameters, *other, number.option, *number.value)) return;
}

std::string help_of(const LawOption& option) {
  std::string help;
  for (const OptionUse& use : option.uses)
    help += fmt::format("{}{} ({})", help.empty() ? "" : "; ", use.meaning, fmt::join(use.laws, ", "));
  return help;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const LawDescription* law : haptics::all_laws()) names.emplace_back(law->name);
  return names;
}

/// The laws by kind of scene: "reliefs: proxy, rolling; contours: tracing".
std::string laws_by_kind() {
  using haptics::ModelKinds;
  struct KindOfScene {
    const char* name;
    bool ModelKinds::*kind;
  };
  constexpr std::array kKinds{
      KindOfScene{"reliefs", &ModelKinds::relief}, KindOfScene{"solids", &ModelKinds::field},
      KindOfScene{"contours", &ModelKinds::contours}, KindOfScene{"grids", &ModelKinds::grid}};
  std::string words;
  for (const auto& [name, kind] : kKinds) {
    std::vector<std::string_view> laws;
    for (const LawDescription* law : haptics::all_laws())
      if (law->models.*kind) laws.push_back(law->name);
    words += fmt::format("{}{}: {}", words.empty() ? "" : "; ", name, fmt::join(laws, ", "));
  }
  return words;
}

/// The laws that break a rule of contact: ". averaged: within its offset ...".
std::string contact_errors() {
  std::string words;
  for (const LawDescription* law : haptics::all_laws())
    if (!law->contact_error.empty()) words += fmt::format(". {}: {}", law->name, law->contact_error);
  return words;
}

Error unknown_law(const std::string& typed) {
  const auto meant = suggestion(typed, all_names());
  return {ErrorCode::usage,
          fmt::format("'{}' is not one of the force laws ({}){}", typed, laws_by_kind(),
                      meant ? fmt::format("; did you mean {}?", *meant) : ""),
          "--law"};
}

}  // namespace

void add_law_options(Options& options, LawArguments& arguments) {
  options.under("How the surface responds");
  options.text("--law", arguments.law,
               fmt::format("Force law; the first for a kind of scene is its default ({}){}", laws_by_kind(),
                           contact_errors()));
  const auto all = options_of_all_laws();
  arguments.numbers.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    arguments.numbers[i].option = all[i].name;
    options.number("--" + all[i].name, arguments.numbers[i].value, all[i].range, help_of(all[i]));
  }
}

Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, haptics::Law otherwise) {
  haptics::LawParameters parameters;
  parameters.law = otherwise;
  if (!arguments.law.empty()) {
    const auto law = haptics::law_from(arguments.law);
    if (!law) return unknown_law(arguments.law);
    parameters.law = *law;
  }
  const LawDescription& description = haptics::description_of(parameters.law);
  for (const LawNumber& number : arguments.numbers)
    if (number.value) set_number(parameters, description, number);
  if (haptics::touches_with_a_point(description))
    for (const LawNumber& number : arguments.numbers)
      if (number.option == "radius" && number.value.value_or(0.0) > 0.0)
        return Error{ErrorCode::usage,
                     fmt::format("the law {} touches with a point: give no radius", description.name),
                     "--radius"};
  return parameters;
}

Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, const models::Scene& scene) {
  const auto laws = haptics::laws_for(scene);
  std::vector<std::string> names;
  for (const haptics::Law law : laws) names.emplace_back(haptics::name_of(law));
  if (!arguments.law.empty() && std::find(names.begin(), names.end(), arguments.law) == names.end()) {
    const auto meant = suggestion(arguments.law, names);
    return Error{ErrorCode::usage,
                 fmt::format("'{}' is not a law of this scene, a {}: its laws are {}{}", arguments.law,
                             models::kind_of(scene.model), fmt::join(names, ", "),
                             meant ? fmt::format("; did you mean {}?", *meant) : ""),
                 "--law"};
  }
  return law_parameters(arguments, laws.empty() ? haptics::Law::proxy : laws.front());
}

std::optional<Note> note_on_unused(const LawArguments& arguments, haptics::Law used) {
  const auto& known = haptics::description_of(used).parameters;
  std::vector<std::string> unused;
  for (const LawNumber& number : arguments.numbers)
    if (number.value && std::none_of(known.begin(), known.end(), [&](const LawParameter& parameter) {
          return parameter.option == number.option;
        }))
      unused.push_back("--" + number.option);
  if (unused.empty()) return std::nullopt;
  return Note(fmt::format("{} {} no effect with the law {}.", describe::listed(unused),
                          unused.size() == 1 ? "has" : "have", haptics::name_of(used)));
}

haptics::Law law_for(haptics::Law chosen, const models::Scene& scene) {
  const auto laws = haptics::laws_for(scene);
  const bool fits = laws.empty() || std::find(laws.begin(), laws.end(), chosen) != laws.end();
  return fits ? chosen : laws.front();
}

std::string bench_name(const haptics::LawParameters& parameters, const models::Scene& scene) {
  const double friction = parameters.static_friction.value_or(scene.materials.front().static_friction);
  const haptics::LawDescription& law = haptics::description_of(parameters.law);
  const bool slides =
      find_parameter(law, &haptics::LawParameters::static_friction) != nullptr && friction > 0.0;
  const bool textured =
      law.renders_textures && std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& m) {
        return m.texture.kind != models::TouchTexture::Kind::none;
      });
  return std::string(law.name) + (slides ? "-friction" : "") + (textured ? "-texture" : "");
}

}  // namespace palpable::cli
