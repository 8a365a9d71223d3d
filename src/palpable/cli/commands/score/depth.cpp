// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/stereo_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/score/score_json.hpp"
#include "palpable/cli/hints.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/session/make/make_scene.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/epipolar_pictures.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct DepthArguments {
  std::string output;
  std::string rectified, confidence;
  StereoArguments stereo;
  bool features = false;
  double surface_weight = static_cast<double>(vision::PyramidOptions{}.surface_weight);
  int iterations = vision::PyramidOptions{}.iterations;
};

Result<vision::StereoOptions> options_of(const DepthArguments& arguments, vision::StereoMethod method) {
  auto options = stereo_options(arguments.stereo, method);
  if (!options) return options;
  const DepthArguments none;
  if (arguments.surface_weight != none.surface_weight)
    options->pyramid.surface_weight = static_cast<float>(arguments.surface_weight);
  if (arguments.iterations != none.iterations) options->pyramid.iterations = arguments.iterations;
  if (arguments.features) options->pyramid.edges = vision::PyramidEdges::features;
  return options;
}

/// An option of one method is rejected with other methods, not ignored silently.
Result<void> only_of_pyramid(const DepthArguments& arguments, vision::StereoMethod method) {
  const DepthArguments none;
  if (method == vision::StereoMethod::pyramid) return {};
  const char* given = arguments.features                                ? "--features"
                      : arguments.iterations != none.iterations         ? "--iterations"
                      : arguments.surface_weight != none.surface_weight ? "--surface-weight"
                                                                        : nullptr;
  if (given == nullptr) return {};
  return Error{ErrorCode::usage,
               fmt::format("is an option of --method pyramid, not of {}", vision::name_of(method)), given};
}

/// The rectified pictures' files: the left one, the right one.
std::vector<std::string> rectified_files(const std::string& prefix) {
  return {prefix + "_left.png", prefix + "_right.png"};
}

Result<void> write_rectified(const std::string& prefix, const vision::StereoPair& pair) {
  if (prefix.empty()) return {};
  if (pair.frame) return write_rectified(prefix, vision::in_epipolar_frame(pair));
  const auto files = rectified_files(prefix);
  if (const auto left = formats::write_png(files.front(), rgb8(pair.left)); !left) return left;
  return formats::write_png(files.back(), rgb8(pair.right));
}

Result<void> write_disparity(const std::filesystem::path& output, const Raster<float>& disparity_px) {
  if (output.extension() == ".pfm") return formats::write_disparity_pfm(output, disparity_px);
  return formats::write_disparity_png(output, disparity_px);
}

/// Writes confidence 0 … 1 as floats, or as 8-bit grey (white = 1).
Result<void> write_confidence(const std::filesystem::path& output, const Raster<float>& confidence) {
  if (confidence.empty()) return Error{ErrorCode::usage, "this method gives no confidence", "--confidence"};
  if (output.extension() == ".pfm") return formats::write_pfm(output, confidence);
  Raster<std::uint8_t> grey(confidence.width(), confidence.height());
  std::transform(confidence.values().begin(), confidence.values().end(), grey.values().begin(), [](float c) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(c, 0.0F, 1.0F)));
  });
  return formats::write_png(output, grey);
}

bool is_raster_name(const std::string& name) {
  const auto ending = std::filesystem::path(name).extension();
  return ending == ".pfm" || ending == ".png";
}

Result<Answer> depth(const DepthArguments& arguments, Console& console) {
  const std::filesystem::path output(arguments.output);
  if (!arguments.confidence.empty() && !is_raster_name(arguments.confidence))
    return Error{ErrorCode::usage, "confidence is written as .pfm or .png", arguments.confidence};
  if (!is_raster_name(arguments.output))
    return Error{ErrorCode::usage, "disparity is written as .pfm or .png", arguments.output};
  const auto method = stereo_method(arguments.stereo);
  if (!method) return method.error();
  if (const auto ok = only_of_pyramid(arguments, *method); !ok) return ok.error();
  const auto options = options_of(arguments, *method);
  if (!options) return options.error();
  const auto ready = read_pair(arguments.stereo, console.work());
  if (!ready) return ready.error();
  for (const Note& note : ready->notes) console.note(note);
  if (const auto written = write_rectified(arguments.rectified, ready->pair); !written)
    return written.error();

  const auto begin = std::chrono::steady_clock::now();
  const auto match = vision::match(ready->pair, *method, *options, console.work());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  if (!match) return Error{match.error().code, match.error().message, places_of(arguments.stereo)};
  for (const std::string& note : match->notes) console.note(note);
  const Raster<float>& disparity_px = match->disparity.disparity_px;
  if (!arguments.confidence.empty())
    if (const auto written = write_confidence(arguments.confidence, match->confidence); !written)
      return written.error();
  if (const auto written = write_disparity(output, disparity_px); !written) return written.error();

  std::vector<Note> notes = ready->notes;
  notes.insert(notes.end(), match->notes.begin(), match->notes.end());
  Answer answer;
  const double coverage = coverage_of(disparity_px);
  answer.json = {{"method", vision::name_of(*method)},
                 {"width", disparity_px.width()},
                 {"height", disparity_px.height()},
                 {"seconds", seconds.count()},
                 {"coverage", coverage},
                 {"rectification", rectification_json(*ready)},
                 {"notes", sentences_of(notes)},
                 {"output", arguments.output}};
  answer.text = fmt::format("{} x {} disparities by {} in {:.2f} s, {:.1f} % known: {}\n",
                            disparity_px.width(), disparity_px.height(), vision::name_of(*method),
                            seconds.count(), 100.0 * coverage, arguments.output);
  return answer;
}

}  // namespace

void add_depth(Program& program) {
  const auto arguments = std::make_shared<DepthArguments>();
  Options options =
      add_command(program, "depth", "Disparity of a stereo pair; the left picture is the reference",
                  "  palpable depth left.png right.png -o depth.pfm\n"
                  "  palpable depth left.png right.png -o depth.png --method scanline --max-disparity 64\n"
                  "  palpable depth camera.mpo -o depth.pfm",
                  [arguments](Console& console) { return depth(*arguments, console); });
  add_pair_arguments(options, arguments->stereo);
  options.required_output(
      "-o,--output", arguments->output, {".pfm", ".png"},
      "Disparity in pixels: .pfm (float, infinity = unknown) or .png (16 bit, times 256, 0 = unknown)");
  options.output("--confidence", arguments->confidence, {".pfm", ".png"},
                 "Also write how sure each pixel is, 0 to 1: .pfm (float) or .png (8 bit, white is sure)");
  options.output("--rectified", arguments->rectified, {},
                 "Also write the rectified pictures, as PREFIX_left.png and PREFIX_right.png");
  options.last_output_writes(rectified_files);
  add_stereo_options(options, arguments->stereo);
  add_parameter_options(options, arguments->stereo);
  options.under("The method pyramid");
  options.flag("--features", arguments->features, "Move disparity steps to edges in the picture");
  options.number("--surface-weight", arguments->surface_weight, {0.001, 100.0},
                 "Weight of the smoothness; the picture has values 0 to 1");
  options.integer("--iterations", arguments->iterations, {0, 1000}, "Iterations of the refinement");
}

}  // namespace palpable::cli
