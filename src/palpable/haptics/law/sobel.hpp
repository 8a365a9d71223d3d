// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstddef>
#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kSobelLaw;

/// A slope as a force image holds it.
struct ImageSlope {
  float dzdx = 0.0F;
  float dzdy = 0.0F;
};

/// Shi & Pai's force image (1997, section 4): the heights at half size, their slopes by a 5 x 5 Sobel
/// operator, read at the nearest pixel. Covers the relief's rectangle; a scene of 150 mm x 100 mm
/// has the paper's 10 x 15 cm.
class SobelSlopes {
 public:
  explicit SobelSlopes(const models::Relief& relief);
  /// The slope of the nearest pixel; the border's outside. Tick path.
  ImageSlope at(double x_m, double y_m) const noexcept;
  std::size_t memory_bytes() const noexcept { return sizeof(*this) + slopes_.count() * sizeof(ImageSlope); }
  const Raster<ImageSlope>& slopes() const noexcept { return slopes_; }

 private:
  Raster<ImageSlope> slopes_;
  double pixels_per_m_x_ = 0.0;
  double pixels_per_m_y_ = 0.0;
};

/// `sobel`: f = -k_g grad z - k_v v with the force image's slopes. It steps from pixel to pixel and is not
/// conservative: kept to compare with `rolling`.
class SobelLaw {
 public:
  struct State {};

  SobelLaw(std::shared_ptr<const models::Relief> relief, double slope_force_N, double damping_Ns_per_m)
      : relief_(std::move(relief)),
        slopes_(*relief_),
        slope_force_N_(slope_force_N),
        damping_Ns_per_m_(damping_Ns_per_m) {}

  LawOutput evaluate(const Hand& hand, State&) const noexcept;
  /// The potential is that of the relief, whose slopes these are but for the operator's errors: what it makes
  /// beyond is counted.
  EnergyModel energy_model() const noexcept { return EnergyModel::weight; }
  const SobelSlopes& surface() const noexcept { return slopes_; }
  double damping_Ns_per_m() const noexcept { return damping_Ns_per_m_; }
  std::size_t memory_bytes() const noexcept { return slopes_.memory_bytes() + relief_->memory_bytes(); }

 private:
  std::shared_ptr<const models::Relief> relief_;
  SobelSlopes slopes_;
  double slope_force_N_;
  double damping_Ns_per_m_;
};

/// Reads every page of it once.
void read_pages(const SobelSlopes& slopes) noexcept;

}  // namespace palpable::haptics
