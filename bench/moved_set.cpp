// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"
#include "palpable/vision/rectification/stereo_rectification.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "depth_rank.hpp"
#include "moved_room.hpp"
#include <fmt/format.h>

// Judges pairs of a camera that was moved in any direction, or was not, as `palpable fit` does, and compares
// the depth of `fast` at the pixels of the given left picture with the true one. One CSV row per pair and a
// summary per movement.
//
//   palpable_moved_set FIRST_SEED LAST_SEED [--only MOVEMENT] [--dump FOLDER] [--moved]
//
// --moved: as `--moved` with the true focal length; the row's error is the median relative error of depth.
namespace palpable::bench {
namespace {

struct Arguments {
  int first = 1, last = 1;
  std::string only, dump;
  bool moved = false;
};

struct Verdict {
  bool fit = false;
  double confidence = 0.0, rank = 0.0, error = 0.0, beyond_turn = 0.0, certainty = 0.0, depth_order = 0.0;
  std::string reason, notes;
  Raster<float> disparity_px, sure;
};

/// Median of |Z / Z_true - 1|.
double median_error(const DisparityMap& found, const Raster<float>& depth_m) {
  std::vector<double> errors;
  if (!found.rig) return 0.0;
  for (std::size_t i = 0; i < depth_m.count(); ++i) {
    const double d = static_cast<double>(found.disparity_px.values()[i]) + found.rig->doffs_px;
    if (std::isfinite(d))
      errors.push_back(std::abs(
          found.rig->baseline_m * found.rig->left.fx / d / static_cast<double>(depth_m.values()[i]) - 1.0));
  }
  if (errors.empty()) return 1.0;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

Verdict judged(const MovedPair& moved, bool metric) {
  Work work;
  work.threads = 1;
  const double f = moved.focal_px, cx = 0.5 * (moved.pair.left.width - 1),
               cy = 0.5 * (moved.pair.left.height - 1);
  const auto rectified = metric ? vision::rectify_moved_camera(
                                      moved.pair, {{f, 0, cx, 0, f, cy, 0, 0, 1}, {}}, moved.moved_m, work)
                                : vision::rectify_uncalibrated(moved.pair, work);
  Verdict out;
  out.reason = rectified ? "" : rectified.error().message;
  if (!rectified) return out;
  for (const auto& note : rectified->notes) out.notes += note + " ";
  const auto match = vision::match_confirmed(rectified->pair, vision::StereoMethod::fast, {}, work);
  out.reason = match ? "" : match.error().message;
  if (!match) return out;
  const vision::FitToTouch fit = vision::fit_to_touch(rectified->pair, *match, work);
  Raster<float> nearness = moved.depth_m;
  for (float& v : nearness.values()) v = 1.0F / v;
  out.fit = fit.fit;
  out.confidence = fit.confidence;
  out.rank = depth_rank(match->disparity.disparity_px, nearness);
  out.error = median_error(match->disparity, moved.depth_m);
  out.reason = vision::words_of(fit.reason);
  out.beyond_turn = fit.points.beyond_turn;
  out.certainty = fit.points.certainty;
  out.depth_order = fit.points.depth_order;
  out.disparity_px = match->disparity.disparity_px;
  out.sure = match->confidence;
  return out;
}

void write(const MovedPair& moved, const Verdict& verdict, const std::string& prefix) {
  (void)formats::write_png(prefix + "-left.png", rgb8(moved.pair.left));
  (void)formats::write_png(prefix + "-right.png", rgb8(moved.pair.right));
  (void)formats::write_pfm(prefix + "-depth.pfm", moved.depth_m);
  if (verdict.disparity_px.empty()) return;
  (void)formats::write_pfm(prefix + "-found.pfm", verdict.disparity_px);
  (void)formats::write_pfm(prefix + "-confidence.pfm", verdict.sure);
}

void run(Movement movement, const Arguments& arguments) {
  int fits = 0, good_ranks = 0, wrong = 0, all = 0;
  for (int seed = arguments.first; seed <= arguments.last; ++seed) {
    const MovedPair moved = moved_pair(movement, static_cast<std::uint64_t>(seed));
    const Verdict v = judged(moved, arguments.moved);
    if (!arguments.dump.empty())
      write(moved, v, fmt::format("{}/{}-{}", arguments.dump, name_of(movement), seed));
    fmt::print("{},{},{},{:.2f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},\"{:.30}\",\"{}\"\n", name_of(movement),
               seed, v.fit ? 1 : 0, v.confidence, v.rank, v.error, v.beyond_turn, v.certainty, v.depth_order,
               v.reason, v.notes);
    std::fflush(stdout);
    ++all;
    fits += v.fit ? 1 : 0;
    good_ranks += v.fit && v.rank >= 0.9 ? 1 : 0;
    wrong += v.fit && (v.rank < 0.7 || is_hopeless(movement)) ? 1 : 0;
  }
  fmt::print("# {}: {} pairs, {} fit, {} fit with rank 0.9, {} fit and wrong\n", name_of(movement), all, fits,
             good_ranks, wrong);
}

int main_program(const std::vector<std::string>& words) {
  Arguments arguments;
  if (words.size() < 2) {
    fmt::print(
        stderr,
        "usage: palpable_moved_set FIRST_SEED LAST_SEED [--only MOVEMENT] [--dump FOLDER] [--moved]\n");
    return 2;
  }
  arguments.first = std::atoi(words[0].c_str());
  arguments.last = std::atoi(words[1].c_str());
  for (std::size_t i = 2; i < words.size(); ++i) {
    if (words[i] == "--moved") arguments.moved = true;
    if (i + 1 >= words.size()) continue;
    if (words[i] == "--only") arguments.only = words[i + 1];
    if (words[i] == "--dump") arguments.dump = words[i + 1];
  }
  fmt::print("movement,seed,fit,confidence,rank,error,beyond_turn,certainty,depth_order,reason,notes\n");
  for (int m = 0; m < kMovements; ++m)
    if (const auto movement = static_cast<Movement>(m);
        arguments.only.empty() || arguments.only == name_of(movement))
      run(movement, arguments);
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) {
  return palpable::bench::main_program(std::vector<std::string>(words + 1, words + count));
}
