// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/matched_source.hpp"

#include "palpable/vision/stereo/methods/pair_sequence.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace palpable::session {
namespace {

/// The rig for pictures of this size. Errors: invalid_input for other proportions.
Result<StereoRig> rig_for(const StereoRig& rig, const Image& picture) {
  if (rig.left.width <= 0) return rig;
  const double factor = static_cast<double>(picture.width) / rig.left.width;
  StereoRig suited = vision::scaled(rig, factor);
  if (std::abs(suited.left.height - picture.height) <= 1) return suited;
  return invalid_input("the calibration is for pictures of " + size_text(rig.left.width, rig.left.height) +
                       " pixels, but the live ones have " + size_text(picture.width, picture.height));
}

class MatchedSource final : public LiveSource {
 public:
  MatchedSource(std::unique_ptr<PairSource> pairs, std::optional<StereoRig> rig, const Work& work)
      : pairs_(std::move(pairs)), rig_(std::move(rig)), work_(work) {
    work_.progress = {};
  }

  Result<std::optional<LiveFrame>> take(std::chrono::steady_clock::time_point deadline) override {
    auto taken = pairs_->take(deadline);
    if (!taken) return std::move(taken).error();
    if (!*taken) return std::optional<LiveFrame>();
    vision::StereoPair pair{std::move((*taken)->left), std::move((*taken)->right), {}};
    const auto& known = rig_ ? rig_ : (*taken)->rig;
    auto rig = known ? rig_for(*known, pair.left)
                     : Result<StereoRig>(vision::assumed_rig(pair.left.width, pair.left.height));
    if (!rig) return std::move(rig).error();
    pair.rig = *rig;
    auto depth = sequence_.depth(pair, work_);
    if (!depth) return std::move(depth).error();
    if (depth->camera) scale_px_m_ = depth->camera->fx * rig->baseline_m;
    colour_ = std::move(sequence_.exchanged() ? pair.right : pair.left);
    LiveFrame frame{(*taken)->number, (*taken)->arrival, *std::move(depth)};
    frame.stamp_s = (*taken)->stamp_s;
    return std::optional(std::move(frame));
  }

  bool has_ended() const override { return pairs_->has_ended(); }
  std::optional<Image> colour() override { return colour_; }
  std::optional<std::string> loss() override { return pairs_->loss(); }
  std::optional<std::string> notice() override { return pairs_->notice(); }
  bool gives_depths() const override { return false; }
  std::string_view kind() const override { return "stereo camera"; }
  // The touch's own end stops the matching too, and comes with each of the user's.
  void begin(TouchSession& /*session*/) override { work_.cancel = &cancelled_; }
  void cancel() override { cancelled_ = true; }

  /// Depth z = f B / d, so an error of d is one of z^2 / (f B) times it.
  vision::DepthNoise noise() const override {
    constexpr double kDisparity_px = 0.25, kMost_per_m2 = 0.1;
    vision::DepthNoise noise;
    if (scale_px_m_ > 0.0) noise.per_m2 = std::min(kDisparity_px / scale_px_m_, kMost_per_m2);
    return noise;
  }

 private:
  std::unique_ptr<PairSource> pairs_;
  std::optional<StereoRig> rig_;
  Work work_;
  std::atomic<bool> cancelled_{false};
  vision::PairSequence sequence_;
  std::optional<Image> colour_;
  /// Focal length times baseline, as the depths have it; 0 before the first.
  double scale_px_m_ = 0.0;
};

}  // namespace

std::unique_ptr<LiveSource> matched_source(std::unique_ptr<PairSource> pairs, std::optional<StereoRig> rig,
                                           const Work& work) {
  return std::make_unique<MatchedSource>(std::move(pairs), std::move(rig), work);
}

}  // namespace palpable::session
