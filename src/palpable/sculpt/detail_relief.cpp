// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/detail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

// The operator works on the scene in its own proportions, R, which is `compression` times too high, and looks
// for the relief h whose slopes are R's times a gain that falls where the ground is steep on the large: small
// forms on gentle ground keep their height, long slopes give theirs up. Silhouettes (steps that no slope
// limit could hold) are set to a low step and hardly weighed, so that what the gains do not add up to gathers
// there (Weyrich et al. 2007). Every difference between neighbours keeps R's sign, and the slope limit, by
// ADMM with a Poisson solution in each round (Boyd et al. 2011, section 5; the Poisson equation by the
// discrete cosine transform).

/// Silhouettes come out between these steps.
constexpr float kLeastStep_m = 0.0003F;
constexpr float kGreatestStep_m = 0.0020F;
/// A silhouette is steeper than this many times the slope limit.
constexpr float kSilhouette = 2.0F;
constexpr float kSilhouetteWeight = 0.02F;
/// The large scale on which steepness decides the gain, and the small one of detail: shares of the longer
/// side.
constexpr double kGainScale = 0.04;
constexpr double kDetailScale = 0.006;
/// Detail keeps at least this much of its height, wherever the order of heights allows it.
constexpr float kDetailGain = 0.35F;
constexpr int kRounds = 24;

/// Differences to the right and below; the last column (row) is 0.
struct Differences {
  cv::Mat x;
  cv::Mat y;
};

Differences differences(const cv::Mat& z) {
  Differences d{cv::Mat::zeros(z.size(), CV_32F), cv::Mat::zeros(z.size(), CV_32F)};
  const int w = z.cols;
  const int h = z.rows;
  cv::subtract(z.colRange(1, w), z.colRange(0, w - 1), d.x.colRange(0, w - 1));
  cv::subtract(z.rowRange(1, h), z.rowRange(0, h - 1), d.y.rowRange(0, h - 1));
  return d;
}

/// Finds the surface whose differences are nearest to given ones, with level borders.
class PoissonSolver {
 public:
  explicit PoissonSolver(cv::Size size)
      : size_(size),
        padded_(2 * cv::getOptimalDFTSize((size.width + 1) / 2),
                2 * cv::getOptimalDFTSize((size.height + 1) / 2)) {
    inverse_.create(padded_, CV_32F);
    const auto eigenvalue = [](int k, int n) { return 2.0 - 2.0 * std::cos(std::numbers::pi * k / n); };
    for (int y = 0; y < padded_.height; ++y)
      for (int x = 0; x < padded_.width; ++x)
        inverse_.at<float>(y, x) = static_cast<float>(
            1.0 / std::max(1e-12, eigenvalue(x, padded_.width) + eigenvalue(y, padded_.height)));
    inverse_.at<float>(0, 0) = 0.0F;
  }

  cv::Mat solve(const Differences& d) const {
    cv::Mat source = cv::Mat::zeros(padded_, CV_32F);
    const auto add = [&source](const cv::Mat& values, int x, int y, double sign) {
      cv::Mat part = source(cv::Rect(x, y, values.cols, values.rows));
      cv::scaleAdd(values, sign, part, part);
    };
    add(d.x.colRange(0, size_.width - 1), 0, 0, -1.0);
    add(d.x.colRange(0, size_.width - 1), 1, 0, 1.0);
    add(d.y.rowRange(0, size_.height - 1), 0, 0, -1.0);
    add(d.y.rowRange(0, size_.height - 1), 0, 1, 1.0);
    cv::dct(source, source);
    cv::multiply(source, inverse_, source);
    cv::idct(source, source);
    return source(cv::Rect({0, 0}, size_)).clone();
  }

 private:
  cv::Size size_;
  cv::Size padded_;
  cv::Mat inverse_;
};

/// What each difference should be, how much that counts, and what it may be.
struct Goal {
  Differences wanted;
  Differences weight;
  Differences low;
  Differences high;
};

