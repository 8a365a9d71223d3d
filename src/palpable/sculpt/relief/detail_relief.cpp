// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/detail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

// The input R is the scene in its own proportions, `compression` times too high. The result is the relief h
// whose gradient is nearest to a compressed gradient of R. The smooth part of the gradient, a mean over a
// wide neighbourhood, is multiplied by a gain that decreases with the large-scale slope; the rest (detail)
// by one gain everywhere, which preserves its shape. Silhouettes (steps beyond any slope limit) become low
// steps, proportional to each other where their ramps would overlap, with a low weight, so that
// inconsistencies of the gradient field are absorbed there (Weyrich et al. 2007). The sign of each
// difference and the slope limit are constraints, which ADMM satisfies with a Poisson solution in each round
// (Boyd et al. 2011, section 5; the Poisson equation by the discrete cosine transform). In the first rounds
// the gain is adjusted until the relief has the wanted height.

constexpr double kLeastKnee = 0.005;
constexpr double kGreatestKnee = 20.0;

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

/// Solves for the surface whose differences are nearest to given ones, with level borders.
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

/// For each difference the wanted value, its weight, and its bounds.
struct Goal {
  Differences wanted;
  Differences weight;
  Differences low;
  Differences high;
};

/// Means of the values outside silhouettes, over `share` of the picture's longer side. Wide means are
/// computed on a reduced copy.
cv::Mat level_mean(const cv::Mat& values, const cv::Mat& level, double share) {
  const double sigma = std::max(1.5, share * std::max(values.cols, values.rows));
  const double scale = std::min(1.0, 4.0 / sigma);
  const auto spread = [&](const cv::Mat& v) {
    cv::Mat small = v;
    if (scale < 1.0) cv::resize(v, small, {}, scale, scale, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, sigma * scale, sigma * scale, cv::BORDER_REPLICATE);
    return small;
  };
  cv::Mat mean = spread(values.mul(level)) / (spread(level) + 1e-3F);
  if (scale < 1.0) cv::resize(mean, mean, values.size(), 0, 0, cv::INTER_LINEAR);
  return mean;
}

/// The scene's differences, and the quantities that determine their treatment.
struct SceneDifferences {
  Differences own;
  /// 0 at silhouettes, 1 elsewhere.
  Differences level;
  /// The differences without detail.
  Differences base;
  /// The large-scale slope.
  cv::Mat large_slope;
  /// The sum of silhouettes' steps near each pixel.
  cv::Mat steps;
  /// Allowed slope against the sign of the scene's, if nothing slopes nearby.
  cv::Mat tolerated_m;
};

/// 0 at silhouettes: differences above `steep` beside a pixel whose slope (over both of its neighbours, so
/// that the single steps of coarsely quantised depth are none) is above `silhouette`; 1 elsewhere.
Differences levels(const Differences& own, double silhouette, double steep) {
  const cv::Size size = own.x.size();
  Differences level{cv::Mat::ones(size, CV_32F), cv::Mat::ones(size, CV_32F)};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const float across = own.x.at<float>(y, x) + (x > 0 ? own.x.at<float>(y, x - 1) : 0.0F);
      const float down = own.y.at<float>(y, x) + (y > 0 ? own.y.at<float>(y - 1, x) : 0.0F);
      if (!(0.5 * std::hypot(double{across}, double{down}) > silhouette)) continue;
      const auto mark = [steep](const cv::Mat& d, cv::Mat& l, int j, int i) {
        if (std::abs(double{d.at<float>(j, i)}) > steep) l.at<float>(j, i) = 0.0F;
      };
      mark(own.x, level.x, y, x);
      mark(own.y, level.y, y, x);
      if (x > 0) mark(own.x, level.x, y, x - 1);
      if (y > 0) mark(own.y, level.y, y - 1, x);
    }
  return level;
}

/// The sum of the silhouettes' steps near each pixel: over a short window, extended to the reach of their
/// ramps.
cv::Mat crowded_steps(const SceneDifferences& g, const GradientDomainOptions& options) {
  const int window_px = options.step_window_px, reach_px = options.step_reach_px;
  cv::Mat x;
  cv::Mat y;
  cv::boxFilter(cv::abs(g.own.x).mul(1.0F - g.level.x), x, CV_32F, {window_px, 1}, {-1, -1}, false);
  cv::boxFilter(cv::abs(g.own.y).mul(1.0F - g.level.y), y, CV_32F, {1, window_px}, {-1, -1}, false);
  const cv::Mat here = cv::max(x, y);
  cv::Mat steps;
  cv::dilate(here, steps, cv::Mat::ones(2 * reach_px + 1, 2 * reach_px + 1, CV_8U));
  if (reach_px > 0) cv::GaussianBlur(steps, steps, {}, reach_px, reach_px, cv::BORDER_REPLICATE);
  return cv::max(steps, here);
}

