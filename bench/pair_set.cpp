// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/stereo_rectification.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "depth_rank.hpp"
#include "stereo_scenes.hpp"
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

// Judges pairs of the tuning set, unchanged and degraded, as `palpable fit` does. Also computes the rank
// correlation between the depth of the method `fast` and the true depth. Prints one CSV row per case to
// standard output; the thresholds of fit_to_touch() were chosen from these rows.
//
//   palpable_pair_set FIRST_SEED LAST_SEED
namespace palpable::bench {
namespace {

using vision::StereoPair;

cv::Mat view(Image& image) {
  return {image.height, image.width, CV_32FC(image.channels), image.samples.data()};
}

Image warped(Image image, const cv::Mat& map) {
  Image out = image;
  cv::warpAffine(view(image), view(out), map, {image.width, image.height}, cv::INTER_LINEAR,
                 cv::BORDER_REFLECT);
  return out;
}

/// About the middle.
Image turned_and_scaled(const Image& image, double degrees, double scale) {
  const cv::Point2f middle(0.5F * static_cast<float>(image.width - 1),
                           0.5F * static_cast<float>(image.height - 1));
  return warped(image, cv::getRotationMatrix2D(middle, degrees, scale));
}

Image quarter_turned(Image image) {
  Image out = image;
  std::swap(out.width, out.height);
  cv::Mat turned;
  cv::rotate(view(image), turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  std::copy_n(turned.ptr<float>(), out.samples.size(), out.samples.begin());
  return out;
}

Raster<float> quarter_turned(const Raster<float>& values) {
  Raster<float> out(values.height(), values.width());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = values(values.width() - 1 - y, x);
  return out;
}

Image mirrored(Image image) {
  cv::flip(view(image).clone(), view(image), 1);
  return image;
}

/// A short exposure: a fraction of the light, with sensor noise added.
Image dimmed(Image image, double gain, double noise, std::mt19937& random) {
  std::normal_distribution<double> grain(0.0, noise);
  for (float& sample : image.samples)
    sample = static_cast<float>(std::clamp(gain * static_cast<double>(sample) + grain(random), 0.0, 1.0));
  return image;
}

struct Case {
  std::string_view name;
  StereoPair pair;
  /// Empty: there is no right answer.
  Raster<float> truth_px;
};

std::vector<Case> cases_of(const StereoScene& scene, const StereoScene& other, std::uint32_t seed) {
  const Image& left = scene.pair.left;
  const Image& right = scene.pair.right;
  std::mt19937 random(seed);
  const auto noisy = [&](double gain, double noise) {
    return StereoPair{dimmed(left, gain, noise, random), dimmed(right, gain, noise, random), {}};
  };
  std::vector<Case> cases;
  cases.push_back({"as it is", scene.pair, scene.truth_px});
  cases.push_back(
      {"turned", {quarter_turned(left), quarter_turned(right), {}}, quarter_turned(scene.truth_px)});
  cases.push_back({"twice", {left, left, {}}, {}});
  cases.push_back(
      {"twice with noise", {dimmed(left, 1, 0.01, random), dimmed(left, 1, 0.01, random), {}}, {}});
  cases.push_back({"another place", {left, other.pair.right, {}}, {}});
  cases.push_back({"mirrored", {left, mirrored(right), {}}, {}});
  cases.push_back({"swapped", {right, left, {}}, scene.truth_px});
  cases.push_back({"forward", {left, turned_and_scaled(left, 0.0, 1.06), {}}, {}});
  cases.push_back({"turned by 4", {left, turned_and_scaled(right, 4.0, 1.0), {}}, scene.truth_px});
  cases.push_back({"dim", noisy(0.4, 0.008), scene.truth_px});
  cases.push_back({"dark", noisy(0.2, 0.016), scene.truth_px});
  cases.push_back({"darker", noisy(0.1, 0.016), scene.truth_px});
  return cases;
}

void judge(const StereoScene& scene, const Case& c) {
  Work work;
  work.threads = 1;
  auto rectified = vision::rectify_uncalibrated(c.pair, work);
  if (!rectified) return;
  const auto match = vision::match_confirmed(rectified->pair, vision::StereoMethod::fast, {}, work);
  if (!match) {
    fmt::print("{},{},refused,,,,,,,,,,\n", scene.name, c.name);
    return;
  }
  const vision::FitToTouch fit = vision::fit_to_touch(rectified->pair, *match, work);
  const double rank = c.truth_px.empty() ? 0.0 : depth_rank(match->disparity.disparity_px, c.truth_px);
  fmt::print(
      "{},{},{:.3f},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.2f},{:.3f},{},{:.3f},{:.3f},{:.2f},{:.3f},{:.2f},{:.2f}"
      "\n",
      scene.name, c.name, rank, fit.fit ? 1 : 0, fit.confidence, fit.agreement, fit.coverage, fit.textured,
      fit.depth_range_px, fit.brightness, fit.points.count, fit.points.on_rows, fit.points.confirmed,
      fit.points.range_px, fit.points.off_plane, rectified->residual_before_px, rectified->residual_px);
}

int main_program(int count, char** words) {
  if (count != 3) {
    fmt::print(stderr, "usage: palpable_pair_set FIRST_SEED LAST_SEED\n");
    return 2;
  }
  const int first = std::atoi(words[1]), last = std::atoi(words[2]);
  fmt::print(
      "scene,case,rank,fit,confidence,agreement,coverage,textured,range_px,brightness,points,on_rows,"
      "confirmed,points_range_px,off_plane,residual_before_px,residual_px\n");
  for (int seed = first; seed <= last; ++seed)
    for (int k = 0; k < kSceneKinds; ++k) {
      const auto kind = static_cast<SceneKind>(k);
      const StereoScene scene = render_scene(kind, static_cast<std::uint32_t>(seed));
      const StereoScene other = render_scene(static_cast<SceneKind>((k + 3) % kSceneKinds),
                                             static_cast<std::uint32_t>(seed + 1000));
      for (const Case& c : cases_of(scene, other, static_cast<std::uint32_t>(seed * 100 + k)))
        judge(scene, c);
    }
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::main_program(count, words); }
