// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/head_finder.hpp"

#include "palpable/vision/depth_camera/clean_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpable::vision {
namespace {

/// A depth picture that is asked for readings by places.
class DepthView {
 public:
  DepthView(const Raster<float>& depth_m, const DownwardCamera& camera)
      : depth_m_(depth_m), camera_(camera) {}

  /// How far ahead what is seen towards a place is: nullopt outside of the picture; NaN if unknown.
  std::optional<double> ahead_m(Vec3 towards) const {
    const auto [column, row, z] = camera_.pixel(towards);
    const double u = std::round(column), v = std::round(row);
    if (!(z > 0.0 && u >= 0.0 && v >= 0.0 && u < depth_m_.width() && v < depth_m_.height()))
      return std::nullopt;
    return place(static_cast<int>(u), static_cast<int>(v)).z;
  }
  Vec3 place(int x, int y) const { return static_cast<double>(depth_m_(x, y)) * camera_.ray(x, y); }
  const Raster<float>& depth_m() const { return depth_m_; }

 private:
  const Raster<float>& depth_m_;
  DownwardCamera camera_;
};

/// Share of the places above and beside a head behind which there is nothing near; places beyond the
/// picture's border and those hidden by something nearer say nothing. 0 if most of them say nothing.
double free_share(const DepthView& view, Vec3 middle, double size, const HeadShape& shape) {
  constexpr int kPlaces = 16;
  constexpr double kAway = 1.5, kBelow_rad = 0.4, kBehind_m = 0.05, kBefore_m = 0.2;
  int told = 0, free = 0;
  for (int k = 0; k < kPlaces; ++k) {
    const double angle =
        -kBelow_rad + (std::numbers::pi + 2.0 * kBelow_rad) * static_cast<double>(k) / (kPlaces - 1);
    const Vec3 away{std::cos(angle) * kAway * size * shape.half_m.x,
                    -std::sin(angle) * kAway * size * shape.half_m.y, 0.0};
    const auto z = view.ahead_m(middle + away);
    if (!z || *z < middle.z - kBefore_m) continue;
    ++told;
    // Also true for unknown depth: beside a head many cameras see nothing.
    if (!(*z < middle.z + kBehind_m)) ++free;
  }
  return 2 * told >= kPlaces ? static_cast<double>(free) / told : 0.0;
}

/// Whether there are shoulders or a chest below a head, as far as the picture shows what is there.
bool has_body(const DepthView& view, Vec3 middle, double size) {
  constexpr double kBehind_m = 0.25, kBefore_m = 0.4;
  int body = 0, nothing = 0;
  for (const double x : {-0.14, -0.07, 0.0, 0.07, 0.14})
    for (const double y : {0.24, 0.3}) {
      const auto z = view.ahead_m(middle + size * Vec3{x, y, 0.0});
      if (!z || !std::isfinite(*z)) continue;
      if (*z > middle.z + kBehind_m)
        ++nothing;
      else if (*z > middle.z - kBefore_m)
        ++body;
    }
  return body >= nothing;
}

/// Whether what is around a pixel of a reduced picture is of a head's size, and round.
bool is_round(const DepthView& view, Vec3 front, const HeadShape& shape) {
  constexpr int kAngles = 8;
  constexpr double kInner = 0.35, kOuter = 0.75, kLeastRise_m = 0.008, kMostRise_m = 0.07, kOne_m = 0.1;
  std::array<double, 2> sum_m{};
  std::array<int, 2> known{};
  int unknown = 0;
  for (int ring = 0; ring < 2; ++ring)
    for (int k = 0; k < kAngles; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAngles;
      const double away = ring == 0 ? kInner : kOuter;
      const auto z = view.ahead_m(front + Vec3{away * std::cos(angle) * shape.half_m.x,
                                               away * std::sin(angle) * shape.half_m.y, 0.0});
      if (!z) return false;
      const auto r = static_cast<std::size_t>(ring);
      if (!std::isfinite(*z)) {
        ++unknown;
      } else if (std::abs(*z - front.z) > kOne_m) {
        // A nose and the neck may be, but not more.
        if (ring == 0 || ++unknown > kAngles / 2) return false;
      } else {
        sum_m[r] += *z, ++known[r];
      }
    }
  if (unknown > kAngles / 2 || known[0] < kAngles / 2 || known[1] < kAngles / 2) return false;
  const double rise_m = sum_m[1] / known[1] - sum_m[0] / known[0];
  return rise_m > kLeastRise_m && rise_m < kMostRise_m;
}

bool is_head(const HeadFit& fit) {
  // What is flat, as a head rest, is nearer to a plane than to the ellipsoid.
  constexpr double kCovered = 0.45, kRms_m = 0.012, kOfPlane = 0.75, kSmall = 0.78, kLarge = 1.28;
  return fit.covered > kCovered && fit.rms_m < std::min(kRms_m, kOfPlane * fit.rms_of_plane_m) &&
         fit.size > kSmall && fit.size < kLarge;
}

double apart_m(const HeadFit& a, const HeadFit& b) { return norm(a.middle - b.middle); }

DownwardCamera reduced(const DownwardCamera& camera, int k, const Raster<float>& small) {
  const Pinhole& large = camera.pinhole;
  return {{large.fx / k, large.fy / k, (large.cx + 0.5) / k - 0.5, (large.cy + 0.5) / k - 0.5, small.width(),
           small.height()},
          camera.down_rad};
}

/// Places that may be the front of a head, each nearer than the next.
std::vector<Vec3> fronts_in(const DepthView& view, const HeadFinderOptions& options) {
  constexpr double kFree = 0.6, kApart_m = 0.12;
  struct Front {
    Vec3 at;
    double score;
  };
  std::vector<Front> fronts;
  for (int y = 0; y < view.depth_m().height(); ++y)
    for (int x = 0; x < view.depth_m().width(); ++x) {
      if (const double z = view.depth_m()(x, y); !(z >= options.near_m && z <= options.far_m)) continue;
      const Vec3 front = view.place(x, y);
      if (!is_round(view, front, options.shape)) continue;
      const Vec3 middle = front + Vec3{0.0, 0.0, options.shape.half_m.z};
      const double free = free_share(view, middle, 1.0, options.shape);
      if (free >= kFree && has_body(view, middle, 1.0)) fronts.push_back({front, free});
    }
  std::stable_sort(fronts.begin(), fronts.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<Vec3> apart;
  for (const Front& front : fronts)
    if (std::none_of(apart.begin(), apart.end(),
                     [&](Vec3 other) { return norm(front.at - other) < kApart_m; }))
      apart.push_back(front.at);
  std::stable_sort(apart.begin(), apart.end(), [](Vec3 a, Vec3 b) { return a.z < b.z; });
  return apart;
}

}  // namespace

std::vector<HeadFit> HeadFinder::search(const Raster<float>& depth_m, const DownwardCamera& camera) const {
  constexpr int kAcross = 160;
  constexpr std::size_t kMost = 12;
  constexpr double kReach_m = 0.08, kFree = 0.6, kOneHead_m = 0.15;
  const int k = std::max(1, depth_m.width() / kAcross);
  const auto small = reduced_depth(depth_m, k, options_.noise);
  auto fronts = fronts_in(DepthView(small, reduced(camera, k, small)), options_);
  if (fronts.size() > kMost) fronts.resize(kMost);
  const DepthView view(depth_m, camera);
  std::vector<HeadFit> heads;
  for (const Vec3& front : fronts) {
    const Point<LevelFrame> middle{front + Vec3{0.0, 0.0, options_.shape.half_m.z}};
    const auto fit = fit_head(depth_m, camera, middle, kReach_m, options_.shape);
    if (!fit || !is_head(*fit) || free_share(view, fit->middle.v, fit->size, options_.shape) < kFree ||
        !has_body(view, fit->middle.v, fit->size))
      continue;
    if (std::none_of(heads.begin(), heads.end(),
                     [&](const HeadFit& other) { return apart_m(*fit, other) < kOneHead_m; }))
      heads.push_back(*fit);
  }
  return heads;
}

std::optional<HeadFit> HeadFinder::follow(const Raster<float>& depth_m, const DownwardCamera& camera) const {
  // A head moves by less from one picture to the next.
  constexpr double kReach_m = 0.06, kFree = 0.5;
  if (!last_) return std::nullopt;
  const auto fit = fit_head(depth_m, camera, last_->middle, kReach_m, options_.shape);
  if (!fit || !is_head(*fit)) return std::nullopt;
  const DepthView view(depth_m, camera);
  return free_share(view, fit->middle.v, fit->size, options_.shape) >= kFree ? fit : std::nullopt;
}

std::optional<FoundHead> HeadFinder::find(const Raster<float>& depth_m, const DownwardCamera& camera) {
  /// The whole picture is searched for further heads once in so many pictures.
  constexpr int kLookAround = 30;
  auto head = follow(depth_m, camera);
  if (!head || pictures_ % kLookAround == 0) {
    const auto heads = search(depth_m, camera);
    heads_ = static_cast<int>(heads.size());
    if (!head && !heads.empty())
      head = last_ ? *std::min_element(heads.begin(), heads.end(),
                                       [&](const HeadFit& a, const HeadFit& b) {
                                         return apart_m(a, *last_) < apart_m(b, *last_);
                                       })
                   : heads.front();
  }
  ++pictures_;
  last_ = head;
  if (!head) return std::nullopt;
  // Who looks at the screen faces the camera, but not up to it.
  const Vec3 at = head->middle.v;
  const Vec3 towards = unit(Vec3{-at.x, 0.0, -at.z});
  const Vec3 eyes = at + head->size * (options_.shape.eyes_before_m * towards -
                                       Vec3{0.0, options_.shape.eyes_above_m, 0.0});
  return FoundHead{{eyes}, std::max(1, heads_)};
}

}  // namespace palpable::vision
