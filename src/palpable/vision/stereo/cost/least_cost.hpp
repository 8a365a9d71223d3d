// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable::vision {

/// The least of a pixel's costs, its first index, and the least cost elsewhere, excluding that index and its
/// neighbours (the largest number if there is none).
struct LeastCost {
  int at = 0;
  int cost = 0;
  int elsewhere = 0;
};

/// For 1 to 32767 costs. Vectorised.
LeastCost least_cost(const std::uint16_t* costs, int count);

/// Where `costs` are below `least`, sets `least` to them and `least_from` to `from`. All arrays have `count`
/// items and do not overlap.
void keep_least(const std::uint16_t* costs, std::uint16_t from, int count, std::uint16_t* least,
                std::uint16_t* least_from);

/// The first index of the least of 1 to 32767 costs.
int least_at(const std::uint16_t* costs, int count);

}  // namespace palpable::vision
