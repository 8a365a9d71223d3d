// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/sculpt/streets/map_grid.hpp"
#include "palpable/sculpt/streets/map_materials.hpp"
#include "palpable/sculpt/streets/special_place_options.hpp"
#include "palpable/sculpt/streets/tactile_rules.hpp"

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace palpable::sculpt {

/// The special buildings of a map on its plate.
class SpecialBuildings {
 public:
  /// They keep `gap_m` from what is `taken` (CV_8U, 0 or 255). A building is as wide as its symbol at least.
  SpecialBuildings(const StreetMap& map, const MapGrid& grid, const cv::Mat& taken, double gap_m,
                   const TactileRules& rules, const SpecialPlaceOptions& options);

  /// 255 where one is.
  const cv::Mat& mask() const { return mask_; }
  /// Removes what is outside of a mask.
  void keep(const cv::Mat& mask);
  /// The number of the place at a sample; -1 for none.
  int place_at(int x, int y) const { return place_.at<std::int32_t>(y, x); }
  /// For each place of the map whether something of it is there.
  std::vector<bool> felt() const;

 private:
  std::size_t count_;
  cv::Mat mask_;
  cv::Mat place_;
};

struct PlaceMarks {
  SpecialPlaceOptions options;
  TactileRules rules;
  /// Diameter of the texture of junctions, metres: other patches keep away from it.
  double junction_m = 0.003;
};

/// Gives the grooves of roundabouts, and patches at the other places, the labels of their materials:
/// crossings and stops in the nearest groove, entrances at the nearest building. A patch for which there is
/// no room beside an earlier one or a junction is not felt. Sets `felt` of these places.
void mark_places(const StreetMap& map, const MapGrid& grid, const PlaceMarks& marks,
                 const Raster<MapPart>& parts, const MapMaterials& materials, std::vector<bool>& felt,
                 Raster<std::uint8_t>& labels);

}  // namespace palpable::sculpt
