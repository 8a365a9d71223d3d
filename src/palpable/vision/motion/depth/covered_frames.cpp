// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/covered_frames.hpp"

#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/motion/depth/plane_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace palpable::vision {
namespace {

using Levels = std::array<double, 3>;

// The mean colours of a picture's blocks; what is left at the right and below is no block.
Raster<Levels> block_means(const Raster<Rgb8>& picture, int block) {
  Raster<Levels> out(picture.width() / block, picture.height() / block);
  const double share = 1.0 / (block * block);
  for (int y = 0; y < out.height() * block; ++y)
    for (int x = 0; x < out.width() * block; ++x) {
      const Rgb8 p = picture(x, y);
      Levels& mean = out(x / block, y / block);
      mean[0] += share * p.r, mean[1] += share * p.g, mean[2] += share * p.b;
    }
  return out;
}

double brightness(const Levels& colour) { return colour[0] + colour[1] + colour[2]; }

// Between the blocks' middles, bilinear; nullopt outside them.
std::optional<Levels> colour_at(const Raster<Levels>& means, int block, double u, double v) {
  const double x = (u + 0.5) / block - 0.5, y = (v + 0.5) / block - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  if (!means.contains(x0, y0) || !means.contains(x0 + 1, y0 + 1)) return std::nullopt;
  const double right = x - x0, below = y - y0;
  Levels out{};
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = (1 - below) * ((1 - right) * means(x0, y0)[i] + right * means(x0 + 1, y0)[i]) +
             below * ((1 - right) * means(x0, y0 + 1)[i] + right * means(x0 + 1, y0 + 1)[i]);
  return out;
}

class ColourComparison {
 public:
  ColourComparison(std::span<const FrameDepth> maps, std::span<const Raster<Rgb8>* const> pictures,
                   const CoveredFrameOptions& options)
      : maps_(maps), options_(options) {
    for (const FrameDepth& map : maps)
      means_.push_back(block_means(*pictures[static_cast<std::size_t>(map.frame)], options.block_px));
  }

  double covered_share(std::size_t self) const {
    const std::vector<double> gains = gains_of(self);
    const Raster<Levels>& own = means_[self];
    std::vector<bool> covered(own.count());
    for (int y = 0; y < own.height(); ++y)
      for (int x = 0; x < own.width(); ++x)
        covered[block(own, x, y)] = !is_measured(self, x, y) && is_covered(self, x, y, gains);
    return own.count() == 0 ? 0.0 : largest_area(covered, static_cast<std::size_t>(own.width()));
  }

 private:
  static std::size_t block(const Raster<Levels>& means, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(means.width()) +
           static_cast<std::size_t>(x);
  }
  int middle(int index) const { return index * options_.block_px + options_.block_px / 2; }
  bool is_measured(std::size_t self, int x, int y) const {
    return maps_[self].map.depth.depth_m(middle(x), middle(y)) > 0;
  }

