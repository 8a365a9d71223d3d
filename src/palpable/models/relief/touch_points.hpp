// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/relief/rolling_contact.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::models {

/// Where a ball that rolls over a relief touches it: all contacts that may carry it at each sample and around
/// it, and from these the height of its centre at any position, max over |d| <= r of z(p + d) + sqrt(r^2 -
/// |d|^2). Immutable; any thread.
class TouchPoints {
 public:
  /// Searches the contacts above each sample. `relief` must outlive the object; radius_m > 0. Long work:
  /// reports progress, polls cancel.
  TouchPoints(const Relief& relief, double radius_m, const Work& work);

  /// Heights of the centre at the samples.
  const Raster<float>& centre_m() const { return centre_m_; }

  /// The contacts of the four corners of the cell right of and below sample (i, j).
  void of_cell(int i, int j, std::vector<TouchPoint>& points) const;

  /// Height of the centre above (x_m, y_m), which is in the cell of these contacts.
  double centre_m(std::span<const TouchPoint> points, double x_m, double y_m) const;

 private:
  std::span<const TouchPoint> of_sample(int x, int y) const;
  double x_m(int x) const { return (x - 0.5 * (centre_m_.width() - 1)) * relief_.pixel_m(); }
  double y_m(int y) const { return (0.5 * (centre_m_.height() - 1) - y) * relief_.pixel_m(); }

  const Relief& relief_;
  double radius_m_;
  Raster<float> centre_m_;
  /// The contacts, sample by sample in each row, the best one first, and where each row and sample begins.
  std::vector<std::vector<TouchPoint>> rows_;
  Raster<std::uint32_t> begin_;
};

}  // namespace palpable::models
