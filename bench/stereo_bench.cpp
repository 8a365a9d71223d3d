// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>
#include <cstdlib>
#include <string>

#include <benchmark/benchmark.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/disparity_filter.hpp>

// Compares our stereo methods with OpenCV's on the same pictures in the same run, two threads each: wall
// time, processor time, and bad pixels (error above 1 px, not occluded, in percent) of the timed result. The
// pictures are Middlebury's cones if PALPABLE_DATA names the data, else a synthetic pair of the same size; 64
// disparities.
namespace palpable::vision {
namespace {

constexpr int kThreads = 2;
constexpr int kDisparities = 64;

struct Scene {
  cv::Mat left, right;
  cv::Mat truth;  // float px; 0 = does not count
};

cv::Mat mat_of(const Image& image) {
  cv::Mat grey(image.height, image.width, CV_32F, const_cast<float*>(image.samples.data()));
  cv::Mat out;
  grey.convertTo(out, CV_8U, 255.0);
  cv::cvtColor(out, out, cv::COLOR_GRAY2BGR);
  return out;
}

Scene drawn_scene() {
  SyntheticScene scene;
  scene.width = 450;
  scene.height = 375;
  scene.ground_px = 12.0;
  scene.slope_y = 0.05;
  scene.box_px = 52.0;
  scene.box_left = 180;
  scene.box_right = 330;
  scene.box_top = 100;
  scene.box_bottom = 280;
  const StereoPair pair = render(scene);
  Scene out{mat_of(pair.left), mat_of(pair.right), cv::Mat::zeros(scene.height, scene.width, CV_32F)};
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const double d = scene.truth(x, y);
      const bool hidden = !scene.in_box(x, y) && scene.in_box(x - d + scene.box_px, y);
      if (!hidden && x >= d) out.truth.at<float>(y, x) = static_cast<float>(d);
    }
  return out;
}

const Scene& scene() {
  static const Scene found = [] {
    const char* data = std::getenv("PALPABLE_DATA");
    const std::string folder = data == nullptr ? "" : std::string(data) + "/stereo/mid2_cones/";
    const auto read = [&](const char* name, int flags) { return cv::imread(folder + name, flags); };
    Scene cones{read("imL.png", cv::IMREAD_COLOR), read("imR.png", cv::IMREAD_COLOR),
                read("groundtruth.png", cv::IMREAD_GRAYSCALE)};
    const cv::Mat mask = read("nonocc.png", cv::IMREAD_GRAYSCALE);
    if (cones.left.empty() || cones.right.empty() || cones.truth.empty() || mask.empty())
      return drawn_scene();
    cones.truth.convertTo(cones.truth, CV_32F, 0.25);
    cones.truth.setTo(0.0F, mask != 255);
    return cones;
  }();
  return found;
}

Image image_of(const cv::Mat& bgr) {
  Image out{bgr.cols, bgr.rows, 3, 8, {}};
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x) {
      const auto p = bgr.at<cv::Vec3b>(y, x);
      for (const int c : {2, 1, 0}) out.samples.push_back(static_cast<float>(p[c]) / 255.0F);
    }
  return out;
}

template <class DisparityAt>
double bad_percent(const DisparityAt& disparity) {
  const cv::Mat& truth = scene().truth;
  int bad = 0;
  int all = 0;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x) {
      const auto d = static_cast<double>(truth.at<float>(y, x));
      if (d <= 0.0) continue;
      ++all;
      bad += std::abs(disparity(x, y) - d) <= 1.0 ? 0 : 1;
    }
  return 100.0 * bad / all;
}

void BM_OwnStereo(benchmark::State& state, StereoMethod method) {
  const StereoPair pair{image_of(scene().left), image_of(scene().right), {}};
  Work work;
  work.threads = kThreads;
  StereoOptions options;
  options.max_disparity_px = kDisparities - 1;
  Raster<float> disparity;
  for (auto _ : state) {
    auto found = match(pair, method, options, work);
    if (!found) return state.SkipWithError(found.error().message.c_str());
    disparity = std::move(found->disparity.disparity_px);
  }
  state.counters["bad_percent"] =
      bad_percent([&](int x, int y) { return static_cast<double>(disparity(x, y)); });
}

template <class Compute>
void time_opencv(benchmark::State& state, const Compute& compute) {
  cv::setNumThreads(kThreads);
  // Columns that the left picture's edge would lose.
  cv::Mat left;
  cv::Mat right;
  cv::copyMakeBorder(scene().left, left, 0, 0, kDisparities, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(scene().right, right, 0, 0, kDisparities, 0, cv::BORDER_REPLICATE);
  cv::Mat disparity;
  for (auto _ : state) compute(left, right, disparity);
  state.counters["bad_percent"] =
      bad_percent([&](int x, int y) { return disparity.at<std::int16_t>(y, x + kDisparities) / 16.0; });
}

void BM_OpenCvBm(benchmark::State& state) {
  const auto matcher = cv::StereoBM::create(kDisparities, 15);
  time_opencv(state, [&](const cv::Mat& left, const cv::Mat& right, cv::Mat& out) {
    cv::Mat l;
    cv::Mat r;
    cv::cvtColor(left, l, cv::COLOR_BGR2GRAY);
    cv::cvtColor(right, r, cv::COLOR_BGR2GRAY);
    matcher->compute(l, r, out);
  });
}

cv::Ptr<cv::StereoSGBM> sgbm(int mode) {
  return cv::StereoSGBM::create(0, kDisparities, 3, 8 * 3 * 9, 32 * 3 * 9, 1, 63, 0, 0, 0, mode);
}

void BM_OpenCvSgbm(benchmark::State& state) {
  const auto matcher = sgbm(cv::StereoSGBM::MODE_SGBM);
  time_opencv(state, [&](const cv::Mat& l, const cv::Mat& r, cv::Mat& out) { matcher->compute(l, r, out); });
}

void BM_OpenCvSgbm3WayWls(benchmark::State& state) {
  const auto matcher = sgbm(cv::StereoSGBM::MODE_SGBM_3WAY);
  const auto from_right = cv::ximgproc::createRightMatcher(matcher);
  const auto filter = cv::ximgproc::createDisparityWLSFilter(matcher);
  filter->setLambda(100.0);
  filter->setSigmaColor(0.7);
  time_opencv(state, [&](const cv::Mat& left, const cv::Mat& right, cv::Mat& out) {
    cv::Mat l;
    cv::Mat r;
    matcher->compute(left, right, l);
    from_right->compute(right, left, r);
    filter->filter(l, left, out, r);
  });
}

void configure(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK(BM_OpenCvBm)->Apply(configure);
BENCHMARK(BM_OpenCvSgbm)->Apply(configure);
BENCHMARK(BM_OpenCvSgbm3WayWls)->Apply(configure);
BENCHMARK_CAPTURE(BM_OwnStereo, fast, StereoMethod::fast)->Apply(configure);
BENCHMARK_CAPTURE(BM_OwnStereo, scanline, StereoMethod::scanline)->Apply(configure);
BENCHMARK_CAPTURE(BM_OwnStereo, graph_cut, StereoMethod::graph_cut)->Apply(configure);
BENCHMARK_CAPTURE(BM_OwnStereo, segments, StereoMethod::segments)->Apply(configure);
BENCHMARK_CAPTURE(BM_OwnStereo, pyramid, StereoMethod::pyramid)->Apply(configure);
BENCHMARK_CAPTURE(BM_OwnStereo, best, StereoMethod::best)->Apply(configure);

}  // namespace
}  // namespace palpable::vision
