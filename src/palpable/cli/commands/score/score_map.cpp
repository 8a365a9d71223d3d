// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/text/json_integer.hpp"
#include "palpable/measure/street_map_score.hpp"

#include <memory>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct ScoreMapArguments {
  std::string scene, truth;
};

/// Throws the parser's exceptions for another form.
measure::TrueStreetMap true_map_of(const Json& json) {
  measure::TrueStreetMap out;
  out.width_px = integer_from<int>(json.at("width"));
  out.height_px = integer_from<int>(json.at("height"));
  for (const Json& street : json.at("streets")) {
    measure::TrueStreet way;
    way.kind = street.at("highway").get<std::string>();
    way.name = street.value("name", std::string());
    way.width_px = street.value("width_px", 0.0);
    for (const Json& line : street.at("polylines_px")) {
      way.lines.emplace_back();
      for (const Json& p : line) way.lines.back().push_back({p.at(0).get<double>(), p.at(1).get<double>()});
    }
    out.streets.push_back(std::move(way));
  }
  if (json.contains("lettering"))
    for (const Json& name : json.at("lettering"))
      out.drawn_names.push_back(name.at("text").get<std::string>());
  return out;
}

Result<measure::TrueStreetMap> read_true_map(const std::string& path) {
  const auto text = read_text_file(path);
  if (!text) return text.error();
  try {
    return true_map_of(Json::parse(*text));
  } catch (const Json::exception&) {
    return Error{ErrorCode::invalid_input, "is not the truth of a street map (docs/maps.md)", path};
  }
}

Result<Answer> score_map(const ScoreMapArguments& arguments) {
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  if (file->scene.map == nullptr)
    return Error{ErrorCode::invalid_input, "this scene is not a street map", arguments.scene};
  const auto truth = read_true_map(arguments.truth);
  if (!truth) return truth.error();
  const auto score = measure::score_street_map(*file->scene.map, *truth);
  if (!score) return Error{score.error().code, score.error().message, arguments.truth};
  Answer answer;
  answer.json = {
      {"length_px", score->length_px},
      {"found", score->found},
      {"found_closely", score->found_closely},
      {"true", score->true_part},
      {"area_iou", score->area_iou},
      {"junctions",
       {{"wanted", score->junctions},
        {"found", score->junctions_found},
        {"right_degree", score->junctions_right_degree},
        {"false", score->junctions_false},
        {"f", score->junction_f()}}},
      {"names", {{"wanted", score->names}, {"right", score->names_right}, {"false", score->names_false}}}};
  answer.text = fmt::format(
      "centre lines: {:.1f} % found within 3 px, {:.1f} % within 2 px; {:.1f} % of what was found is true\n"
      "street area: intersection over union {:.3f}\n"
      "junctions: {} of {} found, {} of them with the right degree, {} false, F {:.3f}\n"
      "names: {} of {} right, {} false\n",
      100.0 * score->found, 100.0 * score->found_closely, 100.0 * score->true_part, score->area_iou,
      score->junctions_found, score->junctions, score->junctions_right_degree, score->junctions_false,
      score->junction_f(), score->names_right, score->names, score->names_false);
  return answer;
}

}  // namespace

void add_score_map(Program& program) {
  const auto arguments = std::make_shared<ScoreMapArguments>();
  Options options = add_command_below(program, "score", "map",
                                      "Streets, junctions and names of a map against the true ones",
                                      "  palpable score map town.palp town.json",
                                      [arguments](Console& /*console*/) { return score_map(*arguments); });
  options.argument("RESULT", arguments->scene, "A .palp scene of a street map");
  options.argument("TRUTH", arguments->truth, "The true map, JSON (docs/maps.md)");
}

}  // namespace palpable::cli
