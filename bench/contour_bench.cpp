// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/tracing.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/vision/contours/contours.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

namespace palpable {
namespace {

/// 40 discs of random tones, 1024 x 768 pixels.
Image discs(int channels) {
  Image image{1024, 768, channels, 8, {}};
  image.samples.assign(std::size_t{1024} * 768 * static_cast<std::size_t>(channels), 0.5F);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> share;
  for (int k = 0; k < 40; ++k) {
    const float cx = 1024.0F * share(random);
    const float cy = 768.0F * share(random);
    const float radius = 20.0F + 80.0F * share(random);
    const float tone[3] = {share(random), share(random), share(random)};
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        if (std::hypot(static_cast<float>(x) - cx, static_cast<float>(y) - cy) < radius)
          for (int c = 0; c < channels; ++c)
            image.samples[static_cast<std::size_t>((y * image.width + x) * channels + c)] = tone[c];
  }
  return image;
}

/// Argument: channels.
void BM_FindContours1024x768(benchmark::State& state) {
  const Image image = discs(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(vision::find_contours(image, {}, Work{}));
}
BENCHMARK(BM_FindContours1024x768)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond)->UseRealTime();

/// For comparison: OpenCV's Gaussian smoothing and Canny edges, without directions or strengths.
void BM_OpenCvCanny1024x768(benchmark::State& state) {
  const Image image = discs(1);
  cv::Mat grey(image.height, image.width, CV_8U);
  for (std::size_t i = 0; i < image.samples.size(); ++i)
    grey.data[i] = static_cast<std::uint8_t>(255.0F * image.samples[i]);
  cv::Mat smooth;
  cv::Mat lines;
  for (auto _ : state) {
    cv::GaussianBlur(grey, smooth, {}, 1.4);
    cv::Canny(smooth, lines, 50, 100);
    benchmark::DoNotOptimize(lines.data);
  }
}
BENCHMARK(BM_OpenCvCanny1024x768)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Eq. 7 at m = 3 px, from the contours found.
void BM_BoundaryMap1024x768(benchmark::State& state) {
  const auto contours = vision::find_contours(discs(1), {}, Work{});
  for (auto _ : state) benchmark::DoNotOptimize(sculpt::boundary_map_from_contours(*contours, {}, Work{}));
}
BENCHMARK(BM_BoundaryMap1024x768)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A hand that moves at 50 mm/s on a circle of 30 mm across all discs.
void BM_TracingTick(benchmark::State& state) {
  const auto contours = vision::find_contours(discs(1), {}, Work{});
  const auto map =
      std::make_shared<const models::BoundaryMap>(*sculpt::boundary_map_from_contours(*contours, {}, Work{}));
  const haptics::TracingLaw law(map, {});
  haptics::TracingLaw::State touch{};
  std::vector<haptics::Hand> round(3770);
  for (std::size_t k = 0; k < round.size(); ++k) {
    const double angle = 0.001 * 0.05 / 0.03 * static_cast<double>(k);
    round[k].position.v = {0.03 * std::cos(angle), 0.03 * std::sin(angle), 0.0};
    round[k].velocity_m_per_s.v = {-0.05 * std::sin(angle), 0.05 * std::cos(angle), 0.0};
    round[k].dt_s = 0.001;
  }
  std::size_t tick = 0;
  for (auto _ : state) benchmark::DoNotOptimize(law.evaluate(round[tick++ % round.size()], touch));
}
BENCHMARK(BM_TracingTick)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace palpable
