// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/ball_contacts.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {
namespace {

/// Below this radius, trying each sample is quicker.
constexpr double kSmallReach = 24.0;
/// Blocks of a level along each side of a block of the next.
constexpr int kBlocks = 4;

/// best[x] = max(best[x], from[x] + rise); `which` stores the offset of the maximum.
PALPABLE_VECTORIZE void raise(float* best, std::int32_t* which, const float* from, int count, float rise,
                              std::int32_t offset) {
  for (int x = 0; x < count; ++x) {
    const float risen = from[x] + rise;
    which[x] = risen > best[x] ? offset : which[x];
    best[x] = std::max(best[x], risen);
  }
}

Raster<float> highest_of_blocks(const Raster<float>& of) {
  const auto blocks = [](int count) { return (count + kBlocks - 1) / kBlocks; };
  Raster<float> highest(blocks(of.width()), blocks(of.height()), -1e30F);
  for (int y = 0; y < of.height(); ++y)
    for (int x = 0; x < of.width(); ++x) {
      float& most = highest(x / kBlocks, y / kBlocks);
      most = std::max(most, of(x, y));
    }
  return highest;
}

/// Distance along one axis from a sample to the block `index` of `side` samples.
int distance_to_block(int at, int index, int side, int count) {
  const int first = index * side;
  const int last = std::min(first + side, count) - 1;
  return std::max({first - at, 0, at - last});
}

}  // namespace

BallContacts::BallContacts(const Raster<float>& heights, double reach)
    : heights_(heights), reach_(reach), is_small_(reach < kSmallReach) {
  if (is_small_) return;
  const Raster<float>* below = &heights;
  for (int side = kBlocks; below->width() > kBlocks || below->height() > kBlocks; side *= kBlocks) {
    Raster<float> blocks = highest_of_blocks(*below);
    levels_.push_back({side, std::move(blocks)});
    below = &levels_.back().highest;
  }
}

void BallContacts::find_row(int y, std::span<ContactOffset> found) const {
  if (is_small_) return try_each(y, found);
  ContactOffset before;
  for (int x = 0; x < heights_.width(); ++x) {
    Search search{x, y, heights_(x, y), {}};
    // The contact of the sample before is often a good one here too.
    descend(0, std::clamp(x + before.right, 0, heights_.width() - 1),
            std::clamp(y + before.down, 0, heights_.height() - 1), search);
    const std::size_t top = levels_.size();
    for (int j = 0; j < highest(top).height(); ++j)
      for (int i = 0; i < highest(top).width(); ++i) descend(top, i, j, search);
    found[static_cast<std::size_t>(x)] = before = search.at;
  }
}

/// Beyond the border the samples repeat, farther from the centre: none of them is a contact.
void BallContacts::descend(std::size_t level, int i, int j, Search& search) const {
  const int side = level == 0 ? 1 : levels_[level - 1].side;
  const double dx = distance_to_block(search.x, i, side, heights_.width());
  const double dy = distance_to_block(search.y, j, side, heights_.height());
  const double left = reach_ * reach_ - dx * dx - dy * dy;
  if (left < 0.0) return;
  // Height of the ball's surface there above its lowest point, in a form that is exact for any radius.
  const double above = (dx * dx + dy * dy) / (reach_ + std::sqrt(left));
  const float most = highest(level)(i, j) - static_cast<float>(above);
  if (!(most > search.best)) return;
  if (level == 0) {
    search.best = most;
    search.at = {i - search.x, j - search.y};
    return;
  }
  const Raster<float>& below = highest(level - 1);
  for (int v = kBlocks * j; v < std::min(kBlocks * (j + 1), below.height()); ++v)
    for (int u = kBlocks * i; u < std::min(kBlocks * (i + 1), below.width()); ++u)
      descend(level - 1, u, v, search);
}

void BallContacts::try_each(int y, std::span<ContactOffset> found) const {
  const int r = static_cast<int>(std::floor(reach_));
  const int side = 2 * r + 1;
  const int w = heights_.width();
  std::vector<float> padded(static_cast<std::size_t>(w + 2 * r));
  std::vector<float> best(static_cast<std::size_t>(w), -1e30F);
  std::vector<std::int32_t> which(static_cast<std::size_t>(w));
  for (int dy = -r; dy <= r; ++dy) {
    const auto row = heights_.row(std::clamp(y + dy, 0, heights_.height() - 1));
    std::copy(row.begin(), row.end(), padded.begin() + r);
    std::fill_n(padded.begin(), r, row.front());
    std::fill_n(padded.end() - r, r, row.back());
    const int chord = static_cast<int>(std::floor(std::sqrt(reach_ * reach_ - dy * dy)));
    for (int dx = -chord; dx <= chord; ++dx) {
      const double rise = std::sqrt(std::max(0.0, reach_ * reach_ - dx * dx - dy * dy));
      raise(best.data(), which.data(), padded.data() + r + dx, w, static_cast<float>(rise),
            (dy + r) * side + dx + r);
    }
  }
  for (std::size_t x = 0; x < which.size(); ++x) found[x] = {which[x] % side - r, which[x] / side - r};
}

}  // namespace palpable::models
