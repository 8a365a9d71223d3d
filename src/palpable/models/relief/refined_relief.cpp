// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/refined_relief.hpp"

#include <algorithm>

namespace palpable::models {

RefinedRelief::RefinedRelief(std::shared_ptr<const Relief> relief, std::shared_ptr<const FinerCells> cells)
    : relief_(std::move(relief)),
      cells_(std::move(cells)),
      pixels_per_m_(1.0 / relief_->pixel_m()),
      middle_x_px_(0.5 * (relief_->samples_m().width() - 1)),
      middle_y_px_(0.5 * (relief_->samples_m().height() - 1)),
      inside_x_px_(relief_->samples_m().width() - 2),
      inside_y_px_(relief_->samples_m().height() - 2),
      steepest_slope_(relief_->steepest_slope()) {
  if (cells_ != nullptr)
    steepest_slope_ = std::max(steepest_slope_, cells_->steepest_per_pixel() * pixels_per_m_);
}

std::size_t RefinedRelief::memory_bytes() const {
  return relief_->memory_bytes() + (cells_ != nullptr ? cells_->memory_bytes() : 0);
}

}  // namespace palpable::models
