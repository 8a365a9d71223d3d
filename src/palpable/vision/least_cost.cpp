// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/least_cost.hpp"

#include "palpable/core/vectorize.hpp"

#include <limits>

namespace palpable::vision {

PALPABLE_VECTORIZE LeastCost least_cost(const std::int32_t* __restrict costs, int count) {
  constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();
  std::int32_t least = kLargest;
  for (int d = 0; d < count; ++d) least = costs[d] < least ? costs[d] : least;
  std::int32_t at = count;
  for (int d = 0; d < count; ++d) {
    const std::int32_t here = costs[d] == least ? d : count;
    at = here < at ? here : at;
  }
  std::int32_t elsewhere = kLargest;
  for (int d = 0; d < count; ++d) {
    const std::int32_t here = d >= at - 1 && d <= at + 1 ? kLargest : costs[d];
    elsewhere = here < elsewhere ? here : elsewhere;
  }
  return {at, least, elsewhere};
}

PALPABLE_VECTORIZE void keep_least(const std::int32_t* __restrict costs, std::int32_t from, int count,
                                   std::int32_t* __restrict least, std::int32_t* __restrict least_from) {
  for (int d = 0; d < count; ++d) {
    const std::int32_t known = least[d];
    least_from[d] = costs[d] < known ? from : least_from[d];
    least[d] = costs[d] < known ? costs[d] : known;
  }
}

PALPABLE_VECTORIZE void keep_least(const std::uint16_t* __restrict costs, std::uint16_t from, int count,
                                   std::uint16_t* __restrict least, std::uint16_t* __restrict least_from) {
  for (int d = 0; d < count; ++d) {
    const std::uint16_t known = least[d];
    least_from[d] = costs[d] < known ? from : least_from[d];
    least[d] = costs[d] < known ? costs[d] : known;
  }
}

PALPABLE_VECTORIZE int least_at(const std::uint16_t* __restrict costs, int count) {
  std::uint16_t least = 65535;
  for (int d = 0; d < count; ++d) least = costs[d] < least ? costs[d] : least;
  std::uint16_t at = 65535;
  for (int d = 0; d < count; ++d) {
    const std::uint16_t here = costs[d] == least ? static_cast<std::uint16_t>(d) : std::uint16_t{65535};
    at = here < at ? here : at;
  }
  return at;
}

}  // namespace palpable::vision