/// `felt_m` if all neighbours of a pixel differ by less than that, else 0.
cv::Mat unfelt_slopes(const cv::Mat& slope_m, double felt_m) {
  const auto felt = static_cast<float>(felt_m);
  cv::Mat steepest;
  cv::dilate(slope_m, steepest, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat tolerated_m = cv::Mat::zeros(slope_m.size(), CV_32F);
  tolerated_m.setTo(felt, steepest < felt);
  return tolerated_m;
}

SceneDifferences analysed(const cv::Mat& scene, const DetailTarget& target,
                          const GradientDomainOptions& options) {
  SceneDifferences g;
  g.own = differences(scene);
  g.level = levels(g.own, options.silhouette_slope * target.steepest_slope * target.pixel_m,
                   target.steepest_slope * target.pixel_m);
  g.base = {level_mean(g.own.x, g.level.x, options.detail_scale),
            level_mean(g.own.y, g.level.y, options.detail_scale)};
  cv::Mat slope;
  cv::magnitude(g.own.x, g.own.y, slope);
  g.tolerated_m = unfelt_slopes(slope, options.unfelt_slope * target.pixel_m);
  g.large_slope = level_mean(slope / target.pixel_m, g.level.x.mul(g.level.y), options.gain_scale);
  g.steps = crowded_steps(g, options);
  return g;
}

/// The free parameters of a goal. `knee` is the large-scale slope at which the base's gain is one half; the
/// silhouettes' steps increase with it.
struct Strength {
  float knee;
  float step_m;
};

Strength strength_at(double knee, const GradientDomainOptions& options) {
  return {static_cast<float>(knee),
          static_cast<float>(
              std::min(options.greatest_step_m, options.least_step_m * (1.0 + 4.0 * std::sqrt(knee))))};
}

/// The goal of the differences in one direction.
void set_goal(const cv::Mat& own, const cv::Mat& level, const cv::Mat& base, const SceneDifferences& g,
              Strength strength, const DetailTarget& target, const GradientDomainOptions& options,
              cv::Mat& wanted, cv::Mat& weight, cv::Mat& low, cv::Mat& high) {
  for (cv::Mat* m : {&wanted, &weight, &low, &high}) m->create(own.size(), CV_32F);
  const auto steepest = static_cast<float>(target.steepest_slope * target.pixel_m);
  const auto compression = static_cast<float>(target.compression);
  const auto step_at_least = static_cast<float>(options.step_least_share),
             step_at_most = static_cast<float>(options.step_greatest_share),
             detail_gain = static_cast<float>(options.detail_gain),
             silhouette_weight = static_cast<float>(options.silhouette_weight);
  for (int y = 0; y < own.rows; ++y)
    for (int x = 0; x < own.cols; ++x) {
      const float d = own.at<float>(y, x);
      const float size = std::abs(d);
      const bool silhouette = level.at<float>(y, x) == 0.0F;
      const float gain = 1.0F / (1.0F + g.large_slope.at<float>(y, x) / strength.knee);
      const float tolerated_m = g.tolerated_m.at<float>(y, x);
      const float smooth = base.at<float>(y, x);
      const float step =
          size * std::min(1.0F / compression, strength.step_m / std::max(g.steps.at<float>(y, x), 1e-9F));
      const float most = silhouette ? step_at_most * step : std::clamp(size, tolerated_m, steepest);
      const float least = silhouette ? step_at_least * step : -tolerated_m;
      const float eased = gain * smooth + std::max(gain, detail_gain) * (d - smooth);
      const float sign = std::copysign(1.0F, d);
      wanted.at<float>(y, x) = sign * std::clamp(silhouette ? step : sign * eased, least, most);
      weight.at<float>(y, x) = silhouette ? silhouette_weight : 1.0F;
      low.at<float>(y, x) = d > 0.0F ? least : -most;
      high.at<float>(y, x) = d > 0.0F ? most : -least;
    }
}

Goal goal_for(const SceneDifferences& g, double knee, const DetailTarget& target,
              const GradientDomainOptions& options) {
  Goal goal;
  const Strength strength = strength_at(knee, options);
  set_goal(g.own.x, g.level.x, g.base.x, g, strength, target, options, goal.wanted.x, goal.weight.x,
           goal.low.x, goal.high.x);
  set_goal(g.own.y, g.level.y, g.base.y, g, strength, target, options, goal.wanted.y, goal.weight.y,
           goal.low.y, goal.high.y);
  return goal;
}

double range_of(const cv::Mat& z) {
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(z, &low, &high);
  return high - low;
}

/// The knee at which the relief has the wanted height, by bisection on a reduced picture without the rounds:
/// the height increases with the knee.
double knee_for_height(const cv::Mat& scene, const DetailTarget& target,
                       const GradientDomainOptions& options) {
  constexpr int kSmall = 160;
  const double scale = std::min(1.0, static_cast<double>(kSmall) / std::max(scene.cols, scene.rows));
  cv::Mat small;
  cv::resize(scene, small, {}, scale, scale, cv::INTER_AREA);
  if (small.cols < 2 || small.rows < 2) small = scene;
  DetailTarget coarse = target;
  coarse.pixel_m = target.pixel_m * scene.cols / small.cols;
  const PoissonSolver poisson(small.size());
  const SceneDifferences scene_differences = analysed(small, coarse, options);
  double low = std::log(kLeastKnee);
  double high = std::log(kGreatestKnee);
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (low + high);
    const Goal goal = goal_for(scene_differences, std::exp(middle), coarse, options);
    (range_of(poisson.solve(goal.wanted)) > target.height_m ? high : low) = middle;
  }
  return std::exp(0.5 * (low + high));
}

