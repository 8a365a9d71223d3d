// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/pair_sequence.hpp"

#include "palpable/vision/image/reduced_picture.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/prepare_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace palpable::vision {
namespace {

Image small(const Image& picture, std::size_t most_pixels) {
  auto less = reduced(picture, most_pixels);
  return less ? *std::move(less) : picture;
}

/// The greatest disparity but for one pixel of a thousand; 0 if none is known.
int greatest(const Raster<float>& disparity_px) {
  std::vector<float> known;
  for (const float d : disparity_px.values())
    if (std::isfinite(d)) known.push_back(d);
  if (known.empty()) return 0;
  const auto at = known.begin() + static_cast<std::ptrdiff_t>(known.size() - 1 - known.size() / 1000);
  std::nth_element(known.begin(), at, known.end());
  return static_cast<int>(std::ceil(*at));
}

/// Unknown where the pictures do not confirm each other.
void forget_unconfirmed(const Raster<float>& confirmed, Raster<float>& disparity_px) {
  for (std::size_t k = 0; k < disparity_px.count(); ++k)
    if (!(confirmed.values()[k] > 0.0F)) disparity_px.values()[k] = kUnknownDepth;
}

}  // namespace

StereoRig assumed_rig(int width, int height) {
  constexpr double kFocalShare = 0.9, kBaseline_m = 0.06;
  const double f = kFocalShare * width;
  return {{f, f, 0.5 * (width - 1), 0.5 * (height - 1), width, height}, kBaseline_m, 0.0};
}

StereoRig scaled(const StereoRig& rig, double factor) {
  StereoRig out = rig;
  Pinhole& left = out.left;
  left.fx *= factor;
  left.fy *= factor;
  // Pixel centres are at integers.
  left.cx = factor * (left.cx + 0.5) - 0.5;
  left.cy = factor * (left.cy + 0.5) - 0.5;
  left.width = static_cast<int>(std::lround(factor * left.width));
  left.height = static_cast<int>(std::lround(factor * left.height));
  out.doffs_px *= factor;
  return out;
}

Result<DepthMap> PairSequence::depth(const StereoPair& pair, const Work& work) {
  StereoPair less{small(pair.left, options_.most_pixels), small(pair.right, options_.most_pixels), {}};
  if (exchanged_) std::swap(less.left, less.right);
  const int width = less.left.width;
  less.rig = scaled(pair.rig.value(), static_cast<double>(width) / pair.left.width);
  const bool is_first = greatest_px_ == 0;
  Raster<float> disparity_px, confirmed;
  if (is_first || less.left.height != height_ || less.left.width != less.right.width ||
      less.left.height != less.right.height || ++since_search_ >= options_.search_every) {
    auto matched = match(less, StereoMethod::fast, {}, work);
    if (!matched) return std::move(matched).error();
    // Only the first pair decides which camera is the left one.
    if (matched->exchanged && is_first && !std::exchange(exchanged_, true)) return depth(pair, work);
    disparity_px = std::move(matched->disparity.disparity_px);
    confirmed = std::move(matched->confirmed);
    since_search_ = 0;
    height_ = less.left.height;
  } else {
    MatchInput input = prepare_pictures(less, work);
    const int most = 4 + static_cast<int>((1.0 + options_.growth) * greatest_px_);
    input.disparities = std::min(most, width - 1) + 1;
    auto matched = match_fast(input, {}, work);
    if (!matched) return std::move(matched).error();
    disparity_px = std::move(matched->disparity_px);
    confirmed = std::move(matched->confirmed);
  }
  forget_unconfirmed(confirmed, disparity_px);
  greatest_px_ = std::max(1, greatest(disparity_px));
  return *depth_from_disparity({std::move(disparity_px), less.rig});
}

}  // namespace palpable::vision