/// Means of what is not at a silhouette, over `share` of the picture's longer side.
cv::Mat level_mean(const cv::Mat& values, const cv::Mat& level, double share) {
  const double sigma = std::max(1.5, share * std::max(values.cols, values.rows));
  cv::Mat sum;
  cv::Mat count;
  cv::GaussianBlur(values.mul(level), sum, {}, sigma, sigma, cv::BORDER_REPLICATE);
  cv::GaussianBlur(level, count, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return sum / (count + 1e-3F);
}

/// The scene's differences, and what decides how each is treated.
struct Ground {
  Differences own;
  /// 0 at silhouettes, 1 elsewhere.
  Differences level;
  /// The same forms without their detail.
  Differences base;
  /// How steep the ground is on the large.
  cv::Mat large_slope;
};

Ground survey(const cv::Mat& scene, const DetailTarget& target) {
  Ground g;
  g.own = differences(scene);
  const double step = kSilhouette * target.steepest_slope * target.pixel_m;
  const auto level = [step](const cv::Mat& d) {
    cv::Mat mask = cv::abs(d) <= step;
    cv::Mat out;
    mask.convertTo(out, CV_32F, 1.0 / 255.0);
    return out;
  };
  g.level = {level(g.own.x), level(g.own.y)};
  g.base = {level_mean(g.own.x, g.level.x, kDetailScale), level_mean(g.own.y, g.level.y, kDetailScale)};
  cv::Mat slope;
  cv::magnitude(g.own.x, g.own.y, slope);
  g.large_slope = level_mean(slope / target.pixel_m, g.level.x.mul(g.level.y), kGainScale);
  return g;
}

/// One direction's part of the goal. `knee` is the slope on the large at which the gain has fallen to a half.
void set_goal(const cv::Mat& own, const cv::Mat& level, const cv::Mat& base, const cv::Mat& large, float knee,
              const DetailTarget& target, cv::Mat& wanted, cv::Mat& weight, cv::Mat& low, cv::Mat& high) {
  for (cv::Mat* m : {&wanted, &weight, &low, &high}) m->create(own.size(), CV_32F);
  const auto steepest = static_cast<float>(target.steepest_slope * target.pixel_m);
  const auto compression = static_cast<float>(target.compression);
  for (int y = 0; y < own.rows; ++y)
    for (int x = 0; x < own.cols; ++x) {
      const float d = own.at<float>(y, x);
      const float size = std::abs(d);
      const float sign = std::copysign(1.0F, d);
      const bool silhouette = level.at<float>(y, x) == 0.0F;
      const float gain = 1.0F / (1.0F + large.at<float>(y, x) / knee);
      const float smooth = base.at<float>(y, x);
      const float most = silhouette ? size : std::min(size, steepest);
      const float least = silhouette ? kLeastStep_m : 0.0F;
      const float step = silhouette ? std::clamp(size / compression, kLeastStep_m, kGreatestStep_m)
                                    : sign * (gain * smooth + std::max(gain, kDetailGain) * (d - smooth));
      wanted.at<float>(y, x) = sign * std::clamp(step, least, most);
      weight.at<float>(y, x) = silhouette ? kSilhouetteWeight : 1.0F;
      low.at<float>(y, x) = d > 0.0F ? least : -most;
      high.at<float>(y, x) = d > 0.0F ? most : -least;
    }
}

Goal goal_for(const Ground& g, float knee, const DetailTarget& target) {
  Goal goal;
  set_goal(g.own.x, g.level.x, g.base.x, g.large_slope, knee, target, goal.wanted.x, goal.weight.x,
           goal.low.x, goal.high.x);
  set_goal(g.own.y, g.level.y, g.base.y, g.large_slope, knee, target, goal.wanted.y, goal.weight.y,
           goal.low.y, goal.high.y);
  return goal;
}

double range_of(const cv::Mat& z) {
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(z, &low, &high);
  return high - low;
}

/// The knee at which the relief is as high as it may be, found on a small picture without the rounds: its
/// height grows with the knee.
float knee_for_height(const cv::Mat& scene, const DetailTarget& target) {
  constexpr int kSmall = 160;
  const double scale = std::min(1.0, static_cast<double>(kSmall) / std::max(scene.cols, scene.rows));
  cv::Mat small;
  cv::resize(scene, small, {}, scale, scale, cv::INTER_AREA);
  if (small.cols < 2 || small.rows < 2) small = scene;
  DetailTarget coarse = target;
  coarse.pixel_m = target.pixel_m * scene.cols / small.cols;
  const PoissonSolver poisson(small.size());
  const Ground ground = survey(small, coarse);
  double low = std::log(0.005);
  double high = std::log(20.0);
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (low + high);
    const Goal goal = goal_for(ground, static_cast<float>(std::exp(middle)), coarse);
    (range_of(poisson.solve(goal.wanted)) > target.height_m ? high : low) = middle;
  }
  return static_cast<float>(std::exp(0.5 * (low + high)));
}

