// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/score/disparity_file.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/measure/boundary_score.hpp"
#include "palpable/measure/orientation_score.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

bool is_npz(const std::string& file) { return std::filesystem::path(file).extension() == ".npz"; }
bool is_scene(const std::string& file) { return std::filesystem::path(file).extension() == ".palp"; }

Result<models::BoundaryMap> read_boundaries(const std::string& file) {
  auto read = read_scene_argument(file);
  if (!read) return read.error();
  const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&read->scene.model);
  if (contours == nullptr) return Error{ErrorCode::invalid_input, "this scene has no contours", file};
  return (*contours)->boundaries;
}

Result<Raster<float>> member(const formats::Npz& arrays, const std::string& name, const std::string& file) {
  const auto found = arrays.find(name);
  if (found == arrays.end())
    return Error{ErrorCode::invalid_input, fmt::format("has no array {}", name), file};
  auto raster = formats::raster_of(found->second);
  if (!raster) return Error{raster.error().code, raster.error().message, file};
  return raster;
}

/// Reads one-pixel-wide boundaries from a scene, an .npz (`line`), or the grey values of a picture.
Result<Raster<float>> read_lines(const std::string& file) {
  if (is_scene(file)) {
    const auto map = read_boundaries(file);
    if (!map) return map.error();
    return sculpt::boundary_lines(*map);
  }
  if (is_npz(file)) {
    const auto arrays = formats::read_npz(file);
    if (!arrays) return arrays.error();
    return member(*arrays, "line", file);
  }
  const auto picture = sources::read_picture(file);
  if (!picture) return picture.error();
  return grey(*picture);
}

struct BoundaryArguments {
  std::string result;
  std::vector<std::string> truths;
  std::string truth_is = "labels";
  double tolerance_percent = 0.75;
};

/// Non-zero = boundary.
Result<Raster<std::uint8_t>> read_truth(const std::string& file, const std::string& truth_is) {
  if (truth_is == "lines") return read_mask(file);
  const auto picture = sources::read_picture(file);
  if (!picture) return picture.error();
  return measure::boundary_of_labels(grey(*picture));
}

Json json_of(const measure::BoundaryCounts& c) {
  return {{"threshold", c.threshold}, {"precision", c.precision()}, {"recall", c.recall()},
          {"f", c.f_measure()},       {"found", c.found},           {"wanted", c.wanted}};
}

Result<Answer> score_boundary(const BoundaryArguments& arguments, Console& console) {
  const auto lines = read_lines(arguments.result);
  if (!lines) return lines.error();
  std::vector<Raster<std::uint8_t>> truths;
  for (const std::string& file : arguments.truths) {
    auto truth = read_truth(file, arguments.truth_is);
    if (!truth) return truth.error();
    truths.push_back(*std::move(truth));
  }
  measure::BoundaryScoreOptions options;
  options.tolerance_of_diagonal = arguments.tolerance_percent / 100.0;
  options.thresholds = measure::usual_thresholds();
  const auto curve = measure::score_boundary(*lines, truths, options, console.work());
  if (!curve) return Error{curve.error().code, curve.error().message, arguments.result};
  const auto best = std::max_element(curve->begin(), curve->end(), [](const auto& a, const auto& b) {
    return a.f_measure() < b.f_measure();
  });
  Answer answer;
  answer.json = {
      {"truths", truths.size()},
      {"tolerance_px", options.tolerance_of_diagonal * std::hypot(lines->width(), lines->height())},
      {"best", json_of(*best)},
      {"curve", Json::array()}};
  for (const auto& counts : *curve) answer.json["curve"].push_back(json_of(counts));
  answer.text = fmt::format("best F {:.3f} at strength {:.2f}: precision {:.3f}, recall {:.3f}, {} truth{}\n",
                            best->f_measure(), best->threshold, best->precision(), best->recall(),
                            truths.size(), truths.size() == 1 ? "" : "s");
  return answer;
}

struct OrientationArguments {
  std::string result, truth;
  double least_strength = 0.8;
  int margin_px = 0;
};

/// Reads directions from a contours scene (averaged, as rendered), or from an .npz written by `export`.
Result<measure::Directions> read_directions(const std::string& file) {
  if (!is_npz(file)) {
    const auto map = read_boundaries(file);
    if (!map) return map.error();
    sculpt::TangentMap tangents = sculpt::tangents_of(map->averaged());
    return measure::Directions{std::move(tangents.x), std::move(tangents.y), std::move(tangents.strength)};
  }
  const auto arrays = formats::read_npz(file);
  if (!arrays) return arrays.error();
  auto x = member(*arrays, "tangent_x", file);
  if (!x) return x.error();
  auto y = member(*arrays, "tangent_y", file);
  if (!y) return y.error();
  auto strength = member(*arrays, "strength", file);
  if (!strength) return strength.error();
  return measure::Directions{*std::move(x), *std::move(y), *std::move(strength)};
}

Result<Answer> score_orientation(const OrientationArguments& arguments) {
  const auto result = read_directions(arguments.result);
  if (!result) return result.error();
  const auto truth = read_directions(arguments.truth);
  if (!truth) return truth.error();
  const auto score =
      measure::score_orientation(*result, *truth, {arguments.least_strength, arguments.margin_px});
  if (!score) return Error{score.error().code, score.error().message, arguments.result};
  Answer answer;
  answer.json = {{"pixels", score->pixels},
                 {"max_deg", score->max_deg},
                 {"mean_deg", score->mean_deg},
                 {"rms_deg", score->rms_deg}};
  answer.text = fmt::format("{} pixels: greatest error {:.3f} degrees, mean {:.3f}, RMS {:.3f}\n",
                            score->pixels, score->max_deg, score->mean_deg, score->rms_deg);
  return answer;
}

void add_score_orientation(Program& program) {
  const auto arguments = std::make_shared<OrientationArguments>();
  Options options = add_command_below(
      program, "score", "orientation", "Angle between the directions of contours and the true ones",
      "  palpable score orientation edge.palp truth.npz",
      [arguments](Console& /*console*/) { return score_orientation(*arguments); });
  options.argument("RESULT", arguments->result, "A .palp scene of contours, or .npz as export writes it");
  options.argument("TRUTH", arguments->truth, "The same; pixels whose tangent is not zero count");
  options.number("--least-strength", arguments->least_strength, {0.0, 1.0},
                 "Share of the greatest strength from which a pixel counts");
  options.integer("--margin", arguments->margin_px, {0.0, 10000.0}, "Pixels at the border that are left out");
}

}  // namespace

void add_score_contours(Program& program) {
  add_score_orientation(program);
  const auto arguments = std::make_shared<BoundaryArguments>();
  Options options = add_command_below(
      program, "score", "boundary", "Precision, recall and F of boundaries against what people drew",
      "  palpable score boundary scan.palp lesion_mask.png\n"
      "  palpable score boundary lines.png drawn_a.png drawn_b.png --truth lines",
      [arguments](Console& console) { return score_boundary(*arguments, console); });
  constexpr int kMostTruths = 64;
  options.argument("RESULT", arguments->result,
                   "A .palp scene of contours, .npz as export writes it, or a picture of lines");
  options.arguments("TRUTH", arguments->truths, kMostTruths, "One picture per person, of the same size");
  options.choice(
      "--truth", arguments->truth_is, {"labels", "lines"},
      "What the truth shows: regions whose borders count (a mask has two), or the lines themselves");
  options.number("--tolerance", arguments->tolerance_percent, {0.01, 10.0},
                 "Distance within which a pixel counts as found, percent of the diagonal");
}

}  // namespace palpable::cli
