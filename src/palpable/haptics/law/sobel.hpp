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

/// A slope stored in a force image.
struct ImageSlope {
  float dzdx = 0.0F;
  float dzdy = 0.0F;
};

/// Shi & Pai's force image (1997, section 4): slopes of the half-size height map by a 5 x 5 Sobel operator,
/// read at the nearest pixel. It covers the relief's rectangle; a scene of 150 mm x 100 mm has the size of
/// the paper's 10 x 15 cm.
class SobelSlopes {
 public:
  explicit SobelSlopes(const models::Relief& relief);
  /// The slope at the nearest pixel; outside, at the nearest border pixel. Tick path.
  ImageSlope at(double x_m, double y_m) const noexcept;
  std::size_t memory_bytes() const noexcept { return sizeof(*this) + slopes_.count() * sizeof(ImageSlope); }
  const Raster<ImageSlope>& slopes() const noexcept { return slopes_; }

 private:
  Raster<ImageSlope> slopes_;
  double pixels_per_m_x_ = 0.0;
  double pixels_per_m_y_ = 0.0;
};

/// `sobel`: f = -k_g grad z - k_v v with the slopes of the force image. The force changes in steps from pixel
/// to pixel and is not conservative. For comparison with `rolling`.
class SobelLaw {
 public:
  struct State {};

  SobelLaw(std::shared_ptr<const models::Relief> relief, double slope_force_N, double damping_Ns_per_m)
      : relief_(std::move(relief)),
        slopes_(*relief_),
        slope_force_N_(slope_force_N),
        damping_Ns_per_m_(damping_Ns_per_m) {}

  LawOutput evaluate(const Hand& hand, State&) const noexcept;
  /// The relief's potential, whose slopes these are apart from the operator's errors. Energy that is
  /// generated beyond it is observed.
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

/// Reads every page of the slopes once.
void read_pages(const SobelSlopes& slopes) noexcept;

}  // namespace palpable::haptics
