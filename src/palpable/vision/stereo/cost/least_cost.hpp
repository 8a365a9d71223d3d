// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable::vision {

/// The least of a pixel's costs, the first place that has it, and the least elsewhere than there and beside
/// it (the largest number where there is nothing elsewhere).
struct LeastCost {
  int at = 0;
  int cost = 0;
  int elsewhere = 0;
};

/// 1 to 32767 costs. Runs in vectors.
LeastCost least_cost(const std::uint16_t* costs, int count);

/// Where `costs` are below `least`, they and the place `from` replace what is known there. All arrays have
/// `count` items and do not overlap.
void keep_least(const std::uint16_t* costs, std::uint16_t from, int count, std::uint16_t* least,
                std::uint16_t* least_from);

/// The first place of the least of 1 to 32767 costs.
int least_at(const std::uint16_t* costs, int count);

}  // namespace palpable::vision
