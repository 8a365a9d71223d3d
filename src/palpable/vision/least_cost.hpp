// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable::vision {

/// The least of a pixel's costs, the first place that has it, and the least elsewhere than there and beside
/// it (the largest number where there is nothing elsewhere).
struct LeastCost {
  int at = 0;
  std::int32_t cost = 0;
  std::int32_t elsewhere = 0;
};

/// `count` >= 1 costs. Runs in vectors.
LeastCost least_cost(const std::int32_t* costs, int count);

/// Where `costs` are below `least`, they and the place `from` replace what is known there. All arrays have
/// `count` items and do not overlap.
void keep_least(const std::int32_t* costs, std::int32_t from, int count, std::int32_t* least,
                std::int32_t* least_from);

/// The same for costs and places of 16 bits.
void keep_least(const std::uint16_t* costs, std::uint16_t from, int count, std::uint16_t* least,
                std::uint16_t* least_from);

/// The first place of the least of `count` >= 1 costs, at most 32767 of them.
int least_at(const std::uint16_t* costs, int count);

}  // namespace palpable::vision
