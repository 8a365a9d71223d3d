// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cstddef>
#include <vector>

namespace palpable::sculpt {

/// Which pairs of places are compared.
struct DepthOrderOptions {
  /// Random pairs, always the same ones; 100 … 10000000.
  int pairs = 20000;
  /// The places of a pair near each other are at most this share of the longer side apart. 0 … 1.
  double nearby = 0.03;
  /// A pair has an order if its depths differ by more than this share of the picture's depth range. 0 … 1.
  double least_depth = 0.1;
  /// Heights that differ by less than this share of the relief's height are equal. 0 … 1.
  double least_height = 0.01;
};
std::vector<Parameter> parameters_of(DepthOrderOptions& options);

/// How a relief keeps the order of the depth that it was made from: shares of the pairs that have an order.
/// Their sum is 1.
struct DepthOrder {
  /// The nearer place is the higher one.
  double kept = 1.0;
  /// The nearer place is the lower one.
  double inverted = 0.0;
  /// Both have the same height.
  double equal = 0.0;
  /// Pairs that have an order; 0 for a level picture, of which everything is kept.
  std::size_t pairs = 0;
};

/// The order of any two places, and of two that are near each other: an operator may lose one and keep the
/// other.
struct DepthOrders {
  DepthOrder anywhere;
  DepthOrder nearby;
};

/// Compares two rasters of the same size, without NaN: nearness (greater is nearer, any unit) and height
/// (greater is higher, any unit). The options are in their ranges. Any thread.
DepthOrders depth_orders(const Raster<float>& nearness, const Raster<float>& height,
                         const DepthOrderOptions& options = {});

}  // namespace palpable::sculpt
