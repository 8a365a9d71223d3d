// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/parameter_groups.hpp"
#include "palpable/cli/arguments/stereo_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <memory>
#include <string>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

Json json_of(const Parameter& p) {
  return {{"name", p.name},        {"default", p.get()}, {"least", p.range.least}, {"most", p.range.most},
          {"whole", p.is_whole()}, {"unit", p.unit},     {"meaning", p.meaning}};
}

/// All methods, one line each.
Answer all_methods() {
  Answer answer;
  answer.json["methods"] = Json::array();
  for (const vision::StereoMethod method : vision::available_stereo_methods()) {
    answer.json["methods"].push_back({{"name", vision::name_of(method)},
                                      {"summary", vision::summary_of(method)},
                                      {"paper", vision::paper_of(method)}});
    answer.text += fmt::format("{:<10} {} ({})\n", vision::name_of(method), vision::summary_of(method),
                               vision::paper_of(method));
  }
  answer.json["steps"] = Json::array();
  answer.text += "\nOther steps from an input to its scene:\n";
  for (const ParameterGroup& group : parameter_groups()) {
    answer.json["steps"].push_back(
        {{"name", group.name}, {"summary", group.summary}, {"tuned_on", group.tuned_on}});
    answer.text += fmt::format("{:<10} {}\n", group.name, group.summary);
  }
  answer.text += "\npalpable methods NAME lists the parameters of one of them.\n";
  return answer;
}

void add_parameters(const std::vector<Parameter>& parameters, Answer& answer) {
  for (const Parameter& p : parameters) {
    answer.json["parameters"].push_back(json_of(p));
    answer.text +=
        fmt::format("  {:<44} {:>8} {:<10} {:>6} … {:<8} {}\n", p.name, fmt::format("{:g}", p.get()), p.unit,
                    fmt::format("{:g}", p.range.least), fmt::format("{:g}", p.range.most), p.meaning);
  }
}

/// One step's parameters, one line each.
Answer one_group(const ParameterGroup& group) {
  SettableOptions options;
  Answer answer;
  answer.json = {{"name", group.name},
                 {"summary", group.summary},
                 {"tuned_on", group.tuned_on},
                 {"parameters", Json::array()}};
  const std::string defaults = group.tuned_on.empty() ? "initial values, not tuned"
                                                      : fmt::format("defaults chosen on {}", group.tuned_on);
  answer.text = fmt::format("{}: {}; {}\n", group.name, group.summary, defaults);
  add_parameters(parameters_of(group, options), answer);
  return answer;
}

/// One method's parameters, one line each.
Result<Answer> one_method(const std::string& name) {
  if (const ParameterGroup* group = find_group(name)) return one_group(*group);
  StereoArguments arguments;
  arguments.method = name;
  const auto method = stereo_method(arguments);
  if (!method) {
    std::string steps;
    for (const ParameterGroup& group : parameter_groups())
      steps += (steps.empty() ? "" : ", ") + std::string(group.name);
    return Error{method.error().code, method.error().message + "; the steps are " + steps, name};
  }
  vision::StereoOptions options;
  Answer answer;
  answer.json = {{"name", vision::name_of(*method)},
                 {"summary", vision::summary_of(*method)},
                 {"paper", vision::paper_of(*method)},
                 {"parameters", Json::array()}};
  answer.text = fmt::format("{}: {} ({})\n", vision::name_of(*method), vision::summary_of(*method),
                            vision::paper_of(*method));
  add_parameters(vision::parameters_of(options, *method), answer);
  return answer;
}

}  // namespace

void add_methods(Program& program) {
  const auto name = std::make_shared<std::string>();
  Options options = add_command(
      program, "methods", "The stereo methods and other steps, and the parameters that --set changes",
      "  palpable methods\n"
      "  palpable methods best\n"
      "  palpable methods contours\n"
      "  palpable make scan.png -o scan.palp --set contours.standard.half_contrast=0.1\n"
      "  palpable depth left.png right.png -o depth.pfm --set smoothness.largest_step=2",
      [name](Console& /*console*/) -> Result<Answer> {
        if (name->empty()) return all_methods();
        return one_method(*name);
      });
  options.optional_argument("NAME", *name,
                            "The method or step whose parameters are listed: default, unit, range, meaning");
}

}  // namespace palpable::cli
