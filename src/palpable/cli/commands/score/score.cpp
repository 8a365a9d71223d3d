// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/score/disparity_file.hpp"
#include "palpable/cli/commands/score/score_json.hpp"
#include "palpable/measure/relief_score.hpp"
#include "palpable/sources/depth/depth_file.hpp"

#include <cmath>
#include <memory>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct ScoreArguments {
  std::string result, truth, mask;
  std::optional<double> result_scale, truth_scale;
};

Answer answer_of(const DisparityScores& scores) {
  const measure::DisparityScore& score = scores.pixels;
  std::string shares;
  for (std::size_t i = 0; i < measure::kBadThresholds_px.size(); ++i)
    shares += fmt::format("{}over {:g} px {:.2f} %", i == 0 ? "" : ", ", measure::kBadThresholds_px[i],
                          score.bad_percent[i]);
  Answer answer;
  answer.json = json_of(scores);
  answer.text = fmt::format(
      "{} pixels scored, {:.1f} % of them known\nbad: {}\nRMS {:.3f} px, {:.2f} % of the truth's range\n"
      "as a relief of 100 mm, 15 mm high: normals off by {:.2f}°, {:.3f} spurious steps per cm\n",
      score.pixels, 100.0 * score.coverage, shares, score.rms_px, score.rms_percent_of_range,
      scores.touch.normal_error_deg, scores.touch.spurious_steps_per_cm);
  return answer;
}

Result<Answer> score_disparity(const ScoreArguments& arguments) {
  const auto result = read_disparity(arguments.result, arguments.result_scale);
  if (!result) return result.error();
  const auto truth = read_disparity(arguments.truth, arguments.truth_scale);
  if (!truth) return truth.error();
  Raster<std::uint8_t> mask;
  if (!arguments.mask.empty()) {
    auto read = read_mask(arguments.mask);
    if (!read) return read.error();
    mask = std::move(*read);
  }
  const auto score = scores_of(*result, *truth, mask);
  if (!score) return Error{score.error().code, score.error().message, arguments.result};
  return answer_of(*score);
}

struct ReliefArguments {
  std::string scene, truth, kind = "depth";
  double compression = 10.0;
};

/// Greater is nearer, in the truth's own unit.
Result<Raster<float>> read_nearness(const ReliefArguments& arguments) {
  if (arguments.kind == "disparity") return read_disparity(arguments.truth, std::nullopt);
  auto read = sources::read_depth(arguments.truth, 1.0);
  if (!read) return read.error();
  for (float& z : read->depth.depth_m.values()) z = -z;
  return std::move(read->depth.depth_m);
}

Result<Answer> score_relief(const ReliefArguments& arguments) {
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const auto* relief = std::get_if<std::shared_ptr<const models::Relief>>(&file->scene.model);
  if (relief == nullptr)
    return Error{ErrorCode::invalid_input, "this scene is not a relief", arguments.scene};
  const auto truth = read_nearness(arguments);
  if (!truth) return truth.error();
  measure::ReliefScoreOptions options;
  options.compression = arguments.compression;
  const auto score = measure::score_relief((*relief)->samples_m(), (*relief)->pixel_m(), *truth, options);
  if (!score) return Error{score.error().code, score.error().message, arguments.scene};
  const auto or_null = [](double value) { return std::isnan(value) ? Json(nullptr) : Json(value); };
  Answer answer;
  answer.json = {{"reversed_slopes_percent", score->reversed_slopes_percent},
                 {"detail_correlation", or_null(score->detail_correlation)},
                 {"wrong_order_percent", or_null(score->wrong_order_percent)},
                 {"greatest_slope", score->greatest_slope},
                 {"details_kept_percent", or_null(score->details_kept_percent)},
                 {"details", score->details},
                 {"depth_steps", score->depth_steps},
                 {"sum", score->sum()}};
  answer.text = fmt::format(
      "reversed slopes {:.3f} %, detail correlation {:.3f}, wrong order {:.2f} %, greatest slope {:.2f}, "
      "details kept {:.1f} % of {}\n",
      score->reversed_slopes_percent, score->detail_correlation, score->wrong_order_percent,
      score->greatest_slope, score->details_kept_percent, score->details);
  return answer;
}

void add_score_relief(Program& program) {
  const auto arguments = std::make_shared<ReliefArguments>();
  Options options = add_command_below(program, "score", "relief",
                                      "Errors of a relief that a hand would feel (docs/relief.md)",
                                      "  palpable score relief room.palp depth.png\n"
                                      "  palpable score relief cones.palp groundtruth.png --truth disparity",
                                      [arguments](Console& /*console*/) { return score_relief(*arguments); });
  options.argument("RESULT", arguments->scene, "A .palp scene with a relief");
  options.argument("TRUTH", arguments->truth, "The depth or disparity of the same size");
  options.choice("--truth", arguments->kind, {"depth", "disparity"}, "What the truth's values are");
  options.number("--compression", arguments->compression, {1.0, 1000.0},
                 "How many times higher the scene is in its own proportions");
}

}  // namespace

void add_score(Program& program) {
  add_score_relief(program);
  add_score_contours(program);
  add_score_structure(program);
  add_score_map(program);
  const auto arguments = std::make_shared<ScoreArguments>();
  Options options = add_command_below(
      program, "score", "disparity", "Bad pixels, coverage and RMS of a disparity map",
      "  palpable score disparity out.pfm groundtruth.png --truth-scale 4 --mask nonocc.png",
      [arguments](Console& /*console*/) { return score_disparity(*arguments); });
  options.argument("RESULT", arguments->result, "Disparity: .pfm, .png as palpable depth writes it, .npz");
  options.argument("TRUTH", arguments->truth, "True disparity of the same size");
  options.number("--truth-scale", arguments->truth_scale, {1e-6, 1e6},
                 "The truth's stored values are disparity times this");
  options.number("--result-scale", arguments->result_scale, {1e-6, 1e6},
                 "The result's stored values are disparity times this");
  options.text("--mask", arguments->mask, "Score only where this picture is white");
}

}  // namespace palpable::cli