/// A round's new differences and multipliers, one direction.
void project(const cv::Mat& own, const cv::Mat& wanted, const cv::Mat& weight, const cv::Mat& low,
             const cv::Mat& high, cv::Mat& chosen, cv::Mat& multiplier) {
  for (int y = 0; y < own.rows; ++y) {
    const auto* o = own.ptr<float>(y);
    const auto* t = wanted.ptr<float>(y);
    const auto* w = weight.ptr<float>(y);
    const auto* l = low.ptr<float>(y);
    const auto* u = high.ptr<float>(y);
    auto* c = chosen.ptr<float>(y);
    auto* m = multiplier.ptr<float>(y);
    for (int x = 0; x < own.cols; ++x) {
      const float free = (w[x] * t[x] + o[x] + m[x]) / (w[x] + 1.0F);
      c[x] = std::max(l[x], std::min(u[x], free));
      m[x] += o[x] - c[x];
    }
  }
}

}  // namespace

Result<Raster<float>> gradient_domain_relief(const Raster<float>& nearness, const DetailTarget& target,
                                             const Work& work) {
  Raster<float> result = nearness;
  const cv::Mat given(result.height(), result.width(), CV_32F, result.data());
  cv::Mat scene = given * (target.compression * target.height_m);
  if (range_of(scene) <= 0.0) {
    std::fill(result.values().begin(), result.values().end(), 0.0F);
    return result;
  }
  const Goal goal = goal_for(survey(scene, target), knee_for_height(scene, target), target);
  const PoissonSolver poisson(scene.size());
  Differences chosen{goal.wanted.x.clone(), goal.wanted.y.clone()};
  Differences multiplier{cv::Mat::zeros(scene.size(), CV_32F), cv::Mat::zeros(scene.size(), CV_32F)};
  cv::Mat relief;
  for (int round = 0; round < kRounds; ++round) {
    if (work.cancelled()) return Work::interrupted();
    relief = poisson.solve({chosen.x - multiplier.x, chosen.y - multiplier.y});
    const Differences own = differences(relief);
    project(own.x, goal.wanted.x, goal.weight.x, goal.low.x, goal.high.x, chosen.x, multiplier.x);
    project(own.y, goal.wanted.y, goal.weight.y, goal.low.y, goal.high.y, chosen.y, multiplier.y);
    work.report(static_cast<double>(round + 1) / kRounds, "relief");
  }
  relief = poisson.solve(chosen);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(relief, &low, &high);
  const double scale = high > low ? target.height_m / (high - low) : 0.0;
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x)
      result(x, y) = static_cast<float>((double{relief.at<float>(y, x)} - low) * scale);
  return result;
}

}  // namespace palpable::sculpt