/// The differences and multipliers of a new round, in one direction.
void project(const cv::Mat& own, const cv::Mat& wanted, const cv::Mat& weight, const cv::Mat& low,
             const cv::Mat& high, float relaxation, cv::Mat& chosen, cv::Mat& multiplier) {
  for (int y = 0; y < own.rows; ++y) {
    const auto* o = own.ptr<float>(y);
    const auto* t = wanted.ptr<float>(y);
    const auto* w = weight.ptr<float>(y);
    const auto* l = low.ptr<float>(y);
    const auto* u = high.ptr<float>(y);
    auto* c = chosen.ptr<float>(y);
    auto* m = multiplier.ptr<float>(y);
    for (int x = 0; x < own.cols; ++x) {
      const float relaxed = relaxation * o[x] + (1.0F - relaxation) * c[x];
      const float free = (w[x] * t[x] + relaxed + m[x]) / (w[x] + 1.0F);
      c[x] = std::max(l[x], std::min(u[x], free));
      m[x] += relaxed - c[x];
    }
  }
}

}  // namespace

Result<Raster<float>> gradient_domain_relief(const Raster<float>& nearness, const DetailTarget& target,
                                             const GradientDomainOptions& options, const Work& work) {
  Raster<float> result = nearness;
  const cv::Mat given(result.height(), result.width(), CV_32F, result.data());
  cv::Mat scene = given * (target.compression * target.height_m);
  if (range_of(scene) <= 0.0) {
    std::fill(result.values().begin(), result.values().end(), 0.0F);
    return result;
  }
  const SceneDifferences scene_differences = analysed(scene, target, options);
  double knee = knee_for_height(scene, target, options);
  Goal goal = goal_for(scene_differences, knee, target, options);
  const PoissonSolver poisson(scene.size());
  Differences chosen{goal.wanted.x.clone(), goal.wanted.y.clone()};
  Differences multiplier{cv::Mat::zeros(scene.size(), CV_32F), cv::Mat::zeros(scene.size(), CV_32F)};
  const auto relaxation = static_cast<float>(options.relaxation);
  cv::Mat relief;
  for (int round = 1; round <= options.rounds; ++round) {
    if (work.cancelled()) return Work::interrupted();
    relief = poisson.solve({chosen.x - multiplier.x, chosen.y - multiplier.y});
    const Differences own = differences(relief);
    if (round <= options.last_corrected_round && round % options.correction_interval == 0) {
      const double missing = target.height_m / std::max(range_of(relief), 1e-9);
      knee = std::clamp(knee * std::clamp(std::pow(missing, 1.5), 0.5, 2.0), kLeastKnee, kGreatestKnee);
      goal = goal_for(scene_differences, knee, target, options);
    }
    project(own.x, goal.wanted.x, goal.weight.x, goal.low.x, goal.high.x, relaxation, chosen.x, multiplier.x);
    project(own.y, goal.wanted.y, goal.weight.y, goal.low.y, goal.high.y, relaxation, chosen.y, multiplier.y);
    work.report(static_cast<double>(round) / options.rounds, "relief");
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