  // The colour that another frame shows of the surface in the middle of a block; nullopt if it does not show
  // it.
  std::optional<Levels> colour_in(std::size_t other, std::size_t self, int x, int y) const {
    const Pinhole& here = *maps_[self].map.depth.camera;
    const auto z = static_cast<double>(maps_[self].filled.depth_m(middle(x), middle(y)));
    if (!(z > 0)) return std::nullopt;
    const PosedDepthMap& map = maps_[other].map;
    const Pinhole& there = *map.depth.camera;
    const Vec3 p = (map.pose.inverse() * (maps_[self].map.pose *
                                          Point<CameraFrame>{z * line_of_sight(here, middle(x), middle(y))}))
                       .v;
    if (!(p.z > 0)) return std::nullopt;
    const double u = there.fx * p.x / p.z + there.cx, v = there.fy * p.y / p.z + there.cy;
    const Raster<float>& depth = map.depth.depth_m;
    if (!(u > -0.5 && v > -0.5 && u < depth.width() - 0.5 && v < depth.height() - 0.5)) return std::nullopt;
    const double seen =
        static_cast<double>(depth(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v))));
    if (!(std::abs(seen - p.z) < options_.tolerance * p.z)) return std::nullopt;
    return colour_at(means_[other], options_.block_px, u, v);
  }

  // How much brighter this frame is than each other one, where both measured the same surface.
  std::vector<double> gains_of(std::size_t self) const {
    constexpr std::size_t kLeastBlocks = 20;
    const Raster<Levels>& own = means_[self];
    std::vector<double> out(maps_.size(), 1.0);
    for (std::size_t other = 0; other < maps_.size(); ++other) {
      std::vector<double> ratios;
      for (int y = 0; y < own.height(); ++y)
        for (int x = 0; x < own.width(); ++x)
          if (other != self && is_measured(self, x, y))
            if (const auto colour = colour_in(other, self, x, y); colour && brightness(*colour) > 0)
              ratios.push_back(brightness(own(x, y)) / brightness(*colour));
      if (ratios.size() >= kLeastBlocks) out[other] = quantile_of(ratios, 0.5);
    }
    return out;
  }

  bool is_covered(std::size_t self, int x, int y, const std::vector<double>& gains) const {
    std::array<std::vector<double>, 3> levels;
    for (std::size_t other = 0; other < maps_.size(); ++other) {
      if (other == self) continue;
      const auto colour = colour_in(other, self, x, y);
      for (std::size_t i = 0; colour && i < levels.size(); ++i)
        levels[i].push_back(gains[other] * (*colour)[i]);
    }
    if (std::ssize(levels[0]) < options_.least_frames) return false;
    double greatest = 0.0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double median = quantile_of(levels[i], 0.5);
      greatest = std::max(greatest, std::abs(means_[self](x, y)[i] - median));
      const bool agree = std::all_of(levels[i].begin(), levels[i].end(), [&](double level) {
        return std::abs(level - median) < options_.least_difference / 2;
      });
      if (!agree) return false;
    }
    return greatest > options_.least_difference;
  }

  static double largest_area(const std::vector<bool>& covered, std::size_t width) {
    DisjointSets areas(covered.size());
    for (std::size_t i = 0; i < covered.size(); ++i) {
      if (!covered[i]) continue;
      if (i % width != 0 && covered[i - 1]) areas.join(i - 1, i);
      if (i >= width && covered[i - width]) areas.join(i - width, i);
    }
    std::vector<int> sizes(covered.size(), 0);
    for (std::size_t i = 0; i < covered.size(); ++i)
      if (covered[i]) ++sizes[areas.find(i)];
    return *std::max_element(sizes.begin(), sizes.end()) / static_cast<double>(covered.size());
  }

  std::span<const FrameDepth> maps_;
  CoveredFrameOptions options_;
  std::vector<Raster<Levels>> means_;
};

}  // namespace

std::vector<Parameter> parameters_of(CoveredFrameOptions& o) {
  return {{"block_px", &o.block_px, {2, 64}, "px", "Blocks whose mean colours are compared"},
          {"tolerance", &o.tolerance, {0.001, 0.2}, "", "Depths of one surface differ by a smaller share"},
          {"least_frames", &o.least_frames, {2, 16}, "", "Other frames that must show a block's surface"},
          {"least_difference",
           &o.least_difference,
           {1, 255},
           "levels",
           "Difference of colour from which on a block is covered"}};
}

std::vector<double> covered_shares(std::span<const FrameDepth> maps,
                                   std::span<const Raster<Rgb8>* const> pictures,
                                   const CoveredFrameOptions& options) {
  const ColourComparison comparison(maps, pictures, options);
  std::vector<double> out;
  for (std::size_t self = 0; self < maps.size(); ++self) out.push_back(comparison.covered_share(self));
  return out;
}

}  // namespace palpable::vision
