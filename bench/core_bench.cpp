// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/image.hpp"
#include "palpable/core/work.hpp"

#include <benchmark/benchmark.h>

namespace palpable {
namespace {

void BM_Grey640x480(benchmark::State& state) {
  const Image colour{640, 480, 3, 8, std::vector<float>(640UL * 480UL * 3UL, 0.5F)};
  for (auto _ : state) benchmark::DoNotOptimize(grey(colour));
}
BENCHMARK(BM_Grey640x480)->Unit(benchmark::kMicrosecond);

void BM_ParallelForStartsAndEnds(benchmark::State& state) {
  const Work work;
  for (auto _ : state) parallel_for(work, 1000, 1, [](int begin, int) { benchmark::DoNotOptimize(begin); });
}
BENCHMARK(BM_ParallelForStartsAndEnds)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palpable
