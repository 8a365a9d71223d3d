// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace palpable::haptics {

/// Contact properties of a surface at one point. All finite and >= 0.
struct Contact {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double static_friction = 0.0;
  double dynamic_friction = 0.0;
};

/// Maps positions on a relief's rectangle to materials, for the tick. Immutable.
class MaterialMap {
 public:
  /// One material everywhere.
  explicit MaterialMap(Contact everywhere) { contacts_.fill(everywhere); }
  /// `labels` (empty: label 0 everywhere) cover the rectangle of size_x_m x size_y_m around the origin. Label
  /// k has the properties contacts[k].
  MaterialMap(const std::array<Contact, 256>& contacts, Raster<std::uint8_t> labels, double size_x_m,
              double size_y_m)
      : contacts_(contacts),
        labels_(std::move(labels)),
        labels_per_m_x_(labels_.width() / size_x_m),
        labels_per_m_y_(labels_.height() / size_y_m) {}

  bool has_labels() const noexcept { return !labels_.empty(); }
  const Contact& contact(std::uint16_t label) const noexcept { return contacts_[label & 0xFFU]; }
  /// The label at a position; outside the rectangle, that of the nearest edge. Tick path.
  std::uint16_t label_at(double x_m, double y_m) const noexcept {
    if (labels_.empty()) return 0;
    return labels_(held(0.5 * labels_.width() + x_m * labels_per_m_x_, labels_.width()),
                   held(0.5 * labels_.height() - y_m * labels_per_m_y_, labels_.height()));
  }
  std::size_t memory_bytes() const noexcept { return sizeof(*this) + labels_.count(); }

 private:
  static int held(double place, int count) noexcept {
    return place > 0.0 ? (place < count - 1 ? static_cast<int>(place) : count - 1) : 0;
  }

  std::array<Contact, 256> contacts_;
  Raster<std::uint8_t> labels_;
  double labels_per_m_x_ = 0.0;
  double labels_per_m_y_ = 0.0;
};

}  // namespace palpable::haptics
