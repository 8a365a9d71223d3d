// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/cli/disparity_file.hpp"
#include "palpable/measure/disparity_score.hpp"

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct Arguments {
  std::string result, truth, mask;
  std::optional<double> result_scale, truth_scale;
};

Answer answer_of(const measure::DisparityScore& score) {
  Answer answer;
  Json bad;
  std::string shares;
  for (std::size_t i = 0; i < measure::kBadThresholds_px.size(); ++i) {
    const std::string threshold = fmt::format("{:g}", measure::kBadThresholds_px[i]);
    bad[threshold] = score.bad_percent[i];
    shares += fmt::format("{}over {} px {:.2f} %", i == 0 ? "" : ", ", threshold, score.bad_percent[i]);
  }
  answer.json = {{"pixels", score.pixels},
                 {"coverage", score.coverage},
                 {"bad", bad},
                 {"rms_px", score.rms_px},
                 {"rms_percent_of_range", score.rms_percent_of_range}};
  answer.text = fmt::format(
      "{} pixels scored, {:.1f} % of them known\nbad: {}\nRMS {:.3f} px, {:.2f} % of the truth's range\n",
      score.pixels, 100.0 * score.coverage, shares, score.rms_px, score.rms_percent_of_range);
  return answer;
}

Result<Answer> score_disparity(const Arguments& arguments) {
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
  const auto score = measure::score_disparity(*result, *truth, mask);
  if (!score) return Error{score.error().code, score.error().message, arguments.result};
  return answer_of(*score);
}

}  // namespace

void add_score(Program& program) {
  const auto arguments = std::make_shared<Arguments>();
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
