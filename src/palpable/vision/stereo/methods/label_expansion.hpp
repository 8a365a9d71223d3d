// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A labelling problem on the pixel grid (Park & Howard 2012, eqs 1-5, corrected in docs/stereo.md):
/// E(f) = sum_p data(p, f_p) + sum_{p,q} weight(p, q) min(|f_p - f_q|, truncation), over the 8 neighbours,
/// each pair once, diagonal pairs weighted 1/sqrt 2.
struct GridEnergy {
  int width = 0;
  int height = 0;
  int labels = 0;
  /// data[(y * width + x) * labels + label]
  std::vector<std::uint8_t> data;
  /// Smoothness between (x, y) and its right, lower, lower right and lower left neighbour.
  Raster<float> right, down, down_right, down_left;
  float truncation = 2.0F;

  const std::uint8_t* costs(int x, int y) const {
    return data.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(labels);
  }
  double value(const Raster<int>& label) const;
};

/// Candidate labels: cells of kCell x kCell pixels, each with a flag for every label.
struct Candidates {
  static constexpr int kCell = 16;
  Candidates(int width, int height, int labels);
  std::uint8_t* of(int cell_x, int cell_y);
  const std::uint8_t* of(int cell_x, int cell_y) const;

  int columns;
  int rows;
  int labels;
  std::vector<std::uint8_t> flags;
};

/// Minimises the energy by expansion moves (Boykov, Veksler & Zabih 2001), each by a minimum cut: for every
/// label, the pixels of the cells where it is a candidate may take it. The picture is processed in strips,
/// every other one at a time, so that threads never change the same pixels and the result does not depend on
/// their number; later passes shift the strips' borders. `passes` >= 1.
void expand_labels(const GridEnergy& energy, const Candidates& candidates, int passes, Raster<int>& label,
                   const Work& work);

}  // namespace palpable::vision
