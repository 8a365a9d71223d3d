// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/stereo_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/score/disparity_file.hpp"
#include "palpable/cli/commands/score/score_json.hpp"
#include "palpable/cli/hints.hpp"
#include "palpable/draw/view/panels_view.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct CompareArguments {
  std::string output = "comparison.png";
  std::string truth, mask;
  std::optional<double> truth_scale;
  StereoArguments stereo;
};

struct Truth {
  Raster<float> disparity_px;
  Raster<std::uint8_t> mask;
};

/// The result of one method on the pair.
struct Outcome {
  vision::StereoMethod method{};
  double seconds = 0.0;
  DisparityMap disparity;
  std::optional<DisparityScores> scores;
};

Result<std::optional<Truth>> read_truth(const CompareArguments& arguments) {
  if (arguments.truth.empty()) return std::optional<Truth>();
  auto disparity_px = read_disparity(arguments.truth, arguments.truth_scale);
  if (!disparity_px) return disparity_px.error();
  Truth truth{std::move(*disparity_px), {}};
  if (!arguments.mask.empty()) {
    auto mask = read_mask(arguments.mask);
    if (!mask) return mask.error();
    truth.mask = std::move(*mask);
  }
  return std::optional(std::move(truth));
}

Result<Outcome> outcome_of(vision::StereoMethod method, const vision::StereoPair& pair,
                           const CompareArguments& arguments, const std::optional<Truth>& truth,
                           Console& console) {
  const auto options = stereo_options_of_all(arguments.stereo);
  if (!options) return options.error();
  const auto begin = std::chrono::steady_clock::now();
  auto match = vision::match(pair, method, *options, console.work());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  if (!match) return Error{match.error().code, match.error().message, places_of(arguments.stereo)};
  Outcome out{method, seconds.count(), std::move(match->disparity), {}};
  // The notes are about the pair and are the same for every method.
  if (method == vision::available_stereo_methods().front())
    for (const std::string& note : match->notes) console.note(note);
  if (truth) {
    const auto scores = scores_of(out.disparity.disparity_px, truth->disparity_px, truth->mask);
    if (!scores) return Error{scores.error().code, scores.error().message, arguments.truth};
    out.scores = *scores;
  }
  return out;
}

std::string table_of(const std::vector<Outcome>& outcomes, bool scored) {
  std::string table = fmt::format("{:<10} {:>9} {:>8}", "method", "seconds", "known %");
  if (scored)
    table += fmt::format(" {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9}", "bad 0.5", "bad 1", "bad 2",
                         "bad 4", "RMS px", "RMS %", "normals °", "steps/cm");
  table += "\n";
  for (const Outcome& o : outcomes) {
    table += fmt::format("{:<10} {:>9.2f} {:>8.1f}", vision::name_of(o.method), o.seconds,
                         100.0 * coverage_of(o.disparity.disparity_px));
    if (o.scores) {
      const auto& s = o.scores->pixels;
      table += fmt::format(" {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.3f} {:>8.2f} {:>9.2f} {:>9.3f}",
                           s.bad_percent[0], s.bad_percent[1], s.bad_percent[2], s.bad_percent[3], s.rms_px,
                           s.rms_percent_of_range, o.scores->touch.normal_error_deg,
                           o.scores->touch.spurious_steps_per_cm);
    }
    table += "\n";
  }
  return table;
}

draw::Figure picture_of(const vision::StereoPair& pair, const std::vector<Outcome>& outcomes,
                        const std::optional<Truth>& truth, const CompareArguments& arguments) {
  std::vector<draw::Panel> panels;
  panels.push_back({"left picture", names_of(arguments.stereo), rgb8(pair.left)});
  if (truth)
    panels.push_back(
        {"truth", std::filesystem::path(arguments.truth).filename().string(), truth->disparity_px});
  for (const Outcome& o : outcomes) {
    std::string caption = fmt::format("{:.2f} s", o.seconds);
    if (o.scores)
      caption += fmt::format(", {:.1f} % over 1 px, RMS {:.2f} px", o.scores->pixels.bad_percent[1],
                             o.scores->pixels.rms_px);
    panels.push_back({std::string(vision::name_of(o.method)), caption, o.disparity.disparity_px});
  }
  return draw::panels_figure(
      std::move(panels),
      {"Depth by every method", "Pale is near, dark is far, in one scale; hatched areas are unknown."});
}

Json json_of(const std::vector<Outcome>& outcomes) {
  Json methods = Json::array();
  for (const Outcome& o : outcomes) {
    Json json = o.scores ? json_of(*o.scores) : Json::object();
    Json row = {{"method", vision::name_of(o.method)},
                {"seconds", o.seconds},
                {"coverage", coverage_of(o.disparity.disparity_px)}};
    if (o.scores) row["score"] = std::move(json);
    methods.push_back(std::move(row));
  }
  return methods;
}

Result<Answer> compare(const CompareArguments& arguments, Console& console) {
  // Checked before the pictures are read.
  if (const auto options = stereo_options_of_all(arguments.stereo); !options) return options.error();
  const auto truth = read_truth(arguments);
  if (!truth) return truth.error();
  const auto ready = read_pair(arguments.stereo, console.work());
  if (!ready) return ready.error();
  for (const Note& note : ready->notes) console.note(note);
  if (*truth && ready->rectified_by != session::RectifiedBy::nothing)
    console.note(
        "The truth belongs to the original pictures, and they were rectified: the scores mean little.");
  std::vector<Outcome> outcomes;
  for (const vision::StereoMethod method : vision::available_stereo_methods()) {
    auto outcome = outcome_of(method, ready->pair, arguments, *truth, console);
    if (!outcome) return outcome.error();
    outcomes.push_back(std::move(*outcome));
  }
  if (const auto written =
          draw::write_figure(picture_of(ready->pair, outcomes, *truth, arguments), arguments.output);
      !written)
    return written.error();
  Answer answer;
  answer.json = {{"width", ready->pair.left.width},
                 {"height", ready->pair.left.height},
                 {"rectification", rectification_json(*ready)},
                 {"notes", sentences_of(ready->notes)},
                 {"methods", json_of(outcomes)},
                 {"output", arguments.output}};
  answer.text = table_of(outcomes, truth->has_value()) + arguments.output + "\n";
  return answer;
}

}  // namespace

void add_compare(Program& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  Options options =
      add_command(program, "compare", "Every stereo method on one pair: a table, and a picture with all maps",
                  "  palpable compare left.png right.png\n"
                  "  palpable compare imL.png imR.png --truth groundtruth.png --truth-scale 4 --mask "
                  "nonocc.png -o all.png",
                  [arguments](Console& console) { return compare(*arguments, console); });
  add_pair_arguments(options, arguments->stereo);
  options.output("-o,--output", arguments->output, {".png", ".svg", ".pdf"},
                 "Picture to write (.png, .svg, .pdf); default: comparison.png");
  options.text("--truth", arguments->truth, "True disparity of the left picture");
  options.number("--truth-scale", arguments->truth_scale, {1e-6, 1e6},
                 "The truth's stored values are disparity times this");
  options.text("--mask", arguments->mask, "Score only where this picture is white");
  add_pair_options(options, arguments->stereo);
  options.texts(
      "--set", arguments->stereo.parameters,
      "METHOD.NAME=VALUE: a parameter of one method (palpable methods METHOD lists them); may be repeated");
}

}  // namespace palpable::cli
