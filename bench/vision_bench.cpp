// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo.hpp"

#include <cmath>
#include <cstdlib>
#include <string>

#include <benchmark/benchmark.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/disparity_filter.hpp>

// Each of our stereo methods beside OpenCV's on Middlebury's cones (450 x 375, 60 disparities), two threads
// each: wall time, processor time, and the bad pixels (beyond 1 px, not hidden, in percent) of what was
// timed.
namespace palpable::vision {
namespace {

constexpr int kThreads = 2;
constexpr int kDisparities = 64;

struct Scene {
  cv::Mat left, right, truth, mask;
};

const Scene* scene() {
  static const Scene cones = [] {
    const char* data = std::getenv("PALPABLE_DATA");
    const std::string folder = data == nullptr ? "" : std::string(data) + "/stereo/mid2_cones/";
    const auto read = [&](const char* name, int flags) { return cv::imread(folder + name, flags); };
    return Scene{read("imL.png", cv::IMREAD_COLOR), read("imR.png", cv::IMREAD_COLOR),
                 read("groundtruth.png", cv::IMREAD_GRAYSCALE), read("nonocc.png", cv::IMREAD_GRAYSCALE)};
  }();
  return cones.left.empty() || cones.truth.empty() || cones.mask.empty() ? nullptr : &cones;
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
double bad_percent(const Scene& s, const DisparityAt& disparity) {
  int bad = 0;
  int all = 0;
  for (int y = 0; y < s.truth.rows; ++y)
    for (int x = 0; x < s.truth.cols; ++x) {
      if (s.mask.at<std::uint8_t>(y, x) != 255 || s.truth.at<std::uint8_t>(y, x) == 0) continue;
      ++all;
      const double error = std::abs(disparity(x, y) - s.truth.at<std::uint8_t>(y, x) / 4.0);
      bad += error <= 1.0 ? 0 : 1;
    }
  return 100.0 * bad / all;
}

void BM_OwnStereo(benchmark::State& state, StereoMethod method) {
  if (scene() == nullptr) return state.SkipWithError("PALPABLE_DATA names no folder with stereo/mid2_cones");
  const StereoPair pair{image_of(scene()->left), image_of(scene()->right), {}};
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
  state.counters["bad_percent"] = bad_percent(*scene(), [&](int x, int y) { return disparity(x, y); });
}

template <class Compute>
void time_opencv(benchmark::State& state, const Compute& compute) {
  if (scene() == nullptr) return state.SkipWithError("PALPABLE_DATA names no folder with stereo/mid2_cones");
  cv::setNumThreads(kThreads);
  // Columns that the left picture's edge would lose.
  cv::Mat left;
  cv::Mat right;
  cv::copyMakeBorder(scene()->left, left, 0, 0, kDisparities, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(scene()->right, right, 0, 0, kDisparities, 0, cv::BORDER_REPLICATE);
  cv::Mat disparity;
  for (auto _ : state) compute(left, right, disparity);
  state.counters["bad_percent"] = bad_percent(
      *scene(), [&](int x, int y) { return disparity.at<std::int16_t>(y, x + kDisparities) / 16.0; });
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
  filter->setLambda(8000.0);
  filter->setSigmaColor(1.5);
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
BENCHMARK_CAPTURE(BM_OwnStereo, best, StereoMethod::best)->Apply(configure);

}  // namespace
}  // namespace palpable::vision
