// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Inverse depths of points, in any unit, and how uncertain each is (the same unit).
struct PointDepths {
  std::vector<double> nearness;
  std::vector<double> uncertainty;
};

/// Whether other inverse depths of the same points agree on which of two points is nearer: the share of
/// agreeing pairs less that of the others, of the pairs that differ by more than their uncertainties (Goodman
/// & Kruskal's gamma), -1 … 1. 0 without such pairs. At most 300 points are compared. Values are finite.
double order_agreement(const PointDepths& depths, const std::vector<double>& other);

}  // namespace palpable::vision
