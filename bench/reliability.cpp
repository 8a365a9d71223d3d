// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "reliability.hpp"

#include <cmath>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

std::string percent(long part, long whole) {
  return whole > 0 ? fmt::format("{:6.1f}", 100.0 * static_cast<double>(part) / static_cast<double>(whole))
                   : "     -";
}

}  // namespace

Reliability::Bin Reliability::sum(const Bins& bins, std::size_t begin, std::size_t end) {
  Bin out;
  for (std::size_t i = begin; i < end; ++i) {
    out.pixels += bins[i].pixels;
    out.right += bins[i].right;
  }
  return out;
}

void Reliability::add(const StereoScene& scene, const Raster<float>& disparity_px,
                      const Raster<float>& confidence) {
  Bins& bins = by_kind_[scene.kind];
  for (std::size_t i = 0; i < confidence.count(); ++i) {
    std::size_t bin = kFrom.size() - 1;
    while (bin > 0 && confidence.values()[i] < kFrom[bin]) --bin;
    ++bins[bin].pixels;
    bins[bin].right += std::fabs(disparity_px.values()[i] - scene.truth_px.values()[i]) <= 1.0F ? 1 : 0;
  }
}

std::string Reliability::table() const {
  Bins all{};
  std::string out = "kind         from 0.9  right  under 0.5  right  all right\n";
  for (const auto& [kind, bins] : by_kind_) {
    for (std::size_t i = 0; i < bins.size(); ++i) {
      all[i].pixels += bins[i].pixels;
      all[i].right += bins[i].right;
    }
    const Bin whole = sum(bins, 0, 6), sure = bins[5], guessed = sum(bins, 0, 3);
    out += fmt::format("{:<12}   {} {}     {} {}     {}\n", name_of(kind), percent(sure.pixels, whole.pixels),
                       percent(sure.right, sure.pixels), percent(guessed.pixels, whole.pixels),
                       percent(guessed.right, guessed.pixels), percent(whole.right, whole.pixels));
  }
  const Bin whole = sum(all, 0, 6);
  for (std::size_t i = 0; i < all.size(); ++i)
    out += fmt::format("confidence from {:.1f}: {} % of the pixels, {} % of them right\n", kFrom[i],
                       percent(all[i].pixels, whole.pixels), percent(all[i].right, all[i].pixels));
  return out;
}

}  // namespace palpable::bench
