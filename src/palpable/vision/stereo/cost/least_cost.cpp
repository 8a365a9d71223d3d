// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/least_cost.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

namespace palpable::vision {

namespace {

constexpr std::uint16_t kLargest = std::numeric_limits<std::uint16_t>::max();

// Indices are 16-bit lanes too, which the compiler does not find by itself.
constexpr int kLanes = 32;
using Lanes = std::uint16_t __attribute__((vector_size(2 * kLanes)));

struct AllLanes {
  std::array<std::uint16_t, kLanes> of;
  [[gnu::always_inline]] std::uint16_t least() const {
    std::uint16_t least = kLargest;
    for (const std::uint16_t value : of) least = value < least ? value : least;
    return least;
  }
};

constexpr AllLanes kPlaces = [] {
  AllLanes places{};
  for (std::size_t i = 0; i < places.of.size(); ++i) places.of[i] = static_cast<std::uint16_t>(i);
  return places;
}();

[[gnu::always_inline]] inline LeastCost find_least(const std::uint16_t* costs, int count) {
  const int whole = count / kLanes * kLanes;
  Lanes least = Lanes{} + kLargest;
  for (int d = 0; d < whole; d += kLanes) {
    Lanes here;
    std::memcpy(&here, costs + d, sizeof here);
    least = here < least ? here : least;
  }
  AllLanes lanes;
  std::memcpy(&lanes, &least, sizeof lanes);
  std::uint16_t cost = lanes.least();
  for (int d = whole; d < count; ++d) cost = costs[d] < cost ? costs[d] : cost;

  Lanes place;
  std::memcpy(&place, &kPlaces, sizeof place);
  Lanes found = Lanes{} + kLargest;
  for (int d = 0; d < whole; d += kLanes) {
    Lanes here;
    std::memcpy(&here, costs + d, sizeof here);
    const Lanes candidate = here == cost ? place : Lanes{} + kLargest;
    found = candidate < found ? candidate : found;
    place += static_cast<std::uint16_t>(kLanes);
  }
  std::memcpy(&lanes, &found, sizeof lanes);
  int at = lanes.least();
  if (at == kLargest)
    for (at = whole; costs[at] != cost;) ++at;
  return {at, cost, kLargest};
}

}  // namespace

PALPABLE_VECTORIZE LeastCost least_cost(const std::uint16_t* costs, int count) {
  LeastCost out = find_least(costs, count);
  const int whole = count / kLanes * kLanes;
  const auto before = static_cast<std::uint16_t>(out.at - 1);
  Lanes place;
  std::memcpy(&place, &kPlaces, sizeof place);
  Lanes least = Lanes{} + kLargest;
  for (int d = 0; d < whole; d += kLanes) {
    Lanes here;
    std::memcpy(&here, costs + d, sizeof here);
    const Lanes apart = place - before;
    const Lanes elsewhere = apart > std::uint16_t{2} ? here : Lanes{} + kLargest;
    least = elsewhere < least ? elsewhere : least;
    place += static_cast<std::uint16_t>(kLanes);
  }
  AllLanes lanes;
  std::memcpy(&lanes, &least, sizeof lanes);
  out.elsewhere = lanes.least();
  for (int d = whole; d < count; ++d)
    if (d < out.at - 1 || d > out.at + 1) out.elsewhere = costs[d] < out.elsewhere ? costs[d] : out.elsewhere;
  return out;
}

PALPABLE_VECTORIZE void keep_least(const std::uint16_t* __restrict costs, std::uint16_t from, int count,
                                   std::uint16_t* __restrict least, std::uint16_t* __restrict least_from) {
  for (int d = 0; d < count; ++d) {
    const std::uint16_t known = least[d];
    least_from[d] = costs[d] < known ? from : least_from[d];
    least[d] = costs[d] < known ? costs[d] : known;
  }
}

PALPABLE_VECTORIZE int least_at(const std::uint16_t* costs, int count) { return find_least(costs, count).at; }

}  // namespace palpable::vision
