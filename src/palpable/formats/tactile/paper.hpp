// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

namespace palpable::formats {

/// Paper that swell paper and braille paper are sold as.
enum class Paper : std::uint8_t { a4, a3 };

struct PaperSize {
  double width_m = 0.0;
  double height_m = 0.0;
};

/// How many steps fit into a length; a step that ends within a nanometre of its end fits.
inline int whole_steps(double length_m, double step_m) {
  constexpr double kNothing_m = 1e-9;
  return static_cast<int>((length_m + kNothing_m) / step_m);
}

/// Upright or across, whichever has room for the larger drawing of these proportions within the margin.
inline PaperSize paper_for(Paper paper, double width_m, double height_m, double margin_m) {
  const PaperSize upright = paper == Paper::a4 ? PaperSize{0.210, 0.297} : PaperSize{0.297, 0.420};
  const auto scale = [&](double wide_m, double high_m) {
    return std::min((wide_m - 2.0 * margin_m) / width_m, (high_m - 2.0 * margin_m) / height_m);
  };
  if (scale(upright.width_m, upright.height_m) >= scale(upright.height_m, upright.width_m)) return upright;
  return {upright.height_m, upright.width_m};
}

}  // namespace palpable::formats
