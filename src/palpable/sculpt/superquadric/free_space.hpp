// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

struct FreeSpaceOptions {
  /// Pixels on the longer side of a picture of the points, at most. 16 … 4096.
  int most_pixels = 512;
  /// Gaps between the points up to twice this width are closed, and a shape may lie outside of a silhouette
  /// by this much, pixels. 1 … 16.
  int closed_px = 2;
  /// The points that are drawn, at most. 12 … 1e7.
  int drawn_points = 60000;
};

std::vector<Parameter> parameters_of(FreeSpaceOptions& options);

/// Space that is seen to be empty: what the lines of sight to the points pass, and what lies outside of the
/// points' silhouette. Immutable; any thread.
class FreeSpace {
 public:
  /// `eye`: the position from which all points (metres, at least one) were seen; without one they are dense
  /// all around a solid, which is then drawn from 14 directions (space carving, Kutulakos and Seitz 2000).
  /// `slack_m`: how far in front of the points space does not count as free.
  FreeSpace(std::span<const Vec3> all_m, const std::optional<Point<SceneFrame>>& eye, double slack_m,
            const FreeSpaceOptions& options);

  /// How far `p` lies within the free space, metres, along a picture's plane or its line of sight: at least
  /// the distance to a place that is not free. 0 elsewhere.
  double depth_m(Vec3 p) const;
  double slack_m() const { return slack_m_; }

  /// At most `most` free places around points, up to `reach_m` away; the nearer the denser. Deterministic.
  std::vector<Vec3> places_around(std::span<const Vec3> points_m, double reach_m, std::size_t most,
                                  std::uint64_t seed) const;

 private:
  /// A picture of the points, by an eye or along a direction.
  struct Picture {
    Vec3 origin_m;
    std::array<Vec3, 3> axes;  // right, down, ahead
    bool central = false;
    double pixel = 0.0;  // metres, or of a central picture at unit depth
    double left = 0.0, top = 0.0;
    /// Of each pixel: the least depth around it, metres, where the silhouette is; and the pixels to the
    /// silhouette.
    Raster<float> depth_m, outside_px;

    struct Place {
      double u, v, depth_m;
    };
    Place place_of(Vec3 p) const;
  };
  static Picture picture_of(std::span<const Vec3> points_m, Picture frame, double least_pixel_m,
                            const FreeSpaceOptions& options);
  /// How far a place is from the silhouette, and in front of what is seen, metres.
  struct Depths {
    double outside_m = 0.0, in_front_m = 0.0;
  };
  Depths depths_in(const Picture& picture, Vec3 p) const;

  /// Pictures that must see a place in front of the points, where there are several: one or two may look into
  /// a solid through a hole of its scan.
  static constexpr std::size_t kWitnesses = 3;

  std::vector<Picture> pictures_;
  double slack_m_;
  double closed_px_;
};

/// The share of a shape's surface that lies in free space by more than its slack, and the mean depth of the
/// surface in it, metres.
struct SurfaceBeyond {
  double share = 0.0;
  double mean_m = 0.0;
};
SurfaceBeyond surface_beyond(const FreeSpace& space, const models::Superquadric& shape);

/// The shape with its ends moved inwards, one step at a time, until at most `share` of its surface lies in
/// free space; nullopt if that would take more than two thirds of one of its axes, or nearly a third of its
/// surface is there.
std::optional<models::Superquadric> trimmed(const FreeSpace& space, models::Superquadric shape, double share);

}  // namespace palpable::sculpt
