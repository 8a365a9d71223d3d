// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
//
// Every stereo method beside OpenCV's, on the same pictures in the same run: 450 x 375 pixels, disparities up
// to 59.
#include "palpable/vision/stereo.hpp"
#include "palpable/vision/synthetic_pair.hpp"

#include <benchmark/benchmark.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/ximgproc.hpp>

namespace palpable::vision {
namespace {

constexpr int kDisparities = 64;  // OpenCV wants a multiple of 16

const StereoPair& pair_450x375() {
  static const StereoPair pair = [] {
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
    return render(scene);
  }();
  return pair;
}

cv::Mat grey8(const Image& image) {
  cv::Mat out;
  cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(image.samples.data()))
      .convertTo(out, CV_8U, 255.0);
  return out;
}

void BM_Method(benchmark::State& state, StereoMethod method) {
  StereoOptions options;
  options.max_disparity_px = kDisparities - 1;
  for (auto _ : state) benchmark::DoNotOptimize(match(pair_450x375(), method, options, {}));
}
BENCHMARK_CAPTURE(BM_Method, scanline, StereoMethod::scanline)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(BM_Method, graph_cut, StereoMethod::graph_cut)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(BM_Method, segments, StereoMethod::segments)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(BM_Method, pyramid, StereoMethod::pyramid)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(BM_Method, fast, StereoMethod::fast)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(BM_Method, best, StereoMethod::best)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_OpenCvBlockMatching(benchmark::State& state) {
  const cv::Mat left = grey8(pair_450x375().left);
  const cv::Mat right = grey8(pair_450x375().right);
  const auto matcher = cv::StereoBM::create(kDisparities, 15);
  cv::Mat out;
  for (auto _ : state) matcher->compute(left, right, out);
}
BENCHMARK(BM_OpenCvBlockMatching)->Unit(benchmark::kMillisecond)->UseRealTime();

cv::Ptr<cv::StereoSGBM> semi_global(int mode) {
  constexpr int kBlock = 3;
  return cv::StereoSGBM::create(0, kDisparities, kBlock, 8 * kBlock * kBlock, 32 * kBlock * kBlock, 1, 63, 0,
                                0, 0, mode);
}

void BM_OpenCvSemiGlobal(benchmark::State& state) {
  const cv::Mat left = grey8(pair_450x375().left);
  const cv::Mat right = grey8(pair_450x375().right);
  const auto matcher = semi_global(cv::StereoSGBM::MODE_SGBM);
  cv::Mat out;
  for (auto _ : state) matcher->compute(left, right, out);
}
BENCHMARK(BM_OpenCvSemiGlobal)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_OpenCvSemiGlobal3WayWls(benchmark::State& state) {
  const cv::Mat left = grey8(pair_450x375().left);
  const cv::Mat right = grey8(pair_450x375().right);
  const auto matcher = semi_global(cv::StereoSGBM::MODE_SGBM_3WAY);
  const auto right_matcher = cv::ximgproc::createRightMatcher(matcher);
  const auto filter = cv::ximgproc::createDisparityWLSFilter(matcher);
  filter->setLambda(100.0);
  filter->setSigmaColor(0.7);
  cv::Mat from_left;
  cv::Mat from_right;
  cv::Mat out;
  for (auto _ : state) {
    matcher->compute(left, right, from_left);
    right_matcher->compute(right, left, from_right);
    filter->filter(from_left, left, out, from_right);
  }
}
BENCHMARK(BM_OpenCvSemiGlobal3WayWls)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace palpable::vision
