// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/ball_contacts.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::models {
namespace {

/// Below this radius, trying each sample is quicker.
constexpr double kSmallReach = 24.0;
/// The same where all contacts are searched, of which large blocks contain one more often.
constexpr double kMostTried = 48.0;
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

/// to[x] = heights[x] - above[x]; returns the maximum.
PALPABLE_VECTORIZE float lower_row(float* to, const float* heights, const float* above, int count) {
  float best = -1e30F;
  for (int x = 0; x < count; ++x) to[x] = heights[x] - above[x];
  for (int x = 0; x < count; ++x) best = to[x] > best ? to[x] : best;
  return best;
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

BallContacts::BallContacts(const Raster<float>& heights, double reach) : heights_(heights), reach_(reach) {
  if (reach < kMostTried) {
    const int r = static_cast<int>(std::floor(reach));
    above_ = Raster<float>(2 * r + 1, 2 * r + 1);
    for (int dy = -r; dy <= r; ++dy)
      for (int dx = -r; dx <= r; ++dx) {
        const double away2 = 1.0 * dx * dx + 1.0 * dy * dy;
        above_(dx + r, dy + r) =
            static_cast<float>(away2 / (reach + std::sqrt(std::max(0.0, reach * reach - away2))));
      }
  }
  if (reach < kSmallReach) return;
  const Raster<float>* below = &heights;
  for (int side = kBlocks; below->width() > kBlocks || below->height() > kBlocks; side *= kBlocks) {
    Raster<float> blocks = highest_of_blocks(*below);
    levels_.push_back({side, std::move(blocks)});
    below = &levels_.back().highest;
  }
}

void BallContacts::find_row(int y, std::span<ContactOffset> found) const {
  if (levels_.empty()) return try_each(y, found);
  ContactOffset before;
  for (int x = 0; x < heights_.width(); ++x) {
    Search search{x, y, heights_(x, y), {}};
    // The contact of the sample before is often a good one here too.
    descend_from(before, search);
    found[static_cast<std::size_t>(x)] = before = search.at;
  }
}

void BallContacts::find_all(int x, int y, float slack, std::vector<ContactOffset>& found) const {
  if (!above_.empty()) return try_all(x, y, slack, found);
  const ContactOffset first = found.empty() ? ContactOffset{} : found.front();
  found.clear();
  Search search{x, y, heights_(x, y), {}, &found, slack};
  descend_from(first, search);
  const float least = search.best - slack;
  std::erase_if(found, [&](ContactOffset at) {
    const float here = lowest_point(x, y, at);
    if (here < least) return true;
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a)
        if (lowest_point(x, y, {at.right + a, at.down + b}) > here) return true;
    return false;
  });
}

/// Height of the lowest point of a ball above (x, y) that rests on one sample; very low if it cannot.
float BallContacts::lowest_point(int x, int y, ContactOffset at) const {
  constexpr float kNone = -1e30F;
  const double away2 = 1.0 * at.right * at.right + 1.0 * at.down * at.down;
  const double left = reach_ * reach_ - away2;
  if (left < 0.0 || !heights_.contains(x + at.right, y + at.down)) return kNone;
  // The height of the ball's surface above its lowest point, in a form that is exact for any radius.
  return heights_(x + at.right, y + at.down) - static_cast<float>(away2 / (reach_ + std::sqrt(left)));
}

void BallContacts::descend_from(ContactOffset first, Search& search) const {
  const ContactOffset at{std::clamp(search.x + first.right, 0, heights_.width() - 1) - search.x,
                         std::clamp(search.y + first.down, 0, heights_.height() - 1) - search.y};
  const float there = lowest_point(search.x, search.y, at);
  if (there > search.best) {
    search.best = there;
    search.at = at;
  }
  const std::size_t top = levels_.size();
  for (int j = 0; j < highest(top).height(); ++j)
    for (int i = 0; i < highest(top).width(); ++i) descend(top, i, j, search);
}

/// Beyond the border the samples repeat, farther from the centre: none of them is a contact.
void BallContacts::descend(std::size_t level, int i, int j, Search& search) const {
  const int side = level == 0 ? 1 : levels_[level - 1].side;
  const double dx = distance_to_block(search.x, i, side, heights_.width());
  const double dy = distance_to_block(search.y, j, side, heights_.height());
  const double left = reach_ * reach_ - dx * dx - dy * dy;
  if (left < 0.0) return;
  const double above = (dx * dx + dy * dy) / (reach_ + std::sqrt(left));
  const float most = highest(level)(i, j) - static_cast<float>(above);
  if (search.others != nullptr ? most < search.best - search.slack : most <= search.best) return;
  if (level == 0) {
    const ContactOffset at{i - search.x, j - search.y};
    if (search.others != nullptr) search.others->push_back(at);
    if (most <= search.best) return;
    search.best = most;
    search.at = at;
    return;
  }
  const Raster<float>& below = highest(level - 1);
  for (int v = kBlocks * j; v < std::min(kBlocks * (j + 1), below.height()); ++v)
    for (int u = kBlocks * i; u < std::min(kBlocks * (i + 1), below.width()); ++u)
      descend(level - 1, u, v, search);
}

void BallContacts::try_all(int x, int y, float slack, std::vector<ContactOffset>& found) const {
  constexpr int kSide = 2 * static_cast<int>(kMostTried) + 3;
  constexpr float kNone = -1e30F;
  const int r = (above_.width() - 1) / 2;
  // With a border of samples that are no contact.
  std::array<float, std::size_t{kSide} * kSide> lowest;
  std::fill_n(lowest.begin(), kSide * (2 * r + 3), kNone);
  std::array<float, kSide> row_best;
  std::fill_n(row_best.begin(), 2 * r + 1, kNone);
  const auto at = [&](int dx, int dy) { return lowest.data() + kSide * (dy + r + 1) + dx + r + 1; };
  float best = kNone;
  for (int dy = std::max(-r, -y); dy <= std::min(r, heights_.height() - 1 - y); ++dy) {
    const int chord = static_cast<int>(std::sqrt(reach_ * reach_ - dy * dy));
    const int from = std::max(-chord, -x);
    const int count = std::min(chord, heights_.width() - 1 - x) - from + 1;
    const float row = lower_row(at(from, dy), &heights_(x + from, y + dy), &above_(from + r, dy + r), count);
    row_best[static_cast<std::size_t>(dy + r)] = row;
    best = std::max(best, row);
  }
  found.clear();
  const float least = best - slack;
  for (int dy = -r; dy <= r; ++dy) {
    if (row_best[static_cast<std::size_t>(dy + r)] < least) continue;
    for (int dx = -r; dx <= r; ++dx) {
      const float* const here = at(dx, dy);
      if (*here < least) continue;
      const float* const up = here - kSide;
      const float* const down = here + kSide;
      const float around = std::max({here[-1], here[1], up[-1], up[0], up[1], down[-1], down[0], down[1]});
      if (around <= *here) found.push_back({dx, dy});
    }
  }
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
